//! Volume of a loft, by Gauss's theorem over its exact surface.
//!
//! With the field (0, 0, z), V = ∬ z n_z dA over caps and sides:
//!
//! * a cap in the plane z = h + g·(x, y): ∬ z dx dy = ∮ (h x + ½ gₓ x² + g_y x y) dy;
//! * a side S(u, v) = Σ Bₖ(v) eₖ(u) between the level curves eₖ:
//!   ∬ z (xᵤ y_v − x_v yᵤ) du dv.
//!
//! Both are integrated by Gauss rules, exact for everything polynomial and
//! exact to rounding for arcs.

use nalgebra::{Point3, Vector3};

use super::error::BodyError;
use super::gauss;
use super::levels::Levels;
use super::piece::signed_area;
use super::spline::natural_second_derivatives;

/// Simpson's rule: exact for the ruled sides, and looks at mid-span.
const SIMPSON: [(f64, f64); 3] = [(0.0, 1.0 / 6.0), (0.5, 4.0 / 6.0), (1.0, 1.0 / 6.0)];

type Samples = Vec<(Point3<f64>, Vector3<f64>)>;

impl Levels {
    /// Volume, mm³.
    ///
    /// # Errors
    /// If the section vanishes on the way or the volume is not positive.
    pub(super) fn volume(&self) -> Result<f64, BodyError> {
        let rule: &[(f64, f64)] = if self.smooth { &gauss::FIVE } else { &SIMPSON };
        let blends = self.blends(rule);
        let mut areas = vec![0.0; blends.len()];
        let mut volume = 0.0;
        for r in 0..self.rings.len() {
            for j in 0..self.rings[r][0].len() {
                let curves: Vec<Samples> =
                    (0..=self.last()).map(|k| self.samples(r, k, j)).collect();
                let weights = self.rings[r][0][j].weights();
                volume += self.cap(self.last(), &curves[self.last()], &weights);
                volume -= self.cap(0, &curves[0], &weights);
                for (blend, area) in blends.iter().zip(&mut areas) {
                    let (flux, around) = blend.flux(&curves, &weights, self.heights[0]);
                    volume += flux;
                    *area += if r == 0 { around } else { 0.0 };
                }
            }
        }
        self.check(volume, &areas)
    }

    fn check(&self, volume: f64, areas: &[f64]) -> Result<f64, BodyError> {
        let largest = self.rings[0].iter().map(|ring| signed_area(ring)).fold(0.0, f64::max);
        if areas.iter().any(|area| *area <= 1e-9 * largest) {
            Err(BodyError::SectionVanishes)
        } else if volume.is_finite() && volume > 0.0 {
            Ok(volume)
        } else {
            Err(BodyError::NoVolume { volume })
        }
    }

    /// ∬ z dx dy over what one piece of an end encloses with the axis.
    fn cap(&self, k: usize, curve: &Samples, weights: &[f64]) -> f64 {
        let plane = &self.planes[k];
        let (h, g) = (plane.height - self.heights[0], plane.slope);
        let term = |((at, along), w): (&(Point3<f64>, Vector3<f64>), &f64)| {
            w * at.x * (h + 0.5 * g.x * at.x + g.y * at.y) * along.y
        };
        curve.iter().zip(weights).map(term).sum()
    }

    /// Where along the loft its sides are evaluated.
    fn blends(&self, rule: &[(f64, f64)]) -> Vec<Blend> {
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

/// Shares Bₖ(v) of the stations in one cross-section, and their derivatives.
struct Blend {
    weight: f64,
    shares: Vec<(usize, f64, f64)>,
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

    /// Flux through the side along this section, and twice ½∮ around it.
    fn flux(&self, curves: &[Samples], weights: &[f64], base: f64) -> (f64, f64) {
        let (mut flux, mut area) = (0.0, 0.0);
        for (node, weight) in weights.iter().enumerate() {
            let (mut at, mut along, mut up) =
                (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
            for &(station, share, rise) in &self.shares {
                let (p, d) = &curves[station][node];
                at += p.coords * share;
                along += d * share;
                up += p.coords * rise;
            }
            flux += weight * (at.z - base) * (along.x * up.y - up.x * along.y);
            area += 0.5 * weight * (at.x * along.y - at.y * along.x);
        }
        (self.weight * flux, area)
    }
}
