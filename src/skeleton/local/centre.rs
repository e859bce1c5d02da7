//! Joints in the middle of the material, for parts that are no frames of straight bars.
//!
//! A joint goes where its branches' first points are on average, they go to the centroids of their
//! sections, in turns. So the joint slides into the lump of material round it, and no section next
//! to it slices another branch along its length.

use nalgebra::{Point3, Vector3};

use super::axis::all_pass;
use super::draft::{Draft, HubKind, Run};
use super::junction::{axes_at, nearest_inside};
use super::sample::{Known, moved};
use super::trend::Trend;
use crate::finding::{Finding, FindingKind};
use crate::mesh::Surface;
use crate::observer::Observer;
use crate::skeleton::error::SkeletonError;
use crate::skeleton::params::Junctions;
use crate::skeleton::watch::Watch;
use crate::wording::counted;

/// Most turns. Joints settle in about six.
const TURNS: usize = 12;

/// A joint has settled when it moves by less than this part of the step.
const SETTLED: f64 = 0.01;

/// Axes that pass each other farther than this part of their radius do not meet: there is no place
/// where straight bars would. Those of frames whose bars are lumpy miss by up to 0.26, those of
/// optimized webs that run together by 0.41 and more.
const APART: f64 = 1.0 / 3.0;

/// A part is no frame of straight bars where at least this share of its joints has axes apart: one
/// joint in seven of a coarse frame had, one in four of the cantilever of 1.4 mm.
const OFTEN: f64 = 0.2;

/// Whether joints lie in the middle of the material rather than where axes meet, and a word to the
/// user where that was not asked for.
pub(crate) fn is_centred(draft: &Draft, junctions: Junctions) -> (bool, Option<Finding>) {
    match junctions {
        Junctions::Axes => (false, None),
        Junctions::Centred => (true, None),
        Junctions::Auto => {
            let at = draft.incidences();
            let joints = free_joints(draft, &at);
            let is_apart = |&&hub: &&usize| is_apart(draft, &at[hub], hub);
            let apart: Vec<&usize> = joints.iter().filter(is_apart).collect();
            let [first, ..] = apart[..] else { return (false, None) };
            let is_often = apart.len() as f64 >= OFTEN * joints.len() as f64;
            let place = draft.hubs[*first].position;
            (is_often, is_often.then(|| no_straight_bars(apart.len(), joints.len(), place)))
        }
    }
}

fn no_straight_bars(apart: usize, joints: usize, first: Point3<f64>) -> Finding {
    let of = counted(joints, "junction", "junctions");
    Finding::note(
        FindingKind::CentredJunctions,
        Some(first),
        format!(
            "at {apart} of {of} the axes of the branches do not meet: junctions lie in the middle of \
             the material (choose with --junctions)"
        ),
    )
}

/// Moves every joint into the middle of the first points of its branches, about `step` away.
pub(crate) fn centre_joints(
    draft: &mut Draft,
    surface: &Surface,
    step: f64,
    watch: &mut Watch<'_, impl Observer>,
) -> Result<(), SkeletonError> {
    let at = draft.incidences();
    let joints = free_joints(draft, &at);
    joints.iter().for_each(|&hub| draft.hubs[hub].is_centred = true);
    let mut beside = vec![[Point3::origin(); 2]; draft.runs.len()];
    let mut known: Vec<Known> = draft.runs.iter().map(|_| Known::of_ends()).collect();
    let mut has_moved = vec![true; draft.hubs.len()];
    for _ in 0..TURNS {
        for ((points, known), run) in beside.iter_mut().zip(&mut known).zip(&draft.runs) {
            if run.hubs.iter().any(|&hub| has_moved[hub]) {
                *points = beside_hubs(draft, surface, run, step, known, watch)?;
            }
        }
        has_moved.fill(false);
        for &joint in &joints {
            let runs = &at[joint];
            let sum: Vector3<f64> = runs.iter().map(|&(run, end)| beside[run][end].coords).sum();
            let middle = Point3::from(sum / runs.len() as f64);
            let hub = &mut draft.hubs[joint];
            let place = nearest_inside(surface, middle, hub.position);
            has_moved[joint] = (place - hub.position).norm() > SETTLED * step;
            hub.position = place;
        }
        if !has_moved.contains(&true) {
            break;
        }
    }
    Ok(())
}

/// Joints that may lie anywhere.
fn free_joints(draft: &Draft, at: &[Vec<(usize, usize)>]) -> Vec<usize> {
    let is_free = |&joint: &usize| {
        let hub = &draft.hubs[joint];
        hub.kind == HubKind::Joint && hub.pinned.is_none() && !at[joint].is_empty()
    };
    (0..draft.hubs.len()).filter(is_free).collect()
}

/// Whether the axes of a joint's runs pass each other.
fn is_apart(draft: &Draft, runs: &[(usize, usize)], hub: usize) -> bool {
    let axes = axes_at(draft, runs);
    !all_pass(&axes, &draft.hubs[hub].position, APART)
}

/// The points of a run next to its hubs.
fn beside_hubs(
    draft: &Draft,
    surface: &Surface,
    run: &Run,
    step: f64,
    known: &mut Known,
    watch: &mut Watch<'_, impl Observer>,
) -> Result<[Point3<f64>; 2], SkeletonError> {
    let hubs = run.hubs.map(|h| &draft.hubs[h]);
    let Some(trend) = Trend::of(run) else { return Ok(hubs.map(|h| h.position)) };
    let points = moved(surface, run, &trend, hubs, step, known, watch)?.points;
    Ok([points[1], points[points.len() - 2]])
}

#[cfg(test)]
mod tests {
    use super::super::axis::tests::station;
    use super::super::draft::Station;
    use super::*;

    /// A joint at the origin of three rods of radius 1, the axis of one lifted by `miss`.
    fn joint(miss: f64) -> Draft {
        let rod = |way: [f64; 2], lift: f64| {
            let at = |i: usize| station([way[0] * i as f64, way[1] * i as f64, lift], 1.0);
            Run { hubs: [0, 0], stations: (2..20).map(at).collect::<Vec<Station>>() }
        };
        let mut draft = Draft::default();
        let hub = draft.add_hub(HubKind::Joint);
        for (i, (way, lift)) in
            [([1.0, 0.0], 0.0), ([-1.0, 0.0], 0.0), ([0.0, 1.0], miss)].into_iter().enumerate()
        {
            let tip = draft.add_hub(HubKind::Tip);
            draft.runs.push(rod(way, lift));
            draft.runs[i].hubs = [hub, tip];
        }
        draft
    }

    #[test]
    fn a_frame_of_lumpy_bars_keeps_its_axes() {
        assert_eq!(is_centred(&joint(0.26), Junctions::Auto), (false, None));
    }

    #[test]
    fn where_axes_miss_each_other_the_middle_is_wanted() {
        let (is_centred, said) = is_centred(&joint(0.41), Junctions::Auto);
        assert!(is_centred);
        assert!(said.is_some_and(|s| s.text.starts_with("at 1 of 1 junction the axes")));
    }

    #[test]
    fn what_is_asked_for_decides() {
        assert_eq!(is_centred(&joint(0.41), Junctions::Axes), (false, None));
        assert_eq!(is_centred(&joint(0.0), Junctions::Centred), (true, None));
    }
}
