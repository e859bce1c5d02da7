//! Round beams that end along the side of a round member.

use std::f64::consts::{PI, TAU};

use nalgebra::{Point2, Point3, Vector2};

use super::error::BodyError;
use super::levels::{Level, Levels, slope};
use super::loft::{EndCut, Loft, Station};
use super::tolerance::{MOST_OBLIQUE_DEGREES, SHORTEST};
use crate::saddle::Saddle;
use crate::section::outline::Outline;

/// Places around the beam at which its two ends are held against each other.
const AROUND: usize = 64;

/// A bar or tube of constant section with at least one end along a round member.
#[derive(Clone, Debug)]
pub(super) struct Coped {
    /// The outside, then the bore if there is one.
    pub(super) radii: Vec<f64>,
    /// The first and the second end.
    pub(super) ends: [End; 2],
}

/// Where a beam ends.
#[derive(Clone, Copy, Debug)]
pub(super) enum End {
    Plane(Level),
    Saddle {
        /// Where it meets the axis of the beam.
        height: f64,
        saddle: Saddle,
    },
}

impl End {
    fn new(loft: &Loft, index: usize) -> Result<Self, BodyError> {
        let (cut, name) = [(&loft.start, "start"), (&loft.end, "end")][index];
        let height = loft.stations[index * (loft.stations.len() - 1)].z;
        let EndCut::Saddle(saddle) = cut else {
            return Ok(Self::Plane(Level { height, slope: slope(cut, name)? }));
        };
        let degrees = saddle.axis.z.abs().asin().to_degrees();
        if degrees > MOST_OBLIQUE_DEGREES {
            return Err(BodyError::TooOblique { end: name, degrees });
        }
        let is_turned = saddle.above == (index == 0);
        if is_turned {
            return Err(BodyError::NoSaddle { why: "its member lies on the side of the beam" });
        }
        Ok(Self::Saddle { height, saddle: *saddle })
    }

    /// Brings a point of the section onto the end.
    pub(super) fn lift(&self, p: &Point2<f64>) -> Point3<f64> {
        match self {
            Self::Plane(level) => level.lift(p),
            Self::Saddle { height, saddle } => Point3::new(p.x, p.y, height + saddle.rise(p)),
        }
    }

    /// Direction of a member as wide as a beam of that radius, as seen along the beam.
    pub(super) fn fish_mouth(&self, radius: f64) -> Option<Vector2<f64>> {
        match self {
            Self::Saddle { saddle, .. } if saddle.is_as_wide(radius) => Some(saddle.along()),
            _ => None,
        }
    }

    /// ∬ height over a disc about the axis.
    fn over_disc(&self, radius: f64) -> f64 {
        let flat = |height: f64| PI * radius * radius * height;
        match self {
            Self::Plane(level) => flat(level.height),
            Self::Saddle { height, saddle } => flat(*height) + saddle.over_disc(radius),
        }
    }

    /// Mean height along a circle about the axis.
    fn mean_on_circle(&self, radius: f64) -> f64 {
        match self {
            Self::Plane(level) => level.height,
            Self::Saddle { height, saddle } => height + saddle.mean_on_circle(radius),
        }
    }
}

impl Coped {
    /// A loft as a beam with saddles, if it has any.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub(super) fn of(loft: &Loft) -> Option<Result<Self, BodyError>> {
        let has_saddle = [&loft.start, &loft.end].iter().any(|e| matches!(e, EndCut::Saddle(_)));
        has_saddle.then(|| Self::new(loft))
    }

    /// The beam, if a loft with a saddle is one.
    ///
    /// # Errors
    /// If the loft is no solid even with square ends, if its section is not round about the axis
    /// and constant, or thicker than its members, or if its ends cross.
    fn new(loft: &Loft) -> Result<Self, BodyError> {
        let square = Loft { start: EndCut::Square, end: EndCut::Square, ..loft.clone() };
        Levels::new(&square)?;
        let no_bar = BodyError::NoSaddle { why: "it is no round bar or tube of constant section" };
        let Some(radii) = radii(&loft.stations[0]) else { return Err(no_bar) };
        let is_constant = loft.stations.iter().all(|s| self::radii(s).as_ref() == Some(&radii));
        if !is_constant {
            return Err(no_bar);
        }
        let ends = [End::new(loft, 0)?, End::new(loft, 1)?];
        let fits = |end: &End| match end {
            End::Plane(_) => true,
            End::Saddle { saddle, .. } => radii.iter().all(|r| saddle.takes(*r)),
        };
        if !ends.iter().all(fits) {
            let why = "it is thicker than the member, or nearly as thick but not quite";
            return Err(BodyError::NoSaddle { why });
        }
        let coped = Self { radii, ends };
        if coped.ascends() { Ok(coped) } else { Err(BodyError::CutsCross) }
    }

    /// Direction across the beam in which its edges begin: far from where they bend, which is at the
    /// sides of members as wide as the beam.
    pub(super) fn seam(&self) -> Vector2<f64> {
        let along: Vec<Vector2<f64>> =
            self.ends.iter().filter_map(|e| e.fish_mouth(self.radii[0])).collect();
        match along[..] {
            [] => Vector2::x(),
            [along] => along,
            // Halfway between the members, where that is farther from a right angle to them.
            [a, b, ..] => {
                let [sum, difference] = [a + b, a - b];
                let longer = if sum.norm() >= difference.norm() { sum } else { difference };
                longer.normalize()
            }
        }
    }

    fn ascends(&self) -> bool {
        let around = (0..AROUND).map(|i| (TAU * i as f64 / AROUND as f64).sin_cos());
        around.map(|(sin, cos)| Vector2::new(cos, sin)).all(|out| {
            self.radii.iter().all(|r| {
                let [start, end] = self.ends.map(|e| e.lift(&Point2::from(out * *r)).z);
                end - start > SHORTEST
            })
        })
    }

    /// Volume, mm³: that between two surfaces over the section.
    pub(super) fn volume(&self) -> f64 {
        let over_disc = |r: f64| self.ends[1].over_disc(r) - self.ends[0].over_disc(r);
        over_disc(self.radii[0]) - self.radii[1..].iter().map(|r| over_disc(*r)).sum::<f64>()
    }

    /// Area of the outside between the ends, mm².
    pub(super) fn skin(&self) -> f64 {
        let radius = self.radii[0];
        let [start, end] = self.ends.map(|e| e.mean_on_circle(radius));
        TAU * radius * (end - start)
    }
}

/// Radii of a station whose outlines are circles about the axis.
fn radii(station: &Station) -> Option<Vec<f64>> {
    let about_axis = |outline: &Outline| match outline {
        Outline::Circle { centre, radius } if *centre == Point2::origin() => Some(*radius),
        _ => None,
    };
    std::iter::once(&station.outer).chain(&station.holes).map(about_axis).collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::{UnitVector3, Vector3};

    use super::*;
    use crate::output::step::Body;

    fn saddle(axis: Vector3<f64>, radius: f64, above: bool) -> EndCut {
        EndCut::Saddle(Saddle { axis: UnitVector3::new_normalize(axis), radius, above })
    }

    fn tube() -> Loft {
        Loft::prism(Outline::circle(5.0), vec![Outline::circle(4.0)], 50.0)
    }

    #[test]
    fn tube_between_two_members_is_a_closed_solid() {
        let start = saddle(Vector3::new(1.0, 0.4, 0.7), 6.0, false);
        let end = saddle(Vector3::new(0.0, 1.0, 0.0), 9.0, true);
        let tube = Body::Loft(Loft { start, end, ..tube() });
        // Both ends stand out at their sides.
        assert!(tube.check().unwrap() > PI * 9.0 * 50.0);
        assert_eq!(tube.check(), tube.volume());
    }

    #[test]
    fn fish_mouths_on_both_ends_are_a_closed_solid_of_known_volume() {
        // Two equal cylinders at a right angle share 16/3 r³; a mouth leaves what is beyond.
        let mouth = |axis, above| saddle(axis, 5.0, above);
        for turn in [0.0, 0.2, 0.8, 1.5, 3.0_f64] {
            let end = mouth(Vector3::new(turn.cos(), turn.sin(), 0.0), true);
            let bar = Loft::prism(Outline::circle(5.0), vec![], 50.0);
            let bar = Loft { start: mouth(Vector3::x(), false), end, ..bar };
            let meant = PI * 25.0 * 60.0 - 16.0 / 3.0 * 125.0;
            assert!((Body::Loft(bar.clone()).check().unwrap() / meant - 1.0).abs() < 1e-14);
            // What they share has 8 r² of the surface of each, and a mouth takes half of that.
            let meant = TAU * 5.0 * 60.0 - 8.0 * 25.0;
            assert!((bar.skin().unwrap() / meant - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn volume_over_a_large_member_is_that_of_a_plane_cut() {
        let bar = Loft::prism(Outline::circle(5.0), vec![], 50.0);
        let end = saddle(Vector3::x(), 1e7, true);
        let coped = Body::Loft(Loft { end, ..bar.clone() }).volume().unwrap();
        assert!((coped / Body::Loft(bar).volume().unwrap() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn what_cannot_sit_on_a_member_is_refused() {
        let on = |radius: f64, loft: Loft| {
            Body::Loft(Loft { end: saddle(Vector3::x(), radius, true), ..loft }).volume()
        };
        let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)];
        let corners = corners.map(|(x, y)| Point2::new(x, y));
        let flat = Loft::prism(Outline::polygon(&corners), vec![], 50.0);
        assert!(on(6.0, tube()).is_ok() && on(5.0, tube()).is_ok());
        for refused in [on(4.9, tube()), on(5.001, tube()), on(6.0, flat)] {
            assert!(matches!(refused, Err(BodyError::NoSaddle { .. })), "{refused:?}");
        }
        let below = Loft { end: saddle(Vector3::x(), 6.0, false), ..tube() };
        assert!(matches!(Body::Loft(below).volume(), Err(BodyError::NoSaddle { .. })));
    }
}
