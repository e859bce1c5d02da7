//! Any polygon: triangles of its corners.

#![no_main]

use beamwright_formats::RawMesh;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (Vec<[f64; 3]>, Vec<Vec<u8>>)| {
    let (mut positions, faces) = input;
    positions.iter_mut().flatten().filter(|number| !number.is_finite()).for_each(|number| *number = 0.0);
    let count = positions.len() as u32;
    let mut mesh = RawMesh { positions, ..RawMesh::default() };
    for face in faces.iter().filter(|face| face.len() >= 3 && count > 0) {
        mesh.faces.push(face.iter().map(|&corner| u32::from(corner) % count));
    }
    mesh.check();
    let triangles = mesh.triangulate();
    assert_eq!(triangles.corners.len(), triangles.face.len());
    assert!(triangles.corners.iter().all(|&[a, b, c]| a != b && b != c && c != a));
});
