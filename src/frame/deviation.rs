//! How far the beams leave the branches they stand for.

use nalgebra::Point3;

use super::beam_station::BeamStation;
use super::params::FrameParams;
use super::pieces::{Making, Piece};
use crate::finding::{Finding, FindingKind};
use crate::mesh::TriangleTree;
use crate::segment;

/// How much farther than wanted a branch may bend away: joints shared with others take their part.
const GRACE: f64 = 1.33;

/// The place where a branch is farthest from its beams.
pub(super) struct Worst {
    centroid: Point3<f64>,
    /// Distance, mm, and in half-depths of the section.
    distance: f64,
    pub(super) depths: f64,
}

/// The centroid of a piece that is farthest from its axis and from those of the pieces it meets.
pub(super) fn worst(making: &Making<'_>, piece: &Piece) -> Option<Worst> {
    let near: Vec<[Point3<f64>; 2]> = making
        .pieces
        .iter()
        .filter(|p| p.ends.iter().any(|n| piece.ends.contains(n)))
        .map(|p| making.axis(p))
        .collect();
    let stations = making.beam_section(piece).stations;
    let radius = making.radius(piece);
    let is_own = |s: &&BeamStation| making.own(piece, radius, s) >= 0.5;
    let places = stations.iter().filter(is_own).map(|s| &s.point);
    places
        .filter_map(|&p| {
            let centroid = making.sections[p as usize].as_ref()?.centroid;
            let depths = making.depths[p as usize]?;
            let offsets = near.iter().map(|[a, b]| segment::offset(&centroid, a, b));
            let (depths, distance) = offsets
                .map(|offset| (depths.in_depths(&offset), offset.norm()))
                .min_by(|a, b| a.0.total_cmp(&b.0))?;
            Some(Worst { centroid, distance, depths })
        })
        .max_by(|a, b| a.depths.total_cmp(&b.depths))
}

/// Names the beams whose branch bends away by more than was asked for.
pub(super) fn report(making: &Making<'_>, params: &FrameParams, findings: &mut Vec<Finding>) {
    for (i, piece) in making.pieces.iter().enumerate() {
        let worst = worst(making, piece);
        if let Some(worst) = worst.filter(|w| w.depths > GRACE * params.max_deviation) {
            findings.push(Finding::note(
                FindingKind::Deviation,
                Some(worst.centroid),
                format!(
                    "{} leaves its branch by {:.2} mm ({:.2} section radii)",
                    super::mark(i),
                    worst.distance,
                    worst.depths
                ),
            ));
        }
    }
}

/// Names the beams whose axis leaves the material, all in one.
pub(super) fn report_outside(
    making: &Making<'_>,
    tree: &TriangleTree,
    findings: &mut Vec<Finding>,
) {
    let outside: Vec<usize> = (0..making.pieces.len())
        .filter(|&i| super::hold::leaves_material(making, &making.pieces[i], tree))
        .collect();
    let Some(&first) = outside.first() else { return };
    let [a, b] = making.axis(&making.pieces[first]);
    let marks: Vec<String> = outside.iter().map(|&i| super::mark(i)).collect();
    findings.push(Finding::note(
        FindingKind::BeamOutside,
        Some(nalgebra::center(&a, &b)),
        format!("the axis leaves the material of {}", marks.join(", ")),
    ));
}
