//! The surface a round member leaves on the end of a beam that stops at its side.
//!
//! ```text
//!        z ▲
//!      │   │   │         seen along the member: the beam ends on its upper side,
//!      │   │   │         at z = √(R² − s²) over the axis of the member, s across it
//!      │ ╭─┴─╮ │
//!      ╭╯  R  ╰╮
//!     │    ○    │
//! ```

use std::f64::consts::TAU;

use nalgebra::{Point2, UnitVector3, Vector2};

/// The end of a beam along the side of a round member whose axis crosses its own.
///
/// In coordinates of the beam: x and y across it, z along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saddle {
    /// Direction of the axis of the member; not that of z.
    pub axis: UnitVector3<f64>,
    /// Radius of the member, mm; that of the beam is at most 0.9 of it.
    pub radius: f64,
    /// Whether the member lies above the end, at the second end of a beam.
    pub above: bool,
}

/// Steps around a circle. The integrands are smooth and return after a turn, so that the error
/// falls with e^(−128 a), cosh a = R/r: below the rounding of the numbers.
const STEPS: usize = 128;

impl Saddle {
    /// Largest part of the radius of the member that a beam may have. The edge of a beam as wide as
    /// its member runs out into a feather, and long before that the volume OCCT finds is off.
    pub(crate) const WIDEST: f64 = 0.9;

    /// Sine of the angle between the member and the beam.
    pub(crate) fn sine(&self) -> f64 {
        self.axis.xy().norm()
    }

    /// Direction of the member as seen along the beam.
    pub(crate) fn along(&self) -> Vector2<f64> {
        self.axis.xy() / self.sine()
    }

    /// Rise for each mm across, of the line on which the surface meets the plane of both axes.
    pub(crate) fn slope(&self) -> Vector2<f64> {
        self.along() * (self.axis.z / self.sine())
    }

    /// Height of the surface at a point across the beam, over where it meets the axis of the beam.
    pub(crate) fn rise(&self, p: &Point2<f64>) -> f64 {
        self.slope().dot(&p.coords) + self.bend(self.along().perp(&p.coords))
    }

    /// Height at a distance across the member over that in the middle.
    fn bend(&self, across: f64) -> f64 {
        let half = (self.radius * self.radius - across * across).max(0.0).sqrt();
        let up = (half - self.radius) / self.sine();
        if self.above { -up } else { up }
    }

    /// ∬ height over a disc about the axis of the beam, mm³.
    ///
    /// With s = r sin t, ∬ f(s) dA = r² ∮ cos² t f(r sin t) dt.
    pub(crate) fn over_disc(&self, radius: f64) -> f64 {
        radius * radius * self.around(|sin, cos| cos * cos * self.bend(radius * sin))
    }

    /// Mean height along a circle about the axis of the beam, mm.
    pub(crate) fn mean_on_circle(&self, radius: f64) -> f64 {
        self.around(|sin, _| self.bend(radius * sin)) / TAU
    }

    /// ∮ over a full turn of a function of sine and cosine.
    fn around(&self, f: impl Fn(f64, f64) -> f64) -> f64 {
        let step = TAU / STEPS as f64;
        (0..STEPS).map(|i| (step * i as f64).sin_cos()).map(|(sin, cos)| f(sin, cos)).sum::<f64>()
            * step
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point3, Vector3};

    use super::*;

    fn saddle(above: bool) -> Saddle {
        Saddle {
            axis: UnitVector3::new_normalize(Vector3::new(0.6, 0.9, -0.4)),
            radius: 7.0,
            above,
        }
    }

    #[test]
    fn every_point_is_as_far_from_the_member_as_its_radius() {
        for above in [false, true] {
            let saddle = saddle(above);
            let middle = saddle.radius / saddle.sine() * if above { 1.0 } else { -1.0 };
            for i in 0..20 {
                let (sin, cos) = (TAU * f64::from(i) / 20.0).sin_cos();
                let p = Point2::new(5.0 * cos, 5.0 * sin);
                let arm = Point3::new(p.x, p.y, saddle.rise(&p)) - Point3::new(0.0, 0.0, middle);
                let distance = arm.cross(&saddle.axis).norm();
                assert!((distance - 7.0).abs() < 1e-12, "{distance}");
            }
        }
    }

    #[test]
    fn volume_over_a_disc_is_that_of_many_small_tiles() {
        let (saddle, n) = (saddle(false), 1000);
        let tile = 10.0 / f64::from(n);
        let at = |i: i32| (f64::from(i) + 0.5) * tile - 5.0;
        let corners = (0..n).flat_map(|i| (0..n).map(move |j| Point2::new(at(i), at(j))));
        let inside = corners.filter(|p| p.coords.norm() <= 5.0);
        let summed: f64 = inside.map(|p| saddle.rise(&p) * tile * tile).sum();
        assert!((saddle.over_disc(5.0) / summed - 1.0).abs() < 1e-3, "{summed}");
    }
}
