//! Counts in words, as messages to people need them.

/// `1 beam`, `2 beams`.
pub(crate) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::counted;

    #[test]
    fn only_one_is_one() {
        let of = |count| counted(count, "body", "bodies");
        assert_eq!([0, 1, 2].map(of), ["0 bodies", "1 body", "2 bodies"]);
    }
}
