use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Point2, Point3, Unit, Vector2, Vector3};

use super::laid::{SAME_OUTLINE, lies_on};
use super::*;
use crate::frame::shape::BeamShape;
use crate::frame::{Beam, BeamAxes, BeamSection, Node, NodeId, NodeKind};
use crate::joint::EndCut;
use crate::joint::cut::PER_QUARTER;
use crate::saddle::Saddle;
use crate::section::contours::Contours;
use crate::section::{Profile, Shape};

/// A beam of 100 mm or so along z, its section axes those of the model, and its cuts by their
/// rises across.
fn beam(shape: &Shape, length: f64, rises: [[f64; 2]; 2]) -> (Beam, CutBeam) {
    let profile = Profile::new(shape.clone()).unwrap();
    let properties = profile.properties().unwrap();
    let [x, y, z] = [Vector3::z(), Vector3::x(), Vector3::y()].map(Unit::new_unchecked);
    let beam = Beam {
        ends: [NodeId(0), NodeId(1)],
        passes: Vec::new(),
        branch: 0,
        axes: BeamAxes { x, y, z },
        length,
        cut_length: length,
        section: BeamSection::default(),
        measured: None,
        assumed_area: properties.area,
        shape: BeamShape::assumed(profile, properties),
    };
    let cut = |[a, b]: [f64; 2]| {
        EndCut::in_plane(3.0, Unit::new_normalize(Vector3::new(-a, -b, 1.0)), &Vector3::z_axis())
    };
    let cut = CutBeam::new(&beam, rises.map(cut)).unwrap();
    (beam, cut)
}

fn found(beams: Vec<(Beam, CutBeam)>) -> Vec<Alike> {
    let at =
        |z: f64| Node { position: Point3::new(0.0, 0.0, z), kind: NodeKind::End, interface: None };
    let (beams, cuts): (Vec<Beam>, Vec<CutBeam>) = beams.into_iter().unzip();
    let frame = Frame { nodes: vec![at(0.0), at(100.0)], beams };
    let all = alike(&frame, &cuts);
    for (own, Alike { model, motion, .. }) in all.iter().enumerate() {
        lies_in_place(&frame, &cuts, *model, own, motion);
    }
    all
}

/// Every corner of the placed model lies on the outline and at the cut of the beam.
fn lies_in_place(
    frame: &Frame,
    cuts: &[CutBeam],
    model: usize,
    own: usize,
    motion: &Isometry3<f64>,
) {
    let member = |i: usize| Member::new(&frame.beams[i], &cuts[i]);
    let (model, own) = (member(model), member(own));
    let heights = |m: &Member<'_>, p: Vector2<f64>| {
        let start = m.cut.ends[0].setback;
        [start + m.slopes[0].dot(&p), start + m.cut.axis_length + m.slopes[1].dot(&p)]
    };
    let corners =
        |m: &Member<'_>| Contours::of_region(&m.beam.shape.stations[0].region, PER_QUARTER).outer;
    for corner in corners(&model) {
        for z in heights(&model, corner.coords) {
            let at = motion * Point3::new(corner.x, corner.y, z);
            let across = Point2::new(at.x, at.y);
            assert!(lies_on(&[across], &corners(&own), SAME_OUTLINE * own.radius));
            let off = heights(&own, across.coords).map(|z| (z - at.z).abs());
            assert!(off[0].min(off[1]) <= SAME_PIECE * own.radius * 1.001, "{off:?}");
        }
    }
}

fn kinds(beams: Vec<(Beam, CutBeam)>) -> Vec<usize> {
    found(beams).iter().map(|a| a.kind).collect()
}

const ROUND: Shape = Shape::Round { d: 20.0 };
const FLAT: Shape = Shape::Rectangle { b: 10.0, h: 20.0 };

#[test]
fn round_bars_are_one_piece_however_they_are_turned() {
    let turned = |angle: f64| [angle.cos(), angle.sin()].map(|x| 0.7 * x);
    let one_cut = (0..7).map(|k| beam(&ROUND, 100.0, [turned(f64::from(k)), [0.0; 2]]));
    let swapped = (0..7).map(|k| beam(&ROUND, 100.0, [[0.0; 2], turned(f64::from(k))]));
    assert_eq!(kinds(one_cut.chain(swapped).collect()), [0; 14]);
}

#[test]
fn a_twisted_piece_and_its_mirror_image_are_two() {
    let twisted = |twist: f64, at: f64| {
        let rise = |angle: f64| [angle.cos(), angle.sin()].map(|x| 0.7 * x);
        beam(&ROUND, 100.0, [rise(at), rise(at + twist)])
    };
    let beams = vec![twisted(1.0, 0.0), twisted(-1.0, 0.4), twisted(1.0, 2.0), twisted(PI, 0.0)];
    let twists: Vec<f64> = beams.iter().map(|b| b.1.twist).collect();
    assert!((twists[0] - 1.0).abs() < 1e-12 && (twists[1] + 1.0).abs() < 1e-12);
    assert!((twists[3] - PI).abs() < 1e-12);
    assert_eq!(kinds(beams), [0, 1, 0, 2]);
}

#[test]
fn a_twisted_piece_is_itself_end_for_end() {
    let (a, b) = ([0.7, 0.0], [0.1, 0.5]);
    let beams = vec![
        beam(&ROUND, 100.0, [a, b]),
        // Half a turn about y: what was the second end comes first.
        beam(&ROUND, 100.0, [[-b[0], b[1]], [-a[0], a[1]]]),
    ];
    assert_eq!(kinds(beams), [0, 0]);
}

#[test]
fn cuts_of_flats_lean_over_one_pair_of_sides() {
    let beams = vec![
        beam(&FLAT, 100.0, [[0.7, 0.0], [0.0; 2]]),
        beam(&FLAT, 100.0, [[-0.7, 0.0], [0.0; 2]]),
        beam(&FLAT, 100.0, [[0.0; 2], [-0.7, 0.0]]),
        beam(&FLAT, 100.0, [[0.0, 0.7], [0.0; 2]]),
    ];
    assert_eq!(kinds(beams), [0, 0, 0, 1]);
}

#[test]
fn mirror_images_of_a_flat_lean_to_other_sides() {
    let beams = vec![
        beam(&FLAT, 100.0, [[0.5, 0.3], [0.0; 2]]),
        beam(&FLAT, 100.0, [[0.5, -0.3], [0.0; 2]]),
        beam(&FLAT, 100.0, [[0.0; 2], [-0.5, 0.3]]),
    ];
    let leans: Vec<[f64; 2]> = beams.iter().map(|b| b.1.leans).collect();
    let lean = f64::atan2(0.3, 0.5);
    assert!((leans[0][0] - lean).abs() < 1e-12 && (leans[1][0] + lean).abs() < 1e-12);
    assert!((leans[2][1] - lean).abs() < 1e-12);
    assert_eq!(kinds(beams), [0, 1, 0]);
}

#[test]
fn an_angle_is_itself_end_for_end_only_where_its_legs_are_equal() {
    let angle = |h: f64| Shape::L { b: 40.0, h, t: 4.0, r_1: 0.0, r_2: 0.0 };
    let pair = |h: f64| {
        let (shape, square) = (angle(h), [[0.0; 2]; 2]);
        let cut = [[0.5, 0.5], [0.0; 2]];
        let other = [[0.0; 2], [-0.5, -0.5]];
        vec![beam(&shape, 100.0, square), beam(&shape, 100.0, cut), beam(&shape, 100.0, other)]
    };
    assert_eq!(kinds(pair(60.0)), [0, 1, 2]);
    assert_eq!(kinds(pair(40.0)), [0, 1, 1]);
}

#[test]
fn small_differences_are_one_piece_and_do_not_add_up() {
    let of_lengths = |shape: &Shape, lengths: &[f64]| {
        found(lengths.iter().map(|&l| beam(shape, l, [[0.0; 2]; 2])).collect())
    };
    for shape in [ROUND, FLAT] {
        // Up to a tenth of the radius at each end: 2 mm of length.
        let lengths = [100.0, 100.9, 101.8, 102.7, 99.6, 104.0];
        let all = of_lengths(&shape, &lengths);
        for (a, length) in all.iter().zip(lengths) {
            assert!((length - lengths[a.model]).abs() <= 2.0, "{length} is as {}", a.model);
        }
        let kinds = all.iter().map(|a| a.kind).max();
        assert!((1..4).contains(&kinds.unwrap()), "{kinds:?}");
    }
}

#[test]
fn a_gap_parts_two_kinds_that_differ_little() {
    let lengths = [100.0, 101.5, 100.1, 101.4];
    for shape in [ROUND, FLAT] {
        let beams = lengths.map(|l| beam(&shape, l, [[0.0; 2]; 2])).to_vec();
        assert_eq!(kinds(beams), [0, 1, 0, 1]);
        let leaning = [0.5, 0.57, 0.503, 0.568].map(|g| beam(&shape, 100.0, [[g, 0.0], [0.0; 2]]));
        assert_eq!(kinds(leaning.to_vec()), [0, 1, 0, 1]);
    }
}

#[test]
fn what_is_off_is_told_in_mm() {
    let all = found(vec![beam(&ROUND, 100.0, [[0.0; 2]; 2]), beam(&ROUND, 100.5, [[0.0; 2]; 2])]);
    assert_eq!((all[1].kind, all[0].off), (0, 0.0));
    assert!((all[1].off - 0.25).abs() < 1e-9, "{}", all[1].off);
}

#[test]
fn saddles_are_turned_onto_each_other() {
    let coped = |angle: f64, rise: f64, side: usize| {
        let (beam, mut cut) = beam(&ROUND, 100.0, [[0.0; 2]; 2]);
        let axis = Vector3::new(angle.cos(), angle.sin(), if side == 0 { rise } else { -rise });
        let axis = Unit::new_normalize(axis);
        cut.ends[side].saddle = Some(Saddle { axis, radius: 15.0, above: side == 1 });
        (beam, cut)
    };
    let square = vec![coped(0.0, 0.0, 0), coped(1.0, 0.0, 0), coped(2.5, 0.0, 1)];
    assert_eq!(kinds(square), [0, 0, 0]);
    let leaning =
        vec![coped(0.0, 0.5, 0), coped(2.0, 0.5, 0), coped(0.7, -0.5, 1), coped(0.0, 0.0, 0)];
    assert_eq!(kinds(leaning), [0, 0, 0, 1]);
}

#[test]
fn another_profile_is_another_piece() {
    let shapes = [ROUND, FLAT, Shape::Round { d: 20.5 }];
    let beams = shapes.map(|s| beam(&s, 100.0, [[0.0; 2]; 2])).to_vec();
    assert_eq!(kinds(beams), [0, 1, 2]);
}

#[test]
fn a_beam_alone_stays_where_it_is() {
    let one = found(vec![beam(&FLAT, 100.0, [[0.3, 0.1], [0.0; 2]])]);
    assert_eq!(one[0].motion, Isometry3::identity());
    let turned = found(vec![
        beam(&FLAT, 100.0, [[0.3, 0.0], [0.0; 2]]),
        beam(&FLAT, 100.0, [[0.0; 2], [-0.3, 0.0]]),
    ])[1];
    // End for end: z points back.
    assert!((turned.motion * Vector3::z() + Vector3::z()).norm() < 1e-12);
    assert!((turned.motion * Point3::new(0.0, 0.0, 100.0)).z.abs() < FRAC_PI_2 * 1e-9);
}
