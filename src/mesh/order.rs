//! A numbering of the surface that depends on its shape alone.
//!
//! Files list the triangles of one and the same part in any order. Whatever is decided later by
//! "the first one found" must depend neither on that nor on how the part lies in space. Each shell
//! is therefore numbered anew: from its outermost corner on, triangle after triangle over the edges
//! that lead away from there.
//!
//! Where several corners are equally far out, the walks that start there are compared step by step;
//! two that never differ start at places the part cannot be told apart from.

use std::cmp::Ordering;
use std::collections::VecDeque;

use nalgebra::{Point3, Vector3};
use rustc_hash::FxHashSet;

use super::half_edge::HalfEdgeMesh;
use super::id::{FaceId, HalfEdgeId};

/// Lengths that differ by less than this part of the size of the mesh are equal. Turning a part
/// rounds its coordinates by 1e-16, writing them with seven digits by 1e-7; two corners that differ
/// by less would be told apart by that rounding.
const EQUAL: f64 = 1e-6;

/// Walks that agree for so many triangles are taken as equal. Two corners of a frame that look
/// alike differ within the few hundred triangles of the strut they belong to.
const MOST_COMPARED: usize = 4096;

/// Most starts whose walks are compared. Boxes have 8 outermost corners of some 6 sides each; where
/// there are more, as on a ball, coordinates decide.
const MOST_STARTS: usize = 96;

/// Numbers triangles and their corners anew, given the shell of each triangle; the second list says
/// which triangle of the old numbering each one was. Points keep their numbers: nothing is decided
/// by them.
pub(super) fn renumbered(mesh: HalfEdgeMesh, shell_of_face: &[u32]) -> (HalfEdgeMesh, Vec<u32>) {
    let firsts = walk(&mesh, &starts(&mesh, shell_of_face));
    let mut new_half_edge = vec![0u32; 3 * mesh.face_count()];
    for (new, first) in (0..).step_by(3).zip(&firsts) {
        for (side, h) in (0..).zip(sides(*first)) {
            new_half_edge[h.index()] = new + side;
        }
    }
    let corner = |h: HalfEdgeId| mesh.origin(h).0;
    let triangles = firsts.iter().map(|first| sides(*first).map(corner)).collect();
    let twins = firsts
        .iter()
        .flat_map(|first| sides(*first).map(|h| new_half_edge[mesh.twin(h).index()]))
        .collect();
    let old = firsts.iter().map(|h| h.face().0).collect();
    let (positions, ..) = mesh.into_parts();
    (HalfEdgeMesh::from_parts(positions, triangles, twins), old)
}

/// The sides of a triangle from `first` on.
fn sides(first: HalfEdgeId) -> [HalfEdgeId; 3] {
    [first, first.next(), first.previous()]
}

/// The first half-edge of every triangle, in the order in which the triangles are reached.
fn walk(mesh: &HalfEdgeMesh, starts: &[HalfEdgeId]) -> Vec<HalfEdgeId> {
    let mut reached = vec![false; mesh.face_count()];
    let mut firsts = Vec::with_capacity(mesh.face_count());
    for &start in starts {
        let is_new = |f: FaceId| !std::mem::replace(&mut reached[f.index()], true);
        firsts.extend(Walk::new(mesh, start, is_new));
    }
    firsts
}

/// Triangles in the order in which they are reached from a half-edge, each by the half-edge it is
/// entered over.
struct Walk<'a, F> {
    mesh: &'a HalfEdgeMesh,
    ahead: VecDeque<HalfEdgeId>,
    is_new: F,
}

impl<'a, F: FnMut(FaceId) -> bool> Walk<'a, F> {
    fn new(mesh: &'a HalfEdgeMesh, start: HalfEdgeId, mut is_new: F) -> Self {
        let ahead = if is_new(start.face()) { VecDeque::from([start]) } else { VecDeque::new() };
        Self { mesh, ahead, is_new }
    }
}

impl<F: FnMut(FaceId) -> bool> Iterator for Walk<'_, F> {
    type Item = HalfEdgeId;

    fn next(&mut self) -> Option<HalfEdgeId> {
        let first = self.ahead.pop_front()?;
        for h in sides(first).map(|h| self.mesh.twin(h)) {
            if (self.is_new)(h.face()) {
                self.ahead.push_back(h);
            }
        }
        Some(first)
    }
}

/// Where the walk over each shell starts, the shell that reaches farthest out first.
fn starts(mesh: &HalfEdgeMesh, shell_of_face: &[u32]) -> Vec<HalfEdgeId> {
    let count = shell_of_face.iter().max().map_or(0, |m| *m as usize + 1);
    let ruler = Ruler::of(mesh, shell_of_face, count);
    let mut reach = vec![f64::NEG_INFINITY; count];
    let all = || mesh.faces().flat_map(FaceId::half_edges);
    let shell = |h: HalfEdgeId| shell_of_face[h.face().index()] as usize;
    for h in all() {
        let r = &mut reach[shell(h)];
        *r = r.max(ruler.distance(h));
    }
    let mut outermost: Vec<Vec<HalfEdgeId>> = vec![Vec::new(); count];
    for h in all() {
        if ruler.distance(h) >= reach[shell(h)] - ruler.equal {
            outermost[shell(h)].push(h);
        }
    }
    let mut starts: Vec<HalfEdgeId> =
        outermost.into_iter().filter_map(|tied| ruler.first_of(tied)).collect();
    starts = sorted(&starts, &|a, b| ruler.compare(a, b));
    starts
}

/// Merge sort, stable. Lengths within a tolerance are equal, so that of three each may equal the next
/// and the last not the first: the sort of the standard library may panic at that.
fn sorted(
    all: &[HalfEdgeId],
    compare: &impl Fn(HalfEdgeId, HalfEdgeId) -> Ordering,
) -> Vec<HalfEdgeId> {
    if all.len() < 2 {
        return all.to_vec();
    }
    let (left, right) = all.split_at(all.len() / 2);
    let (left, right) = (sorted(left, compare), sorted(right, compare));
    let mut merged = Vec::with_capacity(all.len());
    let (mut l, mut r) = (left.iter().peekable(), right.iter().peekable());
    while let (Some(&&a), Some(&&b)) = (l.peek(), r.peek()) {
        let next = if compare(b, a).is_lt() { r.next() } else { l.next() };
        merged.extend(next);
    }
    merged.extend(l.chain(r));
    merged
}

/// Measures from the middle of each shell, so that no other body decides how one is numbered.
struct Ruler<'a> {
    mesh: &'a HalfEdgeMesh,
    /// Distance of every point from the middle of its shell, mm.
    distances: Vec<f64>,
    /// Lengths that differ by less are equal, mm.
    equal: f64,
}

impl<'a> Ruler<'a> {
    fn of(mesh: &'a HalfEdgeMesh, shell_of_face: &[u32], shells: usize) -> Self {
        let origin = mesh.positions().first().copied().unwrap_or_else(Point3::origin);
        let mut sums = vec![(0.0, Vector3::zeros()); shells];
        for f in mesh.faces() {
            let [a, b, c] = mesh.corners(f).map(|p| p - origin);
            let weight = mesh.face_area(f);
            let (area, moment) = &mut sums[shell_of_face[f.index()] as usize];
            *area += weight;
            *moment += (a + b + c) * (weight / 3.0);
        }
        let mut distances = vec![0.0; mesh.positions().len()];
        for f in mesh.faces() {
            let (area, moment) = sums[shell_of_face[f.index()] as usize];
            let centre = if area > 0.0 { origin + moment / area } else { origin };
            for v in mesh.triangles()[f.index()] {
                distances[v as usize] = (mesh.positions()[v as usize] - centre).norm();
            }
        }
        let size = distances.iter().copied().fold(0.0, f64::max);
        Self { mesh, distances, equal: EQUAL * size }
    }

    /// How far out a half-edge begins, mm.
    fn distance(&self, h: HalfEdgeId) -> f64 {
        self.distances[self.mesh.origin(h).index()]
    }

    /// The half-edge of all whose walk comes first.
    fn first_of(&self, mut tied: Vec<HalfEdgeId>) -> Option<HalfEdgeId> {
        if tied.len() > MOST_STARTS {
            tied = sorted(&tied, &|a, b| self.by_coordinates(a, b));
            tied.truncate(MOST_STARTS);
        }
        tied.into_iter().min_by(|a, b| self.compare(*a, *b))
    }

    /// The walk with the larger lengths comes first.
    fn compare(&self, a: HalfEdgeId, b: HalfEdgeId) -> Ordering {
        let mut reached = [FxHashSet::default(), FxHashSet::default()];
        let [of_a, of_b] = &mut reached;
        let a_steps = Walk::new(self.mesh, a, |f| of_a.insert(f));
        let b_steps = Walk::new(self.mesh, b, |f| of_b.insert(f));
        for (i, j) in a_steps.zip(b_steps).take(MOST_COMPARED) {
            for (at_i, at_j) in self.lengths(i).into_iter().zip(self.lengths(j)) {
                if (at_i - at_j).abs() > self.equal {
                    return at_j.total_cmp(&at_i);
                }
            }
        }
        self.by_coordinates(a, b)
    }

    /// What is compared of a triangle: how far out it begins, and its next two sides.
    fn lengths(&self, first: HalfEdgeId) -> [f64; 3] {
        let [a, b, c] = sides(first).map(|h| self.mesh.position(self.mesh.origin(h)));
        [self.distance(first), (b - a).norm(), (c - b).norm()]
    }

    fn by_coordinates(&self, a: HalfEdgeId, b: HalfEdgeId) -> Ordering {
        let key = |h: HalfEdgeId| {
            let [p, q] = [self.mesh.origin(h), self.mesh.target(h)].map(|v| self.mesh.position(v));
            [p.x, p.y, p.z, q.x, q.y, q.z]
        };
        let (a, b) = (key(a), key(b));
        let differing = a.iter().zip(&b).find(|(x, y)| (*x - *y).abs() > self.equal);
        differing.map_or(Ordering::Equal, |(x, y)| x.total_cmp(y))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    #[test]
    fn lengths_that_equal_only_their_neighbours_do_not_stop_the_sort() {
        let all: Vec<HalfEdgeId> = (0..500).map(|i| HalfEdgeId(i * 7919 % 500)).collect();
        let by_tens = |a: HalfEdgeId, b: HalfEdgeId| {
            if a.0.abs_diff(b.0) <= 10 { Ordering::Equal } else { a.0.cmp(&b.0) }
        };
        let mut found: Vec<u32> = sorted(&all, &by_tens).iter().map(|h| h.0).collect();
        found.sort_unstable();
        assert_eq!(found, (0..500).collect::<Vec<u32>>());
        let exact = sorted(&all, &|a, b| a.0.cmp(&b.0));
        assert!(exact.is_sorted_by_key(|h| h.0));
    }

    /// A box with one corner pulled out, so that no two corners are alike.
    fn lopsided_box() -> (Vec<Point3<f64>>, Vec<[u32; 3]>) {
        let positions = (0..8u32)
            .map(|i| {
                let at = |bit: u32| f64::from(i >> bit & 1);
                let pull = if i == 5 { 0.5 } else { 0.0 };
                Point3::new(3.0 * at(0) + pull, 2.0 * at(1), at(2))
            })
            .collect();
        (positions, TWELVE.to_vec())
    }

    const TWELVE: [[u32; 3]; 12] = [
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5],
    ];

    /// Closed surfaces, each half-edge with the one other way round.
    pub(in crate::mesh) fn mesh(
        positions: Vec<Point3<f64>>,
        triangles: Vec<[u32; 3]>,
    ) -> HalfEdgeMesh {
        let side = |h: usize| (triangles[h / 3][h % 3], triangles[h / 3][(h + 1) % 3]);
        let twins = (0..3 * triangles.len())
            .map(|h| {
                let (a, b) = side(h);
                (0..3 * triangles.len()).find(|&t| side(t) == (b, a)).expect("a twin") as u32
            })
            .collect();
        HalfEdgeMesh::from_parts(positions, triangles, twins)
    }

    fn numbered(mesh: &HalfEdgeMesh) -> HalfEdgeMesh {
        let faces = mesh.face_count();
        let (mesh, _) = renumbered(mesh.clone(), &vec![0; faces]);
        assert_eq!(mesh.check(), Ok(()));
        mesh
    }

    /// Triangles, their corners and the points in another order.
    fn shuffled(positions: &[Point3<f64>], triangles: &[[u32; 3]]) -> HalfEdgeMesh {
        let points = positions.len() as u32;
        let of_point = |v: u32| (5 * v + 3) % points;
        let mut moved = vec![Point3::origin(); positions.len()];
        for (v, p) in (0..).zip(positions) {
            moved[of_point(v) as usize] = *p;
        }
        let turned = |(i, t): (usize, &[u32; 3])| {
            let mut t = t.map(of_point);
            t.rotate_left(i % 3);
            t
        };
        mesh(moved, triangles.iter().rev().enumerate().map(turned).collect())
    }

    #[test]
    fn a_shuffled_surface_is_numbered_like_the_surface() {
        let (positions, triangles) = lopsided_box();
        let plain = numbered(&mesh(positions.clone(), triangles.clone()));
        let other = numbered(&shuffled(&positions, &triangles));
        for (f, g) in plain.faces().zip(other.faces()) {
            assert_eq!(plain.corners(f), other.corners(g));
        }
    }

    #[test]
    fn a_turned_surface_is_numbered_like_the_surface() {
        let (positions, triangles) = lopsided_box();
        let plain = numbered(&mesh(positions.clone(), triangles.clone()));
        let turn =
            nalgebra::Isometry3::new(Vector3::new(7.0, -2.0, 1.0), Vector3::new(0.3, 1.0, 2.0));
        let turned = positions.iter().map(|p| turn * p).collect();
        let other = numbered(&mesh(turned, triangles));
        assert_eq!(plain.triangles(), other.triangles());
        for (p, q) in plain.positions().iter().zip(other.positions()) {
            assert!((turn * p - q).norm() < 1e-12);
        }
    }

    #[test]
    fn every_triangle_knows_its_old_number() {
        let (positions, triangles) = lopsided_box();
        let plain = mesh(positions, triangles);
        let (mesh, old) = renumbered(plain.clone(), &[0; 12]);
        for (f, old) in mesh.faces().zip(old) {
            let mut corners = plain.triangles()[old as usize];
            let turn = corners.iter().position(|v| *v == mesh.triangles()[f.index()][0]);
            corners.rotate_left(turn.expect("the same corners"));
            assert_eq!(mesh.triangles()[f.index()], corners);
        }
    }
}
