//! The march in the local frame (thesis §5.2.2): the identifier box turns with the branch.
//!
//! | step | what | module |
//! |---|---|---|
//! | 1 | every place of the surface is asked whether it lies on a rod | `seed` |
//! | 2 | from there a front marches both ways to the ends of the rod and claims the surface | `march`, `band`, `claim` |
//! | 3 | the surface is cut along one front of each rod; pieces with a handle are searched again | `cutting`, `patch`, `search` |
//! | 4 | pieces become hubs, rods become runs; false joints go | `draft`, `simplify` |
//! | 5 | joints are placed where the straight axes of their runs meet (§5.2.6), or in the middle of the material | `axis`, `junction`, `centre` |
//! | 6 | points are spread along the runs and moved to the centroids of their sections (§5.2.5) | `sample` |
//!
//! Step 3 is what makes the topology sound: every piece, closed over its cuts, is a sphere, so the
//! graph of pieces and rods has the tunnels of the object, neither more nor fewer.
//!
//! # What differs from the thesis
//!
//! * A march starts wherever a rod is found, not only at interface sections, so branches between
//!   two junctions need no guess of their direction (§3.4.3.1) and no second box twice as large.
//! * The skeletal point is the area centroid of the branch's own contour, not the mean of the nodes
//!   in the box; it does not depend on how finely one side is meshed.

mod assemble;
mod axis;
mod band;
mod centre;
mod claim;
mod curve;
mod cutting;
mod draft;
mod handles;
mod junction;
mod march;
pub(super) mod patch;
mod sample;
mod search;
mod section_near;
mod seed;
mod simplify;
mod stocky;
mod trend;
mod way;

use self::curve::MOST_PIECES;
use self::draft::{Draft, HubKind};
use self::march::March;
use super::Marched;
use super::error::SkeletonError;
use super::params::SkeletonParams;
use super::watch::Watch;
use crate::finding::{Finding, FindingKind};
use crate::mesh::Surface;
use crate::observer::Observer;
use crate::wording::counted;

/// Marches the skeleton of a surface in the local frame.
///
/// # Errors
/// No rod anywhere, or the observer asked to stop.
pub fn skeleton(
    surface: &Surface,
    params: &SkeletonParams,
    observer: &mut impl Observer,
) -> Result<Marched, SkeletonError> {
    let mean_radius = surface.mean_radius();
    let mut march = March::new(surface, params);
    let found = search::find_tubes(&mut march, mean_radius, observer)?;
    let mut draft = Draft::new(&found, surface);
    if draft.runs.is_empty() {
        return Err(SkeletonError::NotBeamLike { near: surface.mesh.positions()[0] });
    }
    simplify::simplify(&mut draft, surface, observer)?;
    if draft.runs.len() == 1 && is_block(&draft) {
        return Err(SkeletonError::NotBeamLike { near: surface.mesh.positions()[0] });
    }
    let step = params.step * mean_radius;
    let mut watch = Watch::new(observer);
    let (is_centred, said) = centre::is_centred(&draft, params.junctions);
    if is_centred {
        centre::centre_joints(&mut draft, surface, step, &mut watch)?;
    }
    let skeleton = assemble::assemble(surface, step, &draft, &mut watch)?;
    Ok(Marched { skeleton, findings: findings(surface, &draft, step, said) })
}

/// A single rod with free ends is shorter than this many of its radii when it is a block: a cube is
/// 1.4 long, a bar twice as long as it is thick 3.5.
const BLOCK: f64 = 2.0;

/// Whether the only run of a part with free ends is too short to be a beam.
fn is_block(draft: &Draft) -> bool {
    let run = &draft.runs[0];
    let [a, b] = run.hubs.map(|h| &draft.hubs[h]);
    let is_free = a.kind == HubKind::Tip && b.kind == HubKind::Tip;
    is_free && (a.position - b.position).norm() < BLOCK * run.radius()
}

/// A branch that has as many points as a branch may have, farther apart than wanted.
fn slender(draft: &Draft, step: f64) -> Option<Finding> {
    let lengths = draft.runs.iter().map(|run| (run.length(), run));
    let (length, longest) = lengths.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let apart = length / MOST_PIECES;
    (apart > step).then(|| {
        let middle = longest.stations.get(longest.stations.len() / 2).map(|s| s.centroid);
        let thick = length / (2.0 * longest.radius());
        let text = format!(
            "a branch is {thick:.0} times as long as it is thick: its points are {apart:.3} mm apart, \
             not {step:.3} mm"
        );
        Finding::note(FindingKind::Slender, middle, text)
    })
}

fn findings(surface: &Surface, draft: &Draft, step: f64, centred: Option<Finding>) -> Vec<Finding> {
    let idle = draft.idle_interfaces.iter().map(|&i| {
        Finding::note(
            FindingKind::IdleInterface,
            Some(surface.interfaces[i].centroid),
            "a lump on a non-design part is no branch and was left out",
        )
    });
    let blobs = (draft.blobs > 0).then(|| {
        Finding::note(
            FindingKind::NotBeamLike,
            None,
            format!("{} without any rod left out", counted(draft.blobs, "body", "bodies")),
        )
    });
    idle.chain(blobs).chain(centred).chain(slender(draft, step)).collect()
}
