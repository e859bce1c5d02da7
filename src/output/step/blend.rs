//! Cross-sections of a loft between its stations, where its sides are integrated.
//!
//! A side is S(u, v) = Σ Bₖ(v) eₖ(u), with the level curves eₖ of the stations and their shares Bₖ.

use nalgebra::{Point3, Vector3};

use super::levels::Levels;
use super::spline::natural_second_derivatives;

/// Points and derivatives along one piece of a level curve.
pub(super) type Samples = Vec<(Point3<f64>, Vector3<f64>)>;

/// Shares Bₖ(v) of the stations in one cross-section, and their derivatives.
pub(super) struct Blend {
    /// Of the rule along the loft.
    pub(super) weight: f64,
    shares: Vec<(usize, f64, f64)>,
}

/// A point of a side and its derivatives along the outline and along the loft.
pub(super) struct Tangents {
    pub(super) at: Vector3<f64>,
    pub(super) along: Vector3<f64>,
    pub(super) up: Vector3<f64>,
}

impl Levels {
    /// Piece `j` of ring `r` at all stations.
    pub(super) fn curves(&self, r: usize, j: usize) -> Vec<Samples> {
        (0..=self.last()).map(|k| self.samples(r, k, j)).collect()
    }

    /// Where along the loft its sides are evaluated.
    pub(super) fn blends(&self, rule: &[(f64, f64)]) -> Vec<Blend> {
        let second: Vec<Vec<f64>> =
            if self.smooth { self.cardinal_curvature() } else { Vec::new() };
        let spans = self.heights.windows(2).enumerate();
        spans
            .flat_map(|(k, w)| {
                let second = &second;
                rule.iter().map(move |&(t, weight)| Blend::new(k, w[1] - w[0], t, weight, second))
            })
            .collect()
    }

    /// Second derivatives of the natural splines that are 1 at one station.
    pub(super) fn cardinal_curvature(&self) -> Vec<Vec<f64>> {
        (0..=self.last())
            .map(|one| {
                let values: Vec<f64> =
                    (0..=self.last()).map(|k| f64::from(u8::from(k == one))).collect();
                natural_second_derivatives(&self.heights, &values)
            })
            .collect()
    }
}

impl Blend {
    /// At the fraction `t` of the span of length `h` above station `k`.
    fn new(k: usize, h: f64, t: f64, weight: f64, second: &[Vec<f64>]) -> Self {
        let mut shares = vec![(k, 1.0 - t, -1.0), (k + 1, t, 1.0)];
        for (station, m) in second.iter().enumerate() {
            let s = 1.0 - t;
            let sixth = h * h / 6.0;
            let bend = sixth * ((s * s * s - s) * m[k] + (t * t * t - t) * m[k + 1]);
            let rise = sixth * ((1.0 - 3.0 * s * s) * m[k] + (3.0 * t * t - 1.0) * m[k + 1]);
            shares.push((station, bend, rise));
        }
        Self { weight, shares }
    }

    /// At one node of the curves of a piece.
    pub(super) fn tangents(&self, curves: &[Samples], node: usize) -> Tangents {
        let (mut at, mut along, mut up) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        for &(station, share, rise) in &self.shares {
            let (p, d) = &curves[station][node];
            at += p.coords * share;
            along += d * share;
            up += p.coords * rise;
        }
        Tangents { at, along, up }
    }
}
