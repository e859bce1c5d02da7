//! One bench a stage: how long does a user wait for what?

use std::hint::black_box;

use beamwright::frame::{self, FrameParams, ProfileParams, match_profiles, normalize};
use beamwright::joint::{self, JointKind};
use beamwright::mesh::{LabelParams, prepare};
use beamwright::output::assembly;
use beamwright::output::step;
use beamwright::section::Catalogue;
use beamwright::skeleton::{self, Orientation, SkeletonParams};
use beamwright_formats::{ReadOptions, read};
use criterion::{BatchSize, Criterion, Throughput};

use crate::common::frame::table;

/// Grid of the mesh, mm: gives about 50,000 triangles.
const GRID: f64 = 1.1;

/// Times every stage on the same mesh.
pub fn stages(criterion: &mut Criterion) {
    let mesh = table().mesh(GRID);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("table.obj");
    std::fs::write(&path, mesh.obj()).expect("room for the mesh");
    let mut group = criterion.benchmark_group("table");
    group.sample_size(10).throughput(Throughput::Elements(mesh.triangles.len() as u64));

    let options = ReadOptions::default();
    group.bench_function("read OBJ", |b| b.iter(|| read(black_box(&path), &options)));
    let raw = read(&path, &options).expect("the file just written");

    let labels = LabelParams::default();
    group.bench_function("mesh", |b| b.iter(|| prepare(black_box(&raw), &labels)));
    let surface = prepare(&raw, &labels).expect("a closed mesh");

    for (name, orientation) in
        [("skeleton, local", Orientation::Local), ("skeleton, global", Orientation::Global)]
    {
        let params = SkeletonParams { orientation, ..SkeletonParams::default() };
        group.bench_function(name, |b| {
            b.iter(|| skeleton::march(black_box(&surface), &params, &mut ()));
        });
    }
    let marched = skeleton::march(&surface, &SkeletonParams::default(), &mut ()).expect("beams");

    group.bench_function("sections", |b| {
        b.iter(|| frame::sections(black_box(&surface), &marched.skeleton));
    });
    let sections = frame::sections(&surface, &marched.skeleton);

    let beams = || normalize(&marched.skeleton, &sections, &surface, &FrameParams::default()).frame;
    group.bench_function("normalize", |b| b.iter(beams));
    let profiles = ProfileParams::default();
    group.bench_function("match profiles", |b| {
        let matched = |mut f| match_profiles(&mut f, &profiles, Catalogue::builtin()).map(|_| f);
        b.iter_batched(beams, matched, BatchSize::SmallInput);
    });
    let mut frame = beams();
    match_profiles(&mut frame, &profiles, Catalogue::builtin()).expect("profiles for round bars");

    let (joints, _) = joint::joints(&frame, &surface.interfaces, JointKind::Trim);

    group.bench_function("STEP", |b| {
        b.iter(|| {
            let built = assembly::assembly("table", &frame, &joints, 7850.0).expect("sound beams");
            let mut text = Vec::new();
            step::write(&built.document, &mut text).map(|()| text)
        });
    });
    group.finish();
}
