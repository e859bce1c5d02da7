//! What must hold for the properties of every section, on random ones.

use std::f64::consts::{PI, TAU};

use beamwright::section::freeform::average_outline;
use beamwright::section::matching::{
    MatchErrors, MatchMode, MatchTarget, ProfileChoice, match_profile,
};
use beamwright::section::{Catalogue, Contours, Profile, SectionProperties, Shape};
use nalgebra::{Point2, Vector2};
use proptest::prelude::*;

/// A wavy closed contour about the origin that does not cross itself.
fn contour() -> impl Strategy<Value = Vec<Point2<f64>>> {
    (8usize..70, 1.0..20.0f64, 0.3..1.0f64, prop::collection::vec(-0.12..0.12f64, 6)).prop_map(
        |(n, size, flat, waves)| {
            (0..n)
                .map(|i| {
                    let t = TAU * i as f64 / n as f64;
                    let wave: f64 = (1..)
                        .zip(&waves)
                        .map(|(k, a)| a * (f64::from(k) * t + a * 40.0).cos())
                        .sum();
                    Point2::new(size * (1.0 + wave) * t.cos(), size * flat * (1.0 + wave) * t.sin())
                })
                .collect()
        },
    )
}

fn measured(points: Vec<Point2<f64>>) -> SectionProperties {
    SectionProperties::of_contours(&Contours::solid(points)).unwrap()
}

fn shape() -> impl Strategy<Value = Shape> {
    let (b, h, t) = (10.0..80.0f64, 1.0..3.0f64, 0.05..0.2f64);
    prop_oneof![
        b.clone().prop_map(|d| Shape::Round { d }),
        (b.clone(), t.clone()).prop_map(|(d, t)| Shape::Tube { d, t: t * d }),
        (b.clone(), h.clone()).prop_map(|(b, h)| Shape::Rectangle { b, h: h * b }),
        (b.clone(), h.clone()).prop_map(|(b, h)| Shape::Ellipse { b, h: h * b }),
        (b.clone(), h.clone(), t.clone()).prop_map(|(b, h, t)| Shape::Box {
            b,
            h: h * b,
            t: t * b,
            r_o: 1.5 * t * b,
            r_i: t * b
        }),
        (b.clone(), h.clone(), t.clone()).prop_map(|(b, h, t)| Shape::I {
            h: h * b,
            b,
            t_w: 0.7 * t * b,
            t_f: t * b,
            r: t * b
        }),
        (b, h, t).prop_map(|(b, h, t)| Shape::L {
            h: h * b,
            b,
            t: t * b,
            r_1: t * b,
            r_2: 0.5 * t * b
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn scaling_by_s_scales_moments_by_s_to_the_fourth(points in contour(), s in 0.01..100.0f64) {
        let one = measured(points.clone());
        let two = measured(points.iter().map(|p| p * s).collect());
        prop_assert!((two.area / (one.area * s * s) - 1.0).abs() < 1e-9);
        for (a, b) in [(one.i_1, two.i_1), (one.i_2, two.i_2), (one.i_p, two.i_p)] {
            prop_assert!((b / (a * s.powi(4)) - 1.0).abs() < 1e-8);
        }
        // The triangulation may differ where roundings decide.
        prop_assert!((two.j / (one.j * s.powi(4)) - 1.0).abs() < 2e-3);
    }

    #[test]
    fn motion_turns_the_principal_angle_and_changes_nothing_else(
        points in contour(), angle in -3.0..3.0f64, x in -1e3..1e3f64, y in -1e3..1e3f64,
    ) {
        let one = measured(points.clone());
        let moved = Contours::solid(points).moved(angle, Vector2::new(x, y));
        let two = SectionProperties::of_contours(&moved).unwrap();
        prop_assert!((two.i_1 / one.i_1 - 1.0).abs() < 1e-7);
        prop_assert!((two.i_2 / one.i_2 - 1.0).abs() < 1e-7);
        prop_assert!((two.j / one.j - 1.0).abs() < 5e-3);
        if one.i_1 > 1.05 * one.i_2 {
            let off = (two.principal_angle - one.principal_angle - angle).rem_euclid(PI);
            prop_assert!(off.min(PI - off) < 1e-5);
        }
    }

    #[test]
    fn torsion_constant_lies_below_its_bounds(points in contour()) {
        // J ≤ 4 I_1 I_2 / I_p (equal for ellipses), and of all shapes of an area the circle has most.
        let p = measured(points);
        prop_assert!(p.j > 0.0);
        prop_assert!(p.j <= 4.0 * p.i_1 * p.i_2 / p.i_p * (1.0 + 1e-9));
        prop_assert!(p.j <= p.area * p.area / TAU * (1.0 + 1e-9));
    }

    #[test]
    fn parts_of_a_section_add_up(points in contour(), cut in -0.5..0.5f64) {
        let whole = measured(points.clone());
        let at = cut * whole.reach;
        let [below, above] = split(&points, at);
        prop_assume!(below.len() > 2 && above.len() > 2);
        let [a, b] = [below, above].map(measured);
        prop_assert!(((a.area + b.area) / whole.area - 1.0).abs() < 1e-9);
        let steiner = |p: &SectionProperties| p.i_xx + p.area * (p.centroid.y - whole.centroid.y).powi(2);
        prop_assert!(((steiner(&a) + steiner(&b)) / whole.i_xx - 1.0).abs() < 1e-8);
    }

    #[test]
    fn mean_of_one_contour_keeps_area_and_axes(points in contour()) {
        prop_assume!(points.len() > 15);
        let exact = measured(points.clone());
        let mean = Profile::new(Shape::Freeform(average_outline(&[points], 48).unwrap())).unwrap();
        let own = mean.properties().unwrap();
        prop_assert!((own.area / exact.area - 1.0).abs() < 1e-9);
        if exact.i_1 > 1.1 * exact.i_2 {
            let off = (own.principal_angle - exact.principal_angle).rem_euclid(PI);
            prop_assert!(off.min(PI - off) < 0.01);
            prop_assert!((own.i_1 / exact.i_1 - 1.0).abs() < 0.03);
        }
    }

    #[test]
    fn formula_of_a_shape_agrees_with_its_polygon(shape in shape()) {
        let profile = Profile::new(shape).unwrap();
        let exact = profile.properties().unwrap();
        let polygon = Contours::of_region(&profile.region(), 24);
        let own = SectionProperties::of_contours(&polygon).unwrap();
        prop_assert!((own.area / exact.area - 1.0).abs() < 2e-3);
        prop_assert!((own.i_1 / exact.i_1 - 1.0).abs() < 4e-3);
        prop_assert!((own.i_2 / exact.i_2 - 1.0).abs() < 4e-3);
        // Formulas of standards for boxes and rolled shapes are approximations.
        prop_assert!((own.j / exact.j - 1.0).abs() < 0.08, "{profile}: {} {}", own.j, exact.j);
    }

    #[test]
    fn not_weaker_is_never_weaker(points in contour(), family in 0usize..8) {
        let target = MatchTarget::of_contours(Contours::solid(points)).unwrap();
        let all = ["round", "tube", "rectangle", "box", "ellipse", "freeform", "auto", "catalogue"];
        let choice: ProfileChoice = all[family].parse().unwrap();
        let builtin = Catalogue::builtin();
        let matched = match_profile(&target, &choice, MatchMode::NotWeaker, builtin).unwrap();
        let own = matched.profile.properties().unwrap();
        prop_assert!(MatchErrors::of(&own, &target).is_not_weaker(), "{:?}", matched.errors);
    }
}

/// The parts of a polygon below and above a line across y.
fn split(points: &[Point2<f64>], at: f64) -> [Vec<Point2<f64>>; 2] {
    let mut parts = [Vec::new(), Vec::new()];
    for (i, p) in points.iter().enumerate() {
        let q = points[(i + 1) % points.len()];
        parts[usize::from(p.y >= at)].push(*p);
        if (p.y >= at) != (q.y >= at) {
            let cut = p + (q - p) * ((at - p.y) / (q.y - p.y));
            parts[0].push(cut);
            parts[1].push(cut);
        }
    }
    parts
}

#[test]
fn catalogue_profile_finds_itself_by_its_properties() {
    let all = Catalogue::builtin();
    let choice = ProfileChoice::Catalogue(Vec::new());
    for entry in all.entries() {
        let target = MatchTarget::of_properties(&entry.properties);
        for mode in [MatchMode::Stiffness, MatchMode::Area, MatchMode::NotWeaker] {
            let matched = match_profile(&target, &choice, mode, all).unwrap();
            let found = all.find(&matched.profile.to_string()).unwrap();
            let (a, b) = (&found.properties, &entry.properties);
            // Sizes sold under two names, such as pipe and HSS, have the same properties.
            let same = [(a.area, b.area), (a.i_1, b.i_1), (a.i_2, b.i_2), (a.j, b.j)];
            assert!(
                same.iter().all(|(x, y)| (x / y - 1.0).abs() < 1e-6),
                "{} gave {} ({mode})",
                entry.name(),
                found.name()
            );
            assert!(matched.roll.abs() < 1e-6, "{}: {}", entry.name(), matched.roll);
        }
    }
}

#[test]
fn same_section_gives_the_same_bits() {
    let points: Vec<Point2<f64>> = (0..64)
        .map(|i| {
            let t = TAU * f64::from(i) / 64.0;
            let r = 5.0 + (3.0 * t).sin() + 0.3 * (11.0 * t).cos();
            Point2::new(r * t.cos(), r * t.sin())
        })
        .collect();
    let first = measured(points.clone());
    for _ in 0..5 {
        assert_eq!(measured(points.clone()), first);
    }
}
