//! Volumes against textbook formulas, and random lofts.

mod step_family;

use std::f64::consts::{PI, TAU};

use beamwright::output::step::{self, Between, Body, EndCut, Loft, Station};
use beamwright::section::Outline;
use nalgebra::{Point2, Rotation2, Vector2, Vector3};
use proptest::prelude::*;
use step_family::{document, part, rectangle, solids};

fn volume(loft: Loft) -> f64 {
    Body::Loft(loft).volume().unwrap()
}

#[track_caller]
fn assert_near(found: f64, meant: f64) {
    assert!((found - meant).abs() <= 1e-12 * meant.abs(), "{found} is not {meant}");
}

#[test]
fn cylinder_and_tube() {
    assert_near(Body::round_bar(5.0, 80.0).volume().unwrap(), PI * 25.0 * 80.0);
    assert_near(Body::tube(5.0, 4.0, 80.0).volume().unwrap(), PI * 9.0 * 80.0);
}

#[test]
fn frustum_of_a_cone() {
    let loft = Loft::taper(Outline::circle(6.0), Outline::circle(3.5), 80.0);
    assert_near(volume(loft), PI / 3.0 * 80.0 * (36.0 + 6.0 * 3.5 + 3.5 * 3.5));
}

#[test]
fn frustum_of_a_pyramid() {
    let loft = Loft::taper(rectangle(12.0, 8.0), rectangle(6.0, 4.0), 60.0);
    assert_near(volume(loft), 60.0 / 3.0 * 96.0 * (1.0 + 0.5 + 0.25));
}

#[test]
fn wedge_between_unlike_rectangles_is_a_prismatoid() {
    let loft = Loft::taper(rectangle(12.0, 8.0), rectangle(4.0, 10.0), 60.0);
    assert_near(volume(loft), 60.0 / 6.0 * (96.0 + 4.0 * 8.0 * 9.0 + 40.0));
}

#[test]
fn ellipse_to_ellipse_is_a_prismatoid() {
    let loft = Loft::taper(Outline::ellipse(6.0, 4.0), Outline::ellipse(3.0, 5.0), 60.0);
    assert_near(volume(loft), PI * 60.0 / 6.0 * (24.0 + 4.0 * 4.5 * 4.5 + 15.0));
}

#[test]
fn oblique_cut_of_a_prism_takes_what_it_leaves() {
    let normal = Vector3::new(2.0, -1.0, 1.5);
    for outline in [Outline::circle(5.0), Outline::ellipse(6.0, 4.0)] {
        let bar = Loft::prism(outline, vec![], 80.0);
        let cut = bar.clone().cut(normal, Vector3::new(-0.3, 0.8, 1.0));
        assert_near(volume(cut), volume(bar));
    }
}

#[test]
fn oblique_cut_off_the_centroid_follows_the_first_moments() {
    // z from 0 to 80 + x over a rectangle about (3, 0): 12 · 8 · (80 + 3).
    let corners = [(-3.0, -4.0), (9.0, -4.0), (9.0, 4.0), (-3.0, 4.0)];
    let outline = Outline::polygon(&corners.map(|(x, y)| Point2::new(x, y)));
    let loft = Loft::prism(outline, vec![], 80.0).cut(Vector3::z(), Vector3::new(-1.0, 0.0, 1.0));
    assert_near(volume(loft), 96.0 * 83.0);
}

/// An oblique cut of a cone is an ellipse; over it and under the apex stands ⅓ A h.
#[test]
fn oblique_cut_of_a_cone_leaves_an_oblique_cone() {
    let (r0, r1, length, steepness) = (6.0, 3.0, 80.0, 1.5_f64);
    let loft = Loft::taper(Outline::circle(r0), Outline::circle(r1), length)
        .cut(Vector3::z(), Vector3::new(-steepness, 0.0, 1.0));
    let slope = (r1 - r0) / length; // dr/dz
    let apex = -r0 / slope;
    let epsilon = slope * steepness;
    let (near, far) = (r1 / (1.0 - epsilon), r1 / (1.0 + epsilon));
    let area = PI * 0.5 * (near + far) * (near * far).sqrt(); // seen along the axis
    let over = area * (apex - length) / 3.0;
    let whole = PI * r0 * r0 * apex / 3.0;
    assert_near(volume(loft), whole - over);
}

#[test]
fn smooth_loft_through_a_parabola_of_radii_keeps_its_sections() {
    let radii = [4.0, 5.0, 5.5, 5.0, 4.0];
    let stations = radii.iter().enumerate().map(|(i, r)| Station {
        z: 20.0 * i as f64,
        outer: Outline::circle(*r),
        holes: vec![],
    });
    let ruled = Loft::between_stations(stations.collect());
    let smooth = Loft { between: Between::Smooth, ..ruled.clone() };
    let (ruled, smooth) = (volume(ruled), volume(smooth));
    assert!(smooth > ruled && smooth < 1.02 * ruled, "{ruled} {smooth}");
}

#[test]
fn solids_of_facets() {
    let block = solids::block(Vector3::new(10.0, 20.0, 5.0)).volume().unwrap();
    assert_near(block, 8.0 * 1000.0);
    let holes = -2.0 * PI * 16.0 * 10.0 - PI * 25.0 * 4.0 + PI * 36.0 * 7.0;
    assert_near(solids::plate().volume().unwrap(), 60.0 * 40.0 * 10.0 + holes);
    assert_near(solids::hollow().volume().unwrap(), 40.0 * 30.0 * 20.0 - 24.0 * 16.0 * 10.0);
    assert_near(solids::window().volume().unwrap(), (60.0 * 40.0 - 36.0 * 18.0) * 10.0);
    assert_near(Body::Sphere { radius: 3.0 }.volume().unwrap(), 36.0 * PI);
}

#[test]
fn every_loft_of_every_profile_in_every_cut_is_a_solid() {
    for (profile_name, profile) in step_family::profiles() {
        for (loft_name, loft) in step_family::lofts(profile) {
            for (cut_name, start, end) in step_family::cuts() {
                let body = Body::Loft(Loft { start, end, ..loft.clone() });
                let name = format!("{profile_name} {loft_name} {cut_name}");
                let written = step::write(&document("d", vec![part(&name, body)]), &mut Vec::new());
                assert!(written.is_ok(), "{name}: {written:?}");
            }
        }
    }
}

/// A random section: kind, size, flatness, turn.
fn section(kind: usize, size: f64, flatness: f64, turn: f64) -> (Outline, Vec<Outline>) {
    let profiles = step_family::profiles();
    let (_, profile) = profiles[kind % profiles.len()];
    profile(Vector2::new(size, size * flatness), turn)
}

fn cut(tilt: f64, azimuth: f64) -> EndCut {
    let across = Rotation2::new(azimuth) * Vector2::new(tilt.tan(), 0.0);
    EndCut::Plane { normal: Vector3::new(across.x, across.y, 1.0) }
}

prop_compose! {
    fn lofts()(
        kind in 0usize..11,
        sizes in prop::collection::vec((0.4f64..1.2, 0.6f64..1.0), 2..5),
        turn in -0.5f64..0.5,
        steps in prop::collection::vec(40.0f64..300.0, 4),
        tilts in prop::array::uniform2(0.0f64..1.2),
        azimuths in prop::array::uniform2(0.0f64..TAU),
        smooth in any::<bool>(),
    ) -> Loft {
        let mut z = 0.0;
        let stations = sizes.iter().zip(steps).map(|((size, flatness), step)| {
            let (outer, holes) = section(kind, *size, *flatness, turn);
            z += step;
            Station { z, outer, holes }
        });
        Loft {
            stations: stations.collect(),
            between: if smooth { Between::Smooth } else { Between::Ruled },
            start: cut(tilts[0], azimuths[0]),
            end: cut(tilts[1], azimuths[1]),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]

    /// Whatever has a volume can be built as a closed shell and written.
    #[test]
    fn random_lofts_are_solids_or_refused(loft in lofts()) {
        let body = Body::Loft(loft);
        if let Ok(volume) = body.volume() {
            prop_assert!(volume > 0.0);
            let written = step::write(&document("d", vec![part("p", body)]), &mut Vec::new());
            prop_assert!(written.is_ok(), "{written:?}");
        }
    }

    /// Scaling by s scales the volume by s³; lifting the stations leaves it.
    #[test]
    fn volume_scales_and_does_not_move(loft in lofts(), lift in -1e3f64..1e3) {
        let Ok(volume) = loft.volume() else { return Ok(()) };
        let mut lifted = loft.clone();
        for station in &mut lifted.stations {
            station.z += lift;
        }
        let moved = lifted.volume().unwrap();
        prop_assert!((moved - volume).abs() <= 1e-9 * volume, "{moved} {volume}");
    }

    /// A constant prism has as much between its cuts, whatever they are, as between square ends.
    #[test]
    fn cuts_through_the_centroid_keep_the_volume(
        kind in prop::sample::select(vec![0usize, 1, 3, 4, 5, 6, 7, 8, 9]),
        turn in -3.0f64..3.0,
        tilts in prop::array::uniform2(-1.2f64..1.2),
        azimuths in prop::array::uniform2(0.0f64..TAU),
    ) {
        let (outer, holes) = section(kind, 1.0, 1.0, turn);
        let mut loft = Loft::prism(outer, holes, 400.0);
        let whole = loft.volume().unwrap();
        (loft.start, loft.end) = (cut(tilts[0], azimuths[0]), cut(tilts[1], azimuths[1]));
        let Ok(volume) = loft.volume() else { return Ok(()) };
        prop_assert!((volume - whole).abs() <= 1e-11 * volume, "{volume} {whole}");
    }
}
