//! The way of a run before its points are moved: from hub to hub over the section centroids.

use nalgebra::Point3;

use super::draft::{Hub, HubKind, Run};
use super::trend::Trend;
use crate::mesh::Surface;
use crate::skeleton::inside::way_inside;

/// Sections next to a joint that are larger than the trend by this factor of area hold parts of
/// other branches.
pub(crate) const SWOLLEN: f64 = 1.15;

/// The hubs and the centroids between them, without swollen ones next to joints and without those
/// a hub has moved past; inside the object.
pub(crate) fn base_curve(
    surface: &Surface,
    run: &Run,
    trend: &Trend,
    hubs: [&Hub; 2],
) -> Vec<Point3<f64>> {
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
    if first == last {
        // Nothing is clean: the section in the middle still says where the run passes.
        (first, last) = (n / 2, n / 2 + usize::from(n > 2));
    }
    let mut curve = vec![start];
    curve.extend(run.stations[first..last].iter().map(|s| s.centroid));
    curve.push(end);
    inner_curve(surface, &curve)
}

/// Whether sections next to the hub hold parts of other legs.
pub(crate) fn is_bend(kind: HubKind) -> bool {
    matches!(kind, HubKind::Joint | HubKind::Knee)
}

/// The curve with points put in where it would leave the object.
fn inner_curve(surface: &Surface, curve: &[Point3<f64>]) -> Vec<Point3<f64>> {
    let mut inner = vec![curve[0]];
    for pair in curve.windows(2) {
        inner.extend(way_inside(&surface.mesh, &surface.tree, &pair[0], &pair[1]));
        inner.push(pair[1]);
    }
    inner
}

/// Most pieces of one branch: a branch a thousand radii long has as many, and one that is longer
/// has long pieces instead of taking all memory.
const MOST_PIECES: f64 = 4096.0;

/// Points along a polyline at equal distances near `step`, in `least` pieces at least; both ends
/// included.
pub(crate) fn spaced(curve: &[Point3<f64>], step: f64, least: usize) -> Vec<Point3<f64>> {
    let total: f64 = curve.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let count = ((total / step).round().min(MOST_PIECES) as usize).max(least);
    (0..=count).map(|k| curve_point(curve, k, count)).collect()
}

/// The point `k` of `count` equal steps along a polyline.
pub(crate) fn curve_point(curve: &[Point3<f64>], k: usize, count: usize) -> Point3<f64> {
    let total: f64 = curve.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let mut left = total * k as f64 / count as f64;
    for pair in curve.windows(2) {
        let length = (pair[1] - pair[0]).norm();
        if left <= length && length > 0.0 {
            return pair[0] + (pair[1] - pair[0]) * (left / length);
        }
        left -= length;
    }
    curve[curve.len() - 1]
}
