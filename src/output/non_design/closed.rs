//! Non-design sets as closed bodies: open where the design touched them, closed over there.

use nalgebra::{Point2, Point3, Vector3};
use rustc_hash::FxHashMap;

use crate::mesh::id::{HalfEdgeId, SetId};
use crate::mesh::interface_section::InterfaceKind;
use crate::mesh::label::Label;
use crate::mesh::{InterfaceSection, Surface};
use crate::output::cap::{Ring, cap};

/// A closed body of triangles; side `3 t + k` runs from corner k of triangle t to the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Closed {
    pub(super) points: Vec<Point3<f64>>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The same edge seen from the other triangle.
    pub(super) twins: Vec<u32>,
}

impl Closed {
    /// Twice the area of a triangle times its outward normal, mm².
    pub(super) fn doubled_area_vector(&self, t: usize) -> Vector3<f64> {
        let [a, b, c] = self.triangles[t].map(|v| self.points[v as usize]);
        (b - a).cross(&(c - a))
    }

    /// Enclosed volume, mm³; negative where the surface is the wall of a hole.
    pub(super) fn volume(&self) -> f64 {
        let origin = self.points.first().copied().unwrap_or_else(Point3::origin);
        let part = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| self.points[v as usize] - origin);
            a.dot(&b.cross(&c)) / 6.0
        };
        self.triangles.iter().map(part).sum()
    }

    /// Largest distance of a coordinate from the origin, mm.
    pub(super) fn reach(&self) -> f64 {
        self.points.iter().map(|p| p.coords.amax()).fold(0.0, f64::max)
    }
}

/// The bodies of a set, in the order of their first triangle; `None` if it does not close up.
pub(super) fn bodies_of(surface: &Surface, set: SetId) -> Option<Vec<Closed>> {
    let mesh = &surface.mesh;
    let mut points = mesh.positions().to_vec();
    let labels = &surface.labels.of_face;
    let mut triangles: Vec<[u32; 3]> = mesh
        .triangles()
        .iter()
        .zip(labels)
        .filter(|(_, label)| **label == Label::NonDesign(set))
        .map(|(t, _)| *t)
        .collect();
    let loops: Vec<&InterfaceSection> =
        surface.interfaces.iter().filter(|i| i.set == set).collect();
    for lid in lids(&loops) {
        close_over(surface, &lid, &mut points, &mut triangles);
    }
    of_triangles(&points, &triangles)
}

/// The closed bodies that triangles bound; `None` if a side of one has no partner.
pub(super) fn of_triangles(points: &[Point3<f64>], triangles: &[[u32; 3]]) -> Option<Vec<Closed>> {
    Some(separate(points, triangles, &twins(triangles)?))
}

/// Which loops are closed by one lid: a section, with the rims of holes that open in it.
fn lids<'a>(loops: &[&'a InterfaceSection]) -> Vec<Vec<&'a InterfaceSection>> {
    let is_section = |i: &&InterfaceSection| i.kind == InterfaceKind::Section;
    let (sections, rims): (Vec<_>, Vec<_>) = loops.iter().copied().partition(is_section);
    let mut lids: Vec<Vec<&InterfaceSection>> = sections.into_iter().map(|s| vec![s]).collect();
    for rim in rims {
        match lids.iter_mut().find(|lid| opens_in(rim, lid[0])) {
            Some(lid) => lid.push(rim),
            None => lids.push(vec![rim]),
        }
    }
    lids
}

/// How far, in radii of a section, the rim of a hole in it may lie off its plane.
const SAME_PLANE: f64 = 1e-3;

fn opens_in(rim: &InterfaceSection, section: &InterfaceSection) -> bool {
    let off = rim.centroid - section.centroid;
    let radius = section.radius();
    rim.normal.dot(&section.normal) < SAME_PLANE - 1.0
        && off.dot(&section.normal).abs() < SAME_PLANE * radius
        && off.norm() < radius
        && rim.area < section.area
}

/// Adds the triangles of a lid: flat over its loops, or a fan round the middle of each where they
/// are too wavy to be seen as flat outlines.
fn close_over(
    surface: &Surface,
    lid: &[&InterfaceSection],
    points: &mut Vec<Point3<f64>>,
    triangles: &mut Vec<[u32; 3]>,
) {
    let mesh = &surface.mesh;
    let corners = |i: &InterfaceSection| -> Vec<u32> {
        i.half_edges.iter().map(|&h: &HalfEdgeId| mesh.origin(h).0).collect()
    };
    let (u, v) = across(&lid[0].normal);
    let origin = lid[0].centroid;
    let rings: Vec<Vec<u32>> = lid.iter().map(|i| corners(i)).collect();
    let seen = |&c: &u32| {
        let p = points[c as usize] - origin;
        Point2::new(p.dot(&u), p.dot(&v))
    };
    let flat: Vec<Ring> = rings.iter().map(|r| r.iter().map(seen).collect()).collect();
    if let Some(lid) = cap(&flat) {
        let all = rings.concat();
        triangles.extend(lid.iter().map(|t| t.map(|i| all[i as usize])));
        return;
    }
    for (ring, section) in rings.iter().zip(lid) {
        let middle = points.len() as u32;
        points.push(section.centroid);
        let next = ring.iter().cycle().skip(1);
        triangles.extend(ring.iter().zip(next).map(|(&a, &b)| [a, b, middle]));
    }
}

/// Two unit vectors across `normal`, right-handed with it.
fn across(normal: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let mut other = Vector3::zeros();
    other[normal.iamin()] = 1.0;
    let u = normal.cross(&other).normalize();
    (u, normal.cross(&u))
}

/// Pairs the sides of triangles; `None` if one has no partner.
fn twins(triangles: &[[u32; 3]]) -> Option<Vec<u32>> {
    let sides = || triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut open: FxHashMap<(u32, u32), Vec<u32>> = FxHashMap::default();
    for (h, side) in (0u32..).zip(sides()) {
        open.entry(side).or_default().push(h);
    }
    let mut twins = vec![u32::MAX; 3 * triangles.len()];
    for (h, (a, b)) in sides().enumerate() {
        if twins[h] == u32::MAX {
            let other = open.get_mut(&(b, a)).and_then(Vec::pop)?;
            twins[h] = other;
            twins[other as usize] = h as u32;
            open.get_mut(&(a, b))?.retain(|&own| own as usize != h);
        }
    }
    Some(twins)
}

/// Connected bodies, with a point of its own for every fan of triangles.
fn separate(points: &[Point3<f64>], triangles: &[[u32; 3]], twins: &[u32]) -> Vec<Closed> {
    let mut body_of = vec![usize::MAX; triangles.len()];
    let mut bodies = Vec::new();
    for seed in 0..triangles.len() {
        if body_of[seed] != usize::MAX {
            continue;
        }
        body_of[seed] = bodies.len();
        let mut members = vec![seed];
        let mut next = 0;
        while let Some(&t) = members.get(next) {
            next += 1;
            for twin in &twins[3 * t..3 * t + 3] {
                let other = *twin as usize / 3;
                if body_of[other] == usize::MAX {
                    body_of[other] = bodies.len();
                    members.push(other);
                }
            }
        }
        members.sort_unstable();
        bodies.push(body(points, triangles, twins, &members));
    }
    bodies
}

fn body(
    points: &[Point3<f64>],
    triangles: &[[u32; 3]],
    twins: &[u32],
    members: &[usize],
) -> Closed {
    let place: FxHashMap<usize, u32> = members.iter().copied().zip(0..).collect();
    let local = |h: u32| 3 * place[&(h as usize / 3)] + h % 3;
    let twins: Vec<u32> =
        members.iter().flat_map(|&t| &twins[3 * t..3 * t + 3]).map(|&h| local(h)).collect();
    let mut corner_point = vec![u32::MAX; 3 * members.len()];
    let mut closed = Closed { twins, ..Closed::default() };
    for start in 0..corner_point.len() {
        if corner_point[start] != u32::MAX {
            continue;
        }
        let point = triangles[members[start / 3]][start % 3];
        // Round the fan: the side that leaves a corner, its twin arrives there, the next leaves.
        let mut at = start;
        while corner_point[at] == u32::MAX {
            corner_point[at] = closed.points.len() as u32;
            let twin = closed.twins[at] as usize;
            at = if twin % 3 == 2 { twin - 2 } else { twin + 1 };
        }
        closed.points.push(points[point as usize]);
    }
    closed.triangles = corner_point.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
    closed
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

    fn corners(at: [f64; 3], size: f64) -> [Point3<f64>; 4] {
        let at = Point3::from(at);
        [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()].map(|v| at + v * size)
    }

    #[test]
    fn a_surface_with_an_opening_is_no_body() {
        let points = corners([0.0; 3], 3.0);
        assert!(of_triangles(&points, &TETRAHEDRON[..3]).is_none());
        let mut turned = TETRAHEDRON;
        turned[3].reverse();
        assert!(of_triangles(&points, &turned).is_none());
    }

    #[test]
    fn bodies_that_touch_in_a_point_are_two_with_a_point_each() {
        let points: Vec<Point3<f64>> =
            corners([0.0; 3], 3.0).into_iter().chain(corners([3.0, 0.0, 0.0], 2.0)).collect();
        // The second begins where the first has its corner 1.
        let second = TETRAHEDRON.map(|t| t.map(|v| if v == 0 { 1 } else { v + 4 }));
        let bodies = of_triangles(&points, &[TETRAHEDRON, second].concat()).expect("closed");
        let volumes: Vec<f64> = bodies.iter().map(Closed::volume).collect();
        assert_eq!(bodies.len(), 2);
        assert!((volumes[0] - 27.0 / 6.0).abs() < 1e-12 && (volumes[1] - 8.0 / 6.0).abs() < 1e-12);
        assert!(bodies.iter().all(|b| b.points.len() == 4));
    }

    #[test]
    fn a_surface_inside_out_has_a_negative_volume() {
        let inside_out = TETRAHEDRON.map(|[a, b, c]| [a, c, b]);
        let bodies = of_triangles(&corners([5.0, 1.0, 2.0], 3.0), &inside_out).expect("closed");
        assert!((bodies[0].volume() + 27.0 / 6.0).abs() < 1e-12);
    }
}
