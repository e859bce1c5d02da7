//! What cannot be a solid is refused with its reason, and never a panic.

mod step_family;

use std::io::{Error, ErrorKind, Write};

use beamwright::output::step::{
    self, Between, Body, BodyError, Document, EndCut, Facet, Facets, Loft, Loop, Property, Station,
    StepError, Value,
};
use beamwright::section::{Freeform, Outline, Path, Segment};
use nalgebra::{Isometry3, Point2, Vector3};
use step_family::{document, part, solids};

fn fault(body: Body) -> BodyError {
    let mut text = Vec::new();
    match step::write(&document("d", vec![part("B007", body)]), &mut text) {
        Err(StepError::Body { part, fault }) => {
            assert_eq!(part, "B007");
            assert!(!fault.to_string().is_empty());
            fault
        }
        other => panic!("{other:?}"),
    }
}

fn prism(outer: Outline) -> Loft {
    Loft::prism(outer, vec![], 100.0)
}

/// Lines from corner to corner, as given.
fn path(corners: &[(f64, f64)]) -> Outline {
    let mut corners = corners.iter().map(|&(x, y)| Point2::new(x, y));
    let start = corners.next().unwrap();
    Outline::Path(Path { start, segments: corners.map(|to| Segment::Line { to }).collect() })
}

#[test]
fn document_without_parts_is_refused() {
    let empty = Document { name: "d".into(), groups: vec![] };
    let error = step::write(&empty, &mut Vec::new()).unwrap_err();
    assert_eq!(error.to_string(), "nothing to write: the document \"d\" holds no part");
}

#[test]
fn numbers_that_are_none_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = |body: Body| matches!(fault(body), BodyError::NotFinite { .. });
        assert!(refused(Body::Sphere { radius: bad }));
        assert!(refused(Body::Loft(prism(Outline::circle(bad)))));
        assert!(refused(Body::Loft(prism(Outline::ellipse(3.0, bad)))));
        assert!(refused(Body::Loft(prism(path(&[(0.0, 0.0), (bad, 0.0), (0.0, 1.0)])))));
        assert!(refused(Body::round_bar(5.0, bad)));
        let cut = prism(Outline::circle(5.0)).cut(Vector3::z(), Vector3::new(bad, 0.0, 1.0));
        assert!(refused(Body::Loft(cut)));
        let mut block = solids::block(Vector3::new(1.0, 2.0, 3.0));
        block.corners[3].y = bad;
        assert!(refused(Body::Facets(block)));
    }
}

#[test]
fn placement_and_properties_must_be_finite() {
    let mut misplaced = part("B007", Body::round_bar(5.0, 10.0));
    misplaced.placement = Isometry3::translation(0.0, f64::NAN, 0.0);
    let mut odd = part("B007", Body::round_bar(5.0, 10.0));
    odd.properties = vec![Property::new("mass", Value::Mass(f64::INFINITY))];
    for (part, message) in [
        (misplaced, "part \"B007\": the placement is not a finite number"),
        (odd, "part \"B007\": a property is not a finite number"),
    ] {
        let error = step::write(&document("d", vec![part]), &mut Vec::new()).unwrap_err();
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn numbers_that_overflow_on_the_way_are_refused() {
    let mut text = Vec::new();
    for body in [Body::round_bar(1e200, 1e200), Body::Sphere { radius: 1e300 }] {
        assert!(step::write(&document("d", vec![part("p", body)]), &mut text).is_err());
    }
}

#[test]
fn outlines_must_enclose_an_area_once() {
    let flat = fault(Body::Loft(prism(path(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]))));
    assert_eq!(flat, BodyError::NoArea);
    let bow = fault(Body::Loft(prism(path(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 3.0)]))));
    assert_eq!(bow, BodyError::SelfCrossing { first: 0, second: 2 });
    let tiny = fault(Body::Loft(prism(path(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1e-7), (0.0, 1.0)]))));
    assert!(matches!(tiny, BodyError::TinyEdge { piece: 1, .. }));
    let around = Path {
        start: Point2::new(1.0, 0.0),
        segments: vec![Segment::Arc { to: Point2::new(-1.0, 0.0), sweep: 7.0 }],
    };
    assert_eq!(
        fault(Body::Loft(prism(Outline::Path(around)))),
        BodyError::BadSweep { radians: 7.0 }
    );
}

#[test]
fn freeform_that_crosses_itself_is_refused() {
    let eight = (0..24).map(|i| {
        let t = std::f64::consts::TAU * f64::from(i) / 24.0;
        Point2::new(10.0 * t.sin() + 2.0 * t.cos(), 5.0 * (2.0 * t).sin())
    });
    let curve = Freeform::through(eight.collect()).unwrap();
    let fault = fault(Body::Loft(prism(Outline::Freeform(curve))));
    assert!(matches!(fault, BodyError::NoArea | BodyError::SelfCrossing { .. }));
}

#[test]
fn bore_must_leave_a_wall() {
    assert_eq!(fault(Body::tube(5.0, 5.0, 10.0)), BodyError::HoleOutside { station: 0, hole: 0 });
    let square = |s: f64| path(&[(-s, -s), (s, -s), (s, s), (-s, s)]);
    let crossing = Loft::prism(square(5.0), vec![path(&[(4.0, 0.0), (6.0, 0.0), (5.0, 1.0)])], 9.0);
    assert_eq!(fault(Body::Loft(crossing)), BodyError::HoleOutside { station: 0, hole: 0 });
    let nested = Loft::prism(square(5.0), vec![square(3.0), square(2.0)], 9.0);
    assert!(matches!(fault(Body::Loft(nested)), BodyError::HoleOutside { station: 0, .. }));
}

#[test]
fn stations_must_be_alike_and_ascend() {
    let station = |z: f64, outer: Outline| Station { z, outer, holes: vec![] };
    let circle = || Outline::circle(5.0);
    let lone = Loft::between_stations(vec![station(0.0, circle())]);
    assert_eq!(fault(Body::Loft(lone)), BodyError::TooFewStations { count: 1 });
    let down = Loft::between_stations(vec![station(5.0, circle()), station(5.0, circle())]);
    assert_eq!(fault(Body::Loft(down)), BodyError::NotAscending { station: 1 });
    let square = path(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]);
    let unlike = Loft::taper(circle(), square, 50.0);
    assert_eq!(fault(Body::Loft(unlike)), BodyError::UnlikeOutlines { station: 1 });
    let mut bored = Loft::prism(circle(), vec![], 50.0);
    bored.stations[1].holes.push(Outline::circle(1.0));
    assert_eq!(fault(Body::Loft(bored)), BodyError::UnlikeOutlines { station: 1 });
}

#[test]
fn cuts_must_not_cross_or_run_along_the_beam() {
    let bar = || prism(Outline::circle(20.0));
    let along = bar().cut(Vector3::z(), Vector3::new(1.0, 0.0, 0.1));
    assert!(matches!(fault(Body::Loft(along)), BodyError::TooOblique { end: "end", .. }));
    let lean = |x: f64| Vector3::new(x, 0.0, 1.0);
    assert_eq!(fault(Body::Loft(bar().cut(lean(4.0), lean(-4.0)))), BodyError::CutsCross);
    let none = bar().cut(Vector3::zeros(), Vector3::z());
    assert!(matches!(fault(Body::Loft(none)), BodyError::NotFinite { .. }));
}

#[test]
fn half_a_turn_of_twist_is_refused() {
    let square = |turn: f64| {
        let corner = |i: i32| {
            let angle = turn + std::f64::consts::FRAC_PI_2 * f64::from(i);
            Point2::new(5.0 * angle.cos(), 5.0 * angle.sin())
        };
        Outline::polygon(&[corner(0), corner(1), corner(2), corner(3)])
    };
    let twisted = Loft::taper(square(0.0), square(std::f64::consts::PI), 50.0);
    assert_eq!(fault(Body::Loft(twisted)), BodyError::SectionVanishes);
}

#[test]
fn faces_must_close() {
    let mut open = solids::block(Vector3::new(1.0, 2.0, 3.0));
    open.faces.pop();
    assert!(matches!(fault(Body::Facets(open)), BodyError::NotClosed(_)));
    let mut turned = solids::block(Vector3::new(1.0, 2.0, 3.0));
    if let Facet::Flat { normal, .. } = &mut turned.faces[2] {
        *normal = -*normal;
    }
    assert!(matches!(fault(Body::Facets(turned)), BodyError::NotClosed(_)));
    let mut inside_out = solids::block(Vector3::new(1.0, 2.0, 3.0));
    for face in &mut inside_out.faces {
        if let Facet::Flat { normal, .. } = face {
            *normal = -*normal;
        }
    }
    assert!(matches!(fault(Body::Facets(inside_out)), BodyError::NoVolume { .. }));
    assert!(matches!(fault(Body::Facets(Facets::default())), BodyError::NoVolume { .. }));
}

#[test]
fn faces_must_be_flat_and_name_what_exists() {
    let mut bent = solids::block(Vector3::new(1.0, 2.0, 3.0));
    bent.corners[0].x -= 0.1;
    assert!(matches!(fault(Body::Facets(bent)), BodyError::NotFlat { .. }));
    let mut astray = solids::block(Vector3::new(1.0, 2.0, 3.0));
    if let Facet::Flat { outer, .. } = &mut astray.faces[4] {
        *outer = Loop::Corners(vec![0, 1, 99]);
    }
    assert_eq!(fault(Body::Facets(astray)), BodyError::NoSuchCorner { face: 4 });
    let mut oval = solids::plate();
    oval.circles[1].radius = 3.0;
    assert!(matches!(fault(Body::Facets(oval)), BodyError::NotCylinder { .. }));
}

#[test]
fn separate_solids_are_separate_parts() {
    let mut two = solids::block(Vector3::new(1.0, 2.0, 3.0));
    let mut other = two.clone();
    for corner in &mut other.corners {
        corner.x += 10.0;
    }
    let first = two.corners.len() as u32;
    for face in &mut other.faces {
        if let Facet::Flat { outer: Loop::Corners(corners), .. } = face {
            corners.iter_mut().for_each(|i| *i += first);
        }
    }
    two.corners.extend(other.corners);
    two.faces.extend(other.faces);
    assert_eq!(fault(Body::Facets(two)), BodyError::SeveralSolids { count: 2 });
}

#[test]
fn spike_on_the_way_of_a_smooth_loft_is_refused() {
    let radii = [20.0, 20.0, 0.5, 20.0, 20.0];
    let stations = radii.iter().enumerate().map(|(i, r)| Station {
        z: if i == 2 { 50.0 } else { 25.0 * i as f64 },
        outer: Outline::circle(*r),
        holes: vec![],
    });
    let loft = Loft { between: Between::Smooth, ..Loft::between_stations(stations.collect()) };
    // The spline may dip below zero between the stations; either it is refused or it is a solid.
    match Body::Loft(loft).volume() {
        Ok(volume) => assert!(volume > 0.0),
        Err(fault) => assert_eq!(fault, BodyError::SectionVanishes),
    }
}

#[test]
fn square_cut_is_the_same_as_a_plane_across() {
    let bar = prism(Outline::circle(5.0));
    let crossed = Loft { end: EndCut::Plane { normal: -Vector3::z() * 3.0 }, ..bar.clone() };
    let text = |loft: Loft| {
        let mut text = Vec::new();
        step::write(&document("d", vec![part("p", Body::Loft(loft))]), &mut text).unwrap();
        text
    };
    assert_eq!(text(bar), text(crossed));
}

#[test]
fn output_that_fails_is_reported() {
    struct Full;
    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> Result<usize, Error> {
            Err(Error::new(ErrorKind::StorageFull, "disk full"))
        }
        fn flush(&mut self) -> Result<(), Error> {
            Ok(())
        }
    }
    let error = step::write(&document("d", vec![part("p", Body::round_bar(1.0, 2.0))]), &mut Full);
    assert_eq!(error.unwrap_err().to_string(), "disk full");
}
