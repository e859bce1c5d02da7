//! Cubic splines through given values, one coordinate at a time.
//!
//! A spline is found in two steps: its second derivatives at the breaks (a
//! tridiagonal system), then the de Boor ordinates of the same function on the
//! clamped knots `t₀ t₀ t₀ t₀ t₁ … tₙ₋₁ tₙ tₙ tₙ tₙ`, which is how STEP wants
//! it.  Every ordinate is the blossom (polar form) of one cubic span at three
//! consecutive knots.
//!
//! # References
//!
//! * Ramshaw, *Blossoms are polar forms*, CAGD 6 (1989).
//! * Press et al., *Numerical Recipes*, §2.7.2: cyclic tridiagonal systems.

/// Second derivatives at the breaks of the closed C² spline through `values`.
///
/// `values[i]` is taken at `breaks[i]`; the first value returns at the last
/// break, so there is one value less than there are breaks, and three or more.
pub(super) fn closed_second_derivatives(breaks: &[f64], values: &[f64]) -> Vec<f64> {
    let n = values.len();
    let h: Vec<f64> = breaks.windows(2).map(|w| w[1] - w[0]).collect();
    let before = |i: usize| (i + n - 1) % n;
    let slope = |i: usize| (values[(i + 1) % n] - values[i]) / h[i];
    let corner = h[n - 1];
    let mut diagonal: Vec<f64> = (0..n).map(|i| 2.0 * (h[before(i)] + h[i])).collect();
    let mut m: Vec<f64> = (0..n).map(|i| 6.0 * (slope(i) - slope(before(i)))).collect();

    // Sherman–Morrison: the two corners as a rank-one change of the band.
    let gamma = -diagonal[0];
    diagonal[0] -= gamma;
    diagonal[n - 1] -= corner * corner / gamma;
    let mut z = vec![0.0; n];
    z[0] = gamma;
    z[n - 1] = corner;
    solve_tridiagonal(&h[..n - 1], &diagonal, &mut m);
    solve_tridiagonal(&h[..n - 1], &diagonal, &mut z);
    let ratio = corner / gamma;
    let factor = (m[0] + ratio * m[n - 1]) / (1.0 + z[0] + ratio * z[n - 1]);
    for (m, z) in m.iter_mut().zip(&z) {
        *m -= factor * z;
    }
    m.push(m[0]);
    m
}

/// Second derivatives at the breaks of the C² spline through `values` whose
/// ends are free to straighten (a natural spline).
pub(super) fn natural_second_derivatives(breaks: &[f64], values: &[f64]) -> Vec<f64> {
    let last = values.len() - 1;
    let h: Vec<f64> = breaks.windows(2).map(|w| w[1] - w[0]).collect();
    let slope = |i: usize| (values[i + 1] - values[i]) / h[i];
    let diagonal: Vec<f64> = (1..last).map(|i| 2.0 * (h[i - 1] + h[i])).collect();
    let mut inner: Vec<f64> = (1..last).map(|i| 6.0 * (slope(i) - slope(i - 1))).collect();
    if last > 1 {
        solve_tridiagonal(&h[1..last - 1], &diagonal, &mut inner);
    }
    std::iter::once(0.0).chain(inner).chain(std::iter::once(0.0)).collect()
}

/// Solves a symmetric tridiagonal system in place (Thomas).
///
/// Diagonally dominant by construction, so that no pivoting is needed.
fn solve_tridiagonal(side: &[f64], diagonal: &[f64], rhs: &mut [f64]) {
    let n = diagonal.len();
    let mut pivot = diagonal.to_vec();
    for i in 1..n {
        let factor = side[i - 1] / pivot[i - 1];
        pivot[i] -= factor * side[i - 1];
        rhs[i] -= factor * rhs[i - 1];
    }
    rhs[n - 1] /= pivot[n - 1];
    for i in (0..n - 1).rev() {
        rhs[i] = (rhs[i] - side[i] * rhs[i + 1]) / pivot[i];
    }
}

/// De Boor ordinates of a spline on clamped knots: two more than breaks.
///
/// `values` and `second` are the spline and its second derivative at each
/// break.
pub(super) fn clamped_ordinates(breaks: &[f64], values: &[f64], second: &[f64]) -> Vec<f64> {
    let spans = breaks.len() - 1;
    let knot = |i: usize| breaks[i.saturating_sub(2).min(spans)];
    (0..spans + 3)
        .map(|j| {
            let span = j.saturating_sub(2).min(spans - 1);
            let b = bezier_ordinates(
                [breaks[span], breaks[span + 1]],
                [values[span], values[span + 1]],
                [second[span], second[span + 1]],
            );
            blossom([breaks[span], breaks[span + 1]], b, [knot(j), knot(j + 1), knot(j + 2)])
        })
        .collect()
}

/// Bézier ordinates of the cubic with given end values and second derivatives.
fn bezier_ordinates([a, b]: [f64; 2], [y0, y1]: [f64; 2], [m0, m1]: [f64; 2]) -> [f64; 4] {
    let h = b - a;
    let chord = (y1 - y0) / h;
    let start = chord - h * (2.0 * m0 + m1) / 6.0;
    let end = chord + h * (m0 + 2.0 * m1) / 6.0;
    [y0, y0 + h * start / 3.0, y1 - h * end / 3.0, y1]
}

/// Polar form of a cubic over `[a, b]` at three parameters.
fn blossom([a, b]: [f64; 2], mut c: [f64; 4], at: [f64; 3]) -> f64 {
    for (round, t) in at.into_iter().enumerate() {
        let w = (t - a) / (b - a);
        for i in 0..3 - round {
            c[i] += w * (c[i + 1] - c[i]);
        }
    }
    c[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Value of the B-spline by its ordinates, from the Bézier form of a span.
    fn value(breaks: &[f64], ordinates: &[f64], t: f64) -> f64 {
        let spans = breaks.len() - 1;
        let i = (0..spans).rev().find(|&i| breaks[i] <= t).unwrap();
        let knot = |k: usize| breaks[k.saturating_sub(3).min(spans)];
        let mut d: Vec<f64> = ordinates[i..i + 4].to_vec();
        for round in 1..=3 {
            for j in (round..4).rev() {
                let (lo, hi) = (knot(i + j), knot(i + j + 4 - round));
                let w = (t - lo) / (hi - lo);
                d[j] = (1.0 - w) * d[j - 1] + w * d[j];
            }
        }
        d[3]
    }

    #[test]
    fn closed_spline_passes_through_its_values() {
        let breaks = [0.0, 0.7, 1.5, 2.0, 3.1, 4.0];
        let values = [1.0, 3.0, -2.0, 0.5, 2.0];
        let second = closed_second_derivatives(&breaks, &values);
        let around: Vec<f64> = values.iter().chain(&values[..1]).copied().collect();
        let ordinates = clamped_ordinates(&breaks, &around, &second);
        assert_eq!(ordinates.len(), breaks.len() + 2);
        for (t, y) in breaks.iter().zip(&around) {
            assert!((value(&breaks, &ordinates, *t) - y).abs() < 1e-12, "at {t}");
        }
    }

    #[test]
    fn natural_spline_reproduces_a_straight_line() {
        let breaks = [0.0, 0.2, 0.9, 1.0];
        let values = breaks.map(|t| 3.0 - 2.0 * t);
        let second = natural_second_derivatives(&breaks, &values);
        let ordinates = clamped_ordinates(&breaks, &values, &second);
        for t in [0.0, 0.1, 0.5, 0.95] {
            assert!((value(&breaks, &ordinates, t) - (3.0 - 2.0 * t)).abs() < 1e-14);
        }
    }

    #[test]
    fn natural_spline_through_two_values_is_their_chord() {
        let second = natural_second_derivatives(&[0.0, 2.0], &[1.0, 5.0]);
        assert_eq!(second, [0.0, 0.0]);
        let ordinates = clamped_ordinates(&[0.0, 2.0], &[1.0, 5.0], &second);
        assert!((value(&[0.0, 2.0], &ordinates, 0.5) - 2.0).abs() < 1e-15);
    }
}
