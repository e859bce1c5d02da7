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
//!
//! The edge of a beam slimmer than the member is one smooth curve. That of a beam as wide is two half
//! ellipses in planes that cross under its axis, a fish mouth: at its two sides the surfaces touch.

mod elliptic;

use std::f64::consts::{FRAC_2_PI, PI};

use nalgebra::{Point2, UnitVector3, Vector2};

use elliptic::Elliptic;

/// The end of a beam along the side of a round member whose axis crosses its own.
///
/// In coordinates of the beam: x and y across it, z along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saddle {
    /// Direction of the axis of the member; not that of z.
    pub axis: UnitVector3<f64>,
    /// Radius of the member, mm; that of the beam is the same, or at most 0.999 of it.
    pub radius: f64,
    /// Whether the member lies above the end, at the second end of a beam.
    pub above: bool,
}

/// Steps around a circle. The integrands are smooth in Jacobi's u and return after a turn, so that the
/// error falls with e^(−32 π K′/K), K′ ≥ π/2: below the rounding of the numbers up to [`Saddle::WIDEST`].
const STEPS: usize = 128;

/// Radii that differ by less than this part are the same.
const SAME_RADIUS: f64 = 1e-9;

impl Saddle {
    /// Largest part of the radius of the member that a slimmer beam may have. Up to here OCCT finds
    /// the volume between the surfaces; nearer to 1 they run together along a stretch of the edge.
    pub(crate) const WIDEST: f64 = 0.999;

    /// Whether a beam of a radius can end in the saddle.
    pub(crate) fn takes(&self, radius: f64) -> bool {
        radius <= Self::WIDEST * self.radius || self.is_as_wide(radius)
    }

    /// Whether a beam of a radius is as wide as the member.
    pub(crate) fn is_as_wide(&self, radius: f64) -> bool {
        (radius - self.radius).abs() <= SAME_RADIUS * self.radius
    }

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

    /// Lowest and highest point of a circle about the axis of the beam.
    ///
    /// Seen along the member the edge runs between the ends of the circle that lie along it, at
    /// ± r |slope|, and the place where it turns: there the surface is level.
    pub(crate) fn range(&self, radius: f64) -> [f64; 2] {
        let side = radius * self.slope().norm();
        let flat = (self.radius * self.radius - radius * radius).max(0.0).sqrt();
        let turns = flat * self.slope().norm() <= radius;
        let low = if turns { flat - self.radius / self.sine() } else { -side };
        if self.above { [-side, -low] } else { [low, side] }
    }

    /// ∬ height over a disc about the axis of the beam, mm³.
    ///
    /// With s = r sin t, ∬ f(s) dA = r² ∮ cos² t f(r sin t) dt.
    pub(crate) fn over_disc(&self, radius: f64) -> f64 {
        if self.is_as_wide(radius) {
            return self.deepest() * radius * radius * (PI - 8.0 / 3.0);
        }
        radius * radius * self.around(radius, |sin, cos| cos * cos * self.bend(radius * sin))
    }

    /// Mean height along a circle about the axis of the beam, mm.
    pub(crate) fn mean_on_circle(&self, radius: f64) -> f64 {
        if self.is_as_wide(radius) {
            return self.deepest() * (1.0 - FRAC_2_PI);
        }
        self.around(radius, |sin, _| self.bend(radius * sin)) / (2.0 * PI)
    }

    /// Height at the sides of a beam as wide as the member.
    fn deepest(&self) -> f64 {
        self.bend(self.radius)
    }

    /// ∮ over a full turn of a function of sine and cosine, smooth on a circle of a radius.
    fn around(&self, radius: f64, f: impl Fn(f64, f64) -> f64) -> f64 {
        let elliptic = self.elliptic(radius);
        let step = elliptic.turn() / STEPS as f64;
        let at = |i: usize| {
            let angle = elliptic.angle(step * i as f64);
            let (sin, cos) = angle.sin_cos();
            elliptic.growth(angle) * f(sin, cos)
        };
        (0..STEPS).map(at).sum::<f64>() * step
    }

    /// Places around a circle of a slimmer beam, by which its edge is smooth.
    ///
    /// * `start`: the first of them;
    /// * `left`: whether they follow each other counter-clockwise.
    pub(crate) fn places(&self, start: &Point2<f64>, left: bool, count: usize) -> Vec<Point2<f64>> {
        let radius = start.coords.norm();
        let elliptic = self.elliptic(radius);
        let along = self.along() * radius;
        let across = Vector2::new(-along.y, along.x);
        let from = elliptic.at(along.perp(&start.coords).atan2(along.dot(&start.coords)));
        let step = elliptic.turn() / count as f64 * if left { 1.0 } else { -1.0 };
        let others = (1..count).map(|i| {
            let (sin, cos) = elliptic.angle(from + step * i as f64).sin_cos();
            Point2::from(along * cos + across * sin)
        });
        std::iter::once(*start).chain(others).collect()
    }

    fn elliptic(&self, radius: f64) -> Elliptic {
        Elliptic::new(radius / self.radius)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

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

    /// ∫ of f over [0, 1] by many tiles, denser towards 1.
    fn summed(f: impl Fn(f64) -> f64) -> f64 {
        let pieces = 4000;
        // x = 1 − (1 − w)³.
        let at = |i: i32| {
            let w = (f64::from(i) + 0.5) / f64::from(pieces);
            3.0 * (1.0 - w).powi(2) * f(1.0 - (1.0 - w).powi(3))
        };
        (0..pieces).map(at).sum::<f64>() / f64::from(pieces)
    }

    #[test]
    fn integrals_are_those_of_many_small_tiles_up_to_equal_radii() {
        for radius in [0.1, 5.0, 6.9, 6.993, 7.0] {
            let saddle = saddle(false);
            let bend = |t: f64| saddle.bend(radius * t.sin());
            let quarter = 0.25 * TAU;
            let disc = 4.0 * quarter * summed(|x| (x * quarter).cos().powi(2) * bend(x * quarter));
            let off = saddle.over_disc(radius) / (radius * radius * disc) - 1.0;
            assert!(off.abs() < 1e-6, "{off} at {radius}");
            let off = saddle.mean_on_circle(radius) / summed(|x| bend(x * quarter)) - 1.0;
            assert!(off.abs() < 1e-6, "{off} at {radius}");
        }
    }

    #[test]
    fn lowest_and_highest_points_are_those_found_all_around() {
        for above in [false, true] {
            for tilt in [0.0, 0.3, -2.0] {
                for radius in [2.0, 6.5, 7.0] {
                    let axis = UnitVector3::new_normalize(Vector3::new(0.6, 0.8, tilt));
                    let saddle = Saddle { axis, ..saddle(above) };
                    let rises = (0..20_000).map(|i| {
                        let (sin, cos) = (TAU * f64::from(i) / 20_000.0).sin_cos();
                        saddle.rise(&Point2::new(radius * cos, radius * sin))
                    });
                    let found = rises.fold([f64::MAX, f64::MIN], |[l, h], z| [l.min(z), h.max(z)]);
                    let range = saddle.range(radius);
                    let off = [0, 1].map(|i| (range[i] - found[i]).abs());
                    assert!(off[0].max(off[1]) < 1e-2, "{range:?}, not {found:?}");
                    assert!(range[0] <= found[0] + 1e-12 && range[1] >= found[1] - 1e-12);
                }
            }
        }
    }

    #[test]
    fn places_go_once_around_from_their_start() {
        let saddle = saddle(true);
        let start = Point2::new(-1.2, 6.6);
        for left in [false, true] {
            let places = saddle.places(&start, left, 64);
            let next = places.iter().cycle().skip(1);
            let turns = places.iter().zip(next).map(|(a, b)| a.coords.perp(&b.coords).signum());
            let sense = if left { 1.0 } else { -1.0 };
            assert!(places.len() == 64 && turns.clone().all(|turn| turn == sense));
            let radius = start.coords.norm();
            assert!(places.iter().all(|p| (p.coords.norm() - radius).abs() < 1e-12));
        }
    }
}
