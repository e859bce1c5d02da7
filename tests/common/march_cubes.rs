//! The zero surface of a distance function: marching tetrahedra, closed and manifold.

use std::collections::HashMap;

use super::TestMesh;

/// Corners of a cube, and the six tetrahedra about its diagonal 0–7.
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// The surface where `distance` changes sign inside a box, on a grid of `step`.
///
/// The zero surface must not touch the box.
pub fn surface_of(
    distance: impl Fn([f64; 3]) -> f64,
    low: [f64; 3],
    high: [f64; 3],
    step: f64,
) -> TestMesh {
    let n: [usize; 3] = [0, 1, 2].map(|k| ((high[k] - low[k]) / step).ceil() as usize + 1);
    let at = |i: [usize; 3]| [0, 1, 2].map(|k| low[k] + i[k] as f64 * step);
    let index = |i: [usize; 3]| i[0] + n[0] * (i[1] + n[1] * i[2]);
    let mut values = vec![0.0; n[0] * n[1] * n[2]];
    for z in 0..n[2] {
        for y in 0..n[1] {
            for x in 0..n[0] {
                let d = distance(at([x, y, z]));
                // Never exactly on a grid point: no degenerate triangles.
                values[index([x, y, z])] = if d.abs() < 1e-6 * step { 1e-6 * step } else { d };
            }
        }
    }
    let mut mesh = TestMesh::default();
    let mut on_edge: HashMap<(usize, usize), u32> = HashMap::new();
    for z in 0..n[2] - 1 {
        for y in 0..n[1] - 1 {
            for x in 0..n[0] - 1 {
                let corners: [[usize; 3]; 8] =
                    std::array::from_fn(|c| [x + (c & 1), y + (c >> 1 & 1), z + (c >> 2 & 1)]);
                let ids = corners.map(index);
                let inside = ids.map(|i| values[i] < 0.0);
                if inside.iter().all(|&i| i) || inside.iter().all(|&i| !i) {
                    continue;
                }
                for tetrahedron in TETRAHEDRA {
                    let mut vertex = |a: usize, b: usize| {
                        let (i, j) = (ids[a].min(ids[b]), ids[a].max(ids[b]));
                        *on_edge.entry((i, j)).or_insert_with(|| {
                            let t = values[ids[a]] / (values[ids[a]] - values[ids[b]]);
                            let (p, q) = (at(corners[a]), at(corners[b]));
                            mesh.positions.push([0, 1, 2].map(|k| p[k] + t * (q[k] - p[k])));
                            mesh.positions.len() as u32 - 1
                        })
                    };
                    let (within, without): (Vec<usize>, Vec<usize>) =
                        tetrahedron.iter().partition(|&&c| inside[c]);
                    let found: Vec<[u32; 3]> = match (within.as_slice(), without.as_slice()) {
                        (&[a], &[b, c, d]) | (&[b, c, d], &[a]) => {
                            vec![[vertex(a, b), vertex(a, c), vertex(a, d)]]
                        }
                        (&[a, b], &[c, d]) => {
                            let [p, q, r, s] =
                                [vertex(a, c), vertex(a, d), vertex(b, d), vertex(b, c)];
                            vec![[p, q, r], [p, r, s]]
                        }
                        _ => continue,
                    };
                    // Outwards: away from the inner corner.
                    let inner = at(corners[within[0]]);
                    for t in found {
                        let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
                        mesh.triangles.push(if looks_at(a, b, c, inner) {
                            [t[0], t[2], t[1]]
                        } else {
                            t
                        });
                    }
                }
            }
        }
    }
    mesh.non_design = vec![false; mesh.triangles.len()];
    mesh
}

/// Whether the normal of a triangle points towards a place.
fn looks_at(a: [f64; 3], b: [f64; 3], c: [f64; 3], place: [f64; 3]) -> bool {
    let sub = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k] - q[k]);
    let (u, v, w) = (sub(b, a), sub(c, a), sub(place, a));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    n[0] * w[0] + n[1] * w[1] + n[2] * w[2] > 0.0
}
