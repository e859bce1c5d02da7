//! What each stage costs, beside the reading of the file.
//!
//! `cargo bench --bench main`; the benches of the readers are those of `formats/`. The mesh is a
//! table of eight struts with about 50,000 triangles, made in code.

#![allow(
    missing_docs,
    unreachable_pub,
    reason = "a program of its own, and what tests share with it"
)]

#[path = "../tests/common/mod.rs"]
mod common;
mod stages;

use criterion::{criterion_group, criterion_main};

criterion_group!(benches, stages::stages);
criterion_main!(benches);
