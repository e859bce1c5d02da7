//! How much of the skeleton leaves the object.

use nalgebra::Point3;
use serde::Serialize;

use crate::mesh::TriangleTree;
use crate::skeleton_file::LineGraph;

/// Samples per mean strut radius along the skeleton: an excursion of a fifth of a radius is seen.
const STEP: f64 = 0.2;

/// Crossings of the surface nearer to the end of a segment than this part of its length are its end
/// that lies on the surface.
const AT_END: f64 = 1e-9;

/// Length of the skeleton outside of the object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Outside {
    /// Length of the skeleton, mm.
    pub length: f64,
    /// Length outside, by samples every 0.2 r_mean, mm.
    pub length_outside: f64,
    /// The same over the length of the skeleton.
    pub fraction: f64,
    /// Segments.
    pub segments: usize,
    /// Segments that pass through the surface: exact, also for those that leave it between samples.
    pub segments_through_surface: usize,
}

impl Outside {
    pub(super) fn of(graph: &LineGraph, tree: &TriangleTree, r_mean: f64) -> Self {
        let mut outside = Self { segments: graph.segments().len(), ..Self::default() };
        for &segment in graph.segments() {
            let [a, b] = graph.ends(segment);
            let length = (b - a).norm();
            let samples = (length / (STEP * r_mean)).ceil().max(1.0);
            let is_out = |k: usize| !tree.contains(&(a + (b - a) * ((k as f64 + 0.5) / samples)));
            let out = (0..samples as usize).filter(|&k| is_out(k)).count();
            outside.length += length;
            outside.length_outside += length * out as f64 / samples;
            let inner = [AT_END, 1.0 - AT_END].map(|t| a + (b - a) * t);
            outside.segments_through_surface += usize::from(passes_through(tree, &inner));
        }
        if outside.length > 0.0 {
            outside.fraction = outside.length_outside / outside.length;
        }
        outside
    }
}

/// Whether a segment passes through the surface. One that meets an edge exactly crosses no triangle,
/// but then its ends lie on different sides.
fn passes_through(tree: &TriangleTree, [a, b]: &[Point3<f64>; 2]) -> bool {
    tree.is_crossed_by(a, b) || tree.contains(a) != tree.contains(b)
}
