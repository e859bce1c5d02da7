//! Places the skeletal points of a run: evenly between its hubs, each on the centroid of its own
//! section (thesis §5.2.5).

use std::f64::consts::PI;

use nalgebra::{Point3, Unit, Vector3};

use super::axis::weights;
use super::draft::{HubKind, Run};
use crate::mesh::contour::{Extent, Plane, closed_round, contour_round, entry};
use crate::mesh::id::HalfEdgeId;
use crate::mesh::{HalfEdgeMesh, Surface};
use crate::skeleton::inside::{middle_of_wall, way_inside};

/// A placed point of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) position: Point3<f64>,
    pub(crate) radius: f64,
}

/// Rounds of cutting and moving. The first brings points of the march from its lagging planes to
/// planes across the curve, the others settle; after four nothing moves by a hundredth of a radius.
const ROUNDS: usize = 4;

/// How much larger than the trend of its branch a section may be.
///
/// Up to `follow` a point moves to the centroid of its section; from `leave` on it stays where the
/// neighbours put it; between, in part, so that no step of the area makes a step of the skeleton.
#[derive(Clone, Copy)]
struct Growth {
    follow: f64,
    leave: f64,
}

/// Next to a joint a larger section holds parts of other branches, whose weight would draw the
/// point off the axis: a fillet adds a tenth, a brace that merges a half.
const AT_JOINT: Growth = Growth { follow: 1.15, leave: 1.4 };

/// Next to an interface section or a free end the whole section is the branch's own, flared or not.
const AT_END: Growth = Growth { follow: 2.5, leave: 3.5 };

/// Points between the hubs at `ends`, both left out, about `step` apart.
pub(crate) fn samples(
    surface: &Surface,
    run: &Run,
    kinds: [HubKind; 2],
    ends: [Point3<f64>; 2],
    step: f64,
) -> Vec<Sample> {
    let Some(trend) = Trend::of(run) else { return Vec::new() };
    let curve = inner_curve(surface, &base_curve(run, &trend, kinds, ends));
    let least = if run.hubs[0] == run.hubs[1] { 3 } else { 2 };
    let mut points = spaced(&curve, step, least);
    let last = points.len() - 1;
    let mut radii: Vec<f64> = (0..=last).map(|i| trend.at(i as f64 / last as f64)).collect();
    for _ in 0..ROUNDS {
        let old = points.clone();
        for i in 1..last {
            let part = i as f64 / last as f64;
            let growth = growth_at(kinds, part);
            let Some(normal) = Unit::try_new(old[i + 1] - old[i - 1], 0.0) else { continue };
            let Some(extent) = section_round(surface, run, &old[i], normal) else { continue };
            let share = growth.share(extent.area / (PI * trend.at(part).powi(2)));
            let move_by = extent.centroid - old[i];
            if move_by.norm() <= extent.radius() {
                points[i] = old[i] + move_by * share;
                radii[i] = trend.at(part) + (extent.radius() - trend.at(part)) * share;
            }
        }
    }
    (1..last)
        .map(|i| Sample { position: kept_inside(surface, points[i], curve_point(&curve, i, last)), radius: radii[i] })
        .collect()
}

/// The end that is nearer decides.
fn growth_at(kinds: [HubKind; 2], part: f64) -> Growth {
    let kind = kinds[usize::from(part > 0.5)];
    if is_bend(kind) { AT_JOINT } else { AT_END }
}

/// Whether sections next to the hub hold parts of other legs.
fn is_bend(kind: HubKind) -> bool {
    matches!(kind, HubKind::Joint | HubKind::Knee)
}

impl Growth {
    /// How far towards the centroid a point goes whose section has `growth` times the trend's area.
    fn share(self, growth: f64) -> f64 {
        ((self.leave - growth) / (self.leave - self.follow)).clamp(0.0, 1.0)
    }
}

/// Radius along a run: a line through the radii of its sections that swellings do not bend.
struct Trend {
    start: f64,
    end: f64,
}

impl Trend {
    fn of(run: &Run) -> Option<Self> {
        let weights = weights(&run.stations);
        let n = run.stations.len();
        let (mut s0, mut s1, mut s2, mut t0, mut t1) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (i, (s, w)) in run.stations.iter().zip(&weights).enumerate() {
            let x = i as f64 / (n - 1).max(1) as f64;
            (s0, s1, s2) = (s0 + w, s1 + w * x, s2 + w * x * x);
            (t0, t1) = (t0 + w * s.radius, t1 + w * x * s.radius);
        }
        if s0 == 0.0 {
            return None;
        }
        let det = s0 * s2 - s1 * s1;
        let slope = if det > 1e-6 * s0 * s0 { (s0 * t1 - s1 * t0) / det } else { 0.0 };
        let start = (t0 - slope * s1) / s0;
        let least = 0.3 * t0 / s0;
        Some(Self { start: start.max(least), end: (start + slope).max(least) })
    }

    /// Radius at a part 0..1 of the way.
    fn at(&self, part: f64) -> f64 {
        self.start + (self.end - self.start) * part
    }
}

/// The hubs and the centroids between them, without swollen ones next to joints and without those
/// a hub has moved past.
fn base_curve(
    run: &Run,
    trend: &Trend,
    kinds: [HubKind; 2],
    [start, end]: [Point3<f64>; 2],
) -> Vec<Point3<f64>> {
    let n = run.stations.len();
    let part = |i: usize| i as f64 / (n - 1).max(1) as f64;
    let swollen = |i: usize| (run.stations[i].radius / trend.at(part(i))).powi(2) > AT_JOINT.follow;
    let is_joint = kinds.map(is_bend);
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
    curve
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

/// The point if it is inside, else the place on the curve, else the middle of the nearest wall.
fn kept_inside(surface: &Surface, point: Point3<f64>, on_curve: Point3<f64>) -> Point3<f64> {
    if surface.tree.contains(&point) {
        return point;
    }
    if surface.tree.contains(&on_curve) {
        return on_curve;
    }
    middle_of_wall(&surface.mesh, &surface.tree, &point).unwrap_or(point)
}

/// Points along a polyline at equal distances near `step`, in `least` pieces at least; both ends
/// included.
fn spaced(curve: &[Point3<f64>], step: f64, least: usize) -> Vec<Point3<f64>> {
    let total: f64 = curve.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let count = ((total / step).round() as usize).max(least);
    (0..=count).map(|k| curve_point(curve, k, count)).collect()
}

/// The point `k` of `count` equal steps along a polyline.
fn curve_point(curve: &[Point3<f64>], k: usize, count: usize) -> Point3<f64> {
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

/// Sections that reach farther than this many times the last one are not the branch's own.
const REACH: f64 = 4.0;

/// The section of the branch round a point, of design faces only.
fn section_round(
    surface: &Surface,
    run: &Run,
    point: &Point3<f64>,
    normal: Unit<Vector3<f64>>,
) -> Option<Extent> {
    let plane = Plane::new(*point, normal);
    let nearest = run
        .stations
        .iter()
        .min_by(|a, b| {
            (a.centroid - point).norm_squared().total_cmp(&(b.centroid - point).norm_squared())
        })?;
    let reach = REACH * nearest.reach;
    let contour = approach(&surface.mesh, &plane, nearest.side)
        .and_then(|start| closed_round(&surface.mesh, &plane, start, reach))
        .or_else(|| contour_round(&surface.mesh, &surface.tree, &plane, reach))?;
    if contour.half_edges.iter().any(|h| !surface.labels.is_design(h.face())) {
        return None;
    }
    let extent = Extent::of(&contour, &plane);
    (extent.area > 0.0).then_some(extent)
}

/// From a side near the plane, walks over the surface to a triangle the plane cuts.
fn approach(mesh: &HalfEdgeMesh, plane: &Plane, from: HalfEdgeId) -> Option<HalfEdgeId> {
    if let Some(start) = entry(mesh, plane, from.face()) {
        return Some(start);
    }
    let height = |h: HalfEdgeId| plane.height(&mesh.position(mesh.origin(h)));
    // All corners lie on one side: walk the other way, down from above or up from below.
    let side = if height(from) >= 0.0 { 1.0 } else { -1.0 };
    let mut at = from;
    loop {
        let next = mesh.fan(at).map(|h| h.next()).fold(at, |best, h| {
            if side * height(h) < side * height(best) { h } else { best }
        });
        if next == at {
            return None;
        }
        if let Some(start) = entry(mesh, plane, next.face()) {
            return Some(start);
        }
        at = next;
    }
}
