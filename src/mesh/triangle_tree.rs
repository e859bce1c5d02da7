//! A tree of boxes over triangles: inside tests, segment hits and nearest points.
//!
//! The tree is a plain median split. Bounds are single precision, rounded outwards: half the
//! memory, and never a missed triangle.

use std::cell::Cell;

use nalgebra::{Point3, Vector3};

use super::plane::Plane;
use super::ray::{DIRECTIONS, Hit, Ray};

/// Triangles in one leaf: below four the boxes cost more than they save.
const LEAF: usize = 4;

/// A tree over the triangles of a surface.
#[derive(Clone, Debug)]
pub struct TriangleTree {
    nodes: Vec<TreeNode>,
    faces: Vec<u32>,
    corners: Vec<[Point3<f64>; 3]>,
}

#[derive(Clone, Copy, Debug)]
struct TreeNode {
    low: [f32; 3],
    high: [f32; 3],
    /// Leaf: start in `faces`. Inner: index of the second child; the first follows the node.
    link: u32,
    /// Number of faces in a leaf, 0 for an inner node.
    count: u32,
}

/// The middle of a triangle, while the tree is built.
#[derive(Clone, Copy)]
struct Middle {
    at: [f32; 3],
    face: u32,
}

/// One place where a ray passes through the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Position of the triangle in the list the tree was made from.
    pub face: u32,
    /// Distance along the ray in lengths of its direction.
    pub at: f64,
    /// +1 where the ray leaves the body, −1 where it enters.
    pub sign: i32,
}

impl TriangleTree {
    /// Builds the tree; `O(n log n)`.
    pub fn new(corners: Vec<[Point3<f64>; 3]>) -> Self {
        let third = |[a, b, c]: &[Point3<f64>; 3], k: usize| ((a[k] + b[k] + c[k]) / 3.0) as f32;
        let mut middles: Vec<Middle> = (0..)
            .zip(&corners)
            .map(|(face, at)| Middle { at: [0, 1, 2].map(|k| third(at, k)), face })
            .collect();
        let mut tree =
            Self { nodes: Vec::with_capacity(corners.len() / 2 + 1), faces: Vec::new(), corners };
        if !middles.is_empty() {
            tree.build(&mut middles, 0);
            tree.faces = middles.iter().map(|m| m.face).collect();
        }
        tree
    }

    fn build(&mut self, middles: &mut [Middle], first: usize) {
        let node = self.nodes.len();
        if middles.len() <= LEAF {
            let (low, high) = self.bounds(middles);
            let (link, count) = (first as u32, middles.len() as u32);
            self.nodes.push(TreeNode { low, high, link, count });
            return;
        }
        self.nodes.push(TreeNode { low: [0.0; 3], high: [0.0; 3], link: 0, count: 0 });
        let axis = widest_axis(middles);
        let half = middles.len() / 2;
        middles.select_nth_unstable_by(half, |m, n| {
            m.at[axis].total_cmp(&n.at[axis]).then(m.face.cmp(&n.face))
        });
        let (near, far) = middles.split_at_mut(half);
        self.build(near, first);
        let second = self.nodes.len();
        self.build(far, first + half);
        let [a, b] = [node + 1, second].map(|child| self.nodes[child]);
        let [low, high] = [
            [0, 1, 2].map(|k| a.low[k].min(b.low[k])),
            [0, 1, 2].map(|k| a.high[k].max(b.high[k])),
        ];
        self.nodes[node] = TreeNode { low, high, link: second as u32, count: 0 };
    }

    fn bounds(&self, middles: &[Middle]) -> ([f32; 3], [f32; 3]) {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for p in middles.iter().flat_map(|m| &self.corners[m.face as usize]) {
            for k in 0..3 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        (low.map(|x| (x as f32).next_down()), high.map(|x| (x as f32).next_up()))
    }

    /// The triangles it was made from.
    pub(super) fn corners(&self) -> &[[Point3<f64>; 3]] {
        &self.corners
    }

    /// Whether a point lies inside the surface (winding number above zero).
    pub fn contains(&self, point: &Point3<f64>) -> bool {
        self.winding_number(point) > 0
    }

    /// How often the surface winds round a point: 1 inside, 0 outside of a plain body.
    pub fn winding_number(&self, point: &Point3<f64>) -> i32 {
        for direction in DIRECTIONS.map(Vector3::from) {
            let mut sum = 0;
            let clear = self.visit_crossings(point, &direction, |c| sum += c.sign);
            if clear {
                return sum;
            }
        }
        0
    }

    /// Calls `visit` for every triangle the ray passes through, in no particular order; false when
    /// the ray meets an edge or a corner exactly, so that the count cannot be trusted.
    pub fn visit_crossings(
        &self,
        origin: &Point3<f64>,
        direction: &Vector3<f64>,
        mut visit: impl FnMut(Crossing),
    ) -> bool {
        let ray = Ray::new(origin, direction);
        let mut clear = true;
        self.visit_leaves(
            |n| ray.may_meet(&n.low, &n.high, f64::INFINITY),
            |face| match ray.cross(&self.corners[face as usize]) {
                Hit::At(at, sign) => visit(Crossing { face, at, sign }),
                Hit::Edge => clear = false,
                Hit::Miss => {}
            },
        );
        clear
    }

    /// Whether the open segment `a b` passes through the surface.
    pub fn is_crossed_by(&self, a: &Point3<f64>, b: &Point3<f64>) -> bool {
        self.first_crossing(a, b).is_some()
    }

    /// The crossing of the segment `a b` nearest to `a`, `at` in 0..1 along it.
    pub fn first_crossing(&self, a: &Point3<f64>, b: &Point3<f64>) -> Option<Crossing> {
        self.first_crossing_counted(a, b, &mut 0)
    }

    /// The same; adds to `looked` how many triangles were asked.
    pub(crate) fn first_crossing_counted(
        &self,
        a: &Point3<f64>,
        b: &Point3<f64>,
        looked: &mut usize,
    ) -> Option<Crossing> {
        let mut asked = 0;
        let ray = Ray::new(a, &(b - a));
        let first: Cell<Option<Crossing>> = Cell::new(None);
        self.visit_leaves(
            |n| ray.may_meet(&n.low, &n.high, first.get().map_or(1.0, |f| f.at)),
            |face| {
                asked += 1;
                match ray.cross(&self.corners[face as usize]) {
                    Hit::At(at, sign) if at <= 1.0 && first.get().is_none_or(|f| at < f.at) => {
                        first.set(Some(Crossing { face, at, sign }));
                    }
                    _ => {}
                }
            },
        );
        *looked += asked;
        first.get()
    }

    /// The nearest point of the surface, its distance and its triangle; `None` without triangles.
    pub fn nearest(&self, point: &Point3<f64>) -> Option<(Point3<f64>, f64, u32)> {
        let mut best: Option<(Point3<f64>, f64, u32)> = None;
        let mut stack = vec![0u32];
        while let Some(i) = stack.pop() {
            let Some(node) = self.nodes.get(i as usize) else { continue };
            if best.is_some_and(|b| node.distance_squared(point) > b.1) {
                continue;
            }
            if node.count == 0 {
                let (near, far) = (i + 1, node.link);
                let d = |k: u32| self.nodes[k as usize].distance_squared(point);
                stack.extend(if d(near) < d(far) { [far, near] } else { [near, far] });
                continue;
            }
            for &face in &self.faces[node.link as usize..(node.link + node.count) as usize] {
                let q = nearest_on_triangle(point, &self.corners[face as usize]);
                let d = (q - point).norm_squared();
                if best.is_none_or(|b| d < b.1) {
                    best = Some((q, d, face));
                }
            }
        }
        best.map(|(q, d, f)| (q, d.sqrt(), f))
    }

    /// Calls `visit` for the triangles near a plane, in no particular order: all that it cuts, and
    /// some that it only passes by.
    pub fn visit_plane(&self, plane: &Plane, visit: impl FnMut(u32)) {
        self.visit_leaves(|node| node.may_meet(plane), visit);
    }

    fn visit_leaves(&self, meets: impl Fn(&TreeNode) -> bool, mut visit: impl FnMut(u32)) {
        let mut i = 0;
        let mut stack: [u32; 64] = [0; 64];
        let mut depth = 0;
        while let Some(node) = self.nodes.get(i) {
            if meets(node) {
                if node.count == 0 {
                    stack[depth] = node.link;
                    depth += 1;
                    i += 1;
                    continue;
                }
                let first = node.link as usize;
                self.faces[first..first + node.count as usize].iter().for_each(|&f| visit(f));
            }
            if depth == 0 {
                return;
            }
            depth -= 1;
            i = stack[depth] as usize;
        }
    }
}

fn widest_axis(middles: &[Middle]) -> usize {
    let mut low = [f32::INFINITY; 3];
    let mut high = [f32::NEG_INFINITY; 3];
    for m in middles {
        for k in 0..3 {
            low[k] = low[k].min(m.at[k]);
            high[k] = high[k].max(m.at[k]);
        }
    }
    let width = [0, 1, 2].map(|k| high[k] - low[k]);
    (0..3).fold(0, |best, k| if width[k] > width[best] { k } else { best })
}

impl TreeNode {
    /// Whether the lowest and highest corner of the box lie on both sides of the plane.
    fn may_meet(&self, plane: &Plane) -> bool {
        let (mut low, mut high, mut size) = (0.0, 0.0, 0.0f64);
        for k in 0..3 {
            let height = |x: f32| (f64::from(x) - plane.point[k]) * plane.normal[k];
            let (a, b) = (height(self.low[k]), height(self.high[k]));
            low += a.min(b);
            high += a.max(b);
            size += a.abs().max(b.abs());
        }
        // A triangle that the plane just touches must not be lost to rounding.
        let slack = 1e-12 * size;
        low <= slack && high >= -slack
    }

    fn distance_squared(&self, p: &Point3<f64>) -> f64 {
        (0..3)
            .map(|k| {
                let d = (f64::from(self.low[k]) - p[k]).max(p[k] - f64::from(self.high[k]));
                d.max(0.0).powi(2)
            })
            .sum()
    }
}

/// The point of a triangle nearest to `p` (Ericson, *Real-Time Collision Detection*, §5.1.5).
fn nearest_on_triangle(p: &Point3<f64>, &[a, b, c]: &[Point3<f64>; 3]) -> Point3<f64> {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = va + vb + vc;
    a + ab * (vb / sum) + ac * (vc / sum)
}

#[cfg(test)]
mod tests {
    use super::super::test_box;
    use super::*;

    fn cube() -> TriangleTree {
        TriangleTree::new(test_box::triangles([0.0; 3], [1.0; 3]))
    }

    #[test]
    fn a_point_is_inside_the_cube_or_not() {
        let tree = cube();
        assert_eq!(tree.winding_number(&Point3::new(0.5, 0.5, 0.5)), 1);
        assert_eq!(tree.winding_number(&Point3::new(1.5, 0.5, 0.5)), 0);
        assert_eq!(tree.winding_number(&Point3::new(-0.5, 0.1, 0.9)), 0);
    }

    #[test]
    fn a_segment_through_a_face_is_seen_with_its_place() {
        let hit = cube().first_crossing(&Point3::new(0.4, 0.3, -1.0), &Point3::new(0.4, 0.3, 3.0));
        assert!(hit.is_some_and(|c| (c.at - 0.25).abs() < 1e-12 && c.sign == -1));
        assert!(!cube().is_crossed_by(&Point3::new(0.1, 0.1, 0.1), &Point3::new(0.9, 0.9, 0.9)));
    }

    #[test]
    fn the_nearest_point_may_lie_on_face_edge_or_corner() {
        let tree = cube();
        for (p, q) in [
            ([0.3, 0.4, 2.0], [0.3, 0.4, 1.0]),
            ([0.3, -1.0, 2.0], [0.3, 0.0, 1.0]),
            ([2.0, 2.0, 2.0], [1.0, 1.0, 1.0]),
        ] {
            let found = tree.nearest(&Point3::from(p)).map(|n| n.0);
            assert!(found.is_some_and(|f| (f - Point3::from(q)).norm() < 1e-12), "{found:?}");
        }
    }
}
