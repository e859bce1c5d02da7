//! What has to hold of the evaluation whatever the part.

mod evaluate_shapes;

use beamwright::evaluate::{
    Compared, EvaluateOptions, Evaluated, Evaluation, Evaluator, Link, Report, compare, evaluate,
};
use beamwright::skeleton::graph::Skeleton;
use evaluate_shapes::{Shape, line, lines, moved, rod, y_form};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

fn somewhere() -> impl Strategy<Value = Isometry3<f64>> {
    let turn = prop::array::uniform3(-3.0..3.0f64).prop_map(Vector3::from);
    let shift = prop::array::uniform3(-50.0..50.0f64).prop_map(Translation3::from);
    (turn, shift).prop_map(|(turn, shift)| {
        Isometry3::from_parts(shift, UnitQuaternion::from_scaled_axis(turn))
    })
}

/// A Y with a skeleton off its axes, and a rod with one that leaves it.
fn cases() -> Vec<(Shape, Skeleton)> {
    let arm = |x: f64, y: f64| line([0.1, 0.0, 0.2], [x, y, 0.1], 12);
    let spread = lines(&[arm(11.0, 0.3), arm(-5.6, 9.2), arm(-5.4, -9.6)]);
    let slanted = lines(&[line([1.0, -0.4, 0.1], [9.0, 1.2, 0.3], 20)]);
    vec![(y_form(), spread), (rod(10.0, 72, 4), slanted)]
}

fn measured(shape: &Shape, skeleton: &Skeleton) -> Evaluation {
    evaluate(&shape.surface(), skeleton, &EvaluateOptions::default()).unwrap()
}

/// The figures that may not depend on where the part lies, with the part by which 36 rays in 10°
/// steps may change them: the longest ray of a square that is not cut by a corner may be 8 % longer
/// when the rays are turned by half a step.
fn invariants(k: &Evaluation) -> Vec<(&'static str, f64, f64)> {
    let of = |x: Option<f64>| x.unwrap_or(-1.0);
    let mut figures = vec![
        ("outside", k.outside.length_outside / k.mesh.r_mean, 1e-6),
        ("uncovered", k.coverage.uncovered, 1e-6),
        ("r_mean over r", k.mesh.r_mean / k.mesh.r, 1e-9),
        ("cycles", k.topology.cycle_rank as f64, 0.0),
    ];
    for c in [&k.raw, &k.resampled] {
        figures.extend([
            ("e_true_uncapped", of(c.e_true_uncapped), 0.08),
            ("e_true_uncapped_shaft", of(c.e_true_uncapped_shaft), 0.08),
            ("hu_degree_uncapped", of(c.hu_degree_uncapped), 0.03),
            ("offset", of(c.offset.mean), 1e-6),
            ("points outside", c.points_outside as f64, 0.0),
            ("shaft points", c.shaft_points as f64, 0.0),
        ]);
    }
    figures
}

/// All figures that are pure numbers.
fn relative(k: &Evaluation) -> Vec<Option<f64>> {
    let mut figures = vec![Some(k.outside.fraction), Some(k.coverage.uncovered)];
    for c in [&k.raw, &k.resampled] {
        figures.extend([
            c.e_center,
            c.e_center_shaft,
            c.e_center_max,
            c.e_true,
            c.e_true_shaft,
            c.e_true_uncapped,
            c.hu_degree,
            c.offset.mean,
            c.offset.shaft_median,
        ]);
    }
    figures
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn a_rigid_motion_leaves_the_true_figures(motion in somewhere()) {
        for (shape, skeleton) in cases() {
            let before = invariants(&measured(&shape, &skeleton));
            let after = measured(&shape.moved(&motion, 1.0), &moved(&skeleton, &motion, 1.0));
            for ((name, x, tolerance), (_, y, _)) in before.iter().zip(invariants(&after)) {
                prop_assert!((x - y).abs() <= tolerance * x.abs() + 1e-9, "{name}: {x} became {y}");
            }
        }
    }

    #[test]
    fn scaling_leaves_all_relative_figures(exponent in -3.0..3.0f64) {
        let (scale, here) = (10f64.powf(exponent), Isometry3::identity());
        for (shape, skeleton) in cases() {
            let before = relative(&measured(&shape, &skeleton));
            let after = relative(&measured(&shape.moved(&here, scale), &moved(&skeleton, &here, scale)));
            for (x, y) in before.iter().zip(&after) {
                let (x, y) = (x.unwrap_or(-1.0), y.unwrap_or(-1.0));
                prop_assert!((x - y).abs() <= 1e-6 * x.abs() + 1e-9, "{x} became {y}");
            }
        }
    }
}

#[test]
fn two_skeletons_are_as_far_apart_as_one_was_moved() {
    let shift = Isometry3::translation(0.0, 0.0, 0.5);
    let first = lines(&[line([0.0; 3], [10.0, 0.0, 0.0], 4)]);
    let d = compare(&first, &moved(&first, &shift, 1.0), None).unwrap();
    for distance in [d.d12_mean, d.d12_max, d.d21_mean, d.d21_max, d.hausdorff] {
        assert!((distance - 0.5).abs() < 1e-12);
    }
}

fn report(count: usize) -> Report {
    let (shape, skeleton) = cases().remove(0);
    let surface = shape.surface();
    let evaluator = Evaluator::new(&surface, &EvaluateOptions::default()).unwrap();
    let (skeleton, done) = evaluator.post_process(&skeleton, Link::Closest);
    let evaluated = |k: usize| Evaluated {
        name: format!("a/very/long/folder/skeleton_{k}.json"),
        post_processing: Some(done),
        evaluation: evaluator.evaluate(&skeleton).unwrap(),
    };
    let compared = Compared {
        first: "one".to_owned(),
        second: "two".to_owned(),
        comparison: compare(&skeleton, &skeleton, None).unwrap(),
    };
    Report::new((0..count).map(evaluated).collect(), vec![compared])
}

#[test]
fn the_table_fits_80_columns_whatever_the_number_of_skeletons() {
    for count in [1, 4, 6] {
        let table = report(count).to_table();
        assert!(table.lines().all(|l| l.chars().count() <= 80), "{table}");
        assert_eq!(table.matches("E_center").count(), count.div_ceil(4));
        assert_eq!(table.matches("ton_").count(), count);
    }
}

#[test]
fn the_json_has_stable_names() {
    let json: serde_json::Value = serde_json::from_str(&report(1).to_json().unwrap()).unwrap();
    assert_eq!((&json["format"], &json["version"]), (&"beamwright-evaluation".into(), &1.into()));
    let skeleton = &json["skeletons"][0];
    for path in [
        "/name",
        "/post_processing/joined",
        "/mesh/r",
        "/mesh/r_mean",
        "/mesh/cube_from",
        "/mesh/topology/design_genus",
        "/raw/points",
        "/raw/e_center",
        "/raw/hu_degree",
        "/resampled/e_true_shaft",
        "/resampled/offset/shaft_mean",
        "/outside/fraction",
        "/topology/cycle_rank",
        "/topology/is_homotopic",
        "/coverage/uncovered",
    ] {
        assert!(skeleton.pointer(path).is_some(), "{path} in {skeleton}");
    }
    assert!(json.pointer("/comparisons/0/hausdorff").is_some());
}
