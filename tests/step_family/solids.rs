//! Balls, flat-faced solids, and documents that test the tree.

use beamwright::output::step::{
    Body, Circle, Document, Facet, Facets, Group, Loop, Part, Property, Value,
};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use super::{Case, document, part, placement};

/// Faces of a box, counter-clockwise from outside, over eight corners.
const BOX: [[u32; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

/// Corners of a box about the origin; bit 0 of the index is +x, and so on.
fn box_corners(half: Vector3<f64>) -> Vec<Point3<f64>> {
    (0..8)
        .map(|i| {
            let side = |bit: u32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            Point3::from(half.component_mul(&Vector3::new(side(0), side(1), side(2))))
        })
        .collect()
}

fn flat(corners: &[Point3<f64>], outer: &[u32]) -> Facet {
    let at = |i: usize| corners[outer[i] as usize];
    let normal = (at(1) - at(0)).cross(&(at(2) - at(1)));
    Facet::Flat { normal, outer: Loop::Corners(outer.to_vec()), inner: vec![] }
}

/// A box of the given half sizes.
pub fn block(half: Vector3<f64>) -> Facets {
    let corners = box_corners(half);
    let faces = BOX.iter().map(|face| flat(&corners, face)).collect();
    Facets { corners, circles: vec![], faces }
}

/// A plate 60 × 40 × 10 with two bolt holes, a blind hole and a boss.
pub fn plate() -> Facets {
    let mut plate = block(Vector3::new(30.0, 20.0, 5.0));
    let up = Vector3::z();
    let mut circle = |x: f64, y: f64, z: f64, radius: f64, axis: Vector3<f64>| {
        plate.circles.push(Circle { centre: Point3::new(x, y, z), axis, radius });
        plate.circles.len() - 1
    };
    let [a, b] = [circle(-20.0, 0.0, -5.0, 4.0, up), circle(-20.0, 0.0, 5.0, 4.0, -up * 2.0)];
    let [c, d] = [circle(20.0, 0.0, -5.0, 4.0, up), circle(20.0, 0.0, 5.0, 4.0, up)];
    let [e, f] = [circle(0.0, 10.0, 5.0, 5.0, up), circle(0.0, 10.0, 1.0, 5.0, up)];
    let [g, h] = [circle(0.0, -8.0, 5.0, 6.0, -up), circle(0.0, -8.0, 12.0, 6.0, up)];
    let add = |face: &mut Facet, holes: &[usize]| {
        if let Facet::Flat { inner, .. } = face {
            inner.extend(holes.iter().map(|&c| Loop::Circle(c)));
        }
    };
    add(&mut plate.faces[0], &[a, c]);
    add(&mut plate.faces[1], &[b, d, e, g]);
    let disc = |c: usize| Facet::Flat { normal: up, outer: Loop::Circle(c), inner: vec![] };
    plate.faces.extend([
        Facet::Round { circles: [a, b], bore: true },
        Facet::Round { circles: [d, c], bore: true },
        Facet::Round { circles: [e, f], bore: true },
        disc(f),
        Facet::Round { circles: [g, h], bore: false },
        disc(h),
    ]);
    plate
}

/// A box with a box-shaped cavity.
pub fn hollow() -> Facets {
    let mut outer = block(Vector3::new(20.0, 15.0, 10.0));
    let cavity = block(Vector3::new(12.0, 8.0, 5.0));
    let first = outer.corners.len() as u32;
    outer.corners.extend(&cavity.corners);
    for face in BOX {
        let turned: Vec<u32> = face.iter().rev().map(|i| i + first).collect();
        outer.faces.push(flat(&outer.corners, &turned));
    }
    outer
}

/// A window frame: square holes right through, so that faces have inner polygons.
pub fn window() -> Facets {
    let mut frame = block(Vector3::new(30.0, 20.0, 5.0));
    let hole = box_corners(Vector3::new(18.0, 9.0, 5.0));
    let first = frame.corners.len() as u32;
    frame.corners.extend(hole);
    for (face, ring) in [(0, BOX[0]), (1, BOX[1])] {
        if let Facet::Flat { inner, .. } = &mut frame.faces[face] {
            inner.push(Loop::Corners(ring.iter().map(|i| i + first).collect()));
        }
    }
    for face in &BOX[2..] {
        let turned: Vec<u32> = face.iter().rev().map(|i| i + first).collect();
        frame.faces.push(flat(&frame.corners, &turned));
    }
    frame
}

/// The same solid turned, moved, and rounded to single precision, as a mesh has it.
pub fn as_from_a_mesh(facets: &Facets) -> Facets {
    let place = Isometry3::new(Vector3::new(37.0, -12.0, 81.0), Vector3::new(0.4, 1.1, -0.3));
    let single = |x: f64| f64::from(x as f32);
    let mut moved = facets.clone();
    for corner in &mut moved.corners {
        *corner = (place * *corner).map(single);
    }
    for circle in &mut moved.circles {
        circle.centre = (place * circle.centre).map(single);
        circle.axis = place * circle.axis;
    }
    for face in &mut moved.faces {
        if let Facet::Flat { normal, .. } = face {
            *normal = place * *normal;
        }
    }
    moved
}

/// A ball and solids of facets.
pub fn solids() -> Case {
    let bodies = [
        ("ball", Body::Sphere { radius: 12.5 }),
        ("block", Body::Facets(block(Vector3::new(10.0, 20.0, 5.0)))),
        ("plate", Body::Facets(plate())),
        ("hollow", Body::Facets(hollow())),
        ("window", Body::Facets(window())),
        ("plate of a mesh", Body::Facets(as_from_a_mesh(&plate()))),
        ("window of a mesh", Body::Facets(as_from_a_mesh(&window()))),
    ];
    let parts = bodies.into_iter().enumerate().map(|(i, (name, body))| {
        let mut part = part(name, body);
        part.placement = placement(i);
        part
    });
    Case { name: "solids", document: document("solids", parts.collect()) }
}

/// The same bodies a thousandth and a thousand times as large.
pub fn sizes() -> Vec<Case> {
    let scaled = |name: &'static str, s: f64| {
        let bodies = [
            ("bar", Body::round_bar(5.0 * s, 200.0 * s)),
            ("tube", Body::tube(5.0 * s, 4.0 * s, 200.0 * s)),
            ("ball", Body::Sphere { radius: 5.0 * s }),
            ("block", Body::Facets(block(Vector3::new(10.0, 20.0, 5.0) * s))),
        ];
        let parts = bodies.into_iter().enumerate().map(|(i, (name, body))| {
            let mut part = part(name, body);
            part.placement = Isometry3::translation(0.0, 50.0 * s * i as f64, 0.0);
            part
        });
        Case { name, document: document(name, parts.collect()) }
    };
    vec![scaled("tiny", 1e-3), scaled("huge", 1e3)]
}

/// Names that would break a careless writer.
pub const HOSTILE: [&str; 17] = [
    "it's",
    "'quoted'",
    "six' by two', ends ')",
    "'''",
    "' ,",
    "\\'",
    "back\\slash",
    "\\X2\\00E4\\X0\\",
    "Träger Ø60 ½″",
    "梁 🙂 柱",
    "semi;colon #12=PRODUCT('x')",
    "/* comment */",
    "ENDSEC;",
    "line\nbreak\ttab",
    "  spaced  ",
    "%s%n$0",
    "\u{7f}\u{80}\u{200b}\u{feff}",
];

/// Parts, groups and properties with hostile names.
pub fn names() -> Case {
    let parts = HOSTILE.iter().enumerate().map(|(i, name)| Part {
        name: format!("B{i} {name}"),
        product: (*name).to_owned(),
        colour: [i as u8 * 15, 255, 0],
        placement: Isometry3::translation(0.0, 20.0 * i as f64, 0.0),
        body: Body::round_bar(4.0, 30.0),
        properties: vec![Property::text(*name, *name)],
    });
    let group = Group { name: "it's a \\ group".into(), parts: parts.collect(), groups: vec![] };
    Case { name: "names", document: Document { name: "Größe 'x'".into(), groups: vec![group] } }
}

/// A small frame: equal beams shared, nested groups, an empty group, properties.
pub fn frame() -> Case {
    let bar = |i: usize, length: f64, colour: [u8; 3]| Part {
        name: format!("B{i:03} CHS 60.3x4"),
        product: format!("CHS 60.3x4 L={length}"),
        colour,
        placement: Isometry3::from_parts(
            Vector3::new(0.0, 100.0 * i as f64, 0.0).into(),
            UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.1 * i as f64),
        ),
        body: Body::tube(30.15, 26.15, length),
        properties: properties(length),
    };
    let mut parts: Vec<Part> = (0..10).map(|i| bar(i, 842.5, [70, 130, 180])).collect();
    parts.push(bar(10, 842.5, [200, 60, 60]));
    parts.push(bar(11, 500.0, [70, 130, 180]));
    let ball = |i: usize| Part {
        name: format!("J{i:02}"),
        placement: placement(i),
        colour: [128, 128, 128],
        ..part("ball", Body::Sphere { radius: 31.0 })
    };
    let beams = Group { name: "Beams".into(), parts, groups: vec![] };
    let joints = Group { name: "Joints".into(), parts: (0..4).map(ball).collect(), groups: vec![] };
    let pad = part("pad", Body::Facets(plate()));
    let pads = Group { name: "Pads".into(), parts: vec![pad], groups: vec![] };
    let kept =
        Group { name: "Non-design".into(), parts: vec![], groups: vec![pads, Group::default()] };
    let groups = vec![beams, joints, kept];
    Case { name: "frame", document: Document { name: "frame".into(), groups } }
}

fn properties(length: f64) -> Vec<Property> {
    vec![
        Property::text("profile", "CHS 60.3x4"),
        Property::new("length", Value::Length(length)),
        Property::new("area", Value::Area(707.484)),
        Property::new("solid volume", Value::Volume(707.484 * length)),
        Property::new("mass", Value::Mass(7.85e-6 * 707.484 * length)),
        Property::new("cut angle", Value::Degrees(45.0)),
        Property::new("area error", Value::Number(-0.0125)),
        Property::new("branch", Value::Count(12)),
    ]
}
