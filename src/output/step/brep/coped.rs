//! The boundary of a coped bar: cylinders inside and out, ends in planes or along members.

use std::f64::consts::{FRAC_PI_4, PI, TAU};

use nalgebra::{Point2, Point3, Vector2, Vector3};
use truck_modeling::{BSplineCurve, KnotVec, NurbsCurve, ParametricCurve, Vector4};

use super::curve::lifted;
use super::loft::{cylinder, level_cap};
use super::{Axes, Conic, Curve, Edge, Face, Skin, Solid, Surface, Vertex, Wire, face, solid_of};
use crate::output::step::coped::{Coped, End};
use crate::output::step::error::BodyError;
use crate::output::step::levels::Level;
use crate::output::step::piece::{Arc, Piece};
use crate::output::step::spline::{clamped_ordinates, closed_second_derivatives};
use crate::saddle::Saddle;

/// How far the edge on a member may lie off it and off the beam, in radii of the beam.
const FIT: f64 = 2e-7;

/// Points of a spline all around to begin with; they are doubled until it fits, or there are so many.
const POINTS: usize = 32;
const MOST_POINTS: usize = 1024;

/// Most spans of one edge. OCCT draws the spline into the parameters of both faces through as many
/// points of it, up to about 500 poles; of more it takes few, and its volume is off by 1e-4.
const MOST_SPANS: usize = 256;

/// Largest turn of an edge that is an ellipse. OCCT draws it into the parameters of the cylinders
/// through 23 points, whatever its length: with a member at a right angle the volume is off by 1e-11
/// over 45° and by 5e-8 over 180°.
const MOST_TURN: f64 = FRAC_PI_4;

/// Builds the solid of a coped bar.
pub(super) fn solid(coped: &Coped) -> Result<Solid, BodyError> {
    let seam = coped.seam();
    let mut faces = Vec::new();
    let mut rims: [Vec<Wire>; 2] = Default::default();
    for (i, &radius) in coped.radii.iter().enumerate() {
        let left = if i == 0 { radius } else { -radius };
        let (p, q) = (seam * radius, Vector2::new(-seam.y, seam.x) * left);
        let arc = Arc { centre: Point2::origin(), p, q, sweep: TAU };
        let [lower, upper] = [0, 1].map(|e| rim(&coped.ends[e], &arc));
        let wires = vec![lower.clone(), upper.inverse()];
        let base = coped.ends[0].lift(&Point2::origin()).z;
        let skin = Skin { surface: cylinder(&arc, base), seam: Some(Curve::Line) };
        faces.push(face(wires, skin, arc.is_left())?);
        rims[0].push(lower.inverse());
        rims[1].push(upper);
    }
    for (end, (wires, up)) in coped.ends.iter().zip(rims.into_iter().zip([false, true])) {
        faces.push(match end {
            End::Plane(level) => level_cap(level, up, wires)?,
            End::Saddle { height, saddle } => saddle_cap(*height, saddle, wires)?,
        });
    }
    solid_of(vec![faces.into()])
}

/// The edges of a circle of the section at an end, around from where the arc begins.
fn rim(end: &End, arc: &Arc) -> Wire {
    match end {
        End::Plane(level) if level.is_flat() => {
            closed(end, vec![(arc.p, lifted(&Piece::Arc(*arc), level))])
        }
        End::Plane(level) => closed(end, ellipses(arc, &[], |_| *level)),
        End::Saddle { height, saddle } => match end.fish_mouth(arc.p.norm()) {
            Some(along) => closed(end, halves(arc, *height, saddle, &along)),
            None => closed(end, splines(end, saddle, arc)),
        },
    }
}

/// A wire of curves, each from the place where it begins to that of the next.
fn closed(end: &End, curves: Vec<(Vector2<f64>, Curve)>) -> Wire {
    let vertices: Vec<Vertex> =
        curves.iter().map(|(at, _)| Vertex::new(end.lift(&Point2::from(*at)))).collect();
    let next = vertices.iter().cycle().skip(1);
    let ends = vertices.iter().zip(next);
    curves
        .into_iter()
        .zip(ends)
        .map(|((_, curve), (from, to))| Edge::new_unchecked(from, to, curve))
        .collect()
}

/// A circle lifted onto planes: one from each break to the next, and from the last to the first.
fn ellipses(
    arc: &Arc,
    breaks: &[f64],
    level: impl Fn(&Vector2<f64>) -> Level,
) -> Vec<(Vector2<f64>, Curve)> {
    let stops: Vec<f64> = [0.0].into_iter().chain(breaks.iter().copied()).chain([TAU]).collect();
    let pieces = stops.windows(2).flat_map(|stop| {
        let turn = stop[1] - stop[0];
        let count = (turn / MOST_TURN - 1e-9).ceil() as usize;
        let at = move |i: f64| arc.at(stop[0] + turn * i / count as f64).0.coords;
        let level = &level;
        (0..count).map(move |i| {
            let conic = Conic::lifted(arc, &level(&at(i as f64 + 0.5)));
            (at(i as f64), Curve::Conic(conic))
        })
    });
    pieces.collect()
}

/// The edge on a member as wide as the beam: a half ellipse on each side of it.
fn halves(
    arc: &Arc,
    height: f64,
    saddle: &Saddle,
    along: &Vector2<f64>,
) -> Vec<(Vector2<f64>, Curve)> {
    // The sides of the member, where arc.at(θ) · along = 0.
    let side = (-arc.p.dot(along)).atan2(arc.q.dot(along)).rem_euclid(PI);
    let up = if saddle.above { -1.0 } else { 1.0 } / saddle.sine();
    ellipses(arc, &[side, side + PI], |at| {
        let slope = saddle.slope() + along * (up * at.dot(along).signum());
        Level { height: height - up * saddle.radius, slope }
    })
}

/// The end on a member: a piece of its side, seen from within it, far from its seam.
fn saddle_cap(height: f64, saddle: &Saddle, wires: Vec<Wire>) -> Result<Face, BodyError> {
    let towards = if saddle.above { Vector3::z() } else { -Vector3::z() };
    let origin = Point3::new(0.0, 0.0, height) + towards * (saddle.radius / saddle.sine());
    let axes = Axes::about(origin, saddle.axis.into_inner(), towards);
    let surface = Surface::Cylinder { axes, radius: saddle.radius };
    face(wires, Skin { surface, seam: None }, false)
}

/// The edge between beam and member: splines through so many points that they lie on both.
fn splines(end: &End, saddle: &Saddle, arc: &Arc) -> Vec<(Vector2<f64>, Curve)> {
    let mut count = POINTS;
    loop {
        let places = saddle.places(&(arc.centre + arc.p), arc.is_left(), count);
        let curves = through(&places.iter().map(|p| end.lift(p)).collect::<Vec<_>>());
        let off = curves.iter().map(|c| off(c, end, arc)).fold(0.0, f64::max);
        if count >= MOST_POINTS || off <= FIT * arc.p.norm() {
            let spans = count / curves.len();
            let starts = places.iter().step_by(spans).map(|p| p.coords);
            return starts.zip(curves.into_iter().map(Curve::Spline)).collect();
        }
        count *= 2;
    }
}

/// The closed spline through points at equal steps, in pieces of equal length, each over [0, 1].
fn through(points: &[Point3<f64>]) -> Vec<NurbsCurve<Vector4>> {
    let count = points.len();
    let spans = count.min(MOST_SPANS);
    let breaks = |n: usize| (0..=n).map(|i| i as f64 / spans as f64).collect::<Vec<f64>>();
    let second = [0, 1, 2].map(|axis| {
        let open: Vec<f64> = points.iter().map(|p| p[axis]).collect();
        closed_second_derivatives(&breaks(count), &open)
    });
    let around: Vec<Point3<f64>> = points.iter().chain(&points[..1]).copied().collect();
    let piece = |first: usize| {
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let values: Vec<f64> = around[first..=first + spans].iter().map(|p| p[axis]).collect();
            clamped_ordinates(&breaks(spans), &values, &second[axis][first..=first + spans])
        });
        let mut control: Vec<Vector4> =
            x.iter().zip(&y).zip(&z).map(|((x, y), z)| Vector4::new(*x, *y, *z, 1.0)).collect();
        let (last, end) = (control.len() - 1, around[first + spans]);
        control[last] = Vector4::new(end.x, end.y, end.z, 1.0);
        let knots = [0.0; 3].into_iter().chain(breaks(spans)).chain([1.0; 3]);
        NurbsCurve::new(BSplineCurve::new(KnotVec::from(knots.collect::<Vec<_>>()), control))
    };
    (0..count).step_by(spans).map(piece).collect()
}

/// Farthest a spline lies off beam and member, halfway between its points.
fn off(curve: &NurbsCurve<Vector4>, end: &End, arc: &Arc) -> f64 {
    let spans = curve.control_points().len() - 3;
    let halfway = (0..spans).map(|i| curve.subs((i as f64 + 0.5) / spans as f64));
    halfway
        .map(|p| {
            let across = Point2::new(p.x, p.y);
            let side = (across.coords.norm() - arc.p.norm()).abs();
            side.max((end.lift(&across).z - p.z).abs())
        })
        .fold(0.0, f64::max)
}
