//! What always holds of a skeleton, over families of parts with known topology.

mod common;

use beamwright::evaluate::{EvaluateOptions, evaluate};
use beamwright::finding::FindingKind;
use beamwright::skeleton::{
    Junctions, Marched, Orientation, PointKind, SkeletonError, SkeletonParams, march,
};
use common::TestMesh;
use common::families::{cylinder, cylinder_between_pads, quarter_bend, together, torus};
use common::frame::{self, TrueFrame};
use common::zero_surface::surface_of;

fn marched(mesh: &TestMesh) -> Result<Marched, SkeletonError> {
    march(&mesh.surface(), &SkeletonParams::default(), &mut ())
}

fn marched_with(mesh: &TestMesh, junctions: Junctions) -> Marched {
    let params = SkeletonParams { junctions, ..SkeletonParams::default() };
    march(&mesh.surface(), &params, &mut ()).expect("a skeleton")
}

/// Parts with the components and cycles their skeletons must have.
fn parts() -> Vec<(&'static str, TestMesh, [usize; 2])> {
    vec![
        ("cylinder", cylinder(2.0, 40.0, 24, 20), [1, 0]),
        ("cylinder without points along its shaft", cylinder(2.0, 40.0, 24, 1), [1, 0]),
        ("prism of three sides", cylinder(2.0, 40.0, 3, 1), [1, 0]),
        ("cylinder between pads", cylinder_between_pads(2.0, 40.0, 24, 8), [1, 0]),
        ("ring without junction", torus(20.0, 3.0), [1, 1]),
        ("quarter of a ring", quarter_bend(20.0, 3.0), [1, 0]),
        (
            "two bodies",
            together(&[cylinder(2.0, 40.0, 24, 20), shifted(&torus(20.0, 3.0))]),
            [2, 1],
        ),
        ("taper", frame::taper().mesh(1.0), [1, 0]),
        ("corner", frame::corner().mesh(1.0), [1, 0]),
        ("tee", frame::tee().mesh(1.0), [1, 0]),
        ("cross", frame::cross().mesh(1.0), [1, 0]),
        ("table", frame::table().mesh(1.0), [1, 1]),
        ("cube of struts without labels", frame::cube().mesh(1.0), [1, 5]),
        ("fork of 20°", frame::fork(20.0).mesh(1.0), [1, 0]),
        ("close pair of junctions", frame::close_pair().mesh(1.0), [1, 0]),
        ("three struts to one side", frame::spike().mesh(0.9), [1, 0]),
        ("struts that turn back", frame::turned_back().mesh(0.9), [1, 0]),
        ("pinhole between two struts", frame::fork(20.0).drilled([59.0, 0.0], 0.7, 0.7), [1, 1]),
    ]
}

fn shifted(mesh: &TestMesh) -> TestMesh {
    mesh.mapped(|[x, y, z]| [x + 100.0, y, z])
}

/// Every point moved by up to `size`, the same way at every run.
fn with_noise(mesh: &TestMesh, size: f64) -> TestMesh {
    let mut state = 1u64;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as f64 / f64::from(1u32 << 30) - 1.0
    };
    let mut noisy = mesh.clone();
    noisy.positions.iter_mut().flatten().for_each(|x| *x += size * random());
    noisy
}

fn assert_sound(name: &str, mesh: &TestMesh, topology: [usize; 2]) {
    assert_keeps(name, &marched(mesh).unwrap_or_else(|e| panic!("{name}: {e}")), topology);
}

fn assert_keeps(name: &str, marched: &Marched, [components, cycles]: [usize; 2]) {
    let skeleton = &marched.skeleton;
    let breaches: Vec<_> = marched.findings.iter().filter(|f| f.breach).collect();
    assert!(breaches.is_empty(), "{name}: {breaches:?}");
    assert_eq!([skeleton.components(), skeleton.cycle_rank()], [components, cycles], "{name}");
}

#[test]
fn every_skeleton_lies_inside_and_has_the_tunnels_of_its_part() {
    for (name, mesh, topology) in parts() {
        assert_sound(name, &mesh, topology);
    }
}

#[test]
fn noise_of_a_twentieth_of_an_edge_changes_no_topology() {
    for (name, mesh, topology) in parts().into_iter().filter(|p| p.0 != "prism of three sides") {
        assert_sound(name, &with_noise(&mesh, 0.05), topology);
    }
}

#[test]
fn centred_junctions_change_no_topology_and_leave_the_part_nowhere() {
    for (name, mesh, topology) in parts() {
        assert_keeps(name, &marched_with(&mesh, Junctions::Centred), topology);
    }
}

/// Mean of eq. (2.2) at equal spacing.
fn e_center(mesh: &TestMesh, marched: &Marched) -> f64 {
    let figures = evaluate(&mesh.surface(), &marched.skeleton, &EvaluateOptions::default());
    figures.expect("figures").resampled.e_center.expect("points")
}

#[test]
fn junctions_in_the_middle_are_better_centred_than_those_on_axes() {
    for (name, mesh, _) in parts().into_iter().filter(|p| ["tee", "table"].contains(&p.0)) {
        let [axes, centred] = [Junctions::Axes, Junctions::Centred]
            .map(|junctions| e_center(&mesh, &marched_with(&mesh, junctions)));
        assert!(centred < 0.8 * axes, "{name}: {centred} and {axes}");
    }
}

#[test]
fn a_frame_of_straight_bars_has_its_junctions_on_axes_by_default() {
    for (name, mesh, _) in parts().into_iter().filter(|p| ["tee", "cross", "table"].contains(&p.0))
    {
        let default = marched(&mesh).expect("a skeleton").skeleton;
        assert_eq!(default, marched_with(&mesh, Junctions::Axes).skeleton, "{name}");
    }
}

/// The slab across the march holds the whole leg, down to its interface section.
#[test]
fn the_global_march_sees_a_leg_that_leaves_across_its_way() {
    let params = SkeletonParams { orientation: Orientation::Global, ..SkeletonParams::default() };
    let surface = frame::tee().mesh(1.0).surface();
    let skeleton = march(&surface, &params, &mut ()).expect("a skeleton").skeleton;
    assert_eq!((skeleton.branches.len(), skeleton.count(PointKind::Junction)), (3, 1));
}

/// Distances of the nodes of a frame that are no pads from the nearest junction or knee of a skeleton.
fn misses(truth: &TrueFrame, marched: &Marched) -> Vec<f64> {
    let free = (0..truth.nodes.len()).filter(|n| !truth.pads.contains(n));
    let nearest = |n: usize| {
        let node = nalgebra::Point3::from(truth.nodes[n]);
        let distances = marched.skeleton.points.iter().map(|p| (p.position - node).norm());
        distances.fold(f64::INFINITY, f64::min)
    };
    free.map(nearest).collect()
}

#[test]
fn struts_that_leave_to_one_side_meet_at_the_tip_of_their_lump() {
    let truth = frame::spike();
    let marched = marched(&truth.mesh(0.9)).expect("a skeleton");
    let off = misses(&truth, &marched);
    assert!(off.iter().all(|&d| d < 0.3), "{off:?}");
}

/// The joint at the end of the second strut lies behind the interface section of the first.
#[test]
fn a_joint_behind_a_section_far_along_its_branch_does_not_go_into_it() {
    let truth = frame::turned_back();
    let marched = marched(&truth.mesh(0.9)).expect("a skeleton");
    assert_eq!(marched.skeleton.branches.len(), 3);
    let off = misses(&truth, &marched);
    assert!(off.iter().all(|&d| d < 0.3), "{off:?}");
}

/// Legs that part at a small angle run in one section for many radii behind their joint.
#[test]
fn legs_of_a_fork_meet_where_their_axes_do() {
    for angle in [20.0, 30.0, 45.0, 90.0] {
        let truth = frame::fork(angle);
        let skeleton = marched(&truth.mesh(1.0)).expect("a skeleton").skeleton;
        let joints: Vec<_> =
            skeleton.points.iter().filter(|p| p.kind == PointKind::Junction).collect();
        assert_eq!(joints.len(), 1, "{angle}°");
        let off = (joints[0].position - nalgebra::Point3::from(truth.nodes[1])).norm();
        assert!(off < 0.2 * 3.0, "{angle}°: {off} mm");
    }
}

fn is_told_not_beam_like(marched: &Marched) -> bool {
    marched.findings.iter().any(|f| f.kind == FindingKind::NotBeamLike)
}

#[test]
fn a_plate_is_said_to_be_no_beam_and_beams_are_not() {
    let half = [30.0, 25.0, 2.0];
    let distance =
        |p: [f64; 3]| (0..3).map(|k| p[k].abs() - half[k]).fold(f64::NEG_INFINITY, f64::max);
    let plate = surface_of(distance, half.map(|h| -h - 3.3), half.map(|h| h + 3.3), 1.0);
    assert!(is_told_not_beam_like(&marched(&plate).expect("a skeleton")));
    for (name, mesh, _) in parts() {
        assert!(!is_told_not_beam_like(&marched(&mesh).expect("a skeleton")), "{name}");
    }
}

#[test]
fn a_foot_hardly_longer_than_half_its_width_has_a_point_in_its_section() {
    let mesh = TrueFrame {
        nodes: vec![[0.0; 3], [0.0, 0.0, 17.0], [40.0, 0.0, 40.0], [-40.0, 0.0, 40.0]],
        struts: vec![([0, 1], [6.5; 2]), ([1, 2], [2.5; 2]), ([1, 3], [2.5; 2])],
        pads: vec![0, 2, 3],
        pad: 8.0,
    }
    .mesh(1.0);
    let skeleton = marched(&mesh).expect("a skeleton").skeleton;
    let is_foot = |p: &u32| skeleton.position(*p).coords.norm() < 9.0;
    let foot = skeleton.branches.iter().find(|b| b.points.iter().any(is_foot)).expect("a foot");
    let [_, within @ .., _] = foot.points.as_slice() else { panic!("two ends") };
    assert!(!within.is_empty());
    for &p in within {
        let radius = skeleton.points[p as usize].radius;
        assert!((radius - 6.5).abs() < 0.5, "{radius}");
    }
}
