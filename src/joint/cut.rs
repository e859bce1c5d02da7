//! One beam with its two ends cut.

use std::f64::consts::PI;

use nalgebra::{Unit, Vector3};

use super::{LEAST_LEFT, PER_QUARTER};
use crate::frame::Beam;
use crate::section::properties::Contours;

/// How an end of a beam is cut: in a plane through its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndCut {
    /// Way along the axis from the node to the plane, mm; positive shortens the beam.
    pub setback: f64,
    /// Normal of the plane in model coordinates; `None` for a square cut.
    pub normal: Option<Unit<Vector3<f64>>>,
    /// Angle between the cut and a square one, rad, 0 to π/2.
    pub angle: f64,
}

/// Cuts nearer to square than this are square: a saw is set to a twentieth of a degree.
const SQUARE_ENOUGH: f64 = 8.7e-4;

impl EndCut {
    /// At a right angle to the axis, at the node.
    pub const SQUARE: Self = Self { setback: 0.0, normal: None, angle: 0.0 };

    /// In a plane; `away` is the direction of the beam away from the end.
    pub(super) fn in_plane(
        setback: f64,
        normal: Unit<Vector3<f64>>,
        away: &Unit<Vector3<f64>>,
    ) -> Self {
        let across = normal.cross(away).norm();
        let angle = across.atan2(normal.dot(away).abs());
        if angle < SQUARE_ENOUGH {
            return Self { setback, ..Self::SQUARE };
        }
        Self { setback, normal: Some(normal), angle }
    }
}

/// A beam as it is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct CutBeam {
    /// Its cuts, at the first and at the second node.
    pub ends: [EndCut; 2],
    /// Length along the axis between the cuts, mm.
    pub axis_length: f64,
    /// Length to saw off a bar: from the farthest corner to the farthest, mm.
    pub length: f64,
    /// Turn of the second cut against the first about the axis, rad, in (−π, π]: 0 where both lean
    /// the same way (a parallelogram), π where they lean towards each other (a trapezium); positive
    /// is clockwise as seen along the beam, from either end.
    pub twist: f64,
    /// Direction in which each cut rises, rad, from axis y of the profile: clockwise as seen along
    /// the beam from that end, the far end turned up about y; 0 for a square cut.
    pub leans: [f64; 2],
}

impl CutBeam {
    /// The beam with its ends cut; `None` if too little of it is left.
    pub(super) fn new(beam: &Beam, ends: [EndCut; 2]) -> Option<Self> {
        let axis_length = beam.cut_length - ends[0].setback - ends[1].setback;
        let [start, end] = [slopes(beam, &ends[0]), slopes(beam, &ends[1])];
        let corners = &beam.shape.stations;
        let outline =
            |station: usize| Contours::of_region(&corners[station].region, PER_QUARTER).outer;
        let (first, last) = (outline(0), outline(corners.len() - 1));
        let lows: Vec<f64> = first.iter().map(|p| start[0] * p.x + start[1] * p.y).collect();
        let highs: Vec<f64> =
            last.iter().map(|p| axis_length + end[0] * p.x + end[1] * p.y).collect();
        let [low, high_of_low] = range(&lows);
        let [low_of_high, high] = range(&highs);
        (low_of_high - high_of_low >= LEAST_LEFT * beam.length).then(|| Self {
            ends,
            axis_length,
            length: high - low,
            twist: twist(start, end),
            leans: leans(start, end),
        })
    }

    /// The beam cut square at its nodes.
    pub(super) fn square(beam: &Beam) -> Self {
        let length = beam.cut_length;
        Self { ends: [EndCut::SQUARE; 2], axis_length: length, length, twist: 0.0, leans: [0.0; 2] }
    }
}

/// Rise of a cut along the axis for each mm along y and z of the profile.
pub(super) fn slopes(beam: &Beam, cut: &EndCut) -> [f64; 2] {
    let Some(normal) = cut.normal else { return [0.0; 2] };
    let axes = beam.axes.rolled(beam.shape.roll);
    let along = normal.dot(&axes.x);
    [-normal.dot(&axes.y) / along, -normal.dot(&axes.z) / along]
}

/// Turn from the direction in which the first cut rises to that of the second.
fn twist(start: [f64; 2], end: [f64; 2]) -> f64 {
    if start == [0.0; 2] || end == [0.0; 2] {
        return 0.0;
    }
    let cross = start[0] * end[1] - start[1] * end[0];
    let dot = start[0] * end[0] + start[1] * end[1];
    let twist = cross.atan2(dot);
    // Half a turn either way is the same.
    if twist < SQUARE_ENOUGH - PI { -twist } else { twist }
}

/// Directions of the rises: the first as it is, the second after half a turn of the beam about y.
fn leans([y, z]: [f64; 2], [far_y, far_z]: [f64; 2]) -> [f64; 2] {
    let direction = |y: f64, z: f64| if y == 0.0 && z == 0.0 { 0.0 } else { z.atan2(y) };
    [direction(y, z), direction(-far_y, far_z)]
}

fn range(values: &[f64]) -> [f64; 2] {
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], &v| [l.min(v), h.max(v)])
}
