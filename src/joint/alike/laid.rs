//! A piece laid into the place of a beam: how it is moved there, and how far its corners are then off.
//!
//! It is turned about its axis, and end for end where the section allows it: these are all motions
//! that keep a beam on its axis.

use nalgebra::{Isometry3, Point2, Rotation2, Translation3, UnitQuaternion, Vector2, Vector3};

use super::SAME_PIECE;
use crate::frame::Beam;
use crate::joint::CutBeam;
use crate::joint::cut::{PER_QUARTER, rise, slopes};
use crate::section::contours::Contours;
use crate::section::outline::{Outline, Region};
use crate::segment::distance;

/// Farthest two outlines may lie from each other, in section radii: a tenth of [`SAME_PIECE`],
/// since they run all along the beam. Outlines compared as polygons are off by a tenth of it.
pub(super) const SAME_OUTLINE: f64 = 0.01;

/// A beam as it is compared.
pub(super) struct Member<'a> {
    pub(super) beam: &'a Beam,
    pub(super) cut: &'a CutBeam,
    /// Rises of the cuts at both ends along the axis, for each mm across.
    pub(super) slopes: [Vector2<f64>; 2],
    /// Reach of the section from the axis, mm.
    pub(super) radius: f64,
}

/// A turn about the axis, after half a turn about the first direction across if `swapped`.
#[derive(Clone, Copy)]
struct Turn {
    angle: f64,
    swapped: bool,
}

/// A piece laid into a beam.
pub(super) struct Laid {
    pub(super) motion: Isometry3<f64>,
    /// Farthest a corner is off, in section radii.
    pub(super) off: f64,
}

impl Turn {
    fn across(&self, v: &Vector2<f64>) -> Vector2<f64> {
        let v = if self.swapped { Vector2::new(v.x, -v.y) } else { *v };
        Rotation2::new(self.angle) * v
    }
}

impl<'a> Member<'a> {
    pub(super) fn new(beam: &'a Beam, cut: &'a CutBeam) -> Self {
        let slopes = [0, 1].map(|e| Vector2::from(slopes(beam, &cut.ends[e])));
        Self { beam, cut, slopes, radius: beam.shape.properties.reach }
    }

    /// Where the middle of the solid is to lie, from the first node, mm.
    fn middle(&self) -> f64 {
        let [start, end] = [0, 1].map(|e| self.cut.ends[e].setback);
        0.5 * (start + self.beam.length - end)
    }

    /// Where the middle of the solid lies that is built from the first node on, mm.
    fn built_middle(&self) -> f64 {
        self.cut.ends[0].setback + 0.5 * self.cut.axis_length
    }

    /// A beam cut to the length of its like is off by as much at both ends.
    pub(super) fn centring(&self) -> Isometry3<f64> {
        Isometry3::translation(0.0, 0.0, self.middle() - self.built_middle())
    }

    /// Lays this piece into a beam, if no corner is off by more than `most` section radii there.
    pub(super) fn laid_into(&self, beam: &Member<'_>, most: f64) -> Option<Laid> {
        let longer = 0.5 * (self.cut.axis_length - beam.cut.axis_length).abs() / self.radius;
        if longer > most || !self.is_bar_of(beam) {
            return None;
        }
        let mut turns: Vec<(f64, Turn)> = self
            .turns(beam)
            .into_iter()
            .map(|turn| (longer + self.cuts_off(beam, turn), turn))
            .filter(|(off, _)| *off <= most)
            .collect();
        // The first of equals.
        turns.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (off, turn) = turns.into_iter().find(|(_, turn)| self.has_outlines_of(beam, *turn))?;
        let own = self.built_middle();
        let swap = if turn.swapped {
            UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
        } else {
            UnitQuaternion::identity()
        };
        let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn.angle) * swap;
        let along = beam.middle() - if turn.swapped { -own } else { own };
        let motion = Isometry3::from_parts(Translation3::new(0.0, 0.0, along), turned);
        Some(Laid { motion, off })
    }

    fn is_bar_of(&self, beam: &Member<'_>) -> bool {
        self.beam.shape.profile == beam.beam.shape.profile
            && self.beam.shape.stations.len() == beam.beam.shape.stations.len()
    }

    /// The turns that may bring the section onto itself.
    fn turns(&self, beam: &Member<'_>) -> Vec<Turn> {
        let quarters = (0..4).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2);
        [false, true]
            .into_iter()
            .flat_map(|swapped| {
                if self.is_round() {
                    let saddles = self.turns_of_saddles(beam, swapped);
                    let angles = std::iter::once(self.turn_of_cuts(beam, swapped)).chain(saddles);
                    angles.map(|angle| Turn { angle, swapped }).collect::<Vec<_>>()
                } else {
                    quarters.clone().map(|angle| Turn { angle, swapped }).collect()
                }
            })
            .collect()
    }

    /// Whether every outline is a circle about the axis.
    fn is_round(&self) -> bool {
        let about_axis = |o: &Outline| matches!(o, Outline::Circle { centre, .. } if *centre == Point2::origin());
        self.beam
            .shape
            .stations
            .iter()
            .all(|s| std::iter::once(&s.region.outer).chain(&s.region.holes).all(about_axis))
    }

    /// The cuts of the piece after a turn, from the first end of the beam to the second.
    fn turned_slopes(&self, turn: Turn) -> [Vector2<f64>; 2] {
        let [start, end] = self.slopes;
        if turn.swapped {
            [-turn.across(&end), -turn.across(&start)]
        } else {
            [turn.across(&start), turn.across(&end)]
        }
    }

    /// The turn about the axis that brings both cuts nearest to those of the beam: the least sum
    /// of squares has a closed form in the plane.
    fn turn_of_cuts(&self, beam: &Member<'_>, swapped: bool) -> f64 {
        let own = self.turned_slopes(Turn { angle: 0.0, swapped });
        let (mut sin, mut cos) = (0.0, 0.0);
        for (a, b) in own.iter().zip(&beam.slopes) {
            sin += a.perp(b);
            cos += a.dot(b);
        }
        f64::atan2(sin, cos)
    }

    /// The turns about the axis that bring the members of saddles onto those of the beam.
    fn turns_of_saddles(&self, beam: &Member<'_>, swapped: bool) -> Vec<f64> {
        let swap = Turn { angle: 0.0, swapped };
        let pairs = (0..2).filter_map(|end| {
            let own = self.cut.ends[if swapped { 1 - end } else { end }].saddle?;
            Some((swap.across(&own.along()), beam.cut.ends[end].saddle?.along()))
        });
        pairs
            .map(|(a, b)| a.perp(&b).atan2(a.dot(&b)))
            .flat_map(|angle| [angle, angle + std::f64::consts::PI])
            .collect()
    }

    /// How far the cuts are off at the corners after a turn, in section radii.
    fn cuts_off(&self, beam: &Member<'_>, turn: Turn) -> f64 {
        let has_saddle = |m: &Member<'_>| m.cut.ends.iter().any(|e| e.saddle.is_some());
        if has_saddle(self) || has_saddle(beam) {
            return self.saddles_off(beam, turn);
        }
        let own = self.turned_slopes(turn);
        own.iter().zip(&beam.slopes).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    }

    /// [`cuts_off`](Self::cuts_off) at places all around.
    fn saddles_off(&self, beam: &Member<'_>, turn: Turn) -> f64 {
        let places = (0..4 * PER_QUARTER).map(|i| {
            let angle = i as f64 * std::f64::consts::FRAC_PI_2 / PER_QUARTER as f64;
            Vector2::new(angle.cos(), angle.sin()) * self.radius
        });
        let off = |place: Vector2<f64>, end: usize| {
            let there = rise(beam.beam, &beam.cut.ends[end], &(turn.across(&place)).into());
            let own = if turn.swapped { 1 - end } else { end };
            let here = rise(self.beam, &self.cut.ends[own], &place.into());
            (if turn.swapped { -here } else { here } - there).abs()
        };
        places.map(|p| off(p, 0).max(off(p, 1))).fold(0.0, f64::max) / self.radius
    }

    fn has_outlines_of(&self, beam: &Member<'_>, turn: Turn) -> bool {
        let (own, others) = (&self.beam.shape.stations, &beam.beam.shape.stations);
        let most = SAME_OUTLINE * self.radius;
        let last = own.len() - 1;
        others.iter().enumerate().all(|(i, there)| {
            let (here, at) = if turn.swapped {
                (&own[last - i], 1.0 - own[last - i].at)
            } else {
                (&own[i], own[i].at)
            };
            (at - there.at).abs() * beam.cut.axis_length <= SAME_PIECE * self.radius
                && is_near(&here.region, &there.region, turn, most)
        })
    }
}

/// Whether a turned region lies on another within `most`, mm.
fn is_near(own: &Region, other: &Region, turn: Turn, most: f64) -> bool {
    let outlines = |r: &Region| -> Vec<Vec<Point2<f64>>> {
        Contours::of_region(r, PER_QUARTER).polygons().cloned().collect()
    };
    if own == other && !turn.swapped && turn.angle == 0.0 {
        return true;
    }
    if let (Outline::Circle { radius: a, .. }, Outline::Circle { radius: b, .. }) =
        (&own.outer, &other.outer)
        && own.holes.is_empty()
        && other.holes.is_empty()
    {
        return (a - b).abs() <= most;
    }
    let (own, other) = (outlines(own), outlines(other));
    own.len() == other.len()
        && own.iter().zip(&other).all(|(a, b)| {
            let turned: Vec<Point2<f64>> =
                a.iter().map(|p| Point2::from(turn.across(&p.coords))).collect();
            lies_on(&turned, b, most) && lies_on(b, &turned, most)
        })
}

/// Whether every corner of a polygon lies on another within `most`, mm.
pub(super) fn lies_on(corners: &[Point2<f64>], polygon: &[Point2<f64>], most: f64) -> bool {
    let sides = || polygon.iter().zip(polygon.iter().cycle().skip(1));
    corners.iter().all(|p| sides().any(|(a, b)| distance(p, a, b) <= most))
}
