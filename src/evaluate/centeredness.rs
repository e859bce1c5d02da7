//! The measures of all points of one skeleton, gathered.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use serde::Serialize;

use super::interfaces::median;
use super::point::PointMeasure;
use crate::skeleton_file::LineGraph;

/// Centeredness of one skeleton. E figures are over r, the radius of the bounding sphere; `None`
/// where no point could be measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Centeredness {
    /// Number of skeletal points: compactness.
    pub points: usize,
    /// Points that eq. (2.2) was evaluated at.
    pub evaluated: usize,
    /// Why the others were not.
    pub excluded: Excluded,
    /// Points outside of the object.
    pub points_outside: usize,
    /// Evaluated points with fewer than three crossings in their cube; they are in no mean.
    pub without_contour: usize,
    /// Evaluated points in whose cube the plane has crossings of several curves.
    pub mixed_contours: usize,
    /// Evaluated points whose section the cube cuts off.
    pub cut_off_contours: usize,
    /// Evaluated points on the shafts of the struts: more than 2 r_mean from a junction and 1 r_mean
    /// from an end, along the skeleton.
    pub shaft_points: usize,
    /// E_center of eq. (2.2), mean over the evaluated points.
    pub e_center: Option<f64>,
    /// The same with the sum divided by all m points: the thesis leaves open which is meant.
    pub e_center_over_all_points: Option<f64>,
    /// The largest term of the sum.
    pub e_center_max: Option<f64>,
    /// E_center of the shaft points.
    pub e_center_shaft: Option<f64>,
    /// E_center with rays cast against the real section, cut at the cube.
    pub e_true: Option<f64>,
    /// The same of the shaft points.
    pub e_true_shaft: Option<f64>,
    /// E_center with rays cast against the real section, not cut.
    pub e_true_uncapped: Option<f64>,
    /// The same of the shaft points.
    pub e_true_uncapped_shaft: Option<f64>,
    /// `e_true` over the mean strut radius instead of r.
    pub e_true_over_r_mean: Option<f64>,
    /// Hu's degree of centeredness (thesis §2.4.2.2), rays cut at the cube; 1 is best.
    pub hu_degree: Option<f64>,
    /// The same, rays not cut.
    pub hu_degree_uncapped: Option<f64>,
    /// Distance from the centroid of the section.
    pub offset: Offset,
}

/// Points that the criterion leaves out (thesis §4.4); an end may be counted twice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Excluded {
    /// Junctions: they have no direction.
    pub junctions: usize,
    /// Ends.
    pub ends: usize,
    /// Centres of interface sections.
    pub interfaces: usize,
    /// Other points inside non-design parts.
    pub in_non_design: usize,
}

/// Distance of the points from the area centroid of their section over √(A/π).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Offset {
    /// Mean.
    pub mean: Option<f64>,
    /// Largest.
    pub max: Option<f64>,
    /// Mean of the shaft points.
    pub shaft_mean: Option<f64>,
    /// Largest of the shaft points.
    pub shaft_max: Option<f64>,
    /// Median of the shaft points.
    pub shaft_median: Option<f64>,
}

/// Lengths the figures are relative to, mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Radius of the bounding sphere.
    pub(super) r: f64,
    /// Mean strut radius.
    pub(super) r_mean: f64,
}

/// Fills in all that follows from the measures of the points.
pub(super) fn gather(
    graph: &LineGraph,
    measures: &[Option<PointMeasure>],
    scale: Scale,
) -> Centeredness {
    let on_shaft = shaft(graph, scale.r_mean);
    let evaluated = || measures.iter().zip(&on_shaft).filter_map(|(m, s)| Some((m.as_ref()?, *s)));
    let all = |value: fn(&PointMeasure) -> Option<f64>| {
        evaluated().filter_map(|(m, _)| value(m)).collect::<Vec<f64>>()
    };
    let shaft = |value: fn(&PointMeasure) -> Option<f64>| {
        evaluated().filter(|e| e.1).filter_map(|(m, _)| value(m)).collect::<Vec<f64>>()
    };
    let over_r = |x: Option<f64>| x.map(|x| x / scale.r);
    let e = all(|m| m.e_center);
    Centeredness {
        points: graph.points().len(),
        evaluated: evaluated().count(),
        without_contour: evaluated().filter(|(m, _)| m.e_center.is_none()).count(),
        mixed_contours: evaluated().filter(|(m, _)| m.is_mixed).count(),
        cut_off_contours: evaluated().filter(|(m, _)| m.is_cut_off).count(),
        shaft_points: evaluated().filter(|(_, s)| *s).count(),
        e_center: over_r(mean(&e)),
        e_center_over_all_points: over_r(
            mean(&e).map(|m| m * e.len() as f64 / graph.points().len() as f64),
        ),
        e_center_max: over_r(max(&e)),
        e_center_shaft: over_r(mean(&shaft(|m| m.e_center))),
        e_true: over_r(mean(&all(|m| m.e_true))),
        e_true_shaft: over_r(mean(&shaft(|m| m.e_true))),
        e_true_uncapped: over_r(mean(&all(|m| m.e_true_uncapped))),
        e_true_uncapped_shaft: over_r(mean(&shaft(|m| m.e_true_uncapped))),
        e_true_over_r_mean: mean(&all(|m| m.e_true)).map(|x| x / scale.r_mean),
        hu_degree: hu(graph, measures, |m| m.hu_degree),
        hu_degree_uncapped: hu(graph, measures, |m| m.hu_degree_uncapped),
        offset: offset(all(|m| m.offset), shaft(|m| m.offset)),
        ..Centeredness::default()
    }
}

fn offset(all: Vec<f64>, mut shaft: Vec<f64>) -> Offset {
    shaft.sort_by(f64::total_cmp);
    Offset {
        mean: mean(&all),
        max: max(&all),
        shaft_mean: mean(&shaft),
        shaft_max: max(&shaft),
        shaft_median: median(&shaft),
    }
}

/// Hu's degree of the skeleton: the mean over its points, where a junction takes the mean of its
/// neighbours. A junction with junctions all round is left out, so that no order of points counts.
fn hu(
    graph: &LineGraph,
    measures: &[Option<PointMeasure>],
    degree: fn(&PointMeasure) -> Option<f64>,
) -> Option<f64> {
    let of_point = |p: u32| measures[p as usize].as_ref().and_then(degree);
    let of_junction = |p: u32| {
        let round = graph.neighbours(p).iter().filter_map(|n| of_point(n.point));
        mean(&round.collect::<Vec<f64>>())
    };
    let degrees = graph
        .indices()
        .filter_map(|p| if graph.degree(p) >= 3 { of_junction(p) } else { of_point(p) });
    mean(&degrees.collect::<Vec<f64>>())
}

/// Points farther than 2 r_mean from the next junction and 1 r_mean from the next end, along the
/// skeleton.
fn shaft(graph: &LineGraph, r_mean: f64) -> Vec<bool> {
    let to_junction = distances(graph, |p| graph.degree(p) >= 3);
    let to_end = distances(graph, |p| graph.degree(p) == 1);
    to_junction.iter().zip(&to_end).map(|(j, e)| *j > 2.0 * r_mean && *e > r_mean).collect()
}

/// Way along the skeleton from each point to the nearest chosen one, mm (Dijkstra).
fn distances(graph: &LineGraph, is_chosen: impl Fn(u32) -> bool) -> Vec<f64> {
    let mut distance = vec![f64::INFINITY; graph.points().len()];
    let mut queue = BinaryHeap::new();
    for p in graph.indices().filter(|&p| is_chosen(p)) {
        distance[p as usize] = 0.0;
        queue.push(Waiting { distance: 0.0, point: p });
    }
    while let Some(Waiting { distance: so_far, point }) = queue.pop() {
        if so_far > distance[point as usize] {
            continue;
        }
        for n in graph.neighbours(point) {
            let step = (graph.position(n.point) - graph.position(point)).norm();
            let known = &mut distance[n.point as usize];
            if so_far + step < *known {
                *known = so_far + step;
                queue.push(Waiting { distance: *known, point: n.point });
            }
        }
    }
    distance
}

/// A point of the queue; the nearest one comes first.
#[derive(PartialEq)]
struct Waiting {
    distance: f64,
    point: u32,
}

impl Eq for Waiting {}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        other.distance.total_cmp(&self.distance).then(other.point.cmp(&self.point))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

fn max(values: &[f64]) -> Option<f64> {
    values.iter().copied().reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::skeleton::graph::{PointKind, SkeletalPoint};
    use nalgebra::Point3;

    #[test]
    fn the_shaft_begins_two_radii_from_the_junction_and_one_from_the_end() {
        // A Y with arms along x of length 8 and two short ones.
        let mut places: Vec<[f64; 2]> = (0..=8).map(|x| [f64::from(x), 0.0]).collect();
        places.extend([[-1.0, 1.0], [-1.0, -1.0]]);
        let points = places.iter().map(|&[x, y]| SkeletalPoint {
            position: Point3::new(x, y, 0.0),
            radius: 0.0,
            kind: PointKind::Branch,
        });
        let mut segments: Vec<[u32; 2]> = (0..8).map(|p| [p, p + 1]).collect();
        segments.extend([[0, 9], [0, 10]]);
        let graph = LineGraph::new(points.collect(), segments);
        let on_shaft = shaft(&graph, 1.0);
        let chosen: Vec<u32> = graph.indices().filter(|&p| on_shaft[p as usize]).collect();
        assert_eq!(chosen, [3, 4, 5, 6]);
    }

    #[test]
    fn a_median_of_two_is_their_mean() {
        assert_eq!(median(&[1.0, 2.0]), Some(1.5));
        assert_eq!(median(&[1.0, 2.0, 7.0]), Some(2.0));
        assert_eq!(median(&[]), None);
    }
}
