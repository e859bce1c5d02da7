//! The way of a run before its points are moved: from hub to hub over the section centroids.

use nalgebra::Point3;

use super::draft::{Hub, HubKind, Run, Station};
use super::trend::Trend;
use crate::mesh::Surface;
use crate::observer::Observer;
use crate::skeleton::error::SkeletonError;
use crate::skeleton::inside::way_inside;
use crate::skeleton::watch::Watch;

/// Sections next to a joint that are larger than the trend by this factor of area hold parts of
/// other branches.
pub(crate) const SWOLLEN: f64 = 1.15;

/// The hubs and the centroids between them, without swollen ones next to joints and without those
/// a hub has moved past; inside the object. `straight` says from which stations the way to the next is
/// known to be.
pub(crate) fn base_curve(
    surface: &Surface,
    run: &Run,
    trend: &Trend,
    hubs: [&Hub; 2],
    straight: &mut Vec<bool>,
    watch: &mut Watch<'_, impl Observer>,
) -> Result<Vec<Point3<f64>>, SkeletonError> {
    let [start, end] = hubs.map(|h| h.position);
    let n = run.stations.len();
    let part = |i: usize| i as f64 / (n - 1).max(1) as f64;
    let swollen = |i: usize| (run.stations[i].radius / trend.at(part(i))).powi(2) > SWOLLEN;
    let is_joint = hubs.map(|h| is_bend(h.kind));
    let passed = |i: usize, hub: &Point3<f64>, sense: f64| {
        let s = &run.stations[i];
        sense * (s.centroid - hub).dot(&s.direction) < 0.5 * s.radius
    };
    let mut first = 0;
    while first < n && ((is_joint[0] && swollen(first)) || passed(first, &start, 1.0)) {
        first += 1;
    }
    let mut last = n;
    while last > first && ((is_joint[1] && swollen(last - 1)) || passed(last - 1, &end, -1.0)) {
        last -= 1;
    }
    let mut curve = vec![start];
    if first == last && run.is_loop() {
        // Over both sides of the section in the middle: a way to and fro is no loop.
        if let Some(Station { centroid, direction, radius, .. }) = run.stations.get(n / 2) {
            curve.extend([-0.5, 0.5].map(|side| centroid + **direction * (side * radius)));
        }
        curve.push(end);
        return Ok(curve);
    }
    if first == last {
        // Nothing is clean: the section in the middle still says where the run passes.
        (first, last) = (n / 2, n / 2 + usize::from(n > 2));
    }
    let stride = (last - first).div_ceil(MOST_ON_CURVE).max(1);
    straight.resize(n, false);
    for i in (first..last).step_by(stride) {
        let is_known = stride == 1 && i > first && straight[i - 1];
        let is_straight = is_known || go_on(surface, &mut curve, &run.stations[i].centroid, watch)?;
        curve.push(run.stations[i].centroid);
        if stride == 1 && i > first {
            straight[i - 1] = is_straight;
        }
    }
    go_on(surface, &mut curve, &end, watch)?;
    curve.push(end);
    Ok(curve)
}

/// Whether sections next to the hub hold parts of other legs.
pub(crate) fn is_bend(kind: HubKind) -> bool {
    matches!(kind, HubKind::Joint | HubKind::Knee)
}

/// Puts in points where the way from the end of a curve to the next place would leave the object;
/// whether none were needed.
fn go_on(
    surface: &Surface,
    curve: &mut Vec<Point3<f64>>,
    next: &Point3<f64>,
    watch: &mut Watch<'_, impl Observer>,
) -> Result<bool, SkeletonError> {
    watch.keep_on()?;
    let between = way_inside(surface, &curve[curve.len() - 1], next, watch)?;
    let is_straight = between.is_empty();
    curve.extend(between);
    Ok(is_straight)
}

/// Most pieces of one branch: a branch a thousand radii long has as many, and one that is longer
/// has long pieces instead of taking all memory.
pub(crate) const MOST_PIECES: f64 = 4096.0;

/// Most centroids the way of one branch is taken from: two for every piece.
const MOST_ON_CURVE: usize = 2 * MOST_PIECES as usize;

/// A polyline and the lengths of its segments.
pub(crate) struct Polyline<'a> {
    points: &'a [Point3<f64>],
    lengths: Vec<f64>,
    total: f64,
    /// Way to every point of a polyline of more than [`SHORT`] segments, mm.
    way: Vec<f64>,
}

/// Segments that are counted off one by one, as many as a branch of a thousand radii has.
const SHORT: usize = 1024;

impl<'a> Polyline<'a> {
    pub(crate) fn through(points: &'a [Point3<f64>]) -> Self {
        let lengths: Vec<f64> = points.windows(2).map(|w| (w[1] - w[0]).norm()).collect();
        let total = lengths.iter().sum();
        let way = if lengths.len() > SHORT { way_to_each(points) } else { Vec::new() };
        Self { points, lengths, total, way }
    }

    /// The point `k` of `count` equal steps.
    pub(crate) fn point(&self, k: usize, count: usize) -> Point3<f64> {
        let mut left = self.total * k as f64 / count as f64;
        let first = self.way.partition_point(|w| *w < left).saturating_sub(1);
        left -= self.way.get(first).copied().unwrap_or(0.0);
        for (pair, &length) in self.points.windows(2).zip(&self.lengths).skip(first) {
            if left <= length && length > 0.0 {
                return pair[0] + (pair[1] - pair[0]) * (left / length);
            }
            left -= length;
        }
        self.points[self.points.len() - 1]
    }

    /// The ends of `count` equal steps, the first and the last point included.
    pub(crate) fn spaced(&self, count: usize) -> Vec<Point3<f64>> {
        (0..=count).map(|k| self.point(k, count)).collect()
    }
}

/// Way along a polyline from its first point to every point.
pub(crate) fn way_to_each<'a>(points: impl IntoIterator<Item = &'a Point3<f64>>) -> Vec<f64> {
    let mut points = points.into_iter();
    let Some(mut last) = points.next() else { return Vec::new() };
    let mut way = vec![0.0];
    let mut at = 0.0;
    for point in points {
        at += (point - last).norm();
        way.push(at);
        last = point;
    }
    way
}

/// Points along a polyline at equal distances near `step`, in `least` pieces at least; both ends
/// included.
pub(crate) fn spaced(curve: &[Point3<f64>], step: f64, least: usize) -> Vec<Point3<f64>> {
    let curve = Polyline::through(curve);
    let count = ((curve.total / step).round().min(MOST_PIECES) as usize).max(least);
    curve.spaced(count)
}
