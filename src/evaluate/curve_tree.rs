//! Distances from a skeleton.

use nalgebra::Point3;

use crate::mesh::TriangleTree;
use crate::skeleton::graph::SkeletalPoint;
use crate::skeleton_file::LineGraph;

/// A search tree over the segments of a skeleton.
///
/// A segment is a triangle with two equal corners.
pub(super) struct CurveTree(TriangleTree);

impl CurveTree {
    pub(super) fn new(graph: &LineGraph) -> Self {
        let segments = graph.segments().iter().map(|&s| graph.ends(s));
        Self(TriangleTree::new(segments.map(|[a, b]| [a, b, b]).collect()))
    }

    /// Distance of a point from the nearest segment, mm; infinite when there is none.
    pub(super) fn distance(&self, point: &Point3<f64>) -> f64 {
        self.0.nearest(point).map_or(f64::INFINITY, |n| n.1)
    }
}

/// A search tree over the points of a skeleton: triangles with three equal corners.
pub(super) struct PointTree(TriangleTree);

impl PointTree {
    pub(super) fn new(points: &[SkeletalPoint]) -> Self {
        Self(TriangleTree::new(points.iter().map(|p| [p.position; 3]).collect()))
    }

    /// Distance of a point from the nearest skeletal point, mm; infinite when there is none.
    pub(super) fn distance(&self, point: &Point3<f64>) -> f64 {
        self.0.nearest(point).map_or(f64::INFINITY, |n| n.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::skeleton::graph::PointKind;

    #[test]
    fn the_nearest_place_may_lie_on_a_segment_or_at_its_end() {
        let points = (0..6).map(|k| SkeletalPoint {
            position: Point3::new(f64::from(k), f64::from(k % 2), 0.0),
            radius: 0.0,
            kind: PointKind::Branch,
        });
        let segments = (0..5).map(|k| [k, k + 1]).collect();
        let tree = CurveTree::new(&LineGraph::new(points.collect(), segments));
        assert!((tree.distance(&Point3::new(0.5, 0.5, 2.0)) - 2.0).abs() < 1e-12);
        assert!((tree.distance(&Point3::new(0.0, 1.0, 0.0)) - 0.5f64.sqrt()).abs() < 1e-12);
        assert!((tree.distance(&Point3::new(5.0, 4.0, 0.0)) - 3.0).abs() < 1e-12);
    }
}
