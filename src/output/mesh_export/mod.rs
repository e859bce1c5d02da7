//! The bodies of a STEP document as triangles, for programs that show meshes.
//!
//! ```text
//!   station 0      station 1           sides: two triangles between neighbours on two rings
//!     ╭──╮           ╭──╮              caps:  the outline and its holes, constrained Delaunay
//!    ╱    ╲─────────╱    ╲
//!    ╲    ╱─────────╲    ╱             every part is closed and shares no corner with another
//!     ╰──╯           ╰──╯
//! ```
//!
//! # What does not hold
//! The corners lie on the exact surface, the triangles a little inside of it: a circle has
//! [`ROUND`] sides, and two more where its two ends are fish mouths that look different ways. Between stations the surface is straight, also where the STEP file has a
//! smooth one. Bodies of facets (non-design parts) are left out: the mesh they come from shows
//! them already.

mod loft;
mod ply;

use nalgebra::{Isometry3, Point3};

use super::step::{Body, Document, Group, Part};

pub(super) use ply::write_labelled;
pub use ply::write_parts;

/// Sides of a full circle.
pub const ROUND: usize = 48;

/// Sides of a ball from pole to pole.
const PARALLELS: usize = ROUND / 2;

/// One part as triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct PartMesh {
    /// Name of the part: `B012 CHS 60.3x4`.
    pub name: String,
    /// Red, green, blue.
    pub colour: [u8; 3],
    /// Corners, mm, in the coordinates of the document.
    pub points: Vec<Point3<f64>>,
    /// Counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// The beams and balls of a document, in the order of its tree.
pub fn part_meshes(document: &Document) -> Vec<PartMesh> {
    let mut meshes = Vec::new();
    for group in &document.groups {
        gather(group, &mut meshes);
    }
    meshes
}

fn gather(group: &Group, meshes: &mut Vec<PartMesh>) {
    meshes.extend(group.parts.iter().filter_map(part_mesh));
    for below in &group.groups {
        gather(below, meshes);
    }
}

fn part_mesh(part: &Part) -> Option<PartMesh> {
    let (points, triangles) = match &part.body {
        Body::Loft(loft) => loft::triangulate(loft)?,
        Body::Sphere { radius } => ball(*radius),
        Body::Facets(_) => return None,
    };
    let points = placed(points, &part.placement);
    Some(PartMesh { name: part.name.clone(), colour: part.colour, points, triangles })
}

fn placed(points: Vec<Point3<f64>>, placement: &Isometry3<f64>) -> Vec<Point3<f64>> {
    points.into_iter().map(|p| placement * p).collect()
}

type Triangles = (Vec<Point3<f64>>, Vec<[u32; 3]>);

/// A ball about the origin: rings of longitude between two poles.
fn ball(radius: f64) -> Triangles {
    let mut points = vec![Point3::new(0.0, 0.0, -radius)];
    for i in 1..PARALLELS {
        let (sin, cos) = (std::f64::consts::PI * i as f64 / PARALLELS as f64).sin_cos();
        points.extend((0..ROUND).map(|k| {
            let (y, x) = (std::f64::consts::TAU * k as f64 / ROUND as f64).sin_cos();
            Point3::new(radius * sin * x, radius * sin * y, -radius * cos)
        }));
    }
    points.push(Point3::new(0.0, 0.0, radius));
    let at = |i: usize, k: usize| (1 + (i - 1) * ROUND + k % ROUND) as u32;
    let top = points.len() as u32 - 1;
    let mut triangles = Vec::new();
    for k in 0..ROUND {
        triangles.push([0, at(1, k + 1), at(1, k)]);
        for i in 1..PARALLELS - 1 {
            triangles.push([at(i, k), at(i, k + 1), at(i + 1, k + 1)]);
            triangles.push([at(i, k), at(i + 1, k + 1), at(i + 1, k)]);
        }
        triangles.push([at(PARALLELS - 1, k), at(PARALLELS - 1, k + 1), top]);
    }
    (points, triangles)
}

#[cfg(test)]
pub(super) mod tests {
    use std::collections::HashMap;
    use std::f64::consts::PI;

    use nalgebra::{UnitVector3, Vector3};

    use super::super::step::{EndCut, Loft, Saddle, Station};
    use super::*;
    use crate::section::freeform::Freeform;
    use crate::section::outline::Outline;
    use nalgebra::Point2;

    /// Whether every side of a triangle is met by exactly one other, run the other way.
    pub(crate) fn is_closed(triangles: &[[u32; 3]]) -> bool {
        let mut sides = HashMap::new();
        for t in triangles {
            for k in 0..3 {
                *sides.entry((t[k], t[(k + 1) % 3])).or_insert(0) += 1;
            }
        }
        sides.iter().all(|(&(a, b), &n)| n == 1 && sides.get(&(b, a)) == Some(&1))
    }

    pub(crate) fn volume(points: &[Point3<f64>], triangles: &[[u32; 3]]) -> f64 {
        let p = |i: u32| points[i as usize].coords;
        triangles.iter().map(|&[a, b, c]| p(a).dot(&p(b).cross(&p(c))) / 6.0).sum()
    }

    fn mesh_of(body: Body) -> PartMesh {
        let part = Part {
            name: "B001".into(),
            product: "bar".into(),
            colour: [1, 2, 3],
            placement: Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.3, -0.2, 0.9)),
            body,
            properties: Vec::new(),
        };
        part_mesh(&part).unwrap()
    }

    /// The mesh is closed and its volume that of the body, less what the chords cut off.
    fn assert_like(body: Body, within: f64) {
        let exact = body.volume().unwrap();
        let mesh = mesh_of(body);
        assert!(is_closed(&mesh.triangles));
        let found = volume(&mesh.points, &mesh.triangles);
        assert!((found / exact - 1.0).abs() < within, "{found} for {exact}");
    }

    #[test]
    fn saddles_are_hollow_along_their_members() {
        let axis = UnitVector3::new_normalize(Vector3::new(0.5, 0.8, 0.4));
        for radius in [5.0, 6.0] {
            for holes in [vec![], vec![Outline::circle(4.0)]] {
                let end = EndCut::Saddle(Saddle { axis, radius, above: true });
                let bar = Loft::prism(Outline::circle(5.0), holes, 15.0);
                assert_like(Body::Loft(Loft { end, ..bar }), 0.005);
            }
        }
    }

    #[test]
    fn fish_mouths_are_sharp_at_both_ends_whatever_way_they_look() {
        let mouth = |turn: f64, above| {
            let axis = UnitVector3::new_normalize(Vector3::new(turn.cos(), turn.sin(), 0.0));
            EndCut::Saddle(Saddle { axis, radius: 5.0, above })
        };
        for turn in [0.0, 0.0004, 0.03, 0.065, 0.4, 1.2, 1.6, 2.9] {
            let bar = Loft::prism(Outline::circle(5.0), vec![Outline::circle(4.0)], 30.0);
            let bar = Loft { start: mouth(0.3, false), end: mouth(0.3 + turn, true), ..bar };
            let (points, _) = loft::triangulate(&bar).unwrap();
            // The tips reach to the axes of the members.
            let low = points.iter().map(|p| p.z).fold(f64::MAX, f64::min);
            let high = points.iter().map(|p| p.z).fold(f64::MIN, f64::max);
            assert!(low + 5.0 < 1e-6 && 35.0 - high < 0.005, "{turn}: {low} to {high}");
            assert_like(Body::Loft(bar), 0.005);
        }
    }

    #[test]
    fn ball_and_bars_are_closed_and_as_large_as_they_should_be() {
        assert_like(Body::Sphere { radius: 5.0 }, 0.01);
        assert_like(Body::round_bar(5.0, 80.0), 0.003);
        assert_like(Body::tube(5.0, 4.0, 80.0), 0.003);
        let corners = [(-3.0, -2.0), (3.0, -2.0), (3.0, 2.0), (-3.0, 2.0)];
        let corners = corners.map(|(x, y)| Point2::new(x, y));
        assert_like(Body::Loft(Loft::prism(Outline::polygon(&corners), vec![], 9.0)), 1e-12);
        let taper = Loft::taper(Outline::circle(5.0), Outline::circle(2.0), 30.0);
        assert_like(Body::Loft(taper), 0.003);
    }

    #[test]
    fn concave_outline_has_no_web_in_its_caps() {
        let corners = [(0.0, 0.0), (9.0, 0.0), (9.0, 1.0), (1.0, 1.0), (1.0, 9.0), (0.0, 9.0)];
        let corners = corners.map(|(x, y)| Point2::new(x, y));
        assert_like(Body::Loft(Loft::prism(Outline::polygon(&corners), vec![], 9.0)), 1e-12);
    }

    #[test]
    fn freeform_outlines_follow_their_curve() {
        let points: Vec<_> = (0..32)
            .map(|i| {
                let (sin, cos) = (2.0 * PI * f64::from(i) / 32.0).sin_cos();
                Point2::new(4.0 * cos + 0.4 * (3.0 * cos).sin(), 3.0 * sin)
            })
            .collect();
        let outer = Outline::Freeform(Freeform::through(points).unwrap());
        assert_like(Body::Loft(Loft::prism(outer, vec![], 50.0)), 0.003);
    }

    #[test]
    fn mitred_bar_keeps_its_volume_and_ends_in_the_planes() {
        let bar = Loft::prism(Outline::circle(5.0), vec![Outline::circle(3.0)], 100.0);
        let normal = Vector3::new(1.0, 0.0, 1.0);
        assert_like(Body::Loft(bar.clone().cut(Vector3::z(), normal)), 0.003);
        let (points, _) = loft::triangulate(&bar.cut(Vector3::z(), normal)).unwrap();
        let end = Point3::new(0.0, 0.0, 100.0);
        let on_cut = points.iter().filter(|p| (*p - end).dot(&normal).abs() < 1e-9).count();
        assert_eq!(on_cut, 2 * ROUND);
    }

    #[test]
    fn stations_that_differ_in_their_pieces_make_no_mesh() {
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Point2::new(x, y));
        let stations = [Outline::circle(1.0), Outline::polygon(&corners)]
            .into_iter()
            .enumerate()
            .map(|(z, outer)| Station { z: z as f64, outer, holes: vec![] })
            .collect();
        assert!(loft::triangulate(&Loft::between_stations(stations)).is_none());
    }
}
