//! Frames against what is known of them: struts made from signed distances with known axes and
//! sections, and the volume of topology-optimized parts.

mod common;

use std::path::{Path, PathBuf};

use beamwright::frame::{
    self, Beam, BeamVolumes, FrameParams, Loft, NodeKind, ProfileParams, normalize,
};
use beamwright::pipeline::{Outcome, Settings, run};
use beamwright::section::matching::MatchTarget;
use beamwright::section::outline::Outline;
use beamwright::section::{Catalogue, MatchMode, ProfileChoice, match_profile};
use beamwright::skeleton::{self, SkeletonParams};
use common::TestMesh;
use common::families::quarter_bend;
use common::frame::TrueFrame;
use common::zero_surface::surface_of;
use nalgebra::{Point3, Vector3};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name)
}

fn reconstruct(path: &Path, profiles: ProfileParams) -> Outcome {
    let settings = Settings { profiles, ..Settings::default() };
    run(path, &settings, &mut ()).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The beam with its ends nearest to two points, turned to run from the first to the second.
fn beam_between(outcome: &Outcome, from: [f64; 3], to: [f64; 3]) -> (&Beam, [Point3<f64>; 2]) {
    let truth = [from, to].map(Point3::from);
    let off =
        |axis: &[Point3<f64>; 2]| (axis[0] - truth[0]).norm().max((axis[1] - truth[1]).norm());
    let turned = outcome.frame.beams.iter().flat_map(|b| {
        let [p, q] = outcome.frame.axis(b);
        [(b, [p, q]), (b, [q, p])]
    });
    turned.min_by(|a, b| off(&a.1).total_cmp(&off(&b.1))).expect("a beam")
}

fn off(value: f64, truth: f64) -> f64 {
    (value / truth - 1.0).abs()
}

/// What is known of a strut: its ends, family, A, I₁, I₂ and the axis about which I is largest.
struct Strut {
    ends: [[f64; 3]; 2],
    family: &'static str,
    area: f64,
    i_1: f64,
    i_2: f64,
    axis_1: [f64; 3],
}

#[test]
fn a_portal_of_rectangle_round_and_ellipse_is_measured_and_told_apart() {
    let pi = std::f64::consts::PI;
    let (sin, cos) = 20f64.to_radians().sin_cos();
    let struts = [
        Strut {
            ends: [[0.0, 0.0, 0.0], [0.0, 0.0, 60.0]],
            family: "rectangle",
            area: 8.0 * 14.0,
            i_1: 8.0 * 14f64.powi(3) / 12.0,
            i_2: 14.0 * 8f64.powi(3) / 12.0,
            axis_1: [cos, sin, 0.0],
        },
        Strut {
            ends: [[0.0, 0.0, 60.0], [70.0, 0.0, 60.0]],
            family: "round",
            area: pi * 25.0,
            i_1: pi * 625.0 / 4.0,
            i_2: pi * 625.0 / 4.0,
            axis_1: [0.0; 3],
        },
        Strut {
            ends: [[70.0, 0.0, 0.0], [70.0, 0.0, 60.0]],
            family: "ellipse",
            area: pi * 9.0 * 15.0 / 4.0,
            i_1: pi * 9.0 * 15f64.powi(3) / 64.0,
            i_2: pi * 15.0 * 9f64.powi(3) / 64.0,
            axis_1: [0.0, 1.0, 0.0],
        },
    ];
    let outcome = reconstruct(&data("shapes_portal.obj"), ProfileParams::default());
    assert_eq!(outcome.frame.beams.len(), struts.len());
    for strut in &struts {
        let (beam, axis) = beam_between(&outcome, strut.ends[0], strut.ends[1]);
        let radius = (strut.area / pi).sqrt();
        for (end, truth) in axis.iter().zip(strut.ends) {
            assert!((end - Point3::from(truth)).norm() < 0.2 * radius, "{}: {end}", strut.family);
        }
        let measured = beam.measured.as_ref().expect("a measured beam");
        assert_eq!(beam.shape.profile.family(), strut.family);
        assert!(off(measured.area, strut.area) < 0.02, "{}: {measured:?}", strut.family);
        assert!(off(measured.i_1, strut.i_1) < 0.05, "{}: {measured:?}", strut.family);
        assert!(off(measured.i_2, strut.i_2) < 0.05, "{}: {measured:?}", strut.family);
        if strut.i_1 > 1.2 * strut.i_2 {
            let strong = beam.axes.rolled(measured.principal_angle).y;
            let turn = strong.dot(&Vector3::from(strut.axis_1)).abs().min(1.0).acos();
            assert!(turn.to_degrees() < 2.0, "{}: {turn} rad", strut.family);
        }
    }
}

#[test]
fn nodes_of_a_chord_with_slim_braces_lie_where_the_axes_meet() {
    let at = |panel: usize, z: f64| [45.0 * panel as f64, 0.0, z];
    let panels = [0.0, 45.0].into_iter().flat_map(|z| (0..4).map(move |panel| at(panel, z)));
    let nodes = panels.chain([[-40.0, 0.0, 0.0], [175.0, 0.0, 0.0]]).collect();
    let chords = [[8, 0], [0, 1], [1, 2], [2, 3], [3, 9], [4, 5], [5, 6], [6, 7]];
    let chords = chords.map(|ends| (ends, [5.0; 2]));
    let uprights = (0..4).map(|k| ([k, k + 4], [3.2; 2]));
    let braces = [[4, 1], [1, 6], [6, 3]].map(|ends| (ends, [3.6; 2]));
    let struts = chords.into_iter().chain(uprights).chain(braces).collect();
    let truth = TrueFrame { nodes, struts, pads: vec![8, 9], pad: 8.0 };
    let surface = truth.mesh(1.25).surface();
    let march = skeleton::march(&surface, &SkeletonParams::default(), &mut ()).expect("a skeleton");
    let all = frame::sections(&surface, &march.skeleton);
    let found = normalize(&march.skeleton, &all, &surface, &FrameParams::default()).frame;
    for node in truth.nodes[..8].iter().copied().map(Point3::from) {
        let off = found.nodes.iter().map(|n| (n.position - node).norm()).fold(f64::MAX, f64::min);
        assert!(off < 0.2 * 3.2, "{node}: {off:.2} mm");
    }
}

#[test]
fn a_tapered_strut_has_the_areas_of_both_ends_and_is_built_as_a_cone() {
    let loft = ProfileParams { loft: Loft::Taper, ..ProfileParams::default() };
    let outcome = reconstruct(&data("tapered_portal.obj"), loft);
    let legs = [
        ([0.0, 0.0, 0.0], [0.0, 0.0, 60.0], 7.0, 4.5),
        ([70.0, 0.0, 0.0], [70.0, 0.0, 60.0], 6.0, 4.2),
    ];
    for (foot, head, thick, thin) in legs {
        let (beam, axis) = beam_between(&outcome, foot, head);
        let mut ends = beam.section.ends;
        if outcome.frame.axis(beam) != axis {
            ends.reverse();
        }
        for (end, radius) in ends.iter().zip([thick, thin]) {
            let truth = std::f64::consts::PI * radius * radius;
            assert!(off(end.area, truth) < 0.04, "{} mm² for {truth} mm²", end.area);
        }
        let stations = &beam.shape.stations;
        assert_eq!(stations.len(), 2, "a cone has two sections");
        let name = beam.shape.name();
        assert!(name.starts_with("Cone ") && name.contains(" to ") && name.is_ascii(), "{name}");
        assert!(stations.iter().all(|s| matches!(s.region.outer, Outline::Circle { .. })));
    }
}

#[test]
fn a_twisted_strut_keeps_its_section_and_turns_without_a_flip() {
    let loft = ProfileParams { loft: Loft::Taper, ..ProfileParams::default() };
    let outcome = reconstruct(&data("twisted_bar.obj"), loft);
    let beam = &outcome.frame.beams[0];
    assert_eq!(beam.shape.profile.family(), "ellipse");
    let measured = beam.measured.as_ref().expect("a measured beam");
    assert!(off(measured.area, std::f64::consts::PI * 32.0) < 0.02, "{measured:?}");
    assert!(off(measured.i_1, std::f64::consts::PI * 8.0 * 16f64.powi(3) / 64.0) < 0.05);
    assert!((beam.section.twist.abs().to_degrees() - 60.0).abs() < 3.0, "{}", beam.section.twist);
    let turns: Vec<f64> = beam
        .shape
        .stations
        .iter()
        .map(|s| match s.region.outer {
            Outline::Ellipse { turn, .. } => turn,
            _ => panic!("an ellipse all along"),
        })
        .collect();
    let steps = turns.windows(2).map(|w| w[1] - w[0]);
    assert!(steps.clone().all(|s| s.abs() < 0.3 && s.signum() == beam.section.twist.signum()));
}

/// Volumes against the design part: all beams together, and what sticks out.
fn against_design(outcome: &Outcome) -> [f64; 2] {
    let mut all = BeamVolumes::default();
    frame::volumes(&outcome.frame, &outcome.surface.tree).into_iter().for_each(|v| all += v);
    let design = outcome.surface.design_volume();
    [all.share / design - 1.0, all.outside / design]
}

#[test]
fn beams_of_optimized_parts_fill_the_part_and_hardly_anything_else() {
    let parts = [
        "cantilever.obj",
        "cantilever_14mm.obj",
        "four_fixings.obj",
        "monster_lite.obj",
        "y_form.obj",
    ];
    for part in parts {
        let choice = ProfileChoice::Freeform;
        let freeform = ProfileParams { choice, ..ProfileParams::default() };
        let [more, outside] = against_design(&reconstruct(&sample(part), freeform));
        assert!(more.abs() < 0.05, "{part}: {more:+.3} of the design volume");
        assert!(outside < 0.08, "{part}: {outside:.3} of the design volume sticks out");
    }
}

fn of_mesh(mesh: &TestMesh, profiles: ProfileParams) -> Outcome {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mesh.obj");
    std::fs::write(&path, mesh.obj()).expect("written");
    reconstruct(&path, profiles)
}

#[test]
fn a_fat_bow_gets_as_many_beams_as_keep_it_in_the_material() {
    // Two beams are within the wanted half radius of it, and 9.2 % of them would stick out.
    let freeform = ProfileParams { choice: ProfileChoice::Freeform, ..ProfileParams::default() };
    let outcome = of_mesh(&quarter_bend(52.0, 8.0), freeform);
    let [more, outside] = against_design(&outcome);
    assert_eq!(outcome.frame.beams.len(), 3);
    assert!(outside < 0.06, "{outside:.3} of the design volume sticks out");
    assert!(more.abs() < 0.03, "{more:+.3} of the design volume");
}

#[test]
fn struts_that_leave_one_pad_end_each_where_its_axis_meets_it() {
    // They touch at the pad, so that its interface section is one.
    let ends = [[60.0, 30.0, 0.0], [60.0, 0.0, 0.0], [60.0, -30.0, 0.0]];
    let fan = TrueFrame {
        nodes: [[0.0; 3]].into_iter().chain(ends).collect(),
        struts: (1..4).map(|k| ([0, k], [3.0; 2])).collect(),
        pads: (0..4).collect(),
        pad: 7.0,
    };
    let outcome = of_mesh(&fan.mesh(0.75), ProfileParams::default());
    assert_eq!(outcome.frame.beams.len(), 3, "no bend that leads to the middle of the pad");
    for end in ends {
        let (_, axis) = beam_between(&outcome, [0.0; 3], end);
        let along = Point3::from(end).coords.normalize();
        let off = axis.map(|p| p.coords.cross(&along).norm());
        assert!(off.iter().all(|off| *off < 0.2 * 3.0), "{off:.2?} mm off the axis to {end:?}");
    }
}

#[test]
fn a_bar_gets_the_tube_of_nearest_bending_stiffness() {
    let choice: ProfileChoice = "catalogue:chs".parse().expect("a choice");
    let profiles = ProfileParams { choice, ..ProfileParams::default() };
    let outcome = reconstruct(&sample("single_bar.obj"), profiles);
    let beam = &outcome.frame.beams[0];
    let goal = beam.measured.as_ref().expect("a measured beam").i_1;
    let tubes = Catalogue::builtin().of_families(&["CHS"]).expect("the family");
    let nearest = tubes
        .entries()
        .iter()
        .min_by(|a, b| {
            let apart = |i: f64| (i - goal).abs();
            apart(a.properties.i_1).total_cmp(&apart(b.properties.i_1))
        })
        .expect("tubes");
    assert_eq!(beam.shape.profile.to_string(), nearest.name());
    let designation = beam.shape.profile.designation.as_ref().expect("a standard profile");
    assert!(designation.standard.contains("EN 102"), "{designation:?}");
}

/// A portal of flat bars `b` thick in its plane and `h` deep, meshed three elements to its thickness;
/// its feet are non-design.
fn portal_of_flats(b: f64, h: f64) -> TestMesh {
    let [height, span, foot] = [8.0 * b, 9.0 * b, 0.8 * b];
    let of_box = |p: [f64; 3], low: [f64; 3], high: [f64; 3]| {
        (0..3).map(|k| f64::max(low[k] - p[k], p[k] - high[k])).fold(f64::MIN, f64::max)
    };
    let (t, y) = (0.5 * b, 0.5 * h);
    let distance = |p: [f64; 3]| {
        let legs = [0.0, span].map(|x| of_box(p, [x - t, -y, 0.0], [x + t, y, height + t]));
        let beam = of_box(p, [-t, -y, height - t], [span + t, y, height + t]);
        legs[0].min(legs[1]).min(beam)
    };
    let step = b / 3.0;
    // No side lies on the grid.
    let low = [-t, -y, 0.0].map(|x| x - 2.3 * step);
    let high = [span + t, y, height + t].map(|x| x + 2.0 * step);
    surface_of(distance, low, high, step).labelled(|middle| middle[2] < foot)
}

#[test]
fn flat_bars_are_recognised_whose_corners_a_coarse_mesh_has_worn() {
    let (choice, all_families) = (ProfileChoice::Catalogue(Vec::new()), Catalogue::builtin());
    for (b, h) in [(10.0, 20.0), (12.0, 30.0), (15.0, 40.0)] {
        let surface = portal_of_flats(b, h).surface();
        let params = SkeletonParams::default();
        let march = skeleton::march(&surface, &params, &mut ()).expect("a skeleton");
        let all = frame::sections(&surface, &march.skeleton);
        let found = normalize(&march.skeleton, &all, &surface, &FrameParams::default()).frame;
        assert_eq!(found.beams.len(), 3);
        for beam in &found.beams {
            let measured = beam.measured.as_ref().expect("a measured beam");
            for mode in [MatchMode::Stiffness, MatchMode::Area] {
                let bar = match_profile(measured, &choice, mode, all_families).expect("a match");
                assert_eq!(bar.profile.to_string(), format!("Flat {h}x{b}"), "{mode:?}");
            }
        }
    }
}

#[test]
fn every_catalogue_profile_is_found_again_by_its_properties() {
    let all = Catalogue::builtin();
    let choice = ProfileChoice::Catalogue(Vec::new());
    for entry in all.entries() {
        let target = MatchTarget::of_properties(&entry.properties);
        let found = match_profile(&target, &choice, MatchMode::Stiffness, all).expect("a match");
        let e = found.errors;
        let same = [e.area, e.i_1, e.i_2, e.j].iter().all(|x| x.abs() < 1e-9);
        assert!(same, "{} found as {}: {e:?}", entry.name(), found.profile);
    }
}

#[test]
fn a_member_that_runs_straight_on_is_kept_in_one_piece_if_wanted() {
    let surface = common::frame::cross().mesh(0.8).surface();
    let marched = skeleton::march(&surface, &SkeletonParams::default(), &mut ()).expect("a march");
    let sections = frame::sections(&surface, &marched.skeleton);
    let cut = normalize(&marched.skeleton, &sections, &surface, &FrameParams::default()).frame;
    assert!(cut.beams.iter().all(|b| b.passes.is_empty()));
    let params = FrameParams { continuous: true, ..FrameParams::default() };
    let whole = normalize(&marched.skeleton, &sections, &surface, &params).frame;
    assert!(whole.beams.len() < cut.beams.len(), "{} beams", whole.beams.len());
    for beam in whole.beams.iter().filter(|b| !b.passes.is_empty()) {
        assert_eq!(beam.spans().count(), beam.passes.len() + 1);
        let [a, b] = whole.axis(beam);
        for pass in &beam.passes {
            let node = whole.node(pass.node);
            assert_eq!(node.kind, NodeKind::Junction);
            let off = (node.position - a).cross(&(b - a)).norm() / (b - a).norm();
            assert!(off < 1e-9 * beam.length, "{off} mm off the axis");
        }
    }
}
