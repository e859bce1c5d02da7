//! Plain text: lines of ASCII, and counts in words.

/// A text on one line, with `?` for what is not printable ASCII.
pub(super) fn one_line(text: &str) -> String {
    text.chars().map(|c| if (' '..='~').contains(&c) { c } else { '?' }).collect()
}

/// `1 beam`, `2 beams`.
pub(super) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
