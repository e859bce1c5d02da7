//! Parts that are far longer than thick, on purpose or by a broken file: an end, soon, and the truth.

mod common;

use std::ops::ControlFlow;

use beamwright::finding::FindingKind;
use beamwright::observer::Observer;
use beamwright::skeleton::{self, Marched, SkeletonError, SkeletonParams};
use common::TestMesh;

/// A bar of a square millimetre along x, of twelve triangles.
fn bar(length: f64) -> TestMesh {
    let corner = |k: u32| [f64::from(k & 1) * length, f64::from(k >> 1 & 1), f64::from(k >> 2 & 1)];
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    TestMesh {
        positions: (0..8).map(corner).collect(),
        triangles: quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        ..TestMesh::default()
    }
}

/// The bar with one corner moved away along x.
fn spiked(length: f64, to: f64) -> TestMesh {
    let mut mesh = bar(length);
    mesh.positions[7][0] = to;
    mesh
}

fn march(mesh: &TestMesh) -> Result<Marched, SkeletonError> {
    skeleton::march(&mesh.surface(), &SkeletonParams::default(), &mut ())
}

#[test]
fn a_bar_of_any_length_has_a_bounded_number_of_points_and_its_own_length() {
    for length in [1e2, 1e3, 1e4, 1e5] {
        let Marched { skeleton, findings } = march(&bar(length)).expect("a skeleton");
        assert!(findings.iter().all(|f| !f.breach), "{length}: {findings:?}");
        let [branch] = skeleton.branches.as_slice() else { panic!("{length}: one branch") };
        assert!((skeleton.length(branch) / length - 1.0).abs() < 0.01, "{length}");
        assert!(skeleton.points.len() <= 4097, "{length}: {}", skeleton.points.len());
    }
}

#[test]
fn points_farther_apart_than_wanted_are_told() {
    let is_told = |length: f64| {
        let findings = march(&bar(length)).expect("a skeleton").findings;
        findings.iter().any(|f| f.kind == FindingKind::Slender)
    };
    assert!(!is_told(1e3));
    assert!(is_told(1e4));
}

#[test]
fn a_corner_far_out_in_space_is_named() {
    let Err(SkeletonError::TooSlender { ratio, farthest }) = march(&spiked(20.0, 4.29e9)) else {
        panic!("an error that names the corner")
    };
    assert!(ratio > 1e9, "{ratio}");
    assert_eq!(farthest.coords.as_slice(), [4.29e9, 1.0, 1.0]);
}

#[test]
fn a_spike_is_marched_to_an_end() {
    for to in [1e2, 1e3, 1e4] {
        let marched = march(&spiked(20.0, to)).expect("a skeleton");
        assert!(marched.skeleton.points.len() < 10_000, "{to}");
    }
}

/// Stops the work the `left`-th time it is asked within a step.
struct Impatient {
    left: usize,
}

impl Observer for Impatient {
    fn keep_on(&mut self) -> ControlFlow<()> {
        self.left = self.left.saturating_sub(1);
        if self.left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn the_work_stops_wherever_it_is_asked_to() {
    let surface = bar(200.0).surface();
    let mut counted = Counted::default();
    let params = SkeletonParams::default();
    skeleton::march(&surface, &params, &mut counted).expect("a skeleton");
    assert!(counted.asked > 1000, "{}", counted.asked);
    for left in (1..counted.asked).step_by(97) {
        let stopped = skeleton::march(&surface, &params, &mut Impatient { left });
        assert_eq!(stopped.err(), Some(SkeletonError::Cancelled), "after {left}");
    }
}

/// Counts how often the work asks within a step.
#[derive(Default)]
struct Counted {
    asked: usize,
}

impl Observer for Counted {
    fn keep_on(&mut self) -> ControlFlow<()> {
        self.asked += 1;
        ControlFlow::Continue(())
    }
}
