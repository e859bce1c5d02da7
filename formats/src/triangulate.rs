//! Polygons into triangles.
//!
//! ```text
//!   5 ──────────── 4      Every corner stays a corner, and every edge of the polygon an edge of
//!   │ ╲          ╱ │      just one triangle, also where corners lie on a straight line (6): the
//!   │   ╲ 2 ── 3   │      neighbour across that edge has a corner there, and a triangle without
//!   6 ─── │        │      it would leave a crack.
//!   │   ╱ │
//!   0 ─── 1               n corners give n − 2 triangles.
//! ```
//!
//! A quadrilateral is cut along the better of its diagonals and a convex polygon into a fan; others
//! are projected along their normal by Newell's formula and cut by the `earcut` crate. That drops
//! corners on straight lines, which are put back.

use std::collections::HashMap;

use earcut::Earcut;

use crate::raw_mesh::RawMesh;

/// Triangles cut from polygons.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Triangles {
    /// Indices of points, in the sense of rotation of the polygon.
    pub corners: Vec<[u32; 3]>,
    /// The polygon that each triangle was cut from, in increasing order.
    pub face: Vec<u32>,
}

impl RawMesh {
    /// Cuts all polygons into triangles.
    ///
    /// Repeated corners fall out, so a polygon of fewer than three different corners has no
    /// triangle. A triangle has no area, or is turned over, only where the polygon leaves no choice:
    /// if it is flat as a line, goes back on itself, or crosses itself.
    ///
    /// # Panics
    /// If the mesh breaks the invariants of [`RawMesh`]; none that was read does.
    ///
    /// # Examples
    /// ```
    /// # use beamwright_formats::{Format, ReadOptions, read_bytes};
    /// // An arrowhead, concave at its third corner.
    /// let off = b"OFF 4 1 0\n0 0 0\n2 2 0\n1 0 0\n2 -2 0\n4 0 3 2 1\n";
    /// let mesh = read_bytes(off, Format::Off, &ReadOptions::default())?;
    /// let triangles = mesh.triangulate();
    /// assert_eq!(triangles.corners, [[0, 3, 2], [0, 2, 1]]);
    /// assert_eq!(triangles.face, [0, 0]);
    /// # Ok::<(), beamwright_formats::ReadError>(())
    /// ```
    pub fn triangulate(&self) -> Triangles {
        let mut triangles = Triangles::default();
        // Exact for triangle meshes, and the least for others.
        let least = self.faces.corners.len().saturating_sub(2 * self.faces.len());
        triangles.corners.reserve_exact(least);
        triangles.face.reserve_exact(least);
        let mut cutter = Cutter::default();
        for (face, polygon) in (0_u32..).zip(self.faces.iter()) {
            if let &[a, b, c] = polygon {
                triangles.push([a, b, c], face);
                continue;
            }
            for triangle in cutter.cut(polygon, &self.positions) {
                triangles.push(triangle, face);
            }
        }
        triangles
    }
}

impl Triangles {
    #[inline]
    fn push(&mut self, triangle: [u32; 3], face: u32) {
        let [a, b, c] = triangle;
        if a != b && b != c && c != a {
            self.corners.push(triangle);
            self.face.push(face);
        }
    }
}

type Point2 = [f64; 2];
type Point3 = [f64; 3];

/// Cuts one polygon after the other, with memory that is used again.
#[derive(Default)]
struct Cutter {
    /// The polygon, [simplified](simplify).
    ring: Vec<u32>,
    /// Its points seen against its normal: counter-clockwise.
    flat: Vec<Point2>,
    /// Triangles as places in the ring.
    triangles: Vec<[usize; 3]>,
    earcut: Option<Box<Earcut<f64>>>,
    cut_by_earcut: Vec<u32>,
}

impl Cutter {
    /// The triangles of a polygon, by the indices of its points.
    fn cut(
        &mut self,
        polygon: &[u32],
        positions: &[Point3],
    ) -> impl Iterator<Item = [u32; 3]> + '_ {
        simplify(polygon, &mut self.ring);
        self.triangles.clear();
        if self.ring.len() == 3 {
            self.triangles.push([0, 1, 2]);
        } else if self.ring.len() > 3 {
            self.cut_ring(positions);
        }
        self.triangles.iter().map(|triangle| triangle.map(|place| self.ring[place]))
    }

    fn cut_ring(&mut self, positions: &[Point3]) {
        let is_flat = flatten(&self.ring, positions, &mut self.flat);
        if is_flat && self.ring.len() == 4 {
            self.cut_quadrilateral();
        } else if !is_flat || is_fan(&self.flat) || !self.cut_concave() {
            self.cut_fan();
        }
    }

    fn cut_fan(&mut self) {
        self.triangles.clear();
        self.triangles.extend((1..self.ring.len() - 1).map(|place| [0, place, place + 1]));
    }

    /// Cuts along the diagonal whose smaller triangle is larger.
    fn cut_quadrilateral(&mut self) {
        let smaller = |cut: [[usize; 3]; 2]| {
            let [first, second] = cut.map(|triangle| self.area(triangle));
            first.min(second)
        };
        let (along, across) = ([[0, 1, 2], [0, 2, 3]], [[1, 2, 3], [1, 3, 0]]);
        let (area_along, area_across) = (smaller(along), smaller(across));
        // Of two that are equal but for rounding, the same one everywhere.
        let is_better = area_across > area_along + 1e-9 * area_along.abs();
        self.triangles.extend(if is_better { across } else { along });
    }

    /// Twice the area of a triangle seen against the normal; negative if it is turned over.
    fn area(&self, [a, b, c]: [usize; 3]) -> f64 {
        twice_area(self.flat[a], self.flat[b], self.flat[c])
    }

    /// Cuts by `earcut`; false if the polygon crosses itself in a way that leaves gaps.
    fn cut_concave(&mut self) -> bool {
        let earcut = self.earcut.get_or_insert_with(|| Box::new(Earcut::new()));
        earcut.earcut(self.flat.iter().copied(), &[], &mut self.cut_by_earcut);
        let triangles = self.cut_by_earcut.chunks_exact(3);
        self.triangles.extend(triangles.map(|t| [t[0] as usize, t[1] as usize, t[2] as usize]));
        let area: f64 = self.triangles.iter().map(|&triangle| self.area(triangle)).sum();
        if area < 0.0 {
            self.triangles.iter_mut().for_each(|triangle| triangle.reverse());
        }
        self.put_back_dropped();
        self.triangles.len() == self.ring.len() - 2
    }

    /// Puts back corners that no triangle has: the triangle at their edge is split among them.
    fn put_back_dropped(&mut self) {
        let count = self.ring.len();
        let mut is_used = vec![false; count];
        self.triangles.iter().flatten().for_each(|&place| is_used[place] = true);
        let Some(first) = is_used.iter().position(|&is_used| is_used) else { return };
        if is_used.iter().all(|&is_used| is_used) {
            return;
        }
        let mut triangle_at = HashMap::new();
        for (number, &triangle) in self.triangles.iter().enumerate() {
            triangle_at.extend(edges(triangle).map(|edge| (edge, number)));
        }
        let mut before = first;
        let mut dropped = Vec::new();
        for place in (first + 1..=first + count).map(|place| place % count) {
            if !is_used[place] {
                dropped.push(place);
            } else {
                if !dropped.is_empty() {
                    self.split(before, &dropped, place, &mut triangle_at);
                    dropped.clear();
                }
                before = place;
            }
        }
    }

    /// Splits the triangle at the edge from `start` to `end` so that it has corners on that edge.
    fn split(
        &mut self,
        start: usize,
        on_edge: &[usize],
        end: usize,
        triangle_at: &mut HashMap<[usize; 2], usize>,
    ) {
        let number = triangle_at.get(&[start, end]).copied();
        let Some(number) = number else {
            // No triangle is there: the corners go out and back on a line.
            let chain = on_edge.windows(2).map(|pair| [start, pair[0], pair[1]]);
            self.triangles.extend(chain);
            self.triangles.extend(on_edge.last().map(|&last| [start, last, end]));
            return;
        };
        let apex = self.triangles[number].into_iter().find(|&place| place != start && place != end);
        let apex = apex.unwrap_or(start);
        let ends = on_edge.iter().copied().chain([end]);
        let starts = [start].into_iter().chain(on_edge.iter().copied());
        for (piece, (from, to)) in starts.zip(ends).enumerate() {
            let number = if piece == 0 { number } else { self.triangles.len() };
            let triangle = [from, to, apex];
            if piece == 0 {
                self.triangles[number] = triangle;
            } else {
                self.triangles.push(triangle);
            }
            triangle_at.extend(edges(triangle).map(|edge| (edge, number)));
        }
    }
}

/// The polygon without corners that repeat the one before, and without going out and back.
fn simplify(polygon: &[u32], ring: &mut Vec<u32>) {
    ring.clear();
    for &corner in polygon {
        match ring[..] {
            [.., last] if last == corner => {}
            [.., before, _] if before == corner => drop(ring.pop()),
            _ => ring.push(corner),
        }
    }
    // The same where the end meets the beginning.
    let mut start = 0;
    loop {
        match ring[start..] {
            [first, .., last] if first == last => ring.truncate(ring.len() - 1),
            [first, .., before, _] if first == before => ring.truncate(ring.len() - 2),
            [_, second, .., last] if second == last => start += 1,
            _ => break,
        }
    }
    ring.drain(..start);
}

fn edges([a, b, c]: [usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

fn subtract(a: Point3, b: Point3) -> Point3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Point3, b: Point3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point3, b: Point3) -> Point3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn twice_area(a: Point2, b: Point2, c: Point2) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// How far points may lie from a plane, relative to the size of the polygon, to count as on it.
///
/// Coordinates written with six digits are off by 1e-6 at most.
const PLANE_TOLERANCE: f64 = 1e-5;

/// Below this, relative to the square of the size of the polygon, an area is that of rounding.
const AREA_TOLERANCE: f64 = 1e-12;

/// Projects a polygon along its normal; false if it has none.
fn flatten(ring: &[u32], positions: &[Point3], flat: &mut Vec<Point2>) -> bool {
    let point = |index: u32| positions[index as usize];
    let largest = ring.iter().flat_map(|&index| point(index)).fold(0.0, |a: f64, b| a.max(b.abs()));
    // The squares of numbers beyond these would be infinite or zero.
    let scale = if (1e-100..1e100).contains(&largest) { 1.0 } else { 0.25 / largest };
    let scaled = |index: u32| point(index).map(|coordinate| coordinate * scale);
    let origin = scaled(ring[0]);
    let relative = |index: u32| subtract(scaled(index), origin);

    let size = ring.iter().flat_map(|&index| relative(index)).fold(0.0, |a: f64, b| a.max(b.abs()));
    let normal = newell_normal(ring.iter().map(|&index| relative(index)));
    let length = dot(normal, normal).sqrt();
    if !length.is_finite() || length <= AREA_TOLERANCE * size * size {
        return false;
    }
    let normal = normal.map(|coordinate| coordinate / length);
    let off_plane = |index: &u32| dot(normal, relative(*index)).abs() > PLANE_TOLERANCE * size;
    let [u, v] = if ring.iter().any(off_plane) { plane_of(normal) } else { nearest_plane(normal) };
    flat.clear();
    flat.extend(ring.iter().map(|&index| relative(index)).map(|p| [dot(p, u), dot(p, v)]));
    true
}

/// Normal ½ Σ pᵢ × pᵢ₊₁ (Newell), as long as the area of the polygon.
fn newell_normal(points: impl Iterator<Item = Point3> + Clone) -> Point3 {
    let mut normal = [0.0; 3];
    let next = points.clone().skip(1).chain(points.clone().take(1));
    for (p, q) in points.zip(next) {
        let [x, y, z] = cross(p, q);
        normal = [normal[0] + 0.5 * x, normal[1] + 0.5 * y, normal[2] + 0.5 * z];
    }
    normal
}

/// Two directions at right angles to a normal and to each other.
fn plane_of(normal: Point3) -> [Point3; 2] {
    let [u, _] = nearest_plane(normal);
    let along = dot(u, normal);
    let u = subtract(u, normal.map(|coordinate| coordinate * along));
    let length = dot(u, u).sqrt();
    let u = u.map(|coordinate| coordinate / length);
    [u, cross(normal, u)]
}

/// The coordinate plane that is seen best against a normal.
///
/// To look at a plane polygon along an axis stretches it, but keeps straight what is straight, and
/// rounds nothing.
fn nearest_plane(normal: Point3) -> [Point3; 2] {
    const X: Point3 = [1.0, 0.0, 0.0];
    const Y: Point3 = [0.0, 1.0, 0.0];
    const Z: Point3 = [0.0, 0.0, 1.0];
    let [x, y, z] = normal.map(f64::abs);
    let (side, plane) = if x >= y && x >= z {
        (normal[0], [Y, Z])
    } else if y >= z {
        (normal[1], [Z, X])
    } else {
        (normal[2], [X, Y])
    };
    if side < 0.0 { [plane[1], plane[0]] } else { plane }
}

/// Whether the fan of the first corner has triangles of some area only, and covers the polygon.
///
/// True for convex polygons without corners on straight lines.
fn is_fan(flat: &[Point2]) -> bool {
    let (first, second) = (flat[0], flat[1]);
    let size = flat.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
    let least = AREA_TOLERANCE * size * size;
    // All corners lie to the left of the first edge, or the fan could go round more than once.
    flat[2..].iter().all(|&corner| twice_area(first, second, corner) > least)
        && flat[1..].windows(2).all(|pair| twice_area(first, pair[0], pair[1]) > least)
}

#[cfg(test)]
mod tests;
