//! Closed loops of edges where chosen faces end, and the plane such a loop lies about.

use nalgebra::{Point3, Vector3};

use super::half_edge::HalfEdgeMesh;
use super::id::HalfEdgeId;

/// Area vector and area centroid of a closed polygon in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LoopFrame {
    /// Area centroid, mm.
    pub(crate) centroid: Point3<f64>,
    /// Unit area vector (zero for a loop without area).
    pub(crate) normal: Vector3<f64>,
    /// Length of the area vector, mm².
    pub(crate) area: f64,
}

impl LoopFrame {
    /// ½ Σ (pᵢ − m) × (pᵢ₊₁ − m) about the mean point m, and the centroid of the fan seen along it.
    pub(crate) fn of(points: &[Point3<f64>]) -> Self {
        let n = points.len();
        let mean = Point3::from(points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / n as f64);
        let pieces = (0..n).map(|i| (points[i] - mean, points[(i + 1) % n] - mean));
        let vector: Vector3<f64> = pieces.clone().map(|(a, b)| a.cross(&b) / 2.0).sum();
        let area = vector.norm();
        if area == 0.0 {
            return Self { centroid: mean, normal: Vector3::zeros(), area };
        }
        let normal = vector / area;
        let moment: Vector3<f64> =
            pieces.map(|(a, b)| (a + b) / 3.0 * (a.cross(&b).dot(&normal) / 2.0)).sum();
        Self { centroid: mean + moment / area, normal, area }
    }
}

/// Closed loops of half-edges whose own face is chosen and whose twin's face is not.
///
/// At a vertex where several loops touch, each turns through the chosen faces, so loops never
/// cross.
pub(super) fn border_loops(
    mesh: &HalfEdgeMesh,
    chosen: impl Fn(HalfEdgeId) -> bool,
) -> Vec<Vec<HalfEdgeId>> {
    let on_border = |h: HalfEdgeId| chosen(h) && !chosen(mesh.twin(h));
    let mut seen = vec![false; 3 * mesh.face_count()];
    let mut loops = Vec::new();
    for start in mesh.faces().flat_map(|f| f.half_edges()) {
        if seen[start.index()] || !on_border(start) {
            continue;
        }
        let mut border = Vec::new();
        let mut at = start;
        while !std::mem::replace(&mut seen[at.index()], true) {
            border.push(at);
            at = at.next();
            while !on_border(at) {
                at = mesh.twin(at).next();
            }
        }
        loops.push(border);
    }
    loops
}
