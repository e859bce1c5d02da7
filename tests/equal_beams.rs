//! Equal beams of symmetric parts: one profile, one length, one piece of the cut list, one product
//! of the STEP file, although no mesh is quite symmetric.

mod common;

use std::collections::BTreeSet;

use beamwright::frame::{FrameParams, Loft, ProfileParams, match_profiles, normalize, sections};
use beamwright::joint::{JointKind, Joints, joints};
use beamwright::output::assembly::{Assembly, assembly, mark};
use beamwright::output::cut_list::{CutList, CutListParams};
use beamwright::output::step::{self, Body, Part};
use beamwright::section::Catalogue;
use beamwright::skeleton::{self, SkeletonParams};
use common::frame::{TrueFrame, table};
use nalgebra::{Point3, Vector3};

/// A frame with the sets of struts that its symmetry makes equal.
struct Symmetric {
    name: &'static str,
    truth: TrueFrame,
    equal: Vec<Vec<usize>>,
}

/// Three legs, splayed, on a triangle: turned by a third, it is itself.
fn tripod() -> Symmetric {
    let around = |radius: f64, height: f64| {
        (0..3).map(move |k| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 3.0 + 0.3).sin_cos();
            [radius * cos, radius * sin, height]
        })
    };
    let legs = (0..3).map(|k| ([k, k + 3], [3.5, 3.5]));
    let ring = (0..3).map(|k| ([k, (k + 1) % 3], [3.0, 3.0]));
    let truth = TrueFrame {
        nodes: around(28.0, 40.0).chain(around(45.0, 0.0)).collect(),
        struts: legs.chain(ring).collect(),
        pads: vec![3, 4, 5],
        pad: 6.0,
    };
    Symmetric { name: "tripod", truth, equal: vec![vec![0, 1, 2], vec![3, 4, 5]] }
}

/// A gable: mirrored at x = 0, it is itself.
fn gable() -> Symmetric {
    let side = |s: f64| [[s * 50.0, 0.0, 0.0], [s * 40.0, 0.0, 40.0], [s * 14.0, 0.0, 62.0]];
    let truth = TrueFrame {
        nodes: side(-1.0).into_iter().chain(side(1.0)).collect(),
        struts: [[0, 1], [3, 4], [1, 2], [4, 5], [2, 5], [1, 4]]
            .into_iter()
            .map(|ends| (ends, [3.2, 3.2]))
            .collect(),
        pads: vec![0, 3],
        pad: 6.0,
    };
    Symmetric { name: "gable", truth, equal: vec![vec![0, 1], vec![2, 3]] }
}

/// The legs of a table, and each of its two pairs of sides.
fn four_legs() -> Symmetric {
    let equal = vec![vec![4, 5, 6, 7], vec![0, 2], vec![1, 3]];
    Symmetric { name: "table", truth: table(), equal }
}

struct Built {
    frame: beamwright::frame::Frame,
    joints: Joints,
}

/// The frame of a mesh whose points are moved by `noise` mm either way.
fn built(truth: &TrueFrame, noise: f64, joint: JointKind, choice: &str, loft: Loft) -> Built {
    let mut seed = 1u32;
    let mut shake = move |x: f64| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        x + noise * (f64::from(seed) / f64::from(u32::MAX) - 0.5) * 2.0
    };
    let mut mesh = truth.mesh(1.25);
    mesh.positions.iter_mut().for_each(|p| *p = p.map(&mut shake));
    let surface = mesh.surface();
    let march = skeleton::march(&surface, &SkeletonParams::default(), &mut ()).expect("a skeleton");
    let all = sections(&surface, &march.skeleton);
    let mut frame = normalize(&march.skeleton, &all, &surface, &FrameParams::default()).frame;
    let choice = choice.parse().expect("a choice of profiles");
    let profiles = ProfileParams { loft, choice, ..ProfileParams::default() };
    match_profiles(&mut frame, &profiles, Catalogue::builtin()).expect("profiles");
    let (joints, _) = joints(&frame, &surface.interfaces, joint);
    Built { frame, joints }
}

impl Built {
    /// The beam of a strut.
    fn beam_of(&self, truth: &TrueFrame, strut: usize) -> usize {
        let ends = truth.struts[strut].0.map(|n| Point3::from(truth.nodes[n]));
        let off = |i: &usize| {
            let [p, q] = self.frame.axis(&self.frame.beams[*i]);
            let way = |a: Point3<f64>, b: Point3<f64>| (p - a).norm() + (q - b).norm();
            way(ends[0], ends[1]).min(way(ends[1], ends[0]))
        };
        let beams = 0..self.frame.beams.len();
        beams.min_by(|a, b| off(a).total_cmp(&off(b))).expect("a beam")
    }
}

/// Whether the writer makes one product of two parts.
fn share_a_product(a: &Part, b: &Part) -> bool {
    a.product == b.product
        && a.colour == b.colour
        && a.body == b.body
        && a.properties == b.properties
}

fn assert_equal(case: &Symmetric, joint: JointKind, choice: &str, loft: Loft) {
    let Symmetric { name, truth, equal } = case;
    let built = built(truth, 0.06, joint, choice, loft);
    let Assembly { document, sizes, .. } =
        assembly(name, &built.frame, &built.joints, 7850.0).expect("solids");
    let list = CutList::new(&built.frame, &built.joints, &sizes, &CutListParams::default());
    let parts = &document.groups[0].parts;
    let says = format!("{name}, {joint:?}, {choice}, {loft:?}");
    for equal in equal {
        let beams: Vec<usize> = equal.iter().map(|&s| built.beam_of(truth, s)).collect();
        let first = &built.frame.beams[beams[0]];
        for &b in &beams {
            let beam = &built.frame.beams[b];
            assert_eq!(beam.shape.profile, first.shape.profile, "{says}");
            assert_eq!(beam.cut_length, first.cut_length, "{says}");
            assert!(share_a_product(&parts[b], &parts[beams[0]]), "{says}: {}", parts[b].name);
        }
        let pieces: BTreeSet<&str> = beams
            .iter()
            .filter_map(|&b| list.pieces.iter().find(|p| p.marks.contains(&mark(b))))
            .map(|p| p.piece.as_str())
            .collect();
        assert_eq!(pieces.len(), 1, "{says}: {pieces:?}");
    }
    for (beam, part) in built.frame.beams.iter().zip(parts) {
        let [a, b] = built.frame.axis(beam);
        let axis = part.placement * Vector3::z();
        assert!(axis.cross(&beam.axes.x).norm() < 1e-9, "{says}: {} is off its axis", part.name);
        let Body::Loft(loft) = &part.body else { panic!("a loft") };
        let middle = 0.5 * (loft.stations[0].z + loft.stations[loft.stations.len() - 1].z);
        let middle = part.placement * Point3::new(0.0, 0.0, middle);
        let along = (middle - a).dot(&beam.axes.x) / (b - a).norm();
        assert!((0.3..0.7).contains(&along), "{says}: {} lies at {along}", part.name);
    }
    let (mut once, mut again) = (Vec::new(), Vec::new());
    step::write(&document, &mut once).expect("a STEP file");
    step::write(&document, &mut again).expect("a STEP file");
    assert_eq!(once, again);
    let text = String::from_utf8(once).expect("ASCII");
    let solids = text.matches("MANIFOLD_SOLID_BREP").count();
    let all = parts.len() + built.joints.balls.len();
    assert!(solids < all, "{says}: {solids} solids for {all} parts");
}

#[test]
fn equal_beams_of_symmetric_parts_are_one_piece_and_one_product() {
    for case in [tripod(), gable(), four_legs()] {
        for joint in [JointKind::None, JointKind::Sphere, JointKind::Mitre, JointKind::Trim] {
            assert_equal(&case, joint, "auto", Loft::Constant);
        }
    }
}

#[test]
fn equal_beams_are_one_piece_whatever_their_profile() {
    for choice in ["rectangle", "ellipse", "freeform", "catalogue:L"] {
        assert_equal(&four_legs(), JointKind::None, choice, Loft::Constant);
    }
}

#[test]
fn equal_beams_taper_alike() {
    for loft in [Loft::Taper, Loft::Multi] {
        for choice in ["auto", "rectangle", "freeform"] {
            assert_equal(&four_legs(), JointKind::None, choice, loft);
        }
    }
}

#[test]
fn legs_drawn_a_little_longer_are_another_piece() {
    let mut uneven = four_legs();
    for foot in [5, 7] {
        uneven.truth.nodes[foot][2] -= 0.45; // an eighth of their radius
    }
    uneven.equal = vec![vec![4, 6], vec![5, 7]];
    for choice in ["auto", "rectangle", "freeform"] {
        for loft in [Loft::Constant, Loft::Taper] {
            assert_equal(&uneven, JointKind::None, choice, loft);
            let built = built(&uneven.truth, 0.06, JointKind::None, choice, loft);
            let sizes =
                assembly("legs", &built.frame, &built.joints, 7850.0).expect("solids").sizes;
            let list = CutList::new(&built.frame, &built.joints, &sizes, &CutListParams::default());
            let [short, long] = [4, 5].map(|strut| {
                let mark = mark(built.beam_of(&uneven.truth, strut));
                let piece = list.pieces.iter().find(|p| p.marks.contains(&mark));
                piece.expect("a line of the list").length_mm
            });
            assert!((long - short - 0.45).abs() < 0.15, "{choice}, {loft:?}: {short} and {long}");
        }
    }
}
