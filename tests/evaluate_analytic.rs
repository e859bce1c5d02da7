//! Figures of the evaluation against values worked out by hand.

mod evaluate_shapes;

use std::f64::consts::{PI, TAU};

use beamwright::evaluate::{EvaluateOptions, Evaluator, Link, evaluate};
use beamwright::skeleton::graph::PointKind;
use evaluate_shapes::{line, lines, measured, ring, rod, y_form};
use nalgebra::Point3;

/// Sides of the rods: their polygon differs from the circle by 1 − cos(π/72) = 0.1 %.
const SIDES: usize = 72;

fn near(found: f64, expected: f64, tolerance: f64) -> bool {
    (found - expected).abs() <= tolerance
}

#[test]
fn a_line_beside_the_axis_of_a_rod_is_off_by_twice_its_distance() {
    let shape = rod(10.0, SIDES, 0);
    for e in [0.0, 0.25, 0.5] {
        let k = measured(&shape, &lines(&[line([1.0, e, 0.0], [9.0, e, 0.0], 32)]));
        let r = k.mesh.r;
        assert_eq!((k.raw.points, k.raw.evaluated, k.raw.excluded.ends), (33, 31, 2));
        assert!(near(k.raw.e_center.unwrap() * r, 2.0 * e, 0.01), "{e}: {:?}", k.raw);
        assert!(near(k.raw.e_true_uncapped.unwrap() * r, 2.0 * e, 0.002), "{e}: {:?}", k.raw);
        assert!(near(k.raw.offset.mean.unwrap(), e, 0.002), "{e}: {:?}", k.raw);
        assert!(
            near(k.raw.hu_degree_uncapped.unwrap(), hu_of_circle(e), 0.002),
            "{e}: {:?}",
            k.raw
        );
        assert!(near(
            k.raw.e_center_over_all_points.unwrap(),
            k.raw.e_center.unwrap() * 31.0 / 33.0,
            1e-12
        ));
    }
}

/// Hu's degree at distance e from the centre of the unit circle: rays ±e cos θ + √(1 − e² sin² θ).
fn hu_of_circle(e: f64) -> f64 {
    let pair = |j: usize| {
        let (s, c) = (TAU * j as f64 / 36.0).sin_cos();
        let half = (1.0 - e * e * s * s).sqrt();
        (half - (e * c).abs()) / (half + (e * c).abs())
    };
    (0..18).map(pair).sum::<f64>() / 18.0
}

#[test]
fn lengths_of_a_rod_are_those_of_the_textbook() {
    let k = measured(&rod(10.0, SIDES, 0), &lines(&[line([1.0, 0.0, 0.0], [9.0, 0.0, 0.0], 8)]));
    assert!(near(k.mesh.r_smallest, 26f64.sqrt(), 1e-9));
    // 2 V / A of a closed cylinder: r L / (L + r).
    assert!(near(k.mesh.r_mean, 10.0 / 11.0, 0.002), "{}", k.mesh.r_mean);
    assert!(near(k.outside.length, 8.0, 1e-12));
    assert_eq!(k.mesh.topology.genus, 0);
}

#[test]
fn a_polyline_through_the_wall_is_outside_for_half_of_its_slants() {
    let way = [[1., 0., 0.], [3., 0., 0.], [5., 2., 0.], [7., 0., 0.], [9., 0., 0.]];
    let k = measured(&rod(10.0, SIDES, 0), &lines(&[way.map(Point3::from).to_vec()]));
    assert_eq!(k.raw.points_outside, 1);
    assert_eq!(k.outside.segments_through_surface, 2);
    assert!(near(k.outside.length_outside, 8f64.sqrt(), 0.2), "{:?}", k.outside);
}

#[test]
fn a_point_outside_has_the_far_wall_as_its_difference() {
    // At (5, 2, 0), beside the rod: 3 to the far wall, as in the demonstration of §4.4.1.
    let way = [[4., 2., 0.], [5., 2., 0.], [6., 2., 0.]];
    let skeleton = lines(&[way.map(Point3::from).to_vec()]);
    let options = EvaluateOptions { cube_half: Some(3.5), ..EvaluateOptions::default() };
    let k = evaluate(&rod(10.0, SIDES, 0).surface(), &skeleton, &options).unwrap();
    assert!(near(k.raw.e_center.unwrap() * k.mesh.r, 3.0, 0.01), "{:?}", k.raw);
    assert!(near(k.raw.e_true.unwrap() * k.mesh.r, 3.0, 0.01), "{:?}", k.raw);
}

#[test]
fn the_cube_is_that_of_the_largest_interface_section() {
    let surface = rod(10.0, SIDES, 4).surface();
    let evaluator = Evaluator::new(&surface, &EvaluateOptions::default()).unwrap();
    let facts = evaluator.facts();
    assert!(near(facts.cube_half, 1.0, 1e-9));
    assert!(near(facts.r_mean, 1.0, 0.002), "the lids do not count as surface: {}", facts.r_mean);
    let t = facts.topology;
    assert_eq!((t.interfaces, t.design_components, t.design_genus), (2, 1, 0));
    assert_eq!((t.non_design_components, t.non_design_genus), (2, 0));
}

#[test]
fn post_processing_cuts_at_the_pads_and_joins_the_centres() {
    let surface = rod(10.0, SIDES, 4).surface();
    let evaluator = Evaluator::new(&surface, &EvaluateOptions::default()).unwrap();
    let axis = line([0.3, 0.0, 0.0], [9.7, 0.0, 0.0], 47);
    let spur = vec![axis[23], axis[23] + nalgebra::Vector3::y() * 0.5];
    let (done, report) = evaluator.post_process(&lines(&[axis, spur]), Link::Closest);
    assert_eq!((report.removed, report.joined, report.pruned), (8, 2, 1));
    assert_eq!((done.count(PointKind::Interface), done.count(PointKind::Junction)), (2, 0));
    let ends = done.points.iter().map(|p| p.position.x);
    assert!(near(ends.clone().fold(9.0, f64::min), 1.0, 1e-12));
    assert!(near(ends.fold(0.0, f64::max), 9.0, 1e-12));
    let (again, report) = evaluator.post_process(&done, Link::Closest);
    assert_eq!((report.already_there, report.joined, report.removed), (2, 0, 0));
    assert_eq!(again.points.len(), done.points.len());
}

#[test]
fn two_branches_through_one_interface_are_kept_when_every_cut_is_linked() {
    let surface = rod(10.0, SIDES, 4).surface();
    let evaluator = Evaluator::new(&surface, &EvaluateOptions::default()).unwrap();
    let arm = |y: f64| line([0.5, y, 0.0], [4.0, y, 0.0], 14);
    let tie = vec![arm(0.4)[14], arm(-0.4)[14]];
    let tail = line([4.0, 0.4, 0.0], [9.5, 0.0, 0.0], 20);
    let both = lines(&[arm(0.4), arm(-0.4), tie, tail]);
    let cycles = |link| evaluator.post_process(&both, link).0.cycle_rank();
    assert_eq!((cycles(Link::Closest), cycles(Link::Cut)), (0, 1));
}

#[test]
fn a_ring_has_one_cycle_and_a_gap_in_it_is_seen() {
    let circle = |n: usize| -> Vec<Point3<f64>> {
        let angle = |k: usize| (TAU * k as f64 / 40.0).sin_cos();
        (0..=n).map(angle).map(|(s, c)| Point3::new(4.0 * c, 4.0 * s, 0.0)).collect()
    };
    let whole = measured(&ring(), &lines(&[circle(40)]));
    assert_eq!((whole.topology.cycle_rank, whole.topology.expected_cycle_rank), (1, 1));
    assert!(whole.topology.is_homotopic);
    assert_eq!(whole.raw.evaluated, 40);
    assert!(whole.raw.e_true_uncapped.unwrap() * whole.mesh.r < 0.03, "{:?}", whole.raw);
    assert!(near(whole.mesh.r_mean, 1.0, 0.01));
    assert!(whole.coverage.uncovered == 0.0);
    let gap = measured(&ring(), &lines(&[circle(20)]));
    assert_eq!((gap.topology.cycle_rank, gap.topology.free_ends), (0, 2));
    assert!(!gap.topology.is_homotopic);
    // Half of the ring less what lies within 3 radii of the two ends: 2 asin(3 / 8) each.
    let expected = 0.5 - 2.0 * (2.0 * (3.0f64 / 8.0).asin()) / TAU;
    assert!(near(gap.coverage.uncovered, expected, 0.03), "{:?}", gap.coverage);
}

#[test]
fn a_y_has_a_junction_three_arms_and_square_sections() {
    let arm = |k: usize, length: f64| {
        let (s, c) = (TAU * k as f64 / 3.0).sin_cos();
        line([0.0; 3], [length * c, length * s, 0.0], 12)
    };
    let whole = lines(&[arm(0, 11.0), arm(1, 11.0), arm(2, 11.0)]);
    let k = measured(&y_form(), &whole);
    let t = k.topology;
    assert_eq!((t.components, t.cycle_rank, t.junctions, t.free_ends, t.branches), (1, 0, 1, 3, 3));
    assert!(t.is_homotopic);
    assert_eq!((k.raw.excluded.junctions, k.raw.excluded.ends), (1, 3));
    // Steps of 0.92: two points of each arm are near the junction, one is near the end.
    assert_eq!(k.raw.shaft_points, k.raw.evaluated - 3 * 3);
    assert!(k.raw.e_true_uncapped_shaft.unwrap() < 1e-9, "{:?}", k.raw);
    assert!(k.raw.offset.shaft_max.unwrap() < 1e-9);
    // Three rectangles round a triangle of side 2.
    let area = 3.0 * 2.0 * (12.0 - 1.0 / 3f64.sqrt()) + 3f64.sqrt();
    let (volume, edge) = (2.0 * area, 3.0 * (2.0 * (12.0 - 1.0 / 3f64.sqrt()) + 2.0));
    assert!(near(k.mesh.r_mean, 2.0 * volume / (2.0 * area + 2.0 * edge), 1e-9));
    let missing = measured(&y_form(), &lines(&[arm(0, 11.0), arm(1, 11.0)]));
    assert!(near(missing.coverage.uncovered, 0.25, 0.05), "{:?}", missing.coverage);
}

#[test]
fn a_line_beside_the_axis_of_a_square_arm_is_measured_exactly() {
    let k = measured(&y_form(), &lines(&[line([4.0, 0.0, 0.25], [10.0, 0.0, 0.25], 12)]));
    assert!(near(k.raw.offset.mean.unwrap(), 0.25 / (4.0 / PI).sqrt(), 1e-9), "{:?}", k.raw);
    // 0.75 to the top, 1.25 to the bottom: a pair at φ from the vertical differs by 0.5 / cos φ as
    // long as both rays hit top and bottom, tan φ ≤ 1 / 1.25; of 10° steps that is 30°.
    let expected = 0.5 / (30f64.to_radians()).cos();
    let found = k.raw.e_true_uncapped.unwrap() * k.mesh.r;
    assert!(near(found, expected, 1e-9), "{found} {expected}");
}
