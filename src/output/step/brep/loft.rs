//! The boundary of a loft: rings at its stations, sides between them, two caps.
//!
//! ```text
//!    upper ring   ●────── along ──────●      side face, seen from outside:
//!                 │                   │      lower along, upright,
//!              upright             upright   upper back, upright back
//!                 │                   │
//!    lower ring   ●────── along ──────●
//! ```
//!
//! Holes run clockwise, so that the same order of edges faces into them.  A
//! ring of one closed piece has no uprights; its side face has two boundaries
//! and a seam.

use nalgebra::{Point3, UnitVector3, Vector2, Vector3};
use truck_modeling::{BSplineCurve, BSplineSurface, KnotVec, NurbsCurve, NurbsSurface, Vector4};

use super::curve::{lifted, lifted_nurbs};
use super::{Axes, Conic, Curve, Edge, Face, Skin, Solid, Surface, Vertex, Wire, face, solid_of};
use crate::output::step::error::BodyError;
use crate::output::step::levels::{Level, Levels};
use crate::output::step::piece::{Arc, Piece};
use crate::output::step::side::Side;
use crate::output::step::spline::clamped_ordinates;
use crate::output::step::tolerance::SAME;

/// One ring at one station: piece `j` runs along edge `j` from corner `j`.
struct RingEdges {
    corners: Vec<Vertex>,
    along: Vec<Edge>,
}

/// Builds the solid of a loft.
pub(super) fn solid(levels: &Levels) -> Result<Solid, BodyError> {
    let last = levels.last();
    let stops: Vec<usize> = if levels.smooth { vec![0, last] } else { (0..=last).collect() };
    let skinner = Skinner { levels, rows: smooth_rows(levels) };
    let mut faces = Vec::new();
    let (mut bottom, mut top) = (Vec::new(), Vec::new());
    for r in 0..levels.rings.len() {
        let rings: Vec<RingEdges> = stops.iter().map(|&k| skinner.ring(r, k)).collect();
        for (pair, &k) in rings.windows(2).zip(&stops) {
            faces.extend(skinner.sides(r, k, &pair[0], &pair[1])?);
        }
        bottom.push(Wire::from(rings[0].along.clone()).inverse());
        top.push(Wire::from(rings[rings.len() - 1].along.clone()));
    }
    faces.push(level_cap(&levels.planes[0], false, bottom)?);
    faces.push(level_cap(&levels.planes[last], true, top)?);
    solid_of(vec![faces.into()])
}

/// The plane end of a loft; its surface faces up at both ends.
pub(super) fn level_cap(level: &Level, up: bool, wires: Vec<Wire>) -> Result<Face, BodyError> {
    let only = wires.first().filter(|outer| outer.len() == 1).map(|outer| outer[0].curve());
    // One placement for a closed conic, which runs counter-clockwise, and the plane it lies in.
    let axes = if let Some(Curve::Conic(conic)) = only {
        conic.axes()
    } else {
        let normal = Vector3::new(-level.slope.x, -level.slope.y, 1.0);
        let origin = Point3::new(0.0, 0.0, level.height);
        Axes::about(origin, normal, level.lift_vector(&Vector2::x()))
    };
    face(wires, Skin { surface: Surface::Plane(axes), seam: None }, up)
}

/// How the control points of a smooth loft follow from those of its stations:
/// row i is the sum of station k times `rows[i][k]`.
fn smooth_rows(levels: &Levels) -> Vec<Vec<f64>> {
    if !levels.smooth {
        return Vec::new();
    }
    let columns: Vec<Vec<f64>> = levels
        .cardinal_curvature()
        .iter()
        .enumerate()
        .map(|(one, second)| {
            let count = levels.heights.len();
            let values: Vec<f64> = (0..count).map(|k| f64::from(u8::from(k == one))).collect();
            clamped_ordinates(&levels.heights, &values, second)
        })
        .collect();
    (0..columns[0].len()).map(|i| columns.iter().map(|column| column[i]).collect()).collect()
}

/// Chooses the curve of every edge and the surface of every side.
struct Skinner<'a> {
    levels: &'a Levels,
    rows: Vec<Vec<f64>>,
}

impl Skinner<'_> {
    fn ring(&self, r: usize, k: usize) -> RingEdges {
        let count = self.levels.rings[r][k].len();
        let corners: Vec<Vertex> =
            (0..count).map(|j| Vertex::new(self.levels.corner(r, k, j))).collect();
        let along = (0..count)
            .map(|j| {
                let (from, to) = (&corners[j], &corners[(j + 1) % count]);
                Edge::new_unchecked(from, to, self.curve(r, k, j))
            })
            .collect();
        RingEdges { corners, along }
    }

    /// The curve of piece `j` at station `k`.
    fn curve(&self, r: usize, k: usize, j: usize) -> Curve {
        let levels = self.levels;
        let (piece, level) = (&levels.rings[r][k][j], &levels.planes[k]);
        let next = levels.neighbour(k);
        if let (Piece::Arc(arc), Piece::Arc(other)) = (piece, &levels.rings[r][next][j]) {
            let growth = other.p.norm() - arc.p.norm();
            if levels.trimmed && !level.is_flat() && growth.abs() > SAME * arc.p.norm() {
                let growth = growth / (levels.heights[next] - levels.heights[k]);
                return Curve::Conic(Conic::of_cone(arc, levels.heights[k], growth, level));
            }
        }
        lifted(piece, level)
    }

    /// The faces of ring `r` from station `k` to the next stop.
    fn sides(
        &self,
        r: usize,
        k: usize,
        lower: &RingEdges,
        upper: &RingEdges,
    ) -> Result<Vec<Face>, BodyError> {
        let count = lower.along.len();
        if self.levels.is_closed(r) {
            let wires =
                vec![vec![lower.along[0].clone()].into(), vec![upper.along[0].inverse()].into()];
            let (surface, same_sense) = self.surface(r, k, 0);
            let seam = Some(self.upright(r, 0));
            return Ok(vec![face(wires, Skin { surface, seam }, same_sense)?]);
        }
        let uprights: Vec<Edge> = (0..count)
            .map(|j| Edge::new_unchecked(&lower.corners[j], &upper.corners[j], self.upright(r, j)))
            .collect();
        (0..count)
            .map(|j| {
                let wire = vec![
                    lower.along[j].clone(),
                    uprights[(j + 1) % count].clone(),
                    upper.along[j].inverse(),
                    uprights[j].inverse(),
                ];
                let (surface, same_sense) = self.surface(r, k, j);
                face(vec![wire.into()], Skin { surface, seam: None }, same_sense)
            })
            .collect()
    }

    /// The curve along the beam where piece `j` begins.
    fn upright(&self, r: usize, j: usize) -> Curve {
        if !self.levels.smooth || self.is_straight(r, j) {
            return Curve::Line;
        }
        let stations: Vec<Vector4> = (0..=self.levels.last())
            .map(|k| {
                let p = self.levels.corner(r, k, j);
                Vector4::new(p.x, p.y, p.z, 1.0)
            })
            .collect();
        let points = self.blend(|k| stations[k]);
        Curve::Spline(NurbsCurve::new(BSplineCurve::new(self.knots_along(), points)))
    }

    /// Whether the smooth upright at piece `j` is a straight line after all.
    fn is_straight(&self, r: usize, j: usize) -> bool {
        let (levels, last) = (self.levels, self.levels.last());
        let (from, to) = (levels.corner(r, 0, j), levels.corner(r, last, j));
        (1..last).all(|k| {
            let t = (levels.heights[k] - levels.heights[0])
                / (levels.heights[last] - levels.heights[0]);
            let off = levels.corner(r, k, j) - (from + (to - from) * t);
            off.norm() <= SAME * (to - from).norm()
        })
    }

    /// The surface of piece `j` above station `k`, and whether it faces out.
    fn surface(&self, r: usize, k: usize, j: usize) -> (Surface, bool) {
        let levels = self.levels;
        if levels.smooth {
            return self.smooth_surface(r, j);
        }
        let (a, b) = (&levels.rings[r][k][j], &levels.rings[r][k + 1][j]);
        let base = levels.heights[k];
        match (levels.side(r, k, j), a, b) {
            (Side::Plane, ..) => (self.plane(r, j, k, k + 1), true),
            (Side::Cylinder, Piece::Arc(arc), _) => (cylinder(arc, base), arc.is_left()),
            (Side::Cone, Piece::Arc(a), Piece::Arc(b)) => {
                (cone(a, b, base, levels.heights[k + 1]), a.is_left())
            }
            (Side::Prism, Piece::Arc(arc), _) => {
                let along = Conic::lifted(arc, &levels.planes[k]);
                (Surface::Extrusion { along, direction: Vector3::z_axis() }, true)
            }
            _ => (ruled(&self.nurbs(r, k, j), &self.nurbs(r, k + 1, j)), true),
        }
    }

    fn smooth_surface(&self, r: usize, j: usize) -> (Surface, bool) {
        let (levels, last) = (self.levels, self.levels.last());
        let stations: Vec<usize> = (0..=last).collect();
        let constant = stations.windows(2).all(|w| levels.side(r, w[0], j) == Side::Cylinder);
        match &levels.rings[r][0][j] {
            Piece::Line { .. } if levels.is_coplanar(r, j, &stations) => {
                (self.plane(r, j, 0, last), true)
            }
            Piece::Arc(arc) if constant => (cylinder(arc, levels.heights[0]), arc.is_left()),
            _ => {
                let curves: Vec<_> = stations.iter().map(|&k| self.nurbs(r, k, j)).collect();
                let columns = (0..curves[0].control_points().len())
                    .map(|i| self.blend(|k| *curves[k].control_point(i)))
                    .collect();
                let knots = (curves[0].knot_vec().clone(), self.knots_along());
                (spline(BSplineSurface::new(knots, columns)), true)
            }
        }
    }

    fn nurbs(&self, r: usize, k: usize, j: usize) -> NurbsCurve<Vector4> {
        lifted_nurbs(&self.levels.rings[r][k][j], &self.levels.planes[k])
    }

    /// The plane of piece `j` between two stations, facing out.
    fn plane(&self, r: usize, j: usize, lower: usize, upper: usize) -> Surface {
        let levels = self.levels;
        let next = (j + 1) % levels.rings[r][0].len();
        let origin = levels.corner(r, lower, j);
        let along = levels.corner(r, lower, next) - origin;
        let up = levels.corner(r, upper, j) - origin;
        Surface::Plane(Axes::about(origin, along.cross(&up), along))
    }

    /// Control points along the beam from the points of the stations.
    fn blend(&self, station: impl Fn(usize) -> Vector4) -> Vec<Vector4> {
        self.rows
            .iter()
            .map(|shares| {
                let mut sum = Vector4::new(0.0, 0.0, 0.0, 0.0);
                for (k, share) in shares.iter().enumerate() {
                    sum += station(k) * *share;
                }
                sum
            })
            .collect()
    }

    /// Clamped cubic knots over the stations, from 0 to 1.
    fn knots_along(&self) -> KnotVec {
        let heights = &self.levels.heights;
        let (from, to) = (heights[0], heights[heights.len() - 1]);
        let inner = heights.iter().map(|z| (z - from) / (to - from));
        KnotVec::from([0.0; 3].into_iter().chain(inner).chain([1.0; 3]).collect::<Vec<_>>())
    }
}

/// The ruled surface between two curves: truck's homotopy.
fn ruled(lower: &NurbsCurve<Vector4>, upper: &NurbsCurve<Vector4>) -> Surface {
    let (lower, upper) = (lower.non_rationalized().clone(), upper.non_rationalized().clone());
    spline(BSplineSurface::homotopy(lower, upper))
}

fn spline(surface: BSplineSurface<Vector4>) -> Surface {
    Surface::Spline(Box::new(NurbsSurface::new(surface)))
}

pub(super) fn cylinder(arc: &Arc, base: f64) -> Surface {
    let origin = Point3::new(arc.centre.x, arc.centre.y, base);
    Surface::Cylinder { axes: upright_axes(origin, Vector3::z_axis(), arc), radius: arc.p.norm() }
}

/// The cone through two circles; its axes grow from the smaller one.
fn cone(lower: &Arc, upper: &Arc, bottom: f64, top: f64) -> Surface {
    let growth = upper.p.norm() - lower.p.norm();
    let half_angle = growth.abs().atan2(top - bottom);
    let (small, base, z) = if growth > 0.0 {
        (lower, bottom, Vector3::z_axis())
    } else {
        (upper, top, -Vector3::z_axis())
    };
    let origin = Point3::new(small.centre.x, small.centre.y, base);
    Surface::Cone { axes: upright_axes(origin, z, small), radius: small.p.norm(), half_angle }
}

/// Axes with x where the arc begins, which is where its seam is.
fn upright_axes(origin: Point3<f64>, z: UnitVector3<f64>, arc: &Arc) -> Axes {
    Axes::about(origin, z.into_inner(), Vector3::new(arc.p.x, arc.p.y, 0.0))
}
