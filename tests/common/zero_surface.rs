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
    let grid = Grid::of(distance, low, high, step);
    let mut surface = Surface { grid: &grid, mesh: TestMesh::default(), on_edge: HashMap::new() };
    for cell in places(grid.counts.map(|n| n - 1)) {
        let corners: [[usize; 3]; 8] = std::array::from_fn(|c| {
            [cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)]
        });
        for tetrahedron in TETRAHEDRA {
            surface.cut(tetrahedron.map(|c| corners[c]));
        }
    }
    let mut mesh = surface.mesh;
    mesh.non_design = vec![false; mesh.triangles.len()];
    mesh
}

/// The distance at the points of a grid.
struct Grid {
    counts: [usize; 3],
    low: [f64; 3],
    step: f64,
    values: Vec<f64>,
}

impl Grid {
    fn of(distance: impl Fn([f64; 3]) -> f64, low: [f64; 3], high: [f64; 3], step: f64) -> Self {
        let counts = [0, 1, 2].map(|k| ((high[k] - low[k]) / step).ceil() as usize + 1);
        let mut grid = Self { counts, low, step, values: Vec::new() };
        // Never exactly on a grid point: no degenerate triangles.
        let least = 1e-6 * step;
        let value = |i| {
            let d = distance(grid.at(i));
            if d.abs() < least { least } else { d }
        };
        grid.values = places(counts).map(value).collect();
        grid
    }

    fn at(&self, i: [usize; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| self.low[k] + i[k] as f64 * self.step)
    }

    fn index(&self, i: [usize; 3]) -> usize {
        i[0] + self.counts[0] * (i[1] + self.counts[1] * i[2])
    }

    fn value(&self, i: [usize; 3]) -> f64 {
        self.values[self.index(i)]
    }
}

/// All triples below `counts`, the first number running fastest.
fn places(counts: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let [nx, ny, nz] = counts;
    (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])))
}

/// The surface so far.
struct Surface<'g> {
    grid: &'g Grid,
    mesh: TestMesh,
    /// The point on each edge of the grid that the surface crosses.
    on_edge: HashMap<(usize, usize), u32>,
}

impl Surface<'_> {
    /// Adds what crosses a tetrahedron.
    fn cut(&mut self, corners: [[usize; 3]; 4]) {
        let (within, without): (Vec<_>, Vec<_>) =
            corners.into_iter().partition(|&i| self.grid.value(i) < 0.0);
        let found: Vec<[u32; 3]> = match (within.as_slice(), without.as_slice()) {
            (&[a], &[b, c, d]) | (&[b, c, d], &[a]) => {
                vec![[self.vertex(a, b), self.vertex(a, c), self.vertex(a, d)]]
            }
            (&[a, b], &[c, d]) => {
                let [p, q] = [self.vertex(a, c), self.vertex(a, d)];
                let [r, s] = [self.vertex(b, d), self.vertex(b, c)];
                vec![[p, q, r], [p, r, s]]
            }
            _ => return,
        };
        // Outwards: away from the inner corner.
        let inner = self.grid.at(within[0]);
        for [u, v, w] in found {
            let [a, b, c] = [u, v, w].map(|p| self.mesh.positions[p as usize]);
            self.mesh.triangles.push(if looks_at(a, b, c, inner) { [u, w, v] } else { [u, v, w] });
        }
    }

    /// The point where the surface crosses an edge.
    fn vertex(&mut self, a: [usize; 3], b: [usize; 3]) -> u32 {
        let (i, j) = (self.grid.index(a), self.grid.index(b));
        *self.on_edge.entry((i.min(j), i.max(j))).or_insert_with(|| {
            let t = self.grid.value(a) / (self.grid.value(a) - self.grid.value(b));
            let (p, q) = (self.grid.at(a), self.grid.at(b));
            self.mesh.positions.push([0, 1, 2].map(|k| p[k] + t * (q[k] - p[k])));
            self.mesh.positions.len() as u32 - 1
        })
    }
}

/// Whether the normal of a triangle points towards a place.
fn looks_at(a: [f64; 3], b: [f64; 3], c: [f64; 3], place: [f64; 3]) -> bool {
    let sub = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k] - q[k]);
    let (u, v, w) = (sub(b, a), sub(c, a), sub(place, a));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    n[0] * w[0] + n[1] * w[1] + n[2] * w[2] > 0.0
}
