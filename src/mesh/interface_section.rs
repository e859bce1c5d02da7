//! Interface sections (thesis §3.4.1.2): the loops between design and non-design faces.
//!
//! A loop runs with the design faces on its left, so its area vector points into the design part.
//! Where it does not, the loop is the rim of a hole through the part (a bolt hole whose wall is
//! non-design): no branch starts in the empty middle of a hole.

use nalgebra::{Matrix3, Point3, Vector3};

use super::border::{LoopFrame, border_loops};
use super::half_edge::HalfEdgeMesh;
use super::id::{HalfEdgeId, SetId};
use super::label::Label;
use super::set::Labels;
use super::triangle_tree::TriangleTree;

/// A closed loop of edges between the design part and one non-design set.
#[derive(Clone, Debug, PartialEq)]
pub struct InterfaceSection {
    /// Sides of design faces, in order; the design part is on the left.
    pub half_edges: Vec<HalfEdgeId>,
    /// The set beyond the loop.
    pub set: SetId,
    /// Area centroid of the loop, mm: the non-design skeletal point.
    pub centroid: Point3<f64>,
    /// Unit area vector: points into the design part.
    pub normal: Vector3<f64>,
    /// Enclosed area, mm².
    pub area: f64,
    /// What the loop surrounds.
    pub kind: InterfaceKind,
}

/// What an interface loop surrounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InterfaceKind {
    /// Material: a branch begins here.
    Section,
    /// The opening of a hole whose wall is non-design.
    Rim,
}

impl InterfaceSection {
    /// Radius of the disc of equal area, mm.
    pub fn radius(&self) -> f64 {
        (self.area / std::f64::consts::PI).sqrt()
    }

    /// How far along a line its nearest crossing with the cap of the loop lies, in lengths of
    /// `along`; the cap is the fan of triangles from the centroid. A loop that winds round the
    /// corner of a pad has the design part reach farther on one side than on the other.
    pub(crate) fn way_to_cap(
        &self,
        mesh: &HalfEdgeMesh,
        from: &Point3<f64>,
        along: &Vector3<f64>,
    ) -> Option<f64> {
        let corner = |h: &HalfEdgeId| mesh.position(mesh.origin(*h));
        let ends = self.half_edges.iter().cycle().skip(1);
        let crossings = self.half_edges.iter().zip(ends).filter_map(|(a, b)| {
            let (u, v) = (corner(a) - self.centroid, corner(b) - self.centroid);
            // from + t along = centroid + p u + q v
            let columns = Matrix3::from_columns(&[-along, u, v]);
            let found = columns.try_inverse()? * (from - self.centroid);
            let (p, q) = (found.y, found.z);
            (p >= 0.0 && q >= 0.0 && p + q <= 1.0).then_some(found.x)
        });
        crossings.min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }
}

/// The interface section whose centre lies nearest to a place, by its number.
pub(crate) fn nearest_section(sections: &[InterfaceSection], place: &Point3<f64>) -> Option<usize> {
    let squared = |i: usize| (sections[i].centroid - place).norm_squared();
    (0..sections.len()).min_by(|&a, &b| squared(a).total_cmp(&squared(b)))
}

/// All interface sections of a labelled mesh, in the order of their first half-edge.
pub fn interface_sections(
    mesh: &HalfEdgeMesh,
    labels: &Labels,
    tree: &TriangleTree,
) -> Vec<InterfaceSection> {
    let loops = border_loops(mesh, |h| labels.is_design(h.face()));
    loops
        .into_iter()
        .filter_map(|half_edges| {
            let points: Vec<_> =
                half_edges.iter().map(|&h| mesh.position(mesh.origin(h))).collect();
            let Label::NonDesign(set) = labels.of_face[mesh.neighbour(half_edges[0]).index()]
            else {
                return None;
            };
            let LoopFrame { centroid, normal, area } = LoopFrame::of(&points);
            let kind = kind_of(&points, &centroid, &normal, area, tree);
            Some(InterfaceSection { half_edges, set, centroid, normal, area, kind })
        })
        .collect()
}

/// How far in front of a loop, in its radii, the material is looked for. Below, wavy loops hide it;
/// above, the far side of a thin plate is reached.
const LOOK_AHEAD: f64 = 0.05;

/// Material in front of most of the loop's inner side means a section, void a rim.
fn kind_of(
    points: &[Point3<f64>],
    centroid: &Point3<f64>,
    normal: &Vector3<f64>,
    area: f64,
    tree: &TriangleTree,
) -> InterfaceKind {
    let ahead = normal * (LOOK_AHEAD * (area / std::f64::consts::PI).sqrt());
    let stride = points.len().div_ceil(16);
    let samples = points.iter().step_by(stride);
    let (mut inside, mut all) = (0, 0);
    for p in samples {
        all += 1;
        // A third of the way inwards: clear of the surface, still on this loop's side.
        inside += usize::from(tree.contains(&(p + (centroid - p) / 3.0 + ahead)));
    }
    if 2 * inside >= all { InterfaceKind::Section } else { InterfaceKind::Rim }
}
