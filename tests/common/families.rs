//! Families of meshes a property is asserted on, with telling names.

use std::f64::consts::TAU;

use super::TestMesh;

/// A surface swept round a closed or open chain of centres; open chains are capped.
fn tube(
    centres: &[[f64; 3]],
    ring: impl Fn(usize, f64) -> [f64; 3],
    around: usize,
    closed: bool,
) -> TestMesh {
    let mut mesh = TestMesh::default();
    let (n, m) = (centres.len() as u32, around as u32);
    for (i, c) in centres.iter().enumerate() {
        for k in 0..around {
            let d = ring(i, TAU * k as f64 / around as f64);
            mesh.positions.push([0, 1, 2].map(|a| c[a] + d[a]));
        }
    }
    let at = |i: u32, k: u32| (i % n) * m + k % m;
    for i in 0..if closed { n } else { n - 1 } {
        for k in 0..m {
            mesh.triangles.push([at(i, k), at(i, k + 1), at(i + 1, k + 1)]);
            mesh.triangles.push([at(i, k), at(i + 1, k + 1), at(i + 1, k)]);
        }
    }
    if !closed {
        for (i, flip) in [(0, true), (n - 1, false)] {
            mesh.positions.push(centres[i as usize]);
            let hub = mesh.positions.len() as u32 - 1;
            for k in 0..m {
                let (a, b) = (at(i, k), at(i, k + 1));
                mesh.triangles.push(if flip { [hub, b, a] } else { [hub, a, b] });
            }
        }
    }
    mesh.non_design = vec![false; mesh.triangles.len()];
    mesh
}

/// A straight round bar along x with flat ends; `along` = 1 has no points along its shaft.
pub fn cylinder(radius: f64, length: f64, around: usize, along: usize) -> TestMesh {
    let centres: Vec<[f64; 3]> =
        (0..=along).map(|i| [length * i as f64 / along as f64, 0.0, 0.0]).collect();
    tube(&centres, |_, t| [0.0, radius * t.cos(), radius * t.sin()], around, false)
}

/// The same with its flat ends labelled non-design.
pub fn cylinder_between_pads(radius: f64, length: f64, around: usize, along: usize) -> TestMesh {
    let mut mesh = cylinder(radius, length, around, along);
    let caps = 2 * around;
    let n = mesh.triangles.len();
    mesh.non_design[n - caps..].fill(true);
    mesh
}

/// A torus in the plane z = 0.
pub fn torus(ring: f64, radius: f64) -> TestMesh {
    let around_ring = 96;
    let angle = |i: usize| TAU * i as f64 / around_ring as f64;
    let centres: Vec<[f64; 3]> =
        (0..around_ring).map(|i| [ring * angle(i).cos(), ring * angle(i).sin(), 0.0]).collect();
    let circle = |i: usize, t: f64| {
        let (sin, cos) = angle(i).sin_cos();
        // Outwards first, then down: outward normals for a ring that runs counter-clockwise.
        [radius * t.cos() * cos, radius * t.cos() * sin, -radius * t.sin()]
    };
    tube(&centres, circle, 24, true)
}

/// A quarter of a ring with flat, labelled ends.
pub fn quarter_bend(ring: f64, radius: f64) -> TestMesh {
    let steps = 40;
    let angle = |i: usize| TAU / 4.0 * i as f64 / steps as f64;
    let centres: Vec<[f64; 3]> =
        (0..=steps).map(|i| [ring * angle(i).cos(), ring * angle(i).sin(), 0.0]).collect();
    let circle = |i: usize, t: f64| {
        let (sin, cos) = angle(i).sin_cos();
        [radius * t.cos() * cos, radius * t.cos() * sin, -radius * t.sin()]
    };
    let around = 24;
    let mut mesh = tube(&centres, circle, around, false);
    let n = mesh.triangles.len();
    mesh.non_design[n - 2 * around..].fill(true);
    mesh
}

/// A cube from −1 to 1.
pub fn cube() -> TestMesh {
    let positions =
        (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2].map(|b: i32| f64::from(2 * b - 1))).collect();
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> =
        quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    TestMesh { positions, non_design: vec![false; triangles.len()], triangles }
}

/// A strip with a half twist: one side only.
pub fn moebius_strip() -> TestMesh {
    let n = 24u32;
    let mut mesh = TestMesh::default();
    for i in 0..n {
        let t = TAU * f64::from(i) / f64::from(n);
        for w in [-1.0, 1.0] {
            let (s, c) = (0.5 * t).sin_cos();
            let r = 5.0 + w * c;
            mesh.positions.push([r * t.cos(), r * t.sin(), w * s]);
        }
    }
    let at = |i: u32, side: u32| if i < n { 2 * i + side } else { 1 - side };
    for i in 0..n {
        mesh.triangles.push([at(i, 0), at(i + 1, 0), at(i + 1, 1)]);
        mesh.triangles.push([at(i, 0), at(i + 1, 1), at(i, 1)]);
    }
    mesh.non_design = vec![false; mesh.triangles.len()];
    mesh
}

/// Several meshes as one.
pub fn together(parts: &[TestMesh]) -> TestMesh {
    let mut all = TestMesh::default();
    for part in parts {
        let base = all.positions.len() as u32;
        all.positions.extend(&part.positions);
        all.triangles.extend(part.triangles.iter().map(|t| t.map(|v| v + base)));
        all.non_design.extend(&part.non_design);
    }
    all
}

/// Closed surfaces that must pass every check.
pub fn closed() -> Vec<(&'static str, TestMesh)> {
    vec![
        ("cube", cube()),
        ("torus", torus(20.0, 4.0)),
        ("cylinder", cylinder(3.0, 40.0, 24, 20)),
        ("cylinder without points along its shaft", cylinder(3.0, 40.0, 24, 1)),
        ("quarter bend", quarter_bend(30.0, 4.0)),
    ]
}
