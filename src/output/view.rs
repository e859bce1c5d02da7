//! What pictures, 3D files and the report show of a result.

use nalgebra::Point3;

use super::assembly::mark;
use super::mesh_export::{PartMesh, part_meshes};
use super::step::Document;
use crate::frame::{Frame, Section};
use crate::mesh::Surface;
use crate::skeleton::Skeleton;

/// A result with its beams as triangles.
pub struct View<'a> {
    /// The input mesh.
    pub surface: &'a Surface,
    /// Its skeleton.
    pub skeleton: &'a Skeleton,
    /// The section at each skeletal point.
    pub sections: &'a [Option<Section>],
    /// The straight beams.
    pub frame: &'a Frame,
    /// All bodies of the document as triangles.
    pub parts: Vec<PartMesh>,
}

impl<'a> View<'a> {
    /// Triangulates the parts of a document of the frame.
    pub fn new(
        surface: &'a Surface,
        skeleton: &'a Skeleton,
        sections: &'a [Option<Section>],
        frame: &'a Frame,
        document: &Document,
    ) -> Self {
        Self { surface, skeleton, sections, frame, parts: part_meshes(document) }
    }

    /// The triangles of each beam; `None` for a beam without a body.
    pub fn beam_meshes(&self) -> Vec<Option<&PartMesh>> {
        (0..self.frame.beams.len())
            .map(|i| {
                let wanted = mark(i);
                self.parts.iter().find(|p| p.name.split(' ').next() == Some(&wanted))
            })
            .collect()
    }

    /// Lowest and highest corner of the mesh, mm.
    pub fn bounds(&self) -> (Point3<f64>, Point3<f64>) {
        bounds(self.surface.mesh.positions())
    }
}

/// Lowest and highest corner of a box round points; the origin twice where there are none.
pub(super) fn bounds(points: &[Point3<f64>]) -> (Point3<f64>, Point3<f64>) {
    let first = points.first().copied().unwrap_or_else(Point3::origin);
    points.iter().fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)))
}
