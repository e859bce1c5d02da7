//! What of the part the skeleton says nothing about: surface far from every branch is that of a
//! plate or a block, not of a beam.

use nalgebra::Point3;

use super::graph::Skeleton;
use super::places::places;
use crate::finding::{Finding, FindingKind};
use crate::mesh::Surface;
use crate::segment::distance;

/// A branch tells the surface within so many mean strut radii: the edges of a flat bar of 5 : 1 are
/// within, those of a plate are not.
const REACH: f64 = 3.0;

/// A branch much thicker than the others tells the surface within so many of its own radii.
const REACH_OF_A_THICK_BRANCH: f64 = 1.5;

/// Part of the design surface from which on it is worth saying. The corners of thick interface
/// sections make up to a thousandth, a plate with its skeleton along the diagonals a fifth.
const WORTH_SAYING: f64 = 0.01;

/// Places that are asked: a plate of a hundredth of the surface has ten of them.
const PLACES: f64 = 1000.0;

/// A finding when more than a trifle of the design surface lies far from the skeleton, at the
/// place that lies farthest.
pub(super) fn uncovered(surface: &Surface, skeleton: &Skeleton) -> Option<Finding> {
    let is_design = |f| surface.labels.is_design(f);
    let places = places(&surface.mesh, is_design, surface.design_area() / PLACES);
    let reach = REACH * surface.mean_radius();
    let branches: Vec<Segment> = skeleton.segments().map(|s| Segment::of(skeleton, s)).collect();
    let mut far = Vec::new();
    for place in &places {
        let beyond = branches
            .iter()
            .map(|s| {
                distance(&place.point, &s.ends[0], &s.ends[1])
                    - reach.max(REACH_OF_A_THICK_BRANCH * s.radius)
            })
            .fold(f64::INFINITY, f64::min);
        if beyond > 0.0 {
            far.push((beyond, place.point));
        }
    }
    let part = far.len() as f64 / places.len().max(1) as f64;
    let farthest = far.iter().max_by(|a, b| a.0.total_cmp(&b.0)).map(|f| f.1)?;
    (part > WORTH_SAYING).then(|| {
        Finding::note(
            FindingKind::NotBeamLike,
            Some(farthest),
            format!(
                "{:.0} % of the design surface is far from every branch: a plate or a block there \
                 is not beam-like and is left out, in whole or in part",
                100.0 * part
            ),
        )
    })
}

/// A straight piece of a branch.
struct Segment {
    ends: [Point3<f64>; 2],
    radius: f64,
}

impl Segment {
    fn of(skeleton: &Skeleton, ends: [u32; 2]) -> Self {
        let radius = ends.map(|e| skeleton.points[e as usize].radius);
        Self { ends: ends.map(|e| skeleton.position(e)), radius: radius[0].max(radius[1]) }
    }
}
