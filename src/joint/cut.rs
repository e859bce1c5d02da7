//! One beam with its two ends cut.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Point2, Unit, Vector2, Vector3};

use crate::frame::Beam;
use crate::saddle::Saddle;
use crate::section::contours::Contours;
use crate::section::outline::Outline;

/// A beam keeps at least this part of its length between its cuts.
const LEAST_LEFT: f64 = 0.2;

/// Points on a quarter of a curved outline, where its extent is asked for: 0.1 % of it.
pub(super) const PER_QUARTER: usize = 16;

/// How an end of a beam is cut: in a plane, or along the side of a round member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndCut {
    /// Way along the axis from the node to the cut, mm; positive shortens the beam.
    pub setback: f64,
    /// Normal of the plane in model coordinates; `None` for a square cut and for a saddle.
    pub normal: Option<Unit<Vector3<f64>>>,
    /// The side of the member, in coordinates of the solid: across (y and z of the beam turned by
    /// its roll), then along; `None` for a plane.
    pub saddle: Option<Saddle>,
    /// Angle between the cut and a square one, rad, 0 to π/2; of a saddle, between the beam and a
    /// right angle to the member.
    pub angle: f64,
}

/// Cuts nearer to square than this are square: a saw is set to a twentieth of a degree.
const SQUARE_ENOUGH: f64 = 8.7e-4;

impl EndCut {
    /// At a right angle to the axis, at the node.
    pub const SQUARE: Self = Self { setback: 0.0, normal: None, saddle: None, angle: 0.0 };

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
        Self { setback, normal: Some(normal), saddle: None, angle }
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
    /// is clockwise as seen along the beam, from either end. A saddle leans along its member; on one
    /// at a right angle both ways are the same, and the turn is in (−π/2, π/2].
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
        let rises = |outline: &[Point2<f64>], end: usize| -> Vec<f64> {
            outline.iter().map(|p| rise(beam, &ends[end], p)).collect()
        };
        let reach = |outline: &[Point2<f64>], end: usize| {
            let radius = round(&corners[0].region.outer);
            match ends[end].saddle.zip(radius) {
                Some((saddle, radius)) => saddle.range(radius),
                None => range(&rises(outline, end)),
            }
        };
        let [low, high_of_low] = reach(&first, 0);
        let [low_of_high, high] = reach(&last, 1).map(|z| axis_length + z);
        (low_of_high - high_of_low >= LEAST_LEFT * beam.length).then(|| Self {
            ends,
            axis_length,
            length: high - low,
            twist: twist(lean(beam, &ends[0]), lean(beam, &ends[1])),
            leans: leans(start, end),
        })
    }

    /// The beam cut square at its nodes.
    pub(super) fn square(beam: &Beam) -> Self {
        let length = beam.cut_length;
        Self { ends: [EndCut::SQUARE; 2], axis_length: length, length, twist: 0.0, leans: [0.0; 2] }
    }
}

/// Radius of an outline that is a circle about the axis, mm.
pub(super) fn round(outline: &Outline) -> Option<f64> {
    match outline {
        Outline::Circle { centre, radius } if *centre == Point2::origin() => Some(*radius),
        _ => None,
    }
}

/// How far a cut stands above where it meets the axis, at a point of the section, mm.
pub(super) fn rise(beam: &Beam, cut: &EndCut, p: &Point2<f64>) -> f64 {
    match cut.saddle {
        Some(saddle) => saddle.rise(p),
        None => Vector2::from(slopes(beam, cut)).dot(&p.coords),
    }
}

/// Rise of a cut along the axis for each mm along y and z of the profile, at the axis.
pub(super) fn slopes(beam: &Beam, cut: &EndCut) -> [f64; 2] {
    if let Some(saddle) = cut.saddle {
        return saddle.slope().into();
    }
    let Some(normal) = cut.normal else { return [0.0; 2] };
    let axes = beam.axes.rolled(beam.shape.roll);
    let along = normal.dot(&axes.x);
    [-normal.dot(&axes.y) / along, -normal.dot(&axes.z) / along]
}

/// Where a cut leans.
#[derive(Clone, Copy)]
enum Lean {
    Nowhere,
    Towards(Vector2<f64>),
    /// On a member at a right angle: as much to either side.
    Along(Vector2<f64>),
}

fn lean(beam: &Beam, cut: &EndCut) -> Lean {
    match cut.saddle {
        Some(saddle) if cut.angle == 0.0 => Lean::Along(saddle.along()),
        None if cut.normal.is_none() => Lean::Nowhere,
        _ => Lean::Towards(slopes(beam, cut).into()),
    }
}

/// Turn from the direction in which the first cut leans to that of the second.
fn twist(start: Lean, end: Lean) -> f64 {
    let (Lean::Towards(a) | Lean::Along(a), Lean::Towards(b) | Lean::Along(b)) = (start, end)
    else {
        return 0.0;
    };
    let twist = a.perp(&b).atan2(a.dot(&b));
    let has_line = matches!(start, Lean::Along(_)) || matches!(end, Lean::Along(_));
    let half = if has_line { FRAC_PI_2 } else { PI };
    let twist = if twist > half + SQUARE_ENOUGH {
        twist - 2.0 * half
    } else if twist < -half - SQUARE_ENOUGH {
        twist + 2.0 * half
    } else {
        twist
    };
    // The farthest turn either way is the same.
    if twist < SQUARE_ENOUGH - half { -twist } else { twist }
}

/// Directions of the rises: the first as it is, the second after half a turn of the beam about y.
fn leans([y, z]: [f64; 2], [far_y, far_z]: [f64; 2]) -> [f64; 2] {
    let direction = |y: f64, z: f64| if y == 0.0 && z == 0.0 { 0.0 } else { z.atan2(y) };
    [direction(y, z), direction(-far_y, far_z)]
}

fn range(values: &[f64]) -> [f64; 2] {
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], &v| [l.min(v), h.max(v)])
}
