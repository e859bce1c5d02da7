//! What each stage costs, beside the reading of the file.
//!
//! `cargo bench --bench main`; the benches of the readers are those of `formats/`. The mesh is a
//! table of eight struts with about 50,000 triangles, made in code; the STEP files hold 1,000 beams.

#![allow(
    missing_docs,
    unreachable_pub,
    reason = "a program of its own, and what tests share with it"
)]

#[path = "../tests/common/mod.rs"]
mod common;
mod stages;
mod step;
#[path = "../tests/step_family/mod.rs"]
mod step_family;

use criterion::{criterion_group, criterion_main};

criterion_group!(benches, stages::stages, step::files);
criterion_main!(benches);
