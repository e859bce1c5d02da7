//! The section of a run at a point near one of its known sections.

use nalgebra::{Point3, Unit, Vector3};

use super::draft::Run;
use crate::mesh::contour::{Extent, Plane, closed_round, contour_round, entry};
use crate::mesh::id::HalfEdgeId;
use crate::mesh::{HalfEdgeMesh, Surface};

/// Sections that reach farther than this many times the last one are not the branch's own.
const REACH: f64 = 4.0;

/// The section of the branch round a point, of design faces only.
pub(crate) fn section_round(
    surface: &Surface,
    run: &Run,
    point: &Point3<f64>,
    normal: Unit<Vector3<f64>>,
) -> Option<Extent> {
    let plane = Plane::new(*point, normal);
    let nearest = run.stations.iter().min_by(|a, b| {
        (a.centroid - point).norm_squared().total_cmp(&(b.centroid - point).norm_squared())
    })?;
    let reach = REACH * nearest.reach;
    let contour = approach(&surface.mesh, &plane, nearest.side)
        .and_then(|start| closed_round(&surface.mesh, &plane, start, reach))
        .or_else(|| contour_round(&surface.mesh, &surface.tree, &plane, reach))?;
    if contour.half_edges.iter().any(|h| !surface.labels.is_design(h.face())) {
        return None;
    }
    let extent = Extent::of(&contour, &plane);
    (extent.area > 0.0).then_some(extent)
}

/// From a side near the plane, walks over the surface to a triangle the plane cuts.
fn approach(mesh: &HalfEdgeMesh, plane: &Plane, from: HalfEdgeId) -> Option<HalfEdgeId> {
    if let Some(start) = entry(mesh, plane, from.face()) {
        return Some(start);
    }
    let height = |h: HalfEdgeId| plane.height(&mesh.position(mesh.origin(h)));
    // All corners lie on one side: walk the other way, down from above or up from below.
    let side = if height(from) >= 0.0 { 1.0 } else { -1.0 };
    let mut at = from;
    loop {
        let next = mesh
            .fan(at)
            .map(|h| h.next())
            .fold(at, |best, h| if side * height(h) < side * height(best) { h } else { best });
        if next == at {
            return None;
        }
        if let Some(start) = entry(mesh, plane, next.face()) {
            return Some(start);
        }
        at = next;
    }
}
