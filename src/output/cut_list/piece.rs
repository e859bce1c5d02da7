//! One kind of piece: beams of one profile that are cut alike.

use serde::Serialize;

use super::CutListParams;
use crate::frame::{Beam, Frame};
use crate::joint::{Alike, CutBeam, Joints};
use crate::output::assembly::{SolidSize, mark};
use crate::section::matching::folded_angle;
use crate::wording::{rounded, rounded_figures};

/// A kind of piece. Lengths in mm, angles in degrees.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Piece {
    /// Its own mark: `P01`.
    pub piece: String,
    /// Marks of the beams that are cut like this, as in the STEP file.
    pub marks: Vec<String>,
    /// How many of them there are.
    pub quantity: usize,
    /// Profile, such as `CHS 60.3x4`.
    pub profile: String,
    /// Family of the profile.
    pub family: String,
    /// Standard of the profile; empty for one made to measure.
    pub standard: String,
    /// Material.
    pub material: String,
    /// Length to saw off a bar, from the farthest corner to the farthest.
    pub length_mm: f64,
    /// Length along the axis between the cuts.
    pub axis_length_mm: f64,
    /// Cut at the first end; 0 is square, with a saddle at a right angle to the member.
    pub angle_1_deg: f64,
    /// Cut at the second end.
    pub angle_2_deg: f64,
    /// Diameter of the round member the first end is a saddle on; 0 for a plane.
    pub saddle_1_mm: f64,
    /// Diameter of the round member the second end is a saddle on; 0 for a plane.
    pub saddle_2_mm: f64,
    /// Turn of the second cut against the first about the axis, −180 to 180; 0 where both lean the
    /// same way, positive clockwise as seen along the piece.
    pub twist_deg: f64,
    /// Direction in which the first cut rises, from axis y of the profile, clockwise as seen along
    /// the piece from there; 0 for a round one, within half a turn for one that is the same after
    /// it. Pieces that are mirror images differ in its sign or in that of the twist.
    pub lean_deg: f64,
    /// Farthest a corner of one of the beams lies from that of the piece: they are made equal.
    pub off_mm: f64,
    /// Area of the profile, mm².
    pub area_mm2: f64,
    /// Mass of one, kg.
    pub unit_mass_kg: f64,
    /// Mass of all, kg.
    pub mass_kg: f64,
    /// Surface to paint of one, m²: its outside without the cuts.
    pub unit_surface_m2: f64,
    /// Branches of the skeleton the beams came from.
    pub branches: Vec<u32>,
}

/// All kinds of pieces, sorted by profile and length, the longest first.
pub(super) fn pieces(
    frame: &Frame,
    joints: &Joints,
    sizes: &[SolidSize],
    params: &CutListParams,
) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    for (i, &Alike { kind, off, .. }) in joints.alike.iter().enumerate() {
        let beam = &frame.beams[i];
        if kind == pieces.len() {
            pieces.push(piece(beam, &joints.beams[i], sizes[kind], params));
        }
        let piece = &mut pieces[kind];
        piece.marks.push(mark(i));
        piece.branches.extend(beam.spans().map(|(_, branch)| branch));
        piece.quantity += 1;
        piece.off_mm = piece.off_mm.max(rounded(off, 3));
    }
    pieces.sort_by(|a, b| {
        let angles = |p: &Piece| (p.angle_1_deg, p.angle_2_deg);
        a.profile
            .cmp(&b.profile)
            .then(b.length_mm.total_cmp(&a.length_mm))
            .then(angles(a).0.total_cmp(&angles(b).0))
            .then(angles(a).1.total_cmp(&angles(b).1))
    });
    let digits = pieces.len().to_string().len().max(2);
    for (i, piece) in pieces.iter_mut().enumerate() {
        piece.piece = format!("P{:0digits$}", i + 1);
        piece.mass_kg = rounded_figures(piece.unit_mass_kg * piece.quantity as f64, 6);
    }
    pieces
}

/// A piece that is cut like a beam, before any beam is counted.
fn piece(beam: &Beam, cut: &CutBeam, size: SolidSize, params: &CutListParams) -> Piece {
    let shape = &beam.shape;
    let [a, b] = [&cut.ends[0], &cut.ends[1]].map(|e| rounded(e.angle.to_degrees(), 1));
    // Either end may be called the first: the more oblique one is.
    let first = usize::from(b > a);
    let lean = folded_angle(cut.leans[first], shape.profile.shape.symmetry());
    let saddle = |end: usize| cut.ends[end].saddle.map_or(0.0, |s| rounded(2.0 * s.radius, 3));
    Piece {
        piece: String::new(),
        marks: Vec::new(),
        quantity: 0,
        profile: shape.name(),
        family: shape.profile.family().to_owned(),
        standard: shape.profile.designation.as_ref().map_or(String::new(), |d| d.standard.clone()),
        material: params.material.name.clone(),
        length_mm: rounded_figures(cut.length, 3),
        axis_length_mm: rounded_figures(cut.axis_length, 3),
        angle_1_deg: a.max(b),
        angle_2_deg: a.min(b),
        saddle_1_mm: saddle(first),
        saddle_2_mm: saddle(1 - first),
        twist_deg: rounded(cut.twist.to_degrees(), 1),
        lean_deg: rounded(lean.to_degrees(), 1),
        off_mm: 0.0,
        area_mm2: rounded_figures(shape.properties.area, 3),
        unit_mass_kg: rounded_figures(size.volume * params.material.density * 1e-9, 6),
        mass_kg: 0.0,
        unit_surface_m2: rounded_figures(size.skin * 1e-6, 6),
        branches: Vec::new(),
    }
}
