//! Jacobi's elliptic functions, by which the edge between two round members is smooth.
//!
//! With k the radius of the slimmer over that of the other, the edge is (r cn u, r sn u, R dn u) in
//! coordinates along the thicker one, across it, and away from it. All three stay smooth in u however
//! near k is to 1, where the edge by its angle turns sharply at the sides.
//!
//! # References
//!
//! * Abramowitz & Stegun, *Handbook of Mathematical Functions*, 16.4 and 17.6: by the
//!   arithmetic-geometric mean.

use std::f64::consts::PI;

/// The functions of one modulus.
#[derive(Clone, Debug)]
pub(super) struct Elliptic {
    /// The arithmetic means, the geometric ones, and half the differences of those before.
    means: Vec<[f64; 3]>,
}

/// The mean doubles its digits with each step: the modulus next below 1 takes eight.
const MOST_MEANS: usize = 16;

impl Elliptic {
    /// With modulus k, less than 1.
    pub(super) fn new(k: f64) -> Self {
        let mut means = vec![[1.0, ((1.0 - k) * (1.0 + k)).sqrt(), k]];
        while let [a, b, c] = means[means.len() - 1]
            && c > f64::EPSILON * a
            && means.len() < MOST_MEANS
        {
            means.push([0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b)]);
        }
        Self { means }
    }

    /// u of a full turn: 4 K(k).
    pub(super) fn turn(&self) -> f64 {
        2.0 * PI / self.means[self.means.len() - 1][0]
    }

    /// The angle at u, the amplitude: its sine is sn u, its cosine cn u.
    pub(super) fn angle(&self, u: f64) -> f64 {
        let last = self.means.len() - 1;
        let mut angle = self.means[last][0] * u * (1_u32 << last) as f64;
        for [a, _, c] in self.means[1..].iter().rev() {
            angle = 0.5 * (angle + (c / a * angle.sin()).asin());
        }
        angle
    }

    /// dn at an angle: its growth with u.
    pub(super) fn growth(&self, angle: f64) -> f64 {
        let [_, b, k] = self.means[0];
        b.hypot(k * angle.cos())
    }

    /// u at an angle, the integral of 1 / dn up to there.
    pub(super) fn at(&self, angle: f64) -> f64 {
        let last = self.means.len() - 1;
        let mut turned = angle;
        for [a, b, _] in &self.means[..last] {
            let halves = (turned / PI).round();
            turned += (b / a * turned.tan()).atan() + PI * halves;
        }
        turned / (self.means[last][0] * (1_u32 << last) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_of_a_turn_is_that_of_the_tables() {
        // Abramowitz & Stegun, table 17.1: K at m = k² = 0, 0.5, 0.99.
        for (m, quarter) in [(0.0, 0.5 * PI), (0.5, 1.854074677301), (0.99, 3.695637362989)] {
            let found = 0.25 * Elliptic::new(f64::sqrt(m)).turn();
            assert!((found - quarter).abs() < 1e-11, "{found} at {m}");
        }
    }

    #[test]
    fn angle_and_its_integral_undo_each_other() {
        for k in [1e-9, 0.3, 0.97, 1.0 - 1e-9] {
            let elliptic = Elliptic::new(k);
            for i in -12..=12 {
                let angle = 0.5 * f64::from(i);
                let back = elliptic.angle(elliptic.at(angle));
                // Near 90° the angle hardly grows with u.
                assert!((back - angle).abs() < 1e-10, "{back}, not {angle}, at {k}");
            }
            let turn = elliptic.angle(elliptic.turn());
            assert!((turn - 2.0 * PI).abs() < 1e-10, "{turn} at {k}");
        }
    }

    #[test]
    fn growth_is_that_of_the_angle() {
        let elliptic = Elliptic::new(0.9);
        let (u, step) = (1.3, 1e-5);
        let slope = (elliptic.angle(u + step) - elliptic.angle(u - step)) / (2.0 * step);
        assert!((slope - elliptic.growth(elliptic.angle(u))).abs() < 1e-9);
    }
}
