//! Counts and figures as messages and lists to people need them.

/// `1 beam`, `2 beams`.
pub(crate) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// Whether so many decimals show fewer than two digits of a number: of a bar of 0.0123 mm the one
/// decimal that is enough for frames shows none.
fn is_too_small(x: f64, decimals: usize) -> bool {
    x != 0.0 && x.abs() * 10f64.powi(decimals as i32) < 10.0
}

/// A number with so many decimals, or with three significant digits where those show too little.
pub(crate) fn figures(x: f64, decimals: usize) -> String {
    if !is_too_small(x, decimals) {
        return format!("{x:.decimals$}");
    }
    let exponent = format!("{x:.2e}");
    let plain: f64 = exponent.parse().unwrap_or(x);
    // A row of more than six noughts is no longer read.
    if plain.abs() < 1e-7 { exponent } else { plain.to_string() }
}

/// A number rounded to so many decimals, or to three significant digits where too few would be left.
pub(crate) fn rounded_figures(x: f64, decimals: usize) -> f64 {
    if is_too_small(x, decimals) {
        return format!("{x:.2e}").parse().unwrap_or(x);
    }
    rounded(x, decimals)
}

/// A number rounded to so many decimals.
pub(crate) fn rounded(x: f64, decimals: usize) -> f64 {
    let scale = 10f64.powi(decimals as i32);
    // Never −0.
    (x * scale).round() / scale + 0.0
}

#[cfg(test)]
mod tests {
    use super::{counted, figures, rounded_figures};

    #[test]
    fn figures_have_their_decimals_unless_too_little_is_seen() {
        assert_eq!(figures(182.04, 1), "182.0");
        assert_eq!(figures(1.25, 1), "1.2");
        assert_eq!(figures(0.25, 1), "0.25");
        assert_eq!(figures(0.0, 1), "0.0");
        assert_eq!(figures(0.012_345, 1), "0.0123");
        assert_eq!(figures(-0.000_5, 2), "-0.0005");
        assert_eq!(figures(1.234_56e-12, 0), "1.23e-12");
    }

    #[test]
    fn numbers_are_rounded_but_never_to_nothing() {
        assert_eq!(rounded_figures(182.040_6, 3), 182.041);
        assert_eq!(rounded_figures(1.234_56e-9, 6), 1.23e-9);
        assert_eq!(rounded_figures(0.0, 3), 0.0);
        assert!(rounded_figures(-0.0, 3).is_sign_positive());
    }

    #[test]
    fn only_one_is_one() {
        let of = |count| counted(count, "body", "bodies");
        assert_eq!([0, 1, 2].map(of), ["0 bodies", "1 body", "2 bodies"]);
    }
}
