//! The boundary of a coped bar: cylinders inside and out, ends in planes or along members.

use std::f64::consts::TAU;

use nalgebra::{Point2, Point3, Vector2, Vector3};
use truck_modeling::{BSplineCurve, KnotVec, NurbsCurve, ParametricCurve, Vector4};

use super::curve::lifted;
use super::loft::{cylinder, level_cap};
use super::{Axes, Curve, Edge, Face, Skin, Solid, Surface, Vertex, Wire, face, solid_of};
use crate::output::step::coped::{Coped, End};
use crate::output::step::error::BodyError;
use crate::output::step::piece::{Arc, Piece};
use crate::output::step::spline::{clamped_ordinates, closed_second_derivatives};
use crate::saddle::Saddle;

/// How far the edge on a member may lie off it and off the beam, in radii of the beam.
const FIT: f64 = 2e-7;

/// Points of an edge to begin with; they are doubled until it fits, or there are so many.
const POINTS: usize = 32;
const MOST_POINTS: usize = 1024;

/// Builds the solid of a coped bar.
pub(super) fn solid(coped: &Coped) -> Result<Solid, BodyError> {
    let mut faces = Vec::new();
    let mut rims: [Vec<Wire>; 2] = Default::default();
    for (i, &radius) in coped.radii.iter().enumerate() {
        let left = if i == 0 { radius } else { -radius };
        let (p, q) = (Vector2::new(radius, 0.0), Vector2::new(0.0, left));
        let arc = Arc { centre: Point2::origin(), p, q, sweep: TAU };
        let [lower, upper] = [0, 1].map(|e| rim(&coped.ends[e], &arc));
        let wires = vec![vec![lower.clone()].into(), vec![upper.inverse()].into()];
        let base = coped.ends[0].lift(&Point2::origin()).z;
        let skin = Skin { surface: cylinder(&arc, base), seam: Some(Curve::Line) };
        faces.push(face(wires, skin, arc.is_left())?);
        rims[0].push(Wire::from(vec![lower]).inverse());
        rims[1].push(vec![upper].into());
    }
    for (end, (wires, up)) in coped.ends.iter().zip(rims.into_iter().zip([false, true])) {
        faces.push(match end {
            End::Plane(level) => level_cap(level, up, wires)?,
            End::Saddle { height, saddle } => saddle_cap(*height, saddle, wires)?,
        });
    }
    solid_of(vec![faces.into()])
}

/// The closed edge of a circle of the section at an end.
fn rim(end: &End, arc: &Arc) -> Edge {
    let curve = match end {
        End::Plane(level) => lifted(&Piece::Arc(*arc), level),
        End::Saddle { .. } => Curve::Spline(fitted(end, arc)),
    };
    let vertex = Vertex::new(end.lift(&(arc.centre + arc.p)));
    Edge::new_unchecked(&vertex, &vertex, curve)
}

/// The end on a member: a piece of its side, seen from within it, far from its seam.
fn saddle_cap(height: f64, saddle: &Saddle, wires: Vec<Wire>) -> Result<Face, BodyError> {
    let towards = if saddle.above { Vector3::z() } else { -Vector3::z() };
    let origin = Point3::new(0.0, 0.0, height) + towards * (saddle.radius / saddle.sine());
    let axes = Axes::about(origin, saddle.axis.into_inner(), towards);
    let surface = Surface::Cylinder { axes, radius: saddle.radius };
    face(wires, Skin { surface, seam: None }, false)
}

/// The edge between beam and member: a spline through so many points that it lies on both.
fn fitted(end: &End, arc: &Arc) -> NurbsCurve<Vector4> {
    let mut count = POINTS;
    loop {
        let curve = through(count, end, arc);
        if count >= MOST_POINTS || off(&curve, count, end, arc) <= FIT * arc.p.norm() {
            return curve;
        }
        count *= 2;
    }
}

/// The closed spline through `count` points of the edge, over [0, 1].
fn through(count: usize, end: &End, arc: &Arc) -> NurbsCurve<Vector4> {
    let breaks: Vec<f64> = (0..=count).map(|i| i as f64 / count as f64).collect();
    let points: Vec<Point3<f64>> =
        breaks[..count].iter().map(|t| end.lift(&arc.at(TAU * t).0)).collect();
    let ordinates = |axis: usize| {
        let open: Vec<f64> = points.iter().map(|p| p[axis]).collect();
        let second = closed_second_derivatives(&breaks, &open);
        let around: Vec<f64> = open.iter().chain(&open[..1]).copied().collect();
        clamped_ordinates(&breaks, &around, &second)
    };
    let [x, y, z] = [0, 1, 2].map(ordinates);
    let mut control: Vec<Vector4> =
        x.iter().zip(&y).zip(&z).map(|((x, y), z)| Vector4::new(*x, *y, *z, 1.0)).collect();
    let last = control.len() - 1;
    control[last] = control[0];
    let knots = [0.0; 3].into_iter().chain(breaks).chain([1.0; 3]);
    NurbsCurve::new(BSplineCurve::new(KnotVec::from(knots.collect::<Vec<_>>()), control))
}

/// Farthest the spline lies off beam and member, halfway between its points.
fn off(curve: &NurbsCurve<Vector4>, count: usize, end: &End, arc: &Arc) -> f64 {
    let halfway = (0..count).map(|i| curve.subs((i as f64 + 0.5) / count as f64));
    halfway
        .map(|p| {
            let across = Point2::new(p.x, p.y);
            let side = (across.coords.norm() - arc.p.norm()).abs();
            side.max((end.lift(&across).z - p.z).abs())
        })
        .fold(0.0, f64::max)
}
