//! Plain text: lines of ASCII.

/// A text on one line, with `?` for what is not printable ASCII.
pub(super) fn one_line(text: &str) -> String {
    text.chars().map(|c| if (' '..='~').contains(&c) { c } else { '?' }).collect()
}
