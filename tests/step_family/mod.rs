//! Documents that show every kind of body, for the tests of the STEP writer.
#![allow(dead_code, unreachable_pub)] // each test uses some of it

pub mod solids;

use std::f64::consts::TAU;

use beamwright::output::step::{
    Between, Body, Document, EndCut, Group, Loft, Part, Saddle, Station,
};
use beamwright::section::{Freeform, Outline, Profile, Shape};
use nalgebra::{Isometry3, Point2, Rotation2, UnitVector3, Vector2, Vector3};

/// Length of the beams; 75° cuts of the widest section leave some of it.
pub const LENGTH: f64 = 300.0;

/// A document, and the file name it is written under.
pub struct Case {
    pub name: &'static str,
    pub document: Document,
}

/// A section of a family of similar ones: its outside and its holes.
pub type Section = (Outline, Vec<Outline>);

/// Makes a section of a family: scaled along x and y, turned by an angle.
pub type Kind = fn(Vector2<f64>, f64) -> Section;

/// Every outline kind, by name.
pub fn profiles() -> Vec<(&'static str, Kind)> {
    vec![
        ("round", |s, _| (Outline::circle(20.0 * s.x), vec![])),
        ("tube", |s, _| (Outline::circle(20.0 * s.x), vec![Outline::circle(15.0 * s.x)])),
        ("eccentric", |s, _| {
            let centre = Point2::new(3.0, -2.0) * s.x;
            let bore = Outline::Circle { centre, radius: 10.0 * s.x };
            (Outline::circle(20.0 * s.x), vec![bore])
        }),
        ("ellipse", |s, turn| (ellipse(24.0 * s.x, 15.0 * s.y, turn), vec![])),
        ("elliptic_tube", |s, turn| {
            (ellipse(24.0 * s.x, 15.0 * s.y, turn), vec![ellipse(20.0 * s.x, 11.0 * s.y, turn)])
        }),
        ("rectangle", |s, turn| shaped(Shape::Rectangle { b: 40.0, h: 30.0 }, s, turn)),
        ("box", |s, turn| {
            shaped(Shape::Box { b: 40.0, h: 30.0, t: 4.0, r_o: 7.0, r_i: 3.0 }, s, turn)
        }),
        ("i", |s, turn| shaped(Shape::I { h: 40.0, b: 24.0, t_w: 4.0, t_f: 6.0, r: 3.0 }, s, turn)),
        ("channel", |s, turn| {
            shaped(Shape::C { h: 40.0, b: 20.0, t_w: 4.0, t_f: 5.0, r: 3.0 }, s, turn)
        }),
        ("angle", |s, turn| {
            shaped(Shape::L { h: 40.0, b: 30.0, t: 5.0, r_1: 5.0, r_2: 2.5 }, s, turn)
        }),
        ("freeform", |s, turn| (freeform(24, s, turn), vec![])),
    ]
}

fn ellipse(a: f64, b: f64, turn: f64) -> Outline {
    Outline::Ellipse { centre: Point2::origin(), half_axes: [a, b], turn }
}

/// A shape scaled by `s.x` all over, and turned.  Arcs stay circles.
fn shaped(shape: Shape, s: Vector2<f64>, turn: f64) -> Section {
    let region = Profile::new(shape.scaled(s.x)).unwrap().region().turned(turn);
    (region.outer, region.holes)
}

/// A rectangle about the axis.
pub fn rectangle(b: f64, h: f64) -> Outline {
    Profile::new(Shape::Rectangle { b, h }).unwrap().region().outer
}

/// A wavy closed curve through `n` points.
pub fn freeform(n: usize, s: Vector2<f64>, turn: f64) -> Outline {
    let points: Vec<_> = (0..n)
        .map(|i| {
            let t = TAU * i as f64 / n as f64;
            let r = 17.0 + 2.5 * (3.0 * t).cos() + 0.8 * (5.0 * t + 1.0).sin();
            Rotation2::new(turn) * Point2::new(r * t.cos() * s.x, 0.85 * r * t.sin() * s.y)
        })
        .collect();
    Outline::Freeform(Freeform::through(points).unwrap())
}

/// Every way to loft a profile, by name.
pub fn lofts(profile: Kind) -> Vec<(&'static str, Loft)> {
    let station = |z: f64, x: f64, y: f64, turn: f64| {
        let (outer, holes) = profile(Vector2::new(x, y), turn);
        Station { z, outer, holes }
    };
    let l = LENGTH;
    let multi = vec![
        station(0.0, 1.0, 1.0, 0.0),
        station(0.3 * l, 0.8, 0.9, 0.0),
        station(0.7 * l, 0.9, 0.8, 0.0),
        station(l, 0.7, 0.7, 0.0),
    ];
    let smooth = Loft { between: Between::Smooth, ..Loft::between_stations(multi.clone()) };
    vec![
        (
            "constant",
            Loft::between_stations(vec![station(0.0, 1.0, 1.0, 0.2), station(l, 1.0, 1.0, 0.2)]),
        ),
        (
            "taper",
            Loft::between_stations(vec![station(0.0, 1.0, 1.0, 0.0), station(l, 0.7, 0.7, 0.0)]),
        ),
        (
            "widening",
            Loft::between_stations(vec![station(0.0, 0.7, 0.7, 0.0), station(l, 1.0, 0.8, 0.0)]),
        ),
        (
            "twist",
            Loft::between_stations(vec![station(0.0, 1.0, 1.0, 0.0), station(l, 0.8, 0.9, 0.6)]),
        ),
        ("multi", Loft::between_stations(multi)),
        ("smooth", smooth),
    ]
}

/// Every way to cut the ends, by name.
pub fn cuts() -> Vec<(&'static str, EndCut, EndCut)> {
    let tilted = |degrees: f64, azimuth: f64| {
        let (tilt, azimuth) = (degrees.to_radians(), azimuth.to_radians());
        let across = Vector3::new(azimuth.cos(), azimuth.sin(), 0.0);
        EndCut::Plane { normal: Vector3::z() * tilt.cos() + across * tilt.sin() }
    };
    vec![
        ("square", EndCut::Square, EndCut::Square),
        ("one_mitre", EndCut::Square, tilted(45.0, 30.0)),
        ("mitres", tilted(45.0, 0.0), tilted(30.0, 110.0)),
        ("steep", tilted(75.0, 20.0), tilted(75.0, 200.0)),
        ("parallel", tilted(60.0, 45.0), tilted(60.0, 45.0)),
    ]
}

/// A placement that leaves no coordinate plain.
pub fn placement(i: usize) -> Isometry3<f64> {
    let i = i as f64;
    let turn = Vector3::new(0.3 + 0.1 * i, -0.7 + 0.2 * i, 0.5 * i);
    Isometry3::new(Vector3::new(400.0 * i, 10.0 * i, -7.0 * i), turn)
}

/// A part without properties at the origin.
pub fn part(name: &str, body: Body) -> Part {
    Part {
        name: name.to_owned(),
        product: name.to_owned(),
        colour: [70, 130, 180],
        placement: Isometry3::identity(),
        body,
        properties: vec![],
    }
}

/// A document of one group.
pub fn document(name: &str, parts: Vec<Part>) -> Document {
    let group = Group { name: "Beams".into(), parts, groups: vec![] };
    Document { name: name.into(), groups: vec![group] }
}

/// One document per profile, with all lofts in all cuts.
pub fn beams() -> Vec<Case> {
    profiles()
        .into_iter()
        .map(|(name, profile)| Case { name, document: document(name, all(profile)) })
        .collect()
}

fn all(profile: Kind) -> Vec<Part> {
    let mut parts = Vec::new();
    for (loft_name, loft) in lofts(profile) {
        for (cut_name, start, end) in cuts() {
            let body = Body::Loft(Loft { start, end, ..loft.clone() });
            let mut part = part(&format!("{loft_name} {cut_name}"), body);
            part.placement = placement(parts.len());
            part.colour = [(40 * parts.len() % 256) as u8, 120, 200];
            parts.push(part);
        }
    }
    parts
}

/// Bars or tubes on members of some radii, at right angles and slanting.
fn saddles(name: &'static str, bore: Option<f64>, radii: [f64; 3]) -> Case {
    let mut parts = Vec::new();
    for radius in radii {
        for tilt in [0.0_f64, 25.0, -70.0] {
            let (sin, cos) = tilt.to_radians().sin_cos();
            let saddle = |azimuth: f64, above| {
                let axis = Vector3::new(azimuth.cos() * cos, azimuth.sin() * cos, sin);
                let axis = UnitVector3::new_normalize(axis);
                EndCut::Saddle(Saddle { axis, radius, above })
            };
            let bar = Loft::prism(
                Outline::circle(20.0),
                bore.map(Outline::circle).into_iter().collect(),
                LENGTH,
            );
            let mitre = EndCut::Plane { normal: Vector3::new(0.3, -0.2, 1.0) };
            for (name, start, end) in [
                ("both", saddle(0.2, false), saddle(1.4, true)),
                ("start", saddle(2.0, false), mitre),
                ("end", EndCut::Square, saddle(3.0, true)),
            ] {
                let body = Body::Loft(Loft { start, end, ..bar.clone() });
                let mut part = part(&format!("{name} {tilt} R{radius}"), body);
                part.placement = placement(parts.len());
                parts.push(part);
            }
        }
    }
    Case { name, document: document(name, parts) }
}

/// Every document of the family.
pub fn cases() -> Vec<Case> {
    let mut cases = beams();
    // Members as thick as the beam and hardly thicker; more and much thicker.
    let (near, far) = ([20.0, 20.03, 20.6], [22.3, 60.0, 400.0]);
    cases.extend([
        saddles("fish_mouths", None, near),
        saddles("fish_mouths_of_tubes", Some(15.0), near),
        saddles("fish_mouths_of_thin_tubes", Some(19.5), near),
        saddles("saddles", None, far),
        saddles("saddles_of_tubes", Some(15.0), far),
    ]);
    cases.extend([solids::solids(), solids::names(), solids::frame()]);
    cases.extend(solids::sizes());
    cases
}
