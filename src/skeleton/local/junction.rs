//! Where junctions lie (thesis §5.2.6): where the straight axes of their branches meet.

use nalgebra::{Matrix3, Point3, Vector3};

use super::axis::{Axis, all_pass, axis_at_start};
use super::draft::{Draft, HubKind, Run, Station};
use crate::mesh::Surface;
use crate::skeleton::inside::middle_of_wall;

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

/// Axes of all runs at each hub, in the order of the incidences.
pub(crate) fn axes_at(draft: &Draft, runs: &[(usize, usize)]) -> Vec<Option<Axis>> {
    runs.iter().map(|&(r, end)| axis_at_start(&draft.runs[r].seen_from(end))).collect()
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
        let axes: Vec<Axis> = axes_at(draft, runs).into_iter().flatten().collect();
        let rough = draft.hubs[hub].position;
        let meeting = within_reach(draft, runs, &axes, rough);
        draft.hubs[hub].position = nearest_inside(surface, meeting, rough);
    }
}

/// The meeting point, drawn back to the ball round the joint in which its branches end: axes that
/// run side by side meet far away. Legs that part at a few degrees fill one thick branch before
/// they do; the march took that for the stem, in whose way their axes meet.
fn within_reach(
    draft: &Draft,
    runs: &[(usize, usize)],
    axes: &[Axis],
    rough: Point3<f64>,
) -> Point3<f64> {
    let meeting = meeting_point(axes, &rough);
    let reach = runs
        .iter()
        .filter_map(|&(r, end)| {
            let stations = &draft.runs[r].stations;
            let nearest = if end == 0 { stations.first() } else { stations.last() };
            nearest.map(|s| (s.centroid - rough).norm() + s.radius)
        })
        .fold(0.0f64, f64::max);
    let away = meeting - rough;
    if away.norm() <= reach || is_in_a_stem(draft, runs, axes, &meeting) {
        return meeting;
    }
    rough + away * (reach / away.norm())
}

/// Axes that pass each other within this part of their radius meet. Those of a plain fork miss each
/// other by hundredths; where webs of an optimized part run together, by tenths, and any place on
/// their way is as good.
const MEETS: f64 = 0.1;

/// Whether all axes meet in a place within one of the branches.
fn is_in_a_stem(
    draft: &Draft,
    runs: &[(usize, usize)],
    axes: &[Axis],
    meeting: &Point3<f64>,
) -> bool {
    all_pass(axes, meeting, MEETS)
        && runs.iter().any(|&(r, end)| is_on_the_way(&draft.runs[r], end, meeting))
}

/// Whether a place lies in one of the sections of a run's nearer half.
fn is_on_the_way(run: &Run, end: usize, place: &Point3<f64>) -> bool {
    let holds = |s: &Station| (s.centroid - place).norm() <= s.radius;
    run.seen_from(end).iter().take(run.stations.len() / 2).any(holds)
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
        let axes = axes_at(&draft, &runs).into_iter().flatten().collect();
        (draft, runs, axes)
    }

    #[test]
    fn legs_meet_in_the_way_of_their_stem() {
        let (draft, runs, axes) = fork(25.0);
        let place = within_reach(&draft, &runs, &axes, Point3::new(40.0, 0.0, 0.0));
        // The faint pull to the rough place is felt at so small an angle.
        assert!((place - Point3::new(25.0, 0.0, 0.0)).norm() < 1.0, "{place}");
    }

    #[test]
    fn axes_that_meet_far_from_every_branch_are_drawn_back() {
        let (draft, runs, axes) = fork(-300.0);
        let place = within_reach(&draft, &runs, &axes, Point3::new(40.0, 0.0, 0.0));
        assert!((place.x - 40.0).abs() < 40.0, "{place}");
    }
}
