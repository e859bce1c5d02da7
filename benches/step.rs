//! Size and time of 1,000 beams, beside the same beams from truck-stepio.
//!
//! With `BEAMWRIGHT_STEP_OUT` set to a folder the files stay there, and
//! `tests/occt/time_read.py FOLDER` tells how long OCCT takes to read them.

use std::path::PathBuf;

use beamwright::frame::{Beam, BeamAxes, BeamSection, BeamShape, Frame, Node, NodeId, NodeKind};
use beamwright::joint::{JointKind, joints};
use beamwright::output::assembly::assembly;
use beamwright::output::step::{self, Body, Document, Loft, Part, Property, Value};
use beamwright::section::{Outline, Profile, Shape};
use criterion::{Criterion, Throughput};
use nalgebra::{Isometry3, Point3, Unit, Vector2, Vector3};

use crate::step_family::{document, freeform};

const COUNT: usize = 1000;

/// 1,000 beams, all of different length, each with its place.
fn beams(name: &'static str, section: impl Fn() -> (Outline, Vec<Outline>)) -> Document {
    of_lengths(COUNT, name, section)
}

/// 1,000 beams of so many lengths.
fn of_lengths(
    lengths: usize,
    name: &'static str,
    section: impl Fn() -> (Outline, Vec<Outline>),
) -> Document {
    let (outer, holes) = section();
    let beam = |i: usize| {
        let length = 100.0 + (i % lengths) as f64 / 7.0;
        Part {
            name: format!("B{i:04} {name}"),
            product: format!("{name} L={length:.1} mm"),
            colour: [70, 130, 180],
            placement: place(i),
            body: Body::Loft(Loft::prism(outer.clone(), holes.clone(), length)),
            properties: vec![],
        }
    };
    document(name, (0..COUNT).map(beam).collect())
}

fn place(i: usize) -> Isometry3<f64> {
    let (row, column) = ((i / 32) as f64, (i % 32) as f64);
    Isometry3::new(
        Vector3::new(50.0 * row, 50.0 * column, 0.0),
        Vector3::new(0.01 * row, 0.02 * column, 0.0),
    )
}

fn kinds() -> Vec<Document> {
    let solid = |outer: Outline| (outer, vec![]);
    let shaped = |shape: Shape| {
        let region = Profile::new(shape).expect("a shape").region();
        (region.outer, region.holes)
    };
    vec![
        beams("round", || solid(Outline::circle(5.0))),
        of_lengths(100, "round in 100 lengths", || solid(Outline::circle(5.0))),
        beams("tube", || (Outline::circle(5.0), vec![Outline::circle(4.0)])),
        beams("rectangle", || shaped(Shape::Rectangle { b: 12.0, h: 8.0 })),
        beams("box", || shaped(Shape::Box { b: 12.0, h: 8.0, t: 1.0, r_o: 1.5, r_i: 0.5 })),
        beams("ellipse", || solid(Outline::ellipse(6.0, 4.0))),
        beams("ipe", || shaped(Shape::I { h: 20.0, b: 10.0, t_w: 0.6, t_f: 0.9, r: 1.2 })),
        beams("freeform64", || solid(freeform(64, Vector2::new(0.5, 0.5), 0.0))),
    ]
}

/// Round beams with mitres at both ends and the properties the program gives a matched beam.
fn furnished() -> Document {
    let mut document = beams("furnished", || (Outline::circle(5.0), vec![]));
    for (i, part) in document.groups[0].parts.iter_mut().enumerate() {
        if let Body::Loft(loft) = &mut part.body {
            let tilt = (i as f64 * 0.37).sin();
            *loft = loft.clone().cut(Vector3::new(tilt, 0.2, 1.0), Vector3::new(0.1, -tilt, 1.0));
        }
        part.properties = vec![
            Property::text("profile", "Round 10"),
            Property::new("length", Value::Length(100.0 + i as f64)),
            Property::new("area", Value::Area(78.5398)),
            Property::new("mass", Value::Mass(0.1 + i as f64 * 1e-3)),
            Property::text("branch", i.to_string()),
        ];
        for (name, spread) in [("error of A", 2.0), ("error of I1", 5.0), ("error of I2", 7.0)] {
            let error = spread * (i as f64).sin();
            part.properties.push(Property::text(name, format!("{error:+.1} %")));
        }
    }
    document
}

/// The way of the program: 1,000 beams of a frame, all of different length, to their assembly.
fn frame() -> Frame {
    let bar = Profile::new(Shape::Round { d: 10.0 }).expect("a bar");
    let properties = bar.properties().expect("a bar");
    let mut frame = Frame::default();
    for i in 0..COUNT {
        let start = Point3::from(place(i).translation.vector);
        let axis = Unit::new_normalize(place(i) * Vector3::z());
        let length = 100.0 + 2.0 * i as f64;
        let end = start + axis.into_inner() * length;
        let node = |position| Node { position, kind: NodeKind::End, interface: None };
        frame.nodes.extend([node(start), node(end)]);
        frame.beams.push(Beam {
            ends: [2 * i, 2 * i + 1].map(NodeId::new),
            passes: Vec::new(),
            branch: i as u32,
            axes: BeamAxes::along(axis),
            length,
            cut_length: length,
            section: BeamSection::default(),
            measured: None,
            assumed_area: properties.area,
            shape: BeamShape::assumed(bar.clone(), properties),
        });
    }
    frame
}

/// Writes the beams of every kind, and the plainest also by truck-stepio.
pub fn files(criterion: &mut Criterion) {
    let folder = std::env::var_os("BEAMWRIGHT_STEP_OUT").map(PathBuf::from);
    let save = |name: &str, text: &[u8]| {
        println!("{name}: {:.2} MB", text.len() as f64 / 1e6);
        if let Some(folder) = &folder {
            std::fs::create_dir_all(folder).expect("a folder for the files");
            std::fs::write(folder.join(format!("{name}.step")), text).expect("room for the file");
        }
    };
    let mut group = criterion.benchmark_group("1,000 beams");
    group.sample_size(10).throughput(Throughput::Elements(COUNT as u64));
    for document in kinds().into_iter().chain([furnished()]) {
        let written = || {
            let mut text = Vec::new();
            step::write(&document, &mut text).map(|()| text)
        };
        group.bench_function(&document.name, |b| b.iter(written));
        save(&document.name, &written().expect("sound beams"));
    }
    let frame = frame();
    let (joints, _) = joints(&frame, &[], JointKind::None);
    let written = || {
        let built = assembly("frame", &frame, &joints, 7850.0).expect("sound beams");
        let mut text = Vec::new();
        step::write(&built.document, &mut text).map(|()| text)
    };
    group.bench_function("frame", |b| b.iter(written));
    save("frame", &written().expect("sound beams"));
    for (name, solid) in [("round", truck::round as fn(f64) -> _), ("rectangle", truck::rectangle)]
    {
        let name = format!("{name} by truck-stepio");
        group.bench_function(&name, |b| b.iter(|| truck::file(solid)));
        save(&name, truck::file(solid).as_bytes());
    }
    group.finish();
}

/// The same beams as truck models and truck-stepio writes them.
mod truck {
    use truck_modeling::{EuclideanSpace, Matrix4, Point3, Shell, Solid, Vector4, Wire, builder};
    use truck_stepio::out::{CompleteStepDisplay, StepHeaderDescriptor, StepModels};

    use super::{COUNT, place};

    pub(super) fn file(solid: impl Fn(f64) -> Solid) -> String {
        let placed = |i: usize| {
            let matrix = place(i).to_homogeneous();
            let column = |j: usize| {
                Vector4::new(matrix[(0, j)], matrix[(1, j)], matrix[(2, j)], matrix[(3, j)])
            };
            let matrix = Matrix4::from_cols(column(0), column(1), column(2), column(3));
            builder::transformed(&solid(100.0 + i as f64 / 7.0), matrix).compress()
        };
        let solids: Vec<_> = (0..COUNT).map(placed).collect();
        let header = StepHeaderDescriptor { time_stamp: String::new(), ..Default::default() };
        CompleteStepDisplay::new(StepModels::from_iter(&solids), header).to_string()
    }

    pub(super) fn round(length: f64) -> Solid {
        loft(
            |z| {
                let ends = [-5.0, 5.0].map(|x| builder::vertex(Point3::new(x, 0.0, z)));
                let arc = |from: usize, to: usize, y: f64| {
                    builder::circle_arc(&ends[from], &ends[to], Point3::new(0.0, y, z))
                };
                vec![arc(0, 1, -5.0), arc(1, 0, 5.0)].into()
            },
            length,
        )
    }

    pub(super) fn rectangle(length: f64) -> Solid {
        loft(
            |z| {
                let corners = [(-6.0, -4.0), (6.0, -4.0), (6.0, 4.0), (-6.0, 4.0)]
                    .map(|(x, y)| builder::vertex(Point3::new(x, y, z)));
                (0..4).map(|i| builder::line(&corners[i], &corners[(i + 1) % 4])).collect()
            },
            length,
        )
    }

    fn loft(ring: impl Fn(f64) -> Wire, length: f64) -> Solid {
        let (lower, upper) = (ring(Point3::origin().z), ring(length));
        let mut shell: Shell = builder::try_wire_homotopy(&lower, &upper).unwrap();
        shell.push(builder::try_attach_plane(&[lower.inverse()]).unwrap());
        shell.push(builder::try_attach_plane(&[upper]).unwrap());
        Solid::try_new(vec![shell]).unwrap()
    }
}
