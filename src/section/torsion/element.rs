//! Quadratic triangles for Δφ = −2, and which unknown each node has.
//!
//! ```text
//!        2              corners 0 1 2, mid-side nodes 3 4 5
//!        ●              g_i   gradient of the area coordinate λ_i
//!      5 ● ● 4          G_ij  = A g_i · g_j
//!        ●─●─●
//!        0 3 1
//! ```
//!
//! With the usual shape functions λ(2λ − 1) and 4 λ_i λ_j the stiffness of a straight triangle is
//!
//! | pair                          | entry                        |
//! |-------------------------------|------------------------------|
//! | corner i, corner i            | G_ii                         |
//! | corner i, corner j            | −G_ij / 3                    |
//! | corner i, side ij             | 4 G_ij / 3                   |
//! | corner i, side jk             | 0                            |
//! | side ij, side ij              | 8 (G_ii + G_jj + G_ij) / 3   |
//! | side ij, side jk              | 8 G_ik / 3                   |
//!
//! (Zienkiewicz and Taylor, The Finite Element Method, vol. 1), and of 2 ∫ φ each side bears 2A/3.

use nalgebra::{Point2, Vector2};
use rustc_hash::FxHashMap;

use super::envelope::Envelope;
use super::mesh::Mesh;

/// Corners at the two ends of the mid-side nodes 3, 4, 5.
const SIDES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// Most products of a solution: a second or so. A bar of a thousand by one thickness takes a
/// hundredth of it; the loops of a contour that crosses itself may leave next to no thickness, for
/// which a region is filled with triangles without number.
const MOST_WORK: f64 = 1e9;

/// The system of equations K φ = f of a region.
pub(super) struct Stiffness {
    matrix: Envelope,
    load: Vec<f64>,
    /// Number of the unknown of the first hole; those of the holes come last.
    first_hole: usize,
}

impl Stiffness {
    /// Assembles the system of a triangulated region; `None` if it is too large to be solved.
    pub(super) fn of(mesh: &Mesh) -> Option<Self> {
        let nodes = Nodes::of(mesh);
        let (unknown, first_hole, count) = nodes.unknowns();
        let elements: Vec<[Option<usize>; 6]> =
            nodes.elements.iter().map(|element| element.map(|node| unknown[node])).collect();
        let mut matrix = Envelope::new(count, &elements);
        if matrix.work() > MOST_WORK {
            return None;
        }
        let mut load = vec![0.0; count];
        for (triangle, numbers) in mesh.triangles.iter().zip(&elements) {
            let (k, side_load) = element_matrix(mesh, triangle);
            for (a, row) in k.iter().enumerate() {
                let Some(i) = numbers[a] else { continue };
                if a > 2 {
                    load[i] += side_load;
                }
                for (b, entry) in row.iter().enumerate() {
                    if let Some(j) = numbers[b].filter(|&j| j <= i) {
                        matrix.add(i, j, *entry);
                    }
                }
            }
        }
        Some(Self { matrix, load, first_hole })
    }

    /// Adds 2 A_k to the load of the common value of a hole.
    pub(super) fn load_hole(&mut self, hole: usize, area: f64) {
        self.load[self.first_hole + hole] += 2.0 * area;
    }

    /// f · φ, which is J.
    pub(super) fn solve(mut self) -> f64 {
        let solution = self.matrix.solve(&self.load);
        self.load.iter().zip(&solution).map(|(f, phi)| f * phi).sum()
    }
}

/// Where a node lies.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Inside,
    OnOuterContour,
    OnHole(usize),
}

/// Corners and mid-side nodes of a mesh.
struct Nodes {
    elements: Vec<[usize; 6]>,
    positions: Vec<Point2<f64>>,
    places: Vec<Place>,
    holes: usize,
}

impl Nodes {
    fn of(mesh: &Mesh) -> Self {
        let mut positions = mesh.points.clone();
        let mut middles: FxHashMap<[u32; 2], usize> = FxHashMap::default();
        let mut elements = Vec::with_capacity(mesh.triangles.len());
        for t in &mesh.triangles {
            let mut element = [0; 6];
            for k in 0..3 {
                element[k] = t[k] as usize;
                let ends = SIDES[k].map(|corner| t[corner]);
                element[3 + k] = *middles.entry(sorted(ends)).or_insert_with(|| {
                    let [a, b] = ends.map(|end| mesh.points[end as usize]);
                    positions.push(nalgebra::center(&a, &b));
                    positions.len() - 1
                });
            }
            elements.push(element);
        }
        let mut places = vec![Place::Inside; positions.len()];
        for (side, hole) in mesh.rim_sides() {
            let place = hole.map_or(Place::OnOuterContour, Place::OnHole);
            for node in [side[0] as usize, side[1] as usize, middles[&sorted(side)]] {
                // A corner where a hole touches the outer contour stays at 0.
                if places[node] != Place::OnOuterContour {
                    places[node] = place;
                }
            }
        }
        Self { elements, positions, places, holes: mesh.hole_areas().len() }
    }

    /// Unknown of each node, number of the first hole, count of all.
    ///
    /// Numbers ascend along the longer extent of the region, which keeps the rows of the matrix
    /// short in slender regions.
    fn unknowns(&self) -> (Vec<Option<usize>>, usize, usize) {
        let along = longer_axis(&self.positions);
        let mut inside: Vec<usize> =
            (0..self.positions.len()).filter(|&n| self.places[n] == Place::Inside).collect();
        // Points outside the region belong to no element and get no unknown.
        let mut used = vec![false; self.positions.len()];
        self.elements.iter().flatten().for_each(|&node| used[node] = true);
        inside.retain(|&node| used[node]);
        inside.sort_by(|&a, &b| {
            self.positions[a][along].total_cmp(&self.positions[b][along]).then(a.cmp(&b))
        });
        let mut unknown = vec![None; self.positions.len()];
        for (number, &node) in inside.iter().enumerate() {
            unknown[node] = Some(number);
        }
        let first_hole = inside.len();
        for (node, place) in self.places.iter().enumerate() {
            if let Place::OnHole(hole) = place {
                unknown[node] = Some(first_hole + hole);
            }
        }
        (unknown, first_hole, first_hole + self.holes)
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn longer_axis(points: &[Point2<f64>]) -> usize {
    let extent = |axis: usize| {
        let ends = points
            .iter()
            .fold([f64::MAX, f64::MIN], |[low, high], p| [low.min(p[axis]), high.max(p[axis])]);
        ends[1] - ends[0]
    };
    usize::from(extent(1) > extent(0))
}

/// Stiffness of one triangle, and the load 2A/3 of each of its sides.
fn element_matrix(mesh: &Mesh, t: &[u32; 3]) -> ([[f64; 6]; 6], f64) {
    let [a, b, c] = t.map(|i| mesh.points[i as usize]);
    let area = 0.5 * mesh.doubled_area(t);
    // A g_i · g_j = e_i · e_j / 4A with e_i the side opposite to corner i.
    let e: [Vector2<f64>; 3] = [c - b, a - c, b - a];
    let g = |i: usize, j: usize| e[i].dot(&e[j]) / (4.0 * area);
    let mut k = [[0.0; 6]; 6];
    for (i, row) in k.iter_mut().enumerate().take(3) {
        for (j, entry) in row.iter_mut().enumerate().take(3) {
            *entry = if i == j { g(i, i) } else { -g(i, j) / 3.0 };
        }
    }
    for (s, [p, q]) in SIDES.into_iter().enumerate() {
        for corner in [p, q] {
            k[corner][3 + s] = 4.0 * g(p, q) / 3.0;
            k[3 + s][corner] = k[corner][3 + s];
        }
    }
    for (s, [p, q]) in SIDES.into_iter().enumerate() {
        k[3 + s][3 + s] = 8.0 * (g(p, p) + g(q, q) + g(p, q)) / 3.0;
        // The next side runs from q to the third corner r: they share q.
        let (next, r) = ((s + 1) % 3, SIDES[(s + 1) % 3][1]);
        k[3 + s][3 + next] = 8.0 * g(p, r) / 3.0;
        k[3 + next][3 + s] = k[3 + s][3 + next];
    }
    (k, 2.0 * area / 3.0)
}

#[cfg(test)]
mod tests {
    use super::super::mesh::triangulate;
    use super::*;

    #[test]
    fn constant_field_has_no_energy() {
        let corners = [(0.0, 0.0), (2.0, 0.3), (0.5, 1.0)].map(|(x, y)| Point2::new(x, y));
        let mesh = triangulate(&[corners.to_vec()], 10.0).unwrap();
        let (k, _) = element_matrix(&mesh, &mesh.triangles[0]);
        for row in k {
            assert!(row.iter().sum::<f64>().abs() < 1e-12, "{row:?}");
        }
    }

    #[test]
    fn linear_field_has_the_energy_of_its_slope() {
        let corners = [(0.0, 0.0), (2.0, 0.3), (0.5, 1.0)].map(|(x, y)| Point2::new(x, y));
        let mesh = triangulate(&[corners.to_vec()], 10.0).unwrap();
        let t = mesh.triangles[0];
        let [a, b, c] = t.map(|i| mesh.points[i as usize].x);
        let u = [a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
        let (k, _) = element_matrix(&mesh, &t);
        let energy: f64 = (0..36).map(|n| u[n / 6] * k[n / 6][n % 6] * u[n % 6]).sum();
        assert!((energy - 0.5 * mesh.doubled_area(&t)).abs() < 1e-12);
    }
}
