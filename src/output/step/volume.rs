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

use super::blend::{Blend, Samples, Tangents};
use super::coped::Coped;
use super::error::BodyError;
use super::gauss;
use super::levels::Levels;
use super::loft::Loft;
use super::piece::signed_area;

/// Simpson's rule: exact for the ruled sides, and looks at mid-span.
const SIMPSON: [(f64, f64); 3] = [(0.0, 1.0 / 6.0), (0.5, 4.0 / 6.0), (1.0, 1.0 / 6.0)];

impl Loft {
    /// Volume, mm³, by integration over the exact surface.
    ///
    /// # Errors
    /// If the loft is not a solid.
    pub fn volume(&self) -> Result<f64, BodyError> {
        match Coped::of(self) {
            Some(coped) => coped.map(|c| c.volume()),
            None => Levels::new(self)?.volume(),
        }
    }
}

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
                let curves = self.curves(r, j);
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
}

impl Blend {
    /// Flux through the side along this section, and twice ½∮ around it.
    fn flux(&self, curves: &[Samples], weights: &[f64], base: f64) -> (f64, f64) {
        let (mut flux, mut area) = (0.0, 0.0);
        for (node, weight) in weights.iter().enumerate() {
            let Tangents { at, along, up } = self.tangents(curves, node);
            flux += weight * (at.z - base) * (along.x * up.y - up.x * along.y);
            area += 0.5 * weight * (at.x * along.y - at.y * along.x);
        }
        (self.weight * flux, area)
    }
}
