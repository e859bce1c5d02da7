//! What of the part the skeleton says nothing about: surface far from every branch is that of a
//! plate or a block, not of a beam.

use nalgebra::Point3;

use super::error::{SkeletonError, keep_on};
use super::graph::Skeleton;
use super::places::{Place, places};
use crate::finding::{Finding, FindingKind};
use crate::mesh::Surface;
use crate::observer::Observer;
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
pub(super) fn uncovered(
    surface: &Surface,
    skeleton: &Skeleton,
    observer: &mut impl Observer,
) -> Result<Option<Finding>, SkeletonError> {
    let places = places(surface, |_| true, surface.design_area() / PLACES);
    let reach = REACH * surface.mean_radius();
    let mut branches: Vec<Segment> =
        skeleton.segments().map(|s| Segment::of(skeleton, s, reach)).collect();
    let mut far = Vec::new();
    for Place { point, .. } in &places {
        keep_on(observer)?;
        match branches.iter().position(|s| s.beyond(point) <= 0.0) {
            // The surface is numbered outwards along several branches at once: those met last are
            // asked first.
            Some(met) => branches[..=met].rotate_right(1),
            None => {
                let beyond = branches.iter().map(|s| s.beyond(point)).fold(f64::INFINITY, f64::min);
                far.push((beyond, *point));
            }
        }
    }
    let part = far.len() as f64 / places.len().max(1) as f64;
    let farthest = far.iter().max_by(|a, b| a.0.total_cmp(&b.0)).map(|f| f.1);
    Ok((part > WORTH_SAYING).then(|| {
        Finding::note(
            FindingKind::NotBeamLike,
            farthest,
            format!(
                "{:.0} % of the design surface is far from every branch: a plate or a block there \
                 is not beam-like and is left out, in whole or in part",
                100.0 * part
            ),
        )
    }))
}

/// A straight piece of a branch and how far it tells the surface, mm.
struct Segment {
    ends: [Point3<f64>; 2],
    reach: f64,
}

impl Segment {
    fn of(skeleton: &Skeleton, ends: [u32; 2], reach: f64) -> Self {
        let [a, b] = ends.map(|e| skeleton.points[e as usize].radius);
        let reach = reach.max(REACH_OF_A_THICK_BRANCH * a.max(b));
        Self { ends: ends.map(|e| skeleton.position(e)), reach }
    }

    /// How far beyond its reach a place lies, mm.
    fn beyond(&self, place: &Point3<f64>) -> f64 {
        distance(place, &self.ends[0], &self.ends[1]) - self.reach
    }
}
