//! Places the skeletal points of a run: evenly between its hubs, each on the centroid of its own
//! section (thesis §5.2.5).

use nalgebra::{Point3, Unit, Vector3};

use super::draft::{Run, Station};
use crate::mesh::contour::{Contour, Extent, Plane, entry, follow};
use crate::mesh::id::HalfEdgeId;
use crate::mesh::{HalfEdgeMesh, Surface};

/// A placed point of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) position: Point3<f64>,
    pub(crate) radius: f64,
}

/// Rounds of cutting and moving. The first brings points of the march from its lagging planes to
/// planes across the curve, the second settles; more change less than a hundredth of a radius.
const ROUNDS: usize = 4;

/// A section belongs to the branch up to this many times its median area: more is the junction.
const LARGEST_AREA: f64 = 2.0;
const STAR: bool = false;
const EQ: bool = false;

/// Points between the hubs at `start` and `end`, both left out.
pub(crate) fn samples(
    surface: &Surface,
    run: &Run,
    [start, end]: [Point3<f64>; 2],
    step: f64,
    neighbourhood: f64,
) -> Vec<Sample> {
    let radius = run.radius();
    if radius == 0.0 {
        return Vec::new();
    }
    let curve = base_curve(run, start, end, radius);
    let mut points = spaced(&curve, step);
    let mut radii = vec![radius; points.len()];
    for _ in 0..ROUNDS {
        if EQ { let n = points.len() - 1; points = spaced_n(&points, n); }
        let old = points.clone();
        let last = old.len() - 1;
        for i in 1..last {
            let Some(normal) = Unit::try_new(old[i + 1] - old[i - 1], 0.0) else { continue };
            let own = section_round(surface, run, &old[i], normal).filter(|extent| {
                let moved = (extent.centroid - old[i]).norm();
                extent.area <= LARGEST_AREA * radius * radius * std::f64::consts::PI
                    && moved <= extent.radius()
            });
            if let Some(extent) = own {
                points[i] = extent.centroid;
                radii[i] = extent.radius();
            } else {
                if STAR { points[i] = star_centroid(surface, &Plane::new(old[i], normal), neighbourhood); }
            }
        }
    }
    let inner = 1..points.len() - 1;
    inner.map(|i| Sample { position: points[i], radius: radii[i] }).collect()
}

/// The centroids between the hubs, without those a hub has moved past.
fn base_curve(run: &Run, start: Point3<f64>, end: Point3<f64>, radius: f64) -> Vec<Point3<f64>> {
    let keep = |s: &&Station| {
        let (from, to) = (s.centroid - start, end - s.centroid);
        let clear = 0.5 * radius;
        from.dot(&s.direction) > clear.min(0.2 * (end - start).norm())
            && to.dot(&s.direction) > clear.min(0.2 * (end - start).norm())
            || run.hubs[0] == run.hubs[1]
            || (from.norm() > 3.0 * radius && to.norm() > 3.0 * radius)
    };
    let mut curve = vec![start];
    curve.extend(run.stations.iter().filter(keep).map(|s| s.centroid));
    curve.push(end);
    curve
}

/// Points along a polyline at equal distances near `step`; both ends included.
fn spaced(curve: &[Point3<f64>], step: f64) -> Vec<Point3<f64>> {
    let lengths: Vec<f64> = curve.windows(2).map(|w| (w[1] - w[0]).norm()).collect();
    let total: f64 = lengths.iter().sum();
    spaced_n(curve, ((total / step).round() as usize).max(1))
}
fn spaced_n(curve: &[Point3<f64>], count: usize) -> Vec<Point3<f64>> {
    let lengths: Vec<f64> = curve.windows(2).map(|w| (w[1] - w[0]).norm()).collect();
    let total: f64 = lengths.iter().sum();
    let mut points = vec![curve[0]];
    let (mut segment, mut passed) = (0, 0.0);
    for k in 1..count {
        let at = total * k as f64 / count as f64;
        while segment + 1 < lengths.len() && passed + lengths[segment] < at {
            passed += lengths[segment];
            segment += 1;
        }
        let t = if lengths[segment] > 0.0 { (at - passed) / lengths[segment] } else { 0.0 };
        points.push(curve[segment] + (curve[segment + 1] - curve[segment]) * t.clamp(0.0, 1.0));
    }
    points.push(curve[curve.len() - 1]);
    points
}

/// The section of the branch round a point.
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
    let limit = 4.0 * nearest.reach;
    let mut contour = Contour::default();
    let mut try_from = |start: HalfEdgeId| {
        let fits =
            follow(&surface.mesh, &plane, start, &mut contour, |p| (p - point).norm() <= limit);
        if !fits || contour.points.len() < 3 || !encloses(&contour, &plane, point) {
            return None;
        }
        if contour.half_edges.iter().any(|h| !surface.labels.is_design(h.face())) { return None; }
        let extent = Extent::of(&contour, &plane);
        (extent.area > 0.0).then_some(extent)
    };
    approach(&surface.mesh, &plane, nearest.side)
        .and_then(&mut try_from)
        .or_else(|| ray_start(surface, &plane, limit).and_then(&mut try_from))
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

/// A side of the contour met first by a ray in the plane.
fn ray_start(surface: &Surface, plane: &Plane, limit: f64) -> Option<HalfEdgeId> {
    let (u, v) = plane.axes();
    let reach = plane.point + (u * 0.8 + v * 0.6) * limit;
    let hit = surface.tree.first_crossing(&plane.point, &reach)?;
    entry(&surface.mesh, plane, crate::mesh::id::FaceId(hit.face))
}

/// Whether the contour winds round a point of its plane.
fn encloses(contour: &Contour, plane: &Plane, point: &Point3<f64>) -> bool {
    let (u, v) = plane.axes();
    let flat = |p: &Point3<f64>| ((p - point).dot(&u), (p - point).dot(&v));
    let mut inside = false;
    let mut a = flat(&contour.points[contour.points.len() - 1]);
    for p in &contour.points {
        let b = flat(p);
        if (a.1 > 0.0) != (b.1 > 0.0) && a.0 + a.1 / (a.1 - b.1) * (b.0 - a.0) > 0.0 {
            inside = !inside;
        }
        a = b;
    }
    inside
}

/// Centroid of what is seen from a point in its plane, up to `reach`.
fn star_centroid(surface: &Surface, plane: &Plane, reach: f64) -> Point3<f64> {
    const RAYS: usize = 36;
    let (u, v) = plane.axes();
    let seen: Vec<Vector3<f64>> = (0..RAYS)
        .map(|k| {
            let angle = std::f64::consts::TAU * k as f64 / RAYS as f64;
            let ray = (u * angle.cos() + v * angle.sin()) * reach;
            let hit = surface.tree.first_crossing(&plane.point, &(plane.point + ray));
            ray * hit.map_or(1.0, |h| h.at)
        })
        .collect();
    let (mut area, mut moment) = (0.0, Vector3::zeros());
    for k in 0..RAYS {
        let (a, b) = (seen[k], seen[(k + 1) % RAYS]);
        let w = a.cross(&b).dot(&plane.normal);
        area += w;
        moment += (a + b) / 3.0 * w;
    }
    if area > 0.0 { plane.point + moment / area } else { plane.point }
}
