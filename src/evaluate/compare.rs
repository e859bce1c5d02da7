//! How far two skeletons lie from each other (thesis §2.4.2.2).
//!
//! Eq. (2.1) gives each point x of one skeleton its distance from the other,
//! D₁₂(x) = min ‖x − y‖ over y ∈ S₂ for x ∈ S₁, as a field to be drawn in colours. Its mean along the
//! skeleton and its largest value make numbers of it; the larger of max D₁₂ and max D₂₁ is the
//! Hausdorff distance.

use nalgebra::Point3;
use serde::Serialize;

use super::curve_tree::CurveTree;
use super::error::EvaluateError;
use super::resample::check_steps;
use crate::skeleton::graph::Skeleton;
use crate::skeleton_file::LineGraph;

/// Samples along the diagonal of the bounding box of both skeletons when no step is given.
const STEPS: f64 = 1000.0;

/// Distances between two skeletons S₁ and S₂, mm.
///
/// The curves are sampled, so the largest distances may be short by half a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Comparison {
    /// Mean of D₁₂ along S₁.
    pub d12_mean: f64,
    /// Largest D₁₂: the farthest place of S₁ from S₂.
    pub d12_max: f64,
    /// Mean of D₂₁ along S₂.
    pub d21_mean: f64,
    /// Largest D₂₁.
    pub d21_max: f64,
    /// Hausdorff distance: the larger of the two.
    pub hausdorff: f64,
    /// Distance of the samples.
    pub step: f64,
}

/// Compares two skeletons.
///
/// * `step`: distance of the samples, mm; `None`: a thousandth of the diagonal of both.
///
/// # Errors
/// If `step` is no length above 0, or so small that samples would be without number.
///
/// # Examples
/// ```
/// # use beamwright::evaluate::compare;
/// # use beamwright::skeleton_file::{Format, read_bytes};
/// # use beamwright_formats::Unit;
/// # let read = |obj: &[u8]| read_bytes(obj, Format::Obj, Unit::Mm).unwrap();
/// let short = read(b"v 0 0 0\nv 10 0 0\nl 1 2\n");
/// let long = read(b"v 0 1 0\nv 14 1 0\nl 1 2\n");
/// let d = compare(&short, &long, None).unwrap();
/// assert_eq!((d.d12_max, d.d21_max), (1.0, 17f64.sqrt())); // a part is nearer than the whole
/// assert_eq!(d.hausdorff, d.d21_max);
/// ```
pub fn compare(
    first: &Skeleton,
    second: &Skeleton,
    step: Option<f64>,
) -> Result<Comparison, EvaluateError> {
    let graphs = [LineGraph::of(first), LineGraph::of(second)];
    let step = step.unwrap_or_else(|| diagonal(&graphs) / STEPS);
    if graphs.iter().all(|g| g.segments().is_empty()) {
        return Ok(Comparison { step, ..Comparison::default() });
    }
    if !(step > 0.0 && step.is_finite()) {
        return Err(EvaluateError::OutOfRange { name: "--resample", value: step });
    }
    let [(d12_mean, d12_max), (d21_mean, d21_max)] = [
        along(&graphs[0], &CurveTree::new(&graphs[1]), step)?,
        along(&graphs[1], &CurveTree::new(&graphs[0]), step)?,
    ];
    let hausdorff = d12_max.max(d21_max);
    Ok(Comparison { d12_mean, d12_max, d21_mean, d21_max, hausdorff, step })
}

/// D₁₂ at each point of the first skeleton, mm: the field that is drawn in colours.
pub fn distance_field(first: &Skeleton, second: &Skeleton) -> Vec<f64> {
    let tree = CurveTree::new(&LineGraph::of(second));
    first.points.iter().map(|p| tree.distance(&p.position)).collect()
}

fn diagonal(graphs: &[LineGraph]) -> f64 {
    let mut places = graphs.iter().flat_map(|g| g.points()).map(|p| p.position);
    let Some(first) = places.next() else { return 0.0 };
    let (low, high) = places.fold((first, first), |(l, h), p| (l.inf(&p), h.sup(&p)));
    (high - low).norm()
}

/// Mean and largest distance along a skeleton.
fn along(graph: &LineGraph, other: &CurveTree, step: f64) -> Result<(f64, f64), EvaluateError> {
    check_steps(graph, step)?;
    let (mut sum, mut farthest) = (0.0, 0.0f64);
    for &segment in graph.segments() {
        let [a, b] = graph.ends(segment);
        let length = (b - a).norm();
        let samples = (length / step).ceil().max(1.0);
        let place = |k: f64| -> Point3<f64> { a + (b - a) * (k / samples) };
        for k in 0..samples as usize {
            let distance = other.distance(&place(k as f64 + 0.5));
            sum += distance * length / samples;
            farthest = farthest.max(distance);
        }
    }
    let at_points = graph.points().iter().map(|p| other.distance(&p.position));
    farthest = at_points.fold(farthest, f64::max);
    let length = graph.length();
    Ok((if length > 0.0 { sum / length } else { 0.0 }, farthest))
}
