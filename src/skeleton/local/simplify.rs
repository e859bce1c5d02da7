//! Makes the draft as simple as the part: one joint where one joint explains all axes, no stubs in
//! interface sections, no branch into a rounded corner.

use nalgebra::Point3;

use super::axis::{Axis, all_pass};
use super::draft::{Draft, HubKind, Station};
use super::junction::{axes_at, meeting_point, nearest_inside, place_joints, sees_all};
use crate::mesh::Surface;
use crate::observer::Observer;
use crate::skeleton::error::{SkeletonError, keep_on};

/// Joints nearer to each other than this many radii of their branches are one: the axes of a plain
/// joint miss each other by tenths, two joints a radius apart cannot be built.
const SAME_JOINT: f64 = 1.0;

/// A joint at most this many radii in front of an interface section lies in it: the struts share
/// the section.
const AT_INTERFACE: f64 = 1.0;

/// Struts overlap in a place that is no farther from each axis than this many of its radii.
const OVERLAP: f64 = 1.0;

/// A free end must stand out by this many of its radii over the joint it leaves; rounded corners
/// stand out by less than one.
const STANDS_OUT: f64 = 1.5;

/// Simplifies until nothing changes; every change removes a run.
///
/// # Errors
/// The observer asked to stop.
pub(crate) fn simplify(
    draft: &mut Draft,
    surface: &Surface,
    observer: &mut impl Observer,
) -> Result<(), SkeletonError> {
    loop {
        keep_on(observer)?;
        draft.remove_false_joints(surface);
        place_joints(draft, surface);
        let changed =
            prune_tips(draft) || merge_joints(draft) || merge_into_interfaces(draft, surface);
        if !changed {
            return Ok(());
        }
    }
}

/// Removes runs that end freely within the reach of their joint; whether any was.
fn prune_tips(draft: &mut Draft) -> bool {
    let at = draft.incidences();
    let is_tip = |hub: usize| draft.hubs[hub].kind == HubKind::Tip;
    let stub = |run: &super::draft::Run| {
        let [a, b] = run.hubs;
        let (joint, tip) = match (is_tip(a), is_tip(b)) {
            (true, false) => (b, a),
            (false, true) => (a, b),
            _ => return false,
        };
        if draft.hubs[joint].kind != HubKind::Joint {
            return false;
        }
        let thickest =
            at[joint].iter().map(|&(r, _)| draft.runs[r].radius()).fold(0.0f64, f64::max);
        let length = (draft.hubs[tip].position - draft.hubs[joint].position).norm();
        length < thickest + STANDS_OUT * run.radius()
    };
    // One at a time: a joint that loses a branch may be no joint any more.
    let Some(found) = draft.runs.iter().position(stub) else { return false };
    draft.runs.remove(found);
    true
}

/// Makes one joint of two that are joined by a run shorter than a radius, once both lie where
/// their axes meet; whether any was.
///
/// Struts that leave a joint at a small angle run in one section for a while, which looks like a
/// branch of its own. Its two joints are placed at the same point by their axes.
fn merge_joints(draft: &mut Draft) -> bool {
    let at = draft.incidences();
    let candidates = draft.runs.iter().enumerate().filter(|(_, run)| {
        let [a, b] = run.hubs;
        a != b && [a, b].iter().all(|&h| draft.hubs[h].kind == HubKind::Joint)
    });
    for (r, run) in candidates {
        let [a, b] = run.hubs;
        let legs: Vec<(usize, usize)> =
            [a, b].iter().flat_map(|&h| &at[h]).copied().filter(|&(s, _)| s != r).collect();
        let others = axes_at(draft, &legs);
        if others.is_empty() {
            continue;
        }
        let radius = others.iter().map(|o| o.radius).sum::<f64>() / others.len() as f64;
        let (p, q) = (draft.hubs[a].position, draft.hubs[b].position);
        let near = (p - q).norm() <= SAME_JOINT * radius;
        if near || one_point_explains(&others, &p, &q) {
            merge_hubs(draft, r, a, b);
            return true;
        }
    }
    false
}

/// Axes that pass one point within this part of their radius meet there.
const MEETS: f64 = 0.3;

/// Whether all axes pass one point that lies no farther away than the joints themselves.
fn one_point_explains(axes: &[Axis], p: &Point3<f64>, q: &Point3<f64>) -> bool {
    let between = nalgebra::center(p, q);
    let meeting = meeting_point(axes, &between);
    let reach = 0.5 * (p - q).norm() + axes.iter().map(|a| a.radius).fold(0.0, f64::max);
    axes.len() > 2 && (meeting - between).norm() <= reach && all_pass(axes, &meeting, MEETS)
}

/// Removes run `r` and lets everything that ended in `from` end in `into`.
fn merge_hubs(draft: &mut Draft, r: usize, into: usize, from: usize) {
    draft.runs.remove(r);
    for hub in draft.runs.iter_mut().flat_map(|run| &mut run.hubs) {
        if *hub == from {
            *hub = into;
        }
    }
}

/// Moves joints that lie in an interface section into it; whether any was.
fn merge_into_interfaces(draft: &mut Draft, surface: &Surface) -> bool {
    let interfaces = &surface.interfaces;
    let at = draft.incidences();
    for (r, run) in draft.runs.iter().enumerate() {
        let [a, b] = run.hubs;
        let (joint, interface, i) = match (draft.hubs[a].kind, draft.hubs[b].kind) {
            (HubKind::Joint, HubKind::Interface(i)) => (a, b, i),
            (HubKind::Interface(i), HubKind::Joint) => (b, a, i),
            _ => continue,
        };
        let legs: Vec<(usize, usize)> =
            at[joint].iter().copied().filter(|&(s, _)| s != r).collect();
        let others = axes_at(draft, &legs);
        if others.is_empty() {
            continue;
        }
        let thickest = others.iter().map(|o| o.radius).fold(0.0f64, f64::max);
        let meeting = meeting_point(&others, &draft.hubs[joint].position);
        let in_front = (meeting - interfaces[i].centroid).dot(&interfaces[i].normal);
        if in_front > AT_INTERFACE * thickest {
            continue;
        }
        let stem = run.seen_from(usize::from(run.hubs[1] == joint));
        // Of a branch that bends back the joint lies behind the section, and far from it.
        if stem.first().is_some_and(|s| s.direction.dot(&interfaces[i].normal) > 0.0) {
            continue;
        }
        let parting = match stem.first() {
            Some(first) => {
                let is_shared = |s: &&Station| all_pass(&others, &s.centroid, OVERLAP);
                stem.iter().find(is_shared).unwrap_or(first).centroid
            }
            None => {
                let (from, to) = (parting(draft, &at[joint], r), interfaces[i].centroid);
                nearest_inside(surface, first_overlap(&others, from, to), to)
            }
        };
        let ahead = (parting - interfaces[i].centroid).dot(&interfaces[i].normal);
        if ahead > AT_INTERFACE * thickest && sees_all(draft, surface, &at[joint], &parting) {
            // The struts run in one section for a while: the joint stays where they part.
            if draft.hubs[joint].pinned.is_none() {
                draft.hubs[joint].pinned = Some(parting);
                draft.hubs[joint].is_centred = true;
                return true;
            }
            continue;
        }
        merge_hubs(draft, r, interface, joint);
        return true;
    }
    false
}

/// Steps of a way that are looked at for a place in which struts overlap, and halvings of the step to
/// it: mirrored halves of a part differ by no more.
const STEPS: u32 = 8;
const HALVINGS: u32 = 10;

/// The first place on a straight way in which all struts overlap; where there is none, its start.
fn first_overlap(axes: &[Axis], from: Point3<f64>, to: Point3<f64>) -> Point3<f64> {
    let place = |part: f64| from + (to - from) * part;
    let is_shared = |part: f64| all_pass(axes, &place(part), OVERLAP);
    let mut parts = (0..=STEPS).map(|k| f64::from(k) / f64::from(STEPS));
    let Some(mut high) = parts.find(|&part| is_shared(part)) else { return from };
    let mut low = (high - 1.0 / f64::from(STEPS)).max(0.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *if is_shared(middle) { &mut high } else { &mut low } = middle;
    }
    place(high)
}

/// Middle of the sections next to a joint of the runs other than `stem`: where they part.
fn parting(draft: &Draft, runs: &[(usize, usize)], stem: usize) -> Point3<f64> {
    let ends: Vec<nalgebra::Vector3<f64>> = runs
        .iter()
        .filter(|(r, _)| *r != stem)
        .filter_map(|&(r, end)| {
            let nearest = draft.runs[r].nearest_to(end);
            nearest.map(|s| s.centroid.coords)
        })
        .collect();
    Point3::from(ends.iter().sum::<nalgebra::Vector3<f64>>() / ends.len().max(1) as f64)
}
