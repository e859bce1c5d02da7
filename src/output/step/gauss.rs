//! Integration rules: Gauss–Legendre on [0, 1], and around a full turn.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Exact for polynomials up to degree 9: all that cubic outlines lead to.
pub(super) static FIVE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| rule(5));

/// Exact to rounding for arcs of up to 90°.
pub(super) static SIXTEEN: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| rule(16));

/// Cosine and sine of equally spaced angles: on a full turn they alone, with
/// equal weights, are exact for trigonometric polynomials up to degree 63.
pub(super) static TURN: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    let angle = |i: u32| 2.0 * PI * f64::from(i) / 64.0;
    (0..64).map(|i| (angle(i).cos(), angle(i).sin())).collect()
});

/// Nodes and weights of the `n`-point rule, by Newton's method on Pₙ.
fn rule(n: usize) -> Vec<(f64, f64)> {
    (0..n)
        .map(|i| {
            let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            for _ in 0..8 {
                let (p, slope) = legendre(n, x);
                x -= p / slope;
            }
            let (_, slope) = legendre(n, x);
            (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// Pₙ(x) and its derivative, by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut p) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k);
    }
    (p, n as f64 * (x * p - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_nodes_integrate_the_ninth_power() {
        let sum: f64 = FIVE.iter().map(|(x, w)| w * x.powi(9)).sum();
        assert!((sum - 0.1).abs() < 1e-16);
    }

    #[test]
    fn sixteen_nodes_integrate_a_cosine_over_90_degrees() {
        let sum: f64 = SIXTEEN.iter().map(|(x, w)| w * (x * PI / 2.0).cos()).sum();
        assert!((sum - 2.0 / PI).abs() < 1e-15);
    }

    #[test]
    fn turn_integrates_the_fourth_power_of_a_cosine() {
        let mean: f64 = TURN.iter().map(|(cos, _)| cos.powi(4)).sum::<f64>() / TURN.len() as f64;
        assert!((mean - 3.0 / 8.0).abs() < 1e-15);
    }
}
