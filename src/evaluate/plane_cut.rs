//! The normal plane of a skeletal point and all closed curves in which it cuts the surface.

use std::ops::Range;

use nalgebra::{Point3, Vector2};

use crate::mesh::Surface;
use crate::mesh::contour::{Contour, Plane, entry, follow};
use crate::mesh::id::{FaceId, HalfEdgeId};

/// What lies outside of the cube by less than this part of its size lies in it. A straight round rod
/// just touches the cube that its own interface section gives.
const AT_CUBE: f64 = 1e-9;

/// Where a plane crosses the edges of the mesh, curve after curve.
///
/// Curves run counter-clockwise round material, seen against the normal. All lists have one entry
/// a crossing.
#[derive(Clone, Debug, Default)]
pub(super) struct PlaneCut {
    /// Places in the plane; the skeletal point is the origin.
    pub(super) places: Vec<Vector2<f64>>,
    /// Whether the crossed edge lies in the neighbourhood of the skeletal point.
    pub(super) near: Vec<bool>,
    /// Place of the crossed edge in the order of the mesh.
    pub(super) rank: Vec<u64>,
    /// The crossings of each curve.
    pub(super) curves: Vec<Range<usize>>,
}

impl PlaneCut {
    /// The polygon of a curve.
    pub(super) fn polygon(&self, curve: usize) -> &[Vector2<f64>] {
        &self.places[self.curves[curve].clone()]
    }

    /// Whether each crossing of a curve is near.
    pub(super) fn nearness(&self, curve: usize) -> &[bool] {
        &self.near[self.curves[curve].clone()]
    }

    fn clear(&mut self) {
        self.places.clear();
        self.near.clear();
        self.rank.clear();
        self.curves.clear();
    }
}

/// Cuts one surface by many planes; what it needs for that is allocated once.
pub(super) struct Cutter<'a> {
    surface: &'a Surface,
    /// The cut in which each triangle was last seen.
    seen: Vec<u32>,
    cuts: u32,
    contour: Contour,
    cut: PlaneCut,
}

impl<'a> Cutter<'a> {
    pub(super) fn new(surface: &'a Surface) -> Self {
        Self {
            surface,
            seen: vec![0; surface.mesh.face_count()],
            cuts: 0,
            contour: Contour::default(),
            cut: PlaneCut::default(),
        }
    }

    /// All curves of a plane; crossings of edges that have a point in the cube of half side
    /// `cube_half` about the point of the plane are marked as near.
    ///
    /// The cube is aligned with the axes (thesis §4.4: "a cube in which the skeletal point is in its
    /// center").
    pub(super) fn cut(&mut self, plane: &Plane, cube_half: f64) -> &PlaneCut {
        self.cuts += 1;
        self.cut.clear();
        let mesh = &self.surface.mesh;
        let (u, v) = plane.axes();
        let reach = cube_half * (1.0 + AT_CUBE);
        let in_cube = |p: &Point3<f64>| (p - plane.point).amax() <= reach;
        self.surface.tree.visit_plane(plane, |face| {
            if self.seen[face as usize] == self.cuts {
                return;
            }
            let Some(start) = entry(mesh, plane, FaceId(face)) else { return };
            follow(mesh, plane, start, &mut self.contour, |_| true);
            let first = self.cut.places.len();
            for (&h, x) in self.contour.half_edges.iter().zip(&self.contour.points) {
                self.seen[h.face().index()] = self.cuts;
                let d = x - plane.point;
                self.cut.places.push(Vector2::new(d.dot(&u), d.dot(&v)));
                let ends = [mesh.origin(h), mesh.target(h)].map(|v| mesh.position(v));
                self.cut.near.push(in_cube(x) || ends.iter().any(in_cube));
                self.cut.rank.push(rank(self.surface, h));
            }
            self.cut.curves.push(first..self.cut.places.len());
        });
        &self.cut
    }
}

/// Place of a crossed edge when the triangles are gone through as the file lists them and in each
/// of them the side that comes up through the plane is taken before the one that goes down.
fn rank(surface: &Surface, down: HalfEdgeId) -> u64 {
    let listed = |h: HalfEdgeId| u64::from(surface.listed[h.face().index()]);
    (2 * listed(surface.mesh.twin(down))).min(2 * listed(down) + 1)
}
