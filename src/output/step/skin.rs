//! The skin of a loft: the area of its outside between the cuts.
//!
//! ∬ |S_u × S_v| du dv over the sides of the outline, by Gauss rules: exact to rounding for prisms,
//! cylinders and cones, and to seven digits or more for sides that turn on their way.

use super::blend::Blend;
use super::coped::Coped;
use super::error::BodyError;
use super::gauss;
use super::levels::Levels;
use super::loft::Loft;

impl Loft {
    /// Area of the outside between the cuts, without bores, mm²: what is painted.
    ///
    /// # Errors
    /// If the loft is not a solid.
    pub fn skin(&self) -> Result<f64, BodyError> {
        match Coped::of(self) {
            Some(coped) => coped.map(|c| c.skin()),
            None => Ok(Levels::new(self)?.skin()),
        }
    }
}

impl Levels {
    /// Area of the outside, its ends left out, mm².
    pub(super) fn skin(&self) -> f64 {
        let blends = self.blends(&gauss::FIVE);
        let piece = |j: usize| -> f64 {
            let curves = self.curves(0, j);
            let weights = self.rings[0][0][j].weights();
            let around = |blend: &Blend| -> f64 {
                let area = |(node, weight): (usize, &f64)| {
                    let tangents = blend.tangents(&curves, node);
                    weight * tangents.along.cross(&tangents.up).norm()
                };
                blend.weight * weights.iter().enumerate().map(area).sum::<f64>()
            };
            blends.iter().map(around).sum()
        };
        (0..self.rings[0][0].len()).map(piece).sum()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use nalgebra::{Point2, Vector3};

    use super::*;
    use crate::section::outline::Outline;

    #[track_caller]
    fn assert_near(loft: &Loft, meant: f64) {
        let found = loft.skin().unwrap();
        assert!((found - meant).abs() <= 1e-12 * meant, "{found} is not {meant}");
    }

    fn rectangle(b: f64, h: f64) -> Outline {
        let corners = [(-b, -h), (b, -h), (b, h), (-b, h)];
        Outline::polygon(&corners.map(|(x, y)| Point2::new(0.5 * x, 0.5 * y)))
    }

    #[test]
    fn frusta_have_the_skin_of_the_textbook() {
        let cone = Loft::taper(Outline::circle(6.0), Outline::circle(2.0), 3.0);
        assert_near(&cone, PI * (6.0 + 2.0) * 5.0);
        // Four trapezia, each as high as its side is long on the slant.
        let pyramid = Loft::taper(rectangle(12.0, 8.0), rectangle(6.0, 4.0), 60.0);
        let slant = |inwards: f64| 60.0_f64.hypot(inwards);
        assert_near(&pyramid, (12.0 + 6.0) * slant(2.0) + (8.0 + 4.0) * slant(3.0));
    }

    #[test]
    fn bores_and_cuts_of_a_tube_add_nothing() {
        let tube = Loft::prism(Outline::circle(5.0), vec![Outline::circle(4.0)], 80.0);
        let cut = tube.clone().cut(Vector3::new(1.0, 0.5, 1.0), Vector3::new(0.0, -0.4, 1.0));
        assert_near(&tube, TAU * 5.0 * 80.0);
        assert_near(&cut, TAU * 5.0 * 80.0);
    }

    #[test]
    fn a_mitred_cone_has_the_skin_of_its_ellipse_drawn_to_the_apex() {
        // Seen along the axis every piece of a cone is as large as its shadow over the sine of the
        // half angle: here 3/5, and the shadow of the cut is an ellipse.
        let (slope, tilt) = (0.75, 0.5);
        let cone = Loft::taper(Outline::circle(9.0), Outline::circle(3.0), 8.0);
        let cut = cone.cut(Vector3::z(), Vector3::new(-tilt, 0.0, 1.0));
        // The apex is 4 above the end, so that the shadow is ρ = slope (4 − tilt ρ cos θ).
        let (p, e) = (slope * 4.0, slope * tilt);
        let shadow = PI * p * p / (1.0 - e * e).powf(1.5);
        assert_near(&cut, (PI * 81.0 - shadow) / 0.6);
    }

    #[test]
    fn an_angle_mitred_across_its_legs_has_the_skin_of_its_flat_sides() {
        let corners = [(0.0, 0.0), (40.0, 0.0), (40.0, 5.0), (5.0, 5.0), (5.0, 40.0), (0.0, 40.0)];
        let corners = corners.map(|(x, y)| Point2::new(x, y));
        let bar = Loft::prism(Outline::polygon(&corners), vec![], 200.0);
        // z = 200 + x: each side is longer by the x of its middle.
        let cut = bar.cut(Vector3::z(), Vector3::new(-1.0, 0.0, 1.0));
        let sides = [(40.0, 20.0), (5.0, 40.0), (35.0, 22.5), (35.0, 5.0), (5.0, 2.5), (40.0, 0.0)];
        assert_near(&cut, sides.iter().map(|(width, x)| width * (200.0 + x)).sum());
    }

    #[test]
    fn a_twisted_bar_has_the_skin_of_many_small_triangles() {
        let from = [(-6.0, -4.0), (6.0, -4.0), (6.0, 4.0), (-6.0, 4.0)];
        let turn = nalgebra::Rotation2::new(0.27);
        let from = from.map(|(x, y)| Point2::new(x, y));
        let to = from.map(|p| turn * p * 0.8);
        let bar = Loft::taper(Outline::polygon(&from), Outline::polygon(&to), 30.0);
        let count = 400;
        let part = |i: usize| i as f64 / f64::from(count);
        let mut meant = 0.0;
        for side in 0..4 {
            let next = (side + 1) % 4;
            let at = |i: usize, k: usize| {
                let low = from[side] + (from[next] - from[side]) * part(i);
                let high = to[side] + (to[next] - to[side]) * part(i);
                let p = low + (high - low) * part(k);
                Vector3::new(p.x, p.y, 30.0 * part(k))
            };
            for i in 0..count as usize {
                for k in 0..count as usize {
                    let [a, b, c, d] = [at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)];
                    meant += 0.5 * (c - a).cross(&(d - b)).norm();
                }
            }
        }
        assert!((bar.skin().unwrap() / meant - 1.0).abs() < 1e-7);
    }
}
