//! How far the beams leave the branches they stand for.

use nalgebra::Point3;

use super::params::FrameParams;
use super::pieces::{Making, Piece};
use super::straighten::distance_to_segment;
use crate::finding::{Finding, FindingKind};
use crate::mesh::TriangleTree;

/// A piece is broken once more only where both parts are at least this many radii long: shorter
/// than wide, a piece is no beam.
const SHORTEST_PART: f64 = 1.5;

/// How much farther than wanted a branch may bend away: joints shared with others take their part.
const GRACE: f64 = 1.33;

/// The place where a branch is farthest from its beams.
struct Worst {
    /// Index among the points of the piece.
    at: usize,
    centroid: Point3<f64>,
    /// Distance, mm, and in section radii.
    distance: f64,
    radii: f64,
}

/// Breaks the pieces that bend away by more than wanted; whether there was any.
pub(super) fn split_bent(making: &mut Making<'_>, params: &FrameParams) -> bool {
    let mut bent = Vec::new();
    for (i, piece) in making.pieces.iter().enumerate() {
        if !piece.passes.is_empty() {
            continue; // a member was found straight before it was joined
        }
        let radius = making.radius(piece);
        let [a, b] = making.axis(piece);
        let far = |p: &Point3<f64>| (p - a).norm().min((p - b).norm()) >= SHORTEST_PART * radius;
        let worst = worst(making, piece, |p| far(p));
        if let Some(worst) = worst.filter(|w| w.radii > params.max_deviation) {
            bent.push((i, worst.at));
        }
    }
    for &(i, at) in bent.iter().rev() {
        making.split(i, at);
    }
    !bent.is_empty()
}

/// The farthest centroid of a piece from its axis and from those of the pieces it meets, among the
/// places that count.
fn worst(
    making: &Making<'_>,
    piece: &Piece,
    counts: impl Fn(&Point3<f64>) -> bool,
) -> Option<Worst> {
    let near: Vec<[Point3<f64>; 2]> = making
        .pieces
        .iter()
        .filter(|p| p.ends.iter().any(|n| piece.ends.contains(n)))
        .map(|p| making.axis(p))
        .collect();
    let stations = making.beam_section(piece).stations;
    let swollen =
        |p: u32| stations.iter().any(|station| station.point == p && station.is_outlier());
    let places = piece.points.iter().enumerate().filter(|(_, p)| !swollen(**p));
    places
        .filter_map(|(at, &p)| {
            let section = making.sections[p as usize].as_ref()?;
            let centroid = section.centroid;
            let distances = near.iter().map(|[a, b]| distance_to_segment(&centroid, a, b));
            let distance = distances.fold(f64::INFINITY, f64::min);
            counts(&centroid).then(|| Worst {
                at,
                centroid,
                distance,
                radii: distance / section.radius(),
            })
        })
        .max_by(|a, b| a.radii.total_cmp(&b.radii))
}

/// Names the beams whose branch bends away by more than was asked for.
pub(super) fn report(making: &Making<'_>, params: &FrameParams, findings: &mut Vec<Finding>) {
    for (i, piece) in making.pieces.iter().enumerate() {
        let worst = worst(making, piece, |_| true);
        if let Some(worst) = worst.filter(|w| w.radii > GRACE * params.max_deviation) {
            findings.push(Finding::note(
                FindingKind::Deviation,
                Some(worst.centroid),
                format!(
                    "beam {} leaves its branch by {:.2} mm ({:.2} section radii)",
                    i + 1,
                    worst.distance,
                    worst.radii
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
    let names: Vec<String> = outside.iter().map(|i| (i + 1).to_string()).collect();
    findings.push(Finding::note(
        FindingKind::BeamOutside,
        Some(nalgebra::center(&a, &b)),
        format!("{} beam axis(es) leave the material: beam {}", names.len(), names.join(", ")),
    ));
}
