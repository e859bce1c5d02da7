//! The closed surface as triangles with neighbours.
//!
//! ```text
//!          c                 half-edge 3f     runs a → b
//!         ╱ ╲                          3f + 1      b → c
//!  3f+2  ╱ f ╲  3f+1                   3f + 2      c → a
//!       ╱     ╲
//!      a ───── b             twin(h): the same edge, seen from the triangle
//!          3f                on its other side; runs the other way
//! ```
//!
//! Sides are numbered by their triangle, so only the twins are stored: four bytes a half-edge.
//! The surface is closed, so every half-edge has a twin; [`HalfEdgeMesh::check`] asserts all that
//! the rest of the program relies on.

use nalgebra::{Point3, Vector3};

use super::id::{FaceId, HalfEdgeId, VertexId};

/// A closed, oriented, 2-manifold triangle mesh.
///
/// Invariants (see [`check`](Self::check)): indices are in range; corners of a triangle differ;
/// `twin` is an involution without fixed points that reverses the edge; the triangles about a
/// vertex form one fan.
#[derive(Clone, Debug, Default)]
pub struct HalfEdgeMesh {
    positions: Vec<Point3<f64>>,
    triangles: Vec<[u32; 3]>,
    twins: Vec<u32>,
}

/// A broken invariant of [`HalfEdgeMesh`]; a fault of this program, never of a file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BrokenInvariant {
    /// A corner names a vertex that is not there.
    #[error("triangle {0:?} has a corner outside the mesh")]
    IndexOutOfRange(FaceId),
    /// Two corners of a triangle are the same vertex.
    #[error("triangle {0:?} has two equal corners")]
    RepeatedCorner(FaceId),
    /// The twin of the twin is another half-edge.
    #[error("half-edge {0:?} is not the twin of its twin")]
    TwinNotMutual(HalfEdgeId),
    /// A half-edge and its twin do not run between the same vertices in opposite directions.
    #[error("half-edge {0:?} and its twin do not run against each other")]
    TwinNotOpposed(HalfEdgeId),
    /// A vertex has more than one fan of triangles.
    #[error("vertex {0:?} joins separate fans of triangles")]
    SeveralFans(VertexId),
}

impl HalfEdgeMesh {
    /// Builds the mesh from parts whose invariants the caller has established.
    pub(super) fn from_parts(
        positions: Vec<Point3<f64>>,
        triangles: Vec<[u32; 3]>,
        twins: Vec<u32>,
    ) -> Self {
        debug_assert_eq!(twins.len(), 3 * triangles.len());
        Self { positions, triangles, twins }
    }

    /// Takes the mesh apart: points, triangles, twins.
    pub(super) fn into_parts(self) -> (Vec<Point3<f64>>, Vec<[u32; 3]>, Vec<u32>) {
        (self.positions, self.triangles, self.twins)
    }

    /// All points, mm.
    pub fn positions(&self) -> &[Point3<f64>] {
        &self.positions
    }

    /// Corners of all triangles, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Number of triangles.
    pub fn face_count(&self) -> usize {
        self.triangles.len()
    }

    /// All triangles in order.
    pub fn faces(&self) -> impl Iterator<Item = FaceId> + use<> {
        (0..self.triangles.len() as u32).map(FaceId)
    }

    /// Position of a vertex, mm.
    pub fn position(&self, vertex: VertexId) -> Point3<f64> {
        self.positions[vertex.index()]
    }

    /// Corner positions of a triangle, mm.
    pub fn corners(&self, face: FaceId) -> [Point3<f64>; 3] {
        // Spelled out: `map` over the three is not unrolled.
        let [a, b, c] = self.triangles[face.index()];
        [self.positions[a as usize], self.positions[b as usize], self.positions[c as usize]]
    }

    /// The same edge seen from the neighbouring triangle.
    pub fn twin(&self, half_edge: HalfEdgeId) -> HalfEdgeId {
        HalfEdgeId(self.twins[half_edge.index()])
    }

    /// The triangle on the other side of a half-edge.
    pub fn neighbour(&self, half_edge: HalfEdgeId) -> FaceId {
        self.twin(half_edge).face()
    }

    /// The vertex a half-edge starts from.
    pub fn origin(&self, half_edge: HalfEdgeId) -> VertexId {
        VertexId(self.triangles.as_flattened()[half_edge.index()])
    }

    /// The vertex a half-edge runs to.
    pub fn target(&self, half_edge: HalfEdgeId) -> VertexId {
        self.origin(half_edge.next())
    }

    /// Twice the area of a triangle times its outward normal, mm².
    #[inline]
    pub fn doubled_area_vector(&self, face: FaceId) -> Vector3<f64> {
        let [a, b, c] = self.corners(face);
        (b - a).cross(&(c - a))
    }

    /// Area of a triangle, mm².
    pub fn face_area(&self, face: FaceId) -> f64 {
        0.5 * self.doubled_area_vector(face).norm()
    }

    /// Enclosed volume ⅙ Σ a · (b × c), mm³.
    pub fn volume(&self) -> f64 {
        let origin = self.positions.first().copied().unwrap_or_else(Point3::origin);
        self.faces()
            .map(|f| {
                let [a, b, c] = self.corners(f).map(|p| p - origin);
                a.dot(&b.cross(&c))
            })
            .sum::<f64>()
            / 6.0
    }

    /// Checks every invariant of the type.
    ///
    /// # Errors
    /// The first invariant that does not hold, with its place.
    pub fn check(&self) -> Result<(), BrokenInvariant> {
        for face in self.faces() {
            let [a, b, c] = self.triangles[face.index()];
            if [a, b, c].iter().any(|&v| v as usize >= self.positions.len()) {
                return Err(BrokenInvariant::IndexOutOfRange(face));
            }
            if a == b || b == c || c == a {
                return Err(BrokenInvariant::RepeatedCorner(face));
            }
            for h in face.half_edges() {
                self.check_twin(h)?;
            }
        }
        self.check_fans()
    }

    fn check_twin(&self, h: HalfEdgeId) -> Result<(), BrokenInvariant> {
        let t = self.twin(h);
        if t.index() >= self.twins.len() || self.twin(t) != h || t == h {
            return Err(BrokenInvariant::TwinNotMutual(h));
        }
        if self.origin(t) != self.target(h) || self.target(t) != self.origin(h) {
            return Err(BrokenInvariant::TwinNotOpposed(h));
        }
        Ok(())
    }

    fn check_fans(&self) -> Result<(), BrokenInvariant> {
        let mut corners = vec![0u32; self.positions.len()];
        let mut start = vec![u32::MAX; self.positions.len()];
        for (h, &v) in self.triangles.iter().flatten().enumerate() {
            corners[v as usize] += 1;
            start[v as usize] = h as u32;
        }
        for (v, &h) in start.iter().enumerate().filter(|(_, h)| **h != u32::MAX) {
            let fan = self.fan(HalfEdgeId(h)).count() as u32;
            if fan != corners[v] {
                return Err(BrokenInvariant::SeveralFans(VertexId::new(v)));
            }
        }
        Ok(())
    }

    /// The half-edges that leave the origin of `start`, turning counter-clockwise.
    pub fn fan(&self, start: HalfEdgeId) -> impl Iterator<Item = HalfEdgeId> + '_ {
        let mut next = Some(start);
        std::iter::from_fn(move || {
            let h = next?;
            let turned = self.twin(h.previous());
            next = (turned != start).then_some(turned);
            Some(h)
        })
    }
}
