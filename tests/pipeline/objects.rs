//! What the tests run on: the samples, and frames made in code.

use std::path::Path;

use beamwright_formats::{ReadOptions, read};

use crate::common::TestMesh;
use crate::common::frame::{close_pair, corner, table, taper, tee};
use crate::writers::Model;

/// Labelled meshes with telling names.
pub(crate) fn labelled() -> Vec<(&'static str, TestMesh)> {
    let samples = ["cantilever", "four_fixings", "single_bar", "y_form"];
    let mut all: Vec<_> = samples.map(|name| (name, sample(name))).into();
    all.push(("corner", corner().mesh(1.6)));
    all.push(("table", table().mesh(1.4)));
    all.push(("taper", taper().mesh(1.6)));
    all.push(("tee", tee().mesh(1.4)));
    all.push(("close pair", close_pair().mesh(1.6)));
    all.iter_mut().for_each(|(_, mesh)| *mesh = mesh.mapped(|p| p.map(|x| f64::from(x as f32))));
    all
}

/// One of the samples.
pub(crate) fn sample(name: &str) -> TestMesh {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name);
    let raw = read(&path.with_extension("obj"), &ReadOptions::default()).expect("a sample");
    let carriers = &raw.carriers;
    let is_kept = |set: &u32| {
        let mut names = carriers.name_sets[*set as usize].iter();
        names.any(|&n| carriers.names[n as usize] == "non_design")
    };
    TestMesh {
        triangles: raw.faces.iter().map(|f| f.try_into().expect("triangles")).collect(),
        non_design: carriers.face_names.iter().map(is_kept).collect(),
        positions: raw.positions,
    }
}

/// Length of the diagonal of the bounding box.
pub(crate) fn size(mesh: &TestMesh) -> f64 {
    let bound = |k: usize, pick: fn(f64, f64) -> f64| {
        mesh.positions.iter().map(|p| p[k]).reduce(pick).expect("points")
    };
    [0, 1, 2].map(|k| (bound(k, f64::max) - bound(k, f64::min)).powi(2)).iter().sum::<f64>().sqrt()
}

/// A mesh for the writers, which keep 32 bits.
pub(crate) fn model(mesh: &TestMesh) -> Model {
    Model {
        positions: mesh.positions.iter().map(|p| p.map(|x| x as f32)).collect(),
        faces: mesh.triangles.iter().map(|t| t.to_vec()).collect(),
        non_design: mesh.non_design.clone(),
    }
}

/// The non-design faces as closed parts: each opening gets a fan over its middle.
pub(crate) fn non_design_parts(mesh: &TestMesh) -> TestMesh {
    let mut part = TestMesh { positions: mesh.positions.clone(), ..TestMesh::default() };
    let kept = mesh.triangles.iter().zip(&mesh.non_design).filter(|f| *f.1);
    part.triangles = kept.map(|(t, _)| *t).collect();
    let sides: Vec<[u32; 2]> =
        part.triangles.iter().flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]).collect();
    let known: std::collections::HashSet<[u32; 2]> = sides.iter().copied().collect();
    let mut open: Vec<[u32; 2]> =
        sides.into_iter().filter(|[a, b]| !known.contains(&[*b, *a])).collect();
    while let Some([start, mut end]) = open.pop() {
        let mut rim = vec![start];
        while end != start {
            rim.push(end);
            let next = open.iter().position(|s| s[0] == end).expect("a closed rim");
            end = open.swap_remove(next)[1];
        }
        let middle = [0, 1, 2].map(|k| {
            rim.iter().map(|&v| mesh.positions[v as usize][k]).sum::<f64>() / rim.len() as f64
        });
        let hub = part.positions.len() as u32;
        part.positions.push(middle);
        for (i, &a) in rim.iter().enumerate() {
            part.triangles.push([hub, rim[(i + 1) % rim.len()], a]);
        }
    }
    part.non_design = vec![false; part.triangles.len()];
    part
}
