//! Where junctions lie (thesis §5.2.6): where the straight axes of their branches meet.

use nalgebra::{Matrix3, Point3, Vector3};

use super::axis::{Axis, all_pass, axis_at_start};
use super::draft::{Draft, HubKind, Run, Station};
use crate::mesh::Surface;
use crate::skeleton::inside::{is_inside, middle_of_wall};

/// Pull towards the rough place, against a pull of one by each axis. It decides only along a
/// direction in which the axes say nothing (all nearly parallel).
const PULL_OF_ROUGH_PLACE: f64 = 1e-3;

/// The point nearest to all axes: minimises Σ w |(I − d dᵀ)(x − p)|², with a faint pull to `rough`.
pub(crate) fn meeting_point(axes: &[Axis], rough: &Point3<f64>) -> Point3<f64> {
    let mut matrix = Matrix3::identity() * PULL_OF_ROUGH_PLACE;
    let mut right = Vector3::zeros();
    for axis in axes {
        let d = axis.direction.into_inner();
        let across = Matrix3::identity() - d * d.transpose();
        let w = weight(axis);
        matrix += across * w;
        right += across * (axis.point - rough) * w;
    }
    matrix.lu().solve(&right).map_or(*rough, |x| rough + x)
}

/// A long fitted part tells the direction better; beyond six radii nothing is gained.
fn weight(axis: &Axis) -> f64 {
    (axis.length / (6.0 * axis.radius)).clamp(0.05, 1.0)
}

/// Axes of the runs at a hub; those of runs that begin and end there only where it has no two others:
/// the loop round a pinhole in a fillet says nothing of the joint.
pub(crate) fn axes_at(draft: &Draft, runs: &[(usize, usize)]) -> Vec<Axis> {
    let is_leg = |r: usize| !draft.runs[r].is_loop();
    let has_legs = runs.iter().filter(|&&(r, _)| is_leg(r)).count() > 1;
    let wanted = runs.iter().filter(|&&(r, _)| is_leg(r) || !has_legs);
    wanted.filter_map(|&(r, end)| axis_at_start(&draft.runs[r].seen_from(end))).collect()
}

/// Places every joint where the axes of its runs meet, inside the object.
pub(crate) fn place_joints(draft: &mut Draft, surface: &Surface) {
    let at = draft.incidences();
    draft.place_roughly();
    for (hub, runs) in at.iter().enumerate() {
        if draft.hubs[hub].kind != HubKind::Joint || runs.is_empty() {
            continue;
        }
        if let Some(place) = draft.hubs[hub].pinned {
            draft.hubs[hub].position = place;
            continue;
        }
        let axes = axes_at(draft, runs);
        let rough = draft.hubs[hub].position;
        let is_seen = |place: &Point3<f64>| sees_all(draft, surface, runs, place);
        let meeting = within_reach(draft, runs, &axes, rough, is_seen);
        draft.hubs[hub].position = nearest_inside(surface, meeting, rough);
    }
}

/// The meeting point, drawn back to the ball round the joint in which its branches end: axes that
/// run side by side meet far away. Legs that part at a few degrees fill one thick branch before
/// they do; the march took that for the stem, in whose way their axes meet. Legs that all leave to one
/// side fill one lump; in that their axes meet, seen from the nearest sections of all.
fn within_reach(
    draft: &Draft,
    runs: &[(usize, usize)],
    axes: &[Axis],
    rough: Point3<f64>,
    is_seen: impl Fn(&Point3<f64>) -> bool,
) -> Point3<f64> {
    let meeting = meeting_point(axes, &rough);
    let reach = runs
        .iter()
        .filter_map(|&(r, end)| {
            let nearest = draft.runs[r].nearest_to(end);
            nearest.map(|s| (s.centroid - rough).norm() + s.radius)
        })
        .fold(0.0f64, f64::max);
    let away = meeting - rough;
    let is_on_a_way = || runs.iter().any(|&(r, end)| is_on_the_way(&draft.runs[r], end, &meeting));
    let is_in_a_stem = || all_pass(axes, &meeting, MEETS) && is_on_a_way();
    let is_in_a_tip = || {
        axes.len() > 2
            && all_pass(axes, &meeting, MEETS_IN_TIP)
            && !is_on_a_way()
            && is_seen(&meeting)
    };
    if away.norm() <= reach || is_in_a_stem() || is_in_a_tip() {
        return meeting;
    }
    rough + away * (reach / away.norm())
}

/// Axes that pass each other within this part of their radius meet. Those of a plain fork miss each
/// other by hundredths; where webs of an optimized part run together, by tenths, and any place on
/// their way is as good.
const MEETS: f64 = 0.1;

/// The same where the meeting lies beyond the sections of all branches: those of lumpy struts miss each
/// other by up to 0.27.
const MEETS_IN_TIP: f64 = 0.3;

/// Whether a place lies in one of the sections of a run's nearer half.
fn is_on_the_way(run: &Run, end: usize, place: &Point3<f64>) -> bool {
    let holds = |s: &Station| (s.centroid - place).norm() <= s.radius;
    run.seen_from(end).iter().take(run.stations.len() / 2).any(holds)
}

/// Whether the nearest sections of all runs at a joint are seen from a place inside the object.
pub(crate) fn sees_all(
    draft: &Draft,
    surface: &Surface,
    runs: &[(usize, usize)],
    place: &Point3<f64>,
) -> bool {
    runs.iter().all(|&(r, end)| {
        let nearest = draft.runs[r].nearest_to(end);
        nearest.is_none_or(|s| is_inside(&surface.tree, place, &s.centroid))
    })
}

/// `wanted`, or the point nearest to it on the way to `fallback` that lies inside, or the middle of
/// the wall next to that.
pub(crate) fn nearest_inside(
    surface: &Surface,
    wanted: Point3<f64>,
    fallback: Point3<f64>,
) -> Point3<f64> {
    (0..=8)
        .map(|k| wanted + (fallback - wanted) * (f64::from(k) / 8.0))
        .find(|p| surface.tree.contains(p))
        .or_else(|| middle_of_wall(&surface.mesh, &surface.tree, &fallback))
        .unwrap_or(fallback)
}

#[cfg(test)]
mod tests {
    use super::super::axis::tests::{rod, station};
    use super::*;

    fn axis(from: [f64; 3], towards: [f64; 3]) -> Axis {
        let (a, d) = (Point3::from(from), Vector3::from(towards).normalize());
        let stations: Vec<Station> =
            (0..15).map(|i| station((a + d * f64::from(i)).coords.into(), 1.0)).collect();
        axis_at_start(&stations).expect("an axis")
    }

    #[test]
    fn axes_meet_where_they_cross() {
        let axes = [
            axis([3.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            axis([0.0, 4.0, 0.0], [0.0, 1.0, 0.0]),
            axis([0.0, 0.0, 5.0], [0.0, 0.0, 1.0]),
        ];
        let meeting = meeting_point(&axes, &Point3::new(0.3, 0.3, 0.3));
        assert!(meeting.coords.norm() < 1e-3, "{meeting}");
    }

    #[test]
    fn along_parallel_axes_the_rough_place_decides() {
        let axes = [axis([0.0; 3], [1.0, 0.0, 0.0]), axis([0.0, 0.2, 0.0], [-1.0, 0.0, 0.0])];
        let meeting = meeting_point(&axes, &Point3::new(7.0, 3.0, 0.0));
        assert!((meeting - Point3::new(7.0, 0.1, 0.0)).norm() < 0.01, "{meeting}");
    }

    /// Three runs at one hub: a stem along x up to 40, two legs whose axes meet in it.
    fn fork(meeting: f64) -> (Draft, Vec<(usize, usize)>, Vec<Axis>) {
        let run = |stations: Vec<Station>| Run { hubs: [0, 0], stations };
        let leg = |side: f64| {
            let along = |i: usize| [40.0 + i as f64, side * 0.1 * (40.0 + i as f64 - meeting), 0.0];
            run((0..20).map(|i| station(along(i), 1.0)).collect())
        };
        let mut stem = rod(41);
        stem.reverse();
        let mut draft = Draft::default();
        draft.add_hub(HubKind::Joint);
        draft.runs = vec![run(stem), leg(1.0), leg(-1.0)];
        let runs = vec![(0, 0), (1, 0), (2, 0)];
        let axes = axes_at(&draft, &runs);
        (draft, runs, axes)
    }

    #[test]
    fn legs_meet_in_the_way_of_their_stem() {
        let (draft, runs, axes) = fork(25.0);
        let place = within_reach(&draft, &runs, &axes, Point3::new(40.0, 0.0, 0.0), |_| false);
        // The faint pull to the rough place is felt at so small an angle.
        assert!((place - Point3::new(25.0, 0.0, 0.0)).norm() < 1.0, "{place}");
    }

    #[test]
    fn axes_that_meet_far_from_every_branch_are_drawn_back() {
        let (draft, runs, axes) = fork(-300.0);
        let place = within_reach(&draft, &runs, &axes, Point3::new(40.0, 0.0, 0.0), |_| false);
        assert!((place.x - 40.0).abs() < 40.0, "{place}");
    }

    #[test]
    fn legs_that_leave_to_one_side_meet_in_their_lump_if_it_is_seen() {
        // Three legs from the origin at 20° about x, apart from eight radii on.
        let leg = |k: usize| {
            let (sin, cos) = (k as f64 * std::f64::consts::TAU / 3.0).sin_cos();
            let along = |i: usize| (8.0 + i as f64, 0.36 * (8.0 + i as f64));
            let at = |i: usize| station([along(i).0, along(i).1 * sin, along(i).1 * cos], 1.0);
            Run { hubs: [0, k + 1], stations: (0..20).map(at).collect() }
        };
        let mut draft = Draft::default();
        (0..4).for_each(|_| _ = draft.add_hub(HubKind::Joint));
        draft.runs = (0..3).map(leg).collect();
        let runs = [(0, 0), (1, 0), (2, 0)];
        let axes = axes_at(&draft, &runs);
        let place = |is_seen: bool| {
            within_reach(&draft, &runs, &axes, Point3::new(8.0, 0.0, 0.0), |_| is_seen)
        };
        assert!(place(true).coords.norm() < 0.1, "{}", place(true));
        assert!(place(false).x > 1.0, "{}", place(false));
    }
}
