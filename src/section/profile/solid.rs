//! Solid shapes: round, rectangle, ellipse.

use std::f64::consts::PI;

use nalgebra::Point2;

use super::super::outline::{Outline, Path};

/// A rectangle about the origin, its corners rounded by `r` (0: sharp).
pub(super) fn rectangle(b: f64, h: f64, r: f64) -> Outline {
    let (y, z) = (0.5 * b, 0.5 * h);
    let corners = [(-y, -z), (y, -z), (y, z), (-y, z)];
    Outline::Path(Path::rounded(&corners.map(|(y, z)| (Point2::new(y, z), r))))
}

/// J = π d⁴ / 32.
pub(super) fn round_torsion(d: f64) -> f64 {
    PI * d.powi(4) / 32.0
}

/// J = π a³ b³ / (a² + b²) with the half-axes a, b (Timoshenko and Goodier, §107).
pub(super) fn ellipse_torsion(b: f64, h: f64) -> f64 {
    let (a, b) = (0.5 * h, 0.5 * b);
    PI * (a * b).powi(3) / (a * a + b * b)
}

/// Terms of the series of the rectangle; they fall with n⁻⁵, the last is 1e-9 of the first.
const TERMS: usize = 32;

/// J = b³ h [⅓ − 64 b / (π⁵ h) Σ tanh(n π h / 2b) / n⁵] over odd n, b ≤ h (Timoshenko and
/// Goodier, §109).
pub(super) fn rectangle_torsion(b: f64, h: f64) -> f64 {
    let (b, h) = (b.min(h), b.max(h));
    let term = |k: usize| {
        let n = (2 * k + 1) as f64;
        (n * PI * h / (2.0 * b)).tanh() / n.powi(5)
    };
    let series: f64 = (0..TERMS).map(term).sum();
    b.powi(3) * h * (1.0 / 3.0 - 64.0 * b / (PI.powi(5) * h) * series)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Timoshenko and Goodier, Theory of Elasticity, §109, table of k₁ for h/b.
    #[test]
    fn rectangle_has_the_tabulated_k1() {
        let table = [(1.0, 0.1406), (1.2, 0.166), (1.5, 0.196), (2.0, 0.229), (2.5, 0.249)];
        let longer = [(3.0, 0.263), (4.0, 0.281), (5.0, 0.291), (10.0, 0.312)];
        for (ratio, k) in table.into_iter().chain(longer) {
            let j = rectangle_torsion(1.0, ratio) / ratio;
            assert!((j - k).abs() < 0.000_6, "{ratio}: {j}");
            assert_eq!(rectangle_torsion(ratio, 1.0), rectangle_torsion(1.0, ratio));
        }
    }

    #[test]
    fn ellipse_of_equal_axes_is_a_circle() {
        assert!((ellipse_torsion(3.0, 3.0) / round_torsion(3.0) - 1.0).abs() < 1e-14);
    }
}
