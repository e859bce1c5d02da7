//! Any bytes as Gltf: a mesh that keeps its promises, or an error.

#![no_main]

use beamwright_formats::{Format, ReadOptions, read_bytes};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(mesh) = read_bytes(bytes, Format::Gltf, &ReadOptions::default()) {
        mesh.check();
        mesh.triangulate();
    }
});
