//! Points at equal spacing, so that skeletons of few and of many points compare.

use nalgebra::Point3;

use super::error::EvaluateError;
use crate::skeleton::graph::{PointKind, SkeletalPoint, Skeleton};
use crate::skeleton_file::LineGraph;

/// Most points made: a lattice of a hundred thousand struts has fewer.
pub(super) const MOST_STEPS: usize = 2_000_000;

/// A ring keeps at least so many points: with fewer it would vanish.
const RING: usize = 3;

/// Divides every branch into equal steps along its way, as near to `step` as they fit.
///
/// Junctions, ends and centres of interface sections stay where they are.
///
/// # Errors
/// If `step` is no length above 0, or so small that points would be without number.
///
/// # Examples
/// ```
/// # use beamwright::evaluate::resample;
/// # use beamwright::skeleton_file::{Format, read_bytes};
/// # use beamwright_formats::Unit;
/// let line = read_bytes(b"v 0 0 0\nv 7 0 0\nl 1 2\n", Format::Obj, Unit::Mm).unwrap();
/// assert_eq!(resample(&line, 2.0).unwrap().points.len(), 5); // 4 steps of 1.75 mm
/// ```
pub fn resample(skeleton: &Skeleton, step: f64) -> Result<Skeleton, EvaluateError> {
    if !(step > 0.0 && step.is_finite()) {
        return Err(EvaluateError::OutOfRange { name: "--resample", value: step });
    }
    Ok(resample_graph(&LineGraph::of(skeleton), step)?.to_skeleton())
}

/// Refuses what would take more than [`MOST_STEPS`].
pub(super) fn check_steps(graph: &LineGraph, step: f64) -> Result<(), EvaluateError> {
    let length = graph.length();
    if length / step > MOST_STEPS as f64 {
        return Err(EvaluateError::TooLong { length, step, limit: MOST_STEPS });
    }
    Ok(())
}

pub(super) fn resample_graph(graph: &LineGraph, step: f64) -> Result<LineGraph, EvaluateError> {
    check_steps(graph, step)?;
    let mut even = Even { graph, points: Vec::new(), segments: Vec::new(), number: Vec::new() };
    even.number.resize(graph.points().len(), None);
    for chain in graph.chains() {
        even.add(&chain, step);
    }
    Ok(LineGraph::new(even.points, even.segments))
}

/// The graph under construction; its points are numbered as they are met.
struct Even<'a> {
    graph: &'a LineGraph,
    points: Vec<SkeletalPoint>,
    segments: Vec<[u32; 2]>,
    /// New number of each point that stays.
    number: Vec<Option<u32>>,
}

impl Even<'_> {
    fn add(&mut self, chain: &[u32], step: f64) {
        let way = Way::of(self.graph, chain);
        let [start, end] = [chain[0], chain[chain.len() - 1]];
        let least = if start == end { RING } else { 1 };
        let steps = ((way.length() / step).round() as usize).max(least);
        let mut before = self.keep(start);
        for k in 1..steps {
            let new = self.push(way.at(way.length() * k as f64 / steps as f64));
            self.segments.push([before, new]);
            before = new;
        }
        let last = self.keep(end);
        self.segments.push([before, last]);
    }

    fn keep(&mut self, point: u32) -> u32 {
        self.number[point as usize].unwrap_or_else(|| {
            let new = self.push(self.graph.points()[point as usize]);
            self.number[point as usize] = Some(new);
            new
        })
    }

    fn push(&mut self, point: SkeletalPoint) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }
}

/// A chain with the way to each of its points.
struct Way {
    points: Vec<SkeletalPoint>,
    /// Length up to each point, mm.
    lengths: Vec<f64>,
}

impl Way {
    fn of(graph: &LineGraph, chain: &[u32]) -> Self {
        let points: Vec<SkeletalPoint> =
            chain.iter().map(|&p| graph.points()[p as usize]).collect();
        let mut lengths = vec![0.0];
        for pair in points.windows(2) {
            let so_far = lengths[lengths.len() - 1];
            lengths.push(so_far + (pair[1].position - pair[0].position).norm());
        }
        Self { points, lengths }
    }

    fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// The point at a length along the way.
    fn at(&self, length: f64) -> SkeletalPoint {
        let after = self.lengths.partition_point(|&l| l < length).clamp(1, self.points.len() - 1);
        let [from, to] = [after - 1, after].map(|k| (self.lengths[k], self.points[k]));
        let t = (length - from.0) / (to.0 - from.0);
        let position: Point3<f64> = from.1.position + (to.1.position - from.1.position) * t;
        let radius = from.1.radius + (to.1.radius - from.1.radius) * t;
        SkeletalPoint { position, radius, kind: PointKind::Branch }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::skeleton_file::{Format, read_bytes};
    use beamwright_formats::Unit;

    fn skeleton(obj: &str) -> Skeleton {
        read_bytes(obj.as_bytes(), Format::Obj, Unit::Mm).unwrap()
    }

    #[test]
    fn a_t_keeps_its_junction_and_its_length() {
        let t = skeleton("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 2 -3 0\nl 1 2 3 4\nl 3 5\n");
        let even = resample(&t, 0.5).unwrap();
        assert_eq!(even.points.len(), 1 + 4 + 2 + 6);
        let length = |s: &Skeleton| s.branches.iter().map(|b| s.length(b)).sum::<f64>();
        assert!((length(&even) - length(&t)).abs() < 1e-12);
        assert_eq!(even.count(PointKind::Junction), 1);
    }

    #[test]
    fn a_ring_stays_a_ring_however_long_the_step() {
        let ring = skeleton("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nl 1 2 3 4 1\n");
        let even = resample(&ring, 100.0).unwrap();
        assert_eq!((even.points.len(), even.cycle_rank()), (3, 1));
    }

    #[test]
    fn a_step_without_number_is_refused() {
        let line = skeleton("v 0 0 0\nv 1 0 0\nl 1 2\n");
        assert!(matches!(resample(&line, 1e-9), Err(EvaluateError::TooLong { .. })));
        assert!(matches!(resample(&line, f64::NAN), Err(EvaluateError::OutOfRange { .. })));
    }
}
