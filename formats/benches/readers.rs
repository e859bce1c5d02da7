//! Time to read a torus of 100,000 triangles in each format, and to cut one of squares.
//!
//! `cargo bench -p beamwright-formats`; names are `read/binary STL`, `triangulate/50k squares`.

#[path = "../tests/common/mod.rs"]
mod common;

use std::f32::consts::TAU;
use std::hint::black_box;

use beamwright_formats::{Format, ReadOptions, read_bytes};
use common::{Model, VARIANTS};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Squares around the torus, and around its tube.
const AROUND: [u32; 2] = [500, 100];

/// A torus of squares.
fn torus() -> Model {
    let [around, across] = AROUND;
    let point = |number: u32| {
        let angle = |part: u32, count: u32| (TAU * part as f32 / count as f32).sin_cos();
        let (sin_u, cos_u) = angle(number / across, around);
        let (sin_v, cos_v) = angle(number % across, across);
        [(50.0 + 10.0 * cos_v) * cos_u, (50.0 + 10.0 * cos_v) * sin_u, 10.0 * sin_v]
    };
    let at = |u: u32, v: u32| u % around * across + v % across;
    let face = |number: u32| {
        let (u, v) = (number / across, number % across);
        vec![at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)]
    };
    let count = around * across;
    Model {
        positions: (0..count).map(point).collect(),
        faces: (0..count).map(face).collect(),
        non_design: (0..count).map(|number| number < count / 4).collect(),
    }
}

/// The same of triangles.
fn triangle_torus() -> Model {
    let torus = torus();
    let (faces, non_design) =
        common::fans(&torus).into_iter().map(|(face, label)| (face.to_vec(), label)).unzip();
    Model { faces, non_design, ..torus }
}

fn read_each_format(criterion: &mut Criterion) {
    let model = triangle_torus();
    let mut group = criterion.benchmark_group("read");
    group.sample_size(20);
    for (format, name, write) in VARIANTS.into_iter().filter(|variant| variant.0 != Format::Gltf) {
        let bytes = write(&model);
        group.throughput(Throughput::Elements(model.faces.len() as u64));
        group.bench_function(name, |bencher| {
            bencher.iter(|| read_bytes(black_box(&bytes), format, &ReadOptions::default()));
        });
    }
    group.finish();
}

fn cut_squares(criterion: &mut Criterion) {
    let bytes = common::off(&torus());
    let Ok(mesh) = read_bytes(&bytes, Format::Off, &ReadOptions::default()) else { return };
    criterion.bench_function("triangulate/50k squares", |bencher| {
        bencher.iter(|| black_box(&mesh).triangulate());
    });
}

criterion_group!(benches, read_each_format, cut_squares);
criterion_main!(benches);
