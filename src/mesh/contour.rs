//! The curve in which a plane cuts the surface, followed from triangle to triangle.
//!
//! Only the one closed curve through a given triangle is followed, however many others the plane
//! cuts elsewhere: the cost is the length of that curve, not the size of the mesh.
//!
//! ```text
//!        w (up)             A triangle is entered over a side that runs from above the plane to
//!       ╱ ╲                 below it. It is left over the side that comes up again: towards w or
//!  ────╱───╲──── plane      from w. Walking so keeps the material on the left, seen against the
//!     ╱     ╲               normal (looking down on the upper side).
//!   up ───── down
//! ```

use nalgebra::{Point3, Vector3};

use super::half_edge::HalfEdgeMesh;
use super::id::{FaceId, HalfEdgeId};
pub use super::plane::Plane;
use super::triangle_tree::TriangleTree;

/// One closed curve of a plane section, as a polygon with a corner on each crossed edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contour {
    /// The crossed sides, from above to below, in walking order.
    pub half_edges: Vec<HalfEdgeId>,
    /// Where they are crossed, mm.
    pub points: Vec<Point3<f64>>,
}

impl Contour {
    /// Whether the contour winds round the plane's point.
    pub fn encloses(&self, plane: &Plane) -> bool {
        let (u, v) = plane.axes();
        let flat = |p: &Point3<f64>| ((p - plane.point).dot(&u), (p - plane.point).dot(&v));
        let mut inside = false;
        let Some(last) = self.points.last() else { return false };
        let mut a = flat(last);
        for p in &self.points {
            let b = flat(p);
            if (a.1 > 0.0) != (b.1 > 0.0) && a.0 + a.1 / (a.1 - b.1) * (b.0 - a.0) > 0.0 {
                inside = !inside;
            }
            a = b;
        }
        inside
    }

    fn clear(&mut self) {
        self.half_edges.clear();
        self.points.clear();
    }
}

/// The side over which the contour enters a triangle that the plane cuts: from above to below.
pub fn entry(mesh: &HalfEdgeMesh, plane: &Plane, face: FaceId) -> Option<HalfEdgeId> {
    let above = mesh.corners(face).map(|p| plane.height(&p) >= 0.0);
    (0..3).find(|&k| above[k] && !above[(k + 1) % 3]).map(|k| face.half_edges()[k])
}

/// Follows the contour over the crossed side `start` into `contour`.
///
/// `keep_on` sees every point before it is added; the walk is given up, and `false` returned, when
/// it says no. `start` must run from above the plane to below it.
pub fn follow(
    mesh: &HalfEdgeMesh,
    plane: &Plane,
    start: HalfEdgeId,
    contour: &mut Contour,
    mut keep_on: impl FnMut(&Point3<f64>) -> bool,
) -> bool {
    contour.clear();
    let end = |vertex| {
        let at = mesh.position(vertex);
        (at, plane.height(&at))
    };
    let mut h = start;
    let (mut above, mut below) = (end(mesh.origin(h)), end(mesh.target(h)));
    loop {
        let point = crossing(&above, &below);
        if !keep_on(&point) {
            return false;
        }
        contour.half_edges.push(h);
        contour.points.push(point);
        let apex = end(mesh.origin(h.previous()));
        // The apex is an end of the next side, the other end is known already.
        let out = if apex.1 >= 0.0 {
            above = apex;
            h.next()
        } else {
            below = apex;
            h.previous()
        };
        h = mesh.twin(out);
        if h == start {
            return true;
        }
    }
}

/// Where a side is crossed, given its ends above and below the plane and their heights.
fn crossing((a, above): &(Point3<f64>, f64), (b, below): &(Point3<f64>, f64)) -> Point3<f64> {
    let t = above / (above - below);
    a + (b - a) * t
}

/// The contour round a point of the plane: the first one met from there, if it encloses the point
/// and stays within `reach` of it.
pub fn contour_round(
    mesh: &HalfEdgeMesh,
    tree: &TriangleTree,
    plane: &Plane,
    reach: f64,
) -> Option<Contour> {
    let mut contour = Contour::default();
    let start = first_met(mesh, tree, plane, reach)?;
    closed_round(mesh, plane, start, reach, &mut contour).then_some(contour)
}

/// The crossed side of a contour that is met within `reach` of the point of a plane.
pub fn first_met(
    mesh: &HalfEdgeMesh,
    tree: &TriangleTree,
    plane: &Plane,
    reach: f64,
) -> Option<HalfEdgeId> {
    let (u, v) = plane.axes();
    // Not along an axis: flat faces of CAD models lie there.
    let far = plane.point + (u * 0.8 + v * 0.6) * reach;
    let hit = tree.first_crossing(&plane.point, &far)?;
    entry(mesh, plane, FaceId(hit.face))
}

/// Follows the contour over the crossed side `start`; whether it encloses the plane's point within
/// `reach`.
pub fn closed_round(
    mesh: &HalfEdgeMesh,
    plane: &Plane,
    start: HalfEdgeId,
    reach: f64,
    contour: &mut Contour,
) -> bool {
    let is_near = |p: &Point3<f64>| (p - plane.point).norm_squared() <= reach * reach;
    let fits = follow(mesh, plane, start, contour, is_near);
    fits && contour.points.len() >= 3 && contour.encloses(plane)
}

/// Size and place of the region a contour encloses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Area centroid, mm.
    pub centroid: Point3<f64>,
    /// Signed area, mm²: negative round a hole.
    pub area: f64,
    /// Largest distance of a contour point from the centroid, mm.
    pub reach: f64,
}

impl Extent {
    /// Measures a contour in its plane.
    pub fn of(contour: &Contour, plane: &Plane) -> Self {
        let n = plane.normal.into_inner();
        let first = contour.points[0];
        let mut doubled_area = 0.0;
        let mut moment = Vector3::zeros();
        let mut a = contour.points[contour.points.len() - 1] - first;
        for p in &contour.points {
            let b = p - first;
            let w = n.dot(&a.cross(&b));
            doubled_area += w;
            moment += (a + b) * w;
            a = b;
        }
        let centroid =
            if doubled_area == 0.0 { first } else { first + moment / (3.0 * doubled_area) };
        let reach = contour
            .points
            .iter()
            .map(|p| (p - centroid).norm_squared())
            .fold(0.0f64, f64::max)
            .sqrt();
        Self { centroid, area: 0.5 * doubled_area, reach }
    }

    /// Radius of the disc of equal area, mm.
    pub fn radius(&self) -> f64 {
        (self.area.max(0.0) / std::f64::consts::PI).sqrt()
    }
}
