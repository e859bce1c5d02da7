//! How much of the design surface no branch runs under: missed struts show up here.

use nalgebra::Point3;
use serde::Serialize;

use super::curve_tree::PointTree;
use super::error::EvaluateError;
use super::resample::resample_graph;
use crate::mesh::Surface;
use crate::skeleton_file::LineGraph;

/// Surface farther than so many mean strut radii from the skeleton is not covered. The far corners of
/// a plank 5 times as wide as thick lie within it, the next strut of a frame does not.
const COVERED: f64 = 3.0;

/// The skeleton stands for itself as points so many mean strut radii apart. A distance comes out too
/// long by that: at the limit of 3 radii by 0.35 % at most.
const SPACING: f64 = 0.5;

/// Surface without a skeleton.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Coverage {
    /// Part of the area of the design surface farther than 3 r_mean from the skeleton; a triangle
    /// counts with its centroid.
    pub uncovered: f64,
    /// Largest distance of a triangle of the design surface from the skeleton over r_mean.
    pub max_distance_over_r_mean: Option<f64>,
}

impl Coverage {
    pub(super) fn of(
        graph: &LineGraph,
        surface: &Surface,
        r_mean: f64,
    ) -> Result<Self, EvaluateError> {
        if graph.segments().is_empty() {
            return Ok(Self { uncovered: 1.0, max_distance_over_r_mean: None });
        }
        let points = PointTree::new(resample_graph(graph, SPACING * r_mean)?.points());
        let (mut area, mut uncovered, mut farthest) = (0.0, 0.0, 0.0f64);
        for face in surface.mesh.faces().filter(|&f| surface.labels.is_design(f)) {
            let [a, b, c] = surface.mesh.corners(face);
            let distance = points.distance(&Point3::from((a.coords + b.coords + c.coords) / 3.0));
            let size = surface.mesh.face_area(face);
            area += size;
            farthest = farthest.max(distance);
            if distance > COVERED * r_mean {
                uncovered += size;
            }
        }
        let max_distance_over_r_mean = Some(farthest / r_mean);
        Ok(Self { uncovered: uncovered / area, max_distance_over_r_mean })
    }
}
