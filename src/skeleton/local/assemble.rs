//! Turns hubs and runs into points and branches, every segment inside.

use super::draft::{Draft, HubKind, Run};
use super::sample::{Sample, samples};
use crate::mesh::Surface;
use crate::observer::Observer;
use crate::skeleton::error::SkeletonError;
use crate::skeleton::graph::{Branch, PointKind, SkeletalPoint, Skeleton};
use crate::skeleton::inside::way_inside;
use crate::skeleton::watch::Watch;

/// Places the points of every run about `step` apart and chains runs over knees to branches.
pub(crate) fn assemble(
    surface: &Surface,
    step: f64,
    draft: &Draft,
    watch: &mut Watch<'_, impl Observer>,
) -> Result<Skeleton, SkeletonError> {
    let at = draft.incidences();
    let mut skeleton = Skeleton::default();
    let of_hub = hub_points(draft, &at, &mut skeleton);
    let mut chains: Vec<Vec<u32>> = Vec::with_capacity(draft.runs.len());
    for run in &draft.runs {
        let hubs = run.hubs.map(|h| &draft.hubs[h]);
        let placed = samples(surface, run, hubs, step, watch)?;
        let ends = run.hubs.map(|h| of_hub[h]);
        chains.push(run_points(surface, run, &placed, ends, &mut skeleton, watch)?);
    }
    skeleton.branches = chained(draft, &at, &chains);
    Ok(skeleton)
}

/// One point for every hub in use; its index by hub.
fn hub_points(draft: &Draft, at: &[Vec<(usize, usize)>], skeleton: &mut Skeleton) -> Vec<u32> {
    let mut of_hub = vec![u32::MAX; draft.hubs.len()];
    for (hub, runs) in at.iter().enumerate().filter(|(_, runs)| !runs.is_empty()) {
        of_hub[hub] = skeleton.points.len() as u32;
        let kind = match draft.hubs[hub].kind {
            HubKind::Joint => PointKind::Junction,
            HubKind::Interface(_) => PointKind::Interface,
            HubKind::Tip => PointKind::End,
            HubKind::Knee => PointKind::Branch,
        };
        let radius = runs.iter().map(|&(r, _)| draft.runs[r].radius()).fold(0.0, f64::max);
        skeleton.points.push(SkeletalPoint { position: draft.hubs[hub].position, radius, kind });
    }
    of_hub
}

/// Adds the points of a run; the indices of all, those of its hubs included.
fn run_points(
    surface: &Surface,
    run: &Run,
    samples: &[Sample],
    ends: [u32; 2],
    skeleton: &mut Skeleton,
    watch: &mut Watch<'_, impl Observer>,
) -> Result<Vec<u32>, SkeletonError> {
    let [start, end] = ends.map(|e| skeleton.position(e));
    let mut chain = vec![ends[0]];
    let mut add = |position, radius| {
        chain.push(skeleton.points.len() as u32);
        skeleton.points.push(SkeletalPoint { position, radius, kind: PointKind::Branch });
    };
    let mut at = start;
    for &Sample { position, radius } in samples {
        watch.keep_on()?;
        for between in way_inside(surface, &at, &position, watch)? {
            add(between, radius);
        }
        add(position, radius);
        at = position;
    }
    for between in way_inside(surface, &at, &end, watch)? {
        add(between, run.radius());
    }
    chain.push(ends[1]);
    Ok(chain)
}

/// Joins the chains of runs over knees, in the order of the first run of each branch.
fn chained(draft: &Draft, at: &[Vec<(usize, usize)>], chains: &[Vec<u32>]) -> Vec<Branch> {
    let is_knee = |hub: usize| draft.hubs[hub].kind == HubKind::Knee;
    let mut used = vec![false; draft.runs.len()];
    let mut branches = Vec::new();
    // Branches that begin at a hub proper first, then rings of knees.
    for rings in [false, true] {
        for r in 0..draft.runs.len() {
            for end in 0..2 {
                if used[r] || (!rings && is_knee(draft.runs[r].hubs[end])) {
                    continue;
                }
                branches.push(walk(draft, at, chains, &mut used, (r, end)));
            }
        }
    }
    branches
}

/// Follows runs from one end over knees.
fn walk(
    draft: &Draft,
    at: &[Vec<(usize, usize)>],
    chains: &[Vec<u32>],
    used: &mut [bool],
    (mut run, mut end): (usize, usize),
) -> Branch {
    let mut points: Vec<u32> = Vec::new();
    loop {
        used[run] = true;
        let skip = usize::from(!points.is_empty());
        if end == 0 {
            points.extend(chains[run].iter().skip(skip));
        } else {
            points.extend(chains[run].iter().rev().skip(skip));
        }
        let hub = draft.runs[run].hubs[1 - end];
        let onward = at[hub].iter().find(|(r, _)| !used[*r]);
        match onward {
            Some(&next) if draft.hubs[hub].kind == HubKind::Knee => (run, end) = next,
            _ => return Branch { points },
        }
    }
}
