//! Gauss–Legendre rules on [0, 1].

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Exact for polynomials up to degree 9: all that cubic outlines lead to.
pub(super) static FIVE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| rule(5));

/// Exact to rounding for arcs of up to 45°.
pub(super) static SIXTEEN: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| rule(16));

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
    fn sixteen_nodes_integrate_a_cosine_over_45_degrees() {
        let sum: f64 = SIXTEEN.iter().map(|(x, w)| w * (x * PI / 4.0).cos()).sum();
        assert!((sum - (PI / 4.0).sin() / (PI / 4.0)).abs() < 1e-15);
    }
}
