//! Curves of edges: lifted conics, sections of cones, and their B-spline forms.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Point2, Point3, UnitVector3, Vector2, Vector3};
use truck_modeling::{BSplineCurve, KnotVec, NurbsCurve, Vector4};

use super::{Axes, Conic, Curve};
use crate::output::step::closed_spline::ClosedSpline;
use crate::output::step::levels::Level;
use crate::output::step::piece::{Arc, Piece};

/// A direction across another, the same for both signs of it.
///
/// Of the coordinate axes it takes the one least along `axis`, the first of
/// those that are nearly so, so that rounding does not make it jump.
pub(in crate::output::step) fn across(axis: &Vector3<f64>) -> Vector3<f64> {
    let least = axis.abs().min();
    let i = (0..3).find(|&i| axis[i].abs() <= least + 1e-6 * axis.norm()).unwrap_or(0);
    let mut other = Vector3::zeros();
    other[i] = 1.0;
    other - axis * (axis[i] / axis.norm_squared())
}

impl Conic {
    /// An arc of a section, lifted onto its level.
    pub(in crate::output::step) fn lifted(arc: &Arc, level: &Level) -> Self {
        Self {
            centre: level.lift(&arc.centre),
            p: level.lift_vector(&arc.p),
            q: level.lift_vector(&arc.q),
        }
    }

    /// The section of a cone by a level.
    ///
    /// * `arc`, `height`: a circle of the cone;
    /// * `growth`: gain of radius per height, κ.
    ///
    /// Seen along the axis the section is an ellipse with one focus on it:
    /// ρ(θ) = ρ₀ / (1 − ε cos θ) from the direction of the slope g on, with
    /// ε = κ|g| and ρ₀ the radius where the level meets the axis.
    pub(in crate::output::step) fn of_cone(
        arc: &Arc,
        height: f64,
        growth: f64,
        level: &Level,
    ) -> Self {
        let steepness = level.slope.norm();
        let epsilon = growth * steepness;
        let rho = arc.p.norm() + growth * (level.lift(&arc.centre).z - height);
        let flat = 1.0 - epsilon * epsilon;
        let (major, minor) = (rho / flat, rho / flat.sqrt());
        let uphill = level.slope / steepness;
        let left = Vector2::new(-uphill.y, uphill.x) * if arc.is_left() { 1.0 } else { -1.0 };
        Self {
            centre: level.lift(&(arc.centre + uphill * (epsilon * major))),
            p: level.lift_vector(&(uphill * major)),
            q: level.lift_vector(&(left * minor)),
        }
    }

    /// Normal of the plane the conic lies in, counter-clockwise about it.
    pub(in crate::output::step) fn normal(&self) -> UnitVector3<f64> {
        UnitVector3::new_normalize(self.p.cross(&self.q))
    }

    /// The two half-axes, the longer first, in the same sense of rotation.
    ///
    /// From conjugate half-diameters by Rytz: tan 2θ = 2 p·q / (p² − q²).
    pub(in crate::output::step) fn half_axes(&self) -> (Vector3<f64>, Vector3<f64>) {
        let theta =
            0.5 * (2.0 * self.p.dot(&self.q)).atan2(self.p.norm_squared() - self.q.norm_squared());
        let (sin, cos) = theta.sin_cos();
        (self.p * cos + self.q * sin, self.q * cos - self.p * sin)
    }

    /// The radius, if the conic is a circle.
    pub(in crate::output::step) fn radius(&self) -> Option<f64> {
        let (major, minor) = self.half_axes();
        let (a, b) = (major.norm(), minor.norm());
        (a - b <= 1e-12 * a).then_some(a)
    }

    /// Axes in its middle, z the normal, x along the longer half-axis; p of a circle.
    pub(in crate::output::step) fn axes(&self) -> Axes {
        let x = if self.radius().is_some() { self.p } else { self.half_axes().0 };
        Axes::about(self.centre, self.normal().into_inner(), x)
    }

    /// The conic as a rational quadratic B-spline from θ = 0 to `sweep`.
    fn nurbs(&self, sweep: f64) -> NurbsCurve<Vector4> {
        let parts = (sweep / FRAC_PI_2 - 1e-9).ceil().max(1.0) as usize;
        let half = 0.5 * sweep / parts as f64;
        let middle = half.cos();
        let points = (0..=2 * parts).map(|i| {
            let (cos, sin) = if sweep == TAU { EIGHTHS[i] } else { cos_sin(half * i as f64) };
            let weight = if i % 2 == 0 { 1.0 } else { middle };
            let out = (self.p * cos + self.q * sin) / weight;
            homogeneous(&(self.centre + out), weight)
        });
        let points = points.collect();
        let at = |i: usize| i as f64 / parts as f64;
        let knots = [0.0].into_iter().chain((0..=parts).flat_map(|i| [at(i); 2])).chain([1.0]);
        NurbsCurve::new(BSplineCurve::new(KnotVec::from(knots.collect::<Vec<_>>()), points))
    }
}

const H: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Cosine and sine of multiples of 45°, exact where they can be.
const EIGHTHS: [(f64, f64); 9] = [
    (1.0, 0.0),
    (H, H),
    (0.0, 1.0),
    (-H, H),
    (-1.0, 0.0),
    (-H, -H),
    (0.0, -1.0),
    (H, -H),
    (1.0, 0.0),
];

fn cos_sin(angle: f64) -> (f64, f64) {
    let (sin, cos) = angle.sin_cos();
    (cos, sin)
}

fn homogeneous(p: &Point3<f64>, weight: f64) -> Vector4 {
    Vector4::new(p.x * weight, p.y * weight, p.z * weight, weight)
}

/// A piece of a section lifted onto its level, as a B-spline over [0, 1].
pub(super) fn lifted_nurbs(piece: &Piece, level: &Level) -> NurbsCurve<Vector4> {
    match piece {
        Piece::Line { from, to } => polyline(&[level.lift(from), level.lift(to)]),
        Piece::Arc(arc) => Conic::lifted(arc, level).nurbs(arc.sweep),
        Piece::Spline(curve) => lifted_spline(curve, level),
    }
}

fn lifted_spline(curve: &ClosedSpline, level: &Level) -> NurbsCurve<Vector4> {
    let lift = |p: &Point2<f64>| homogeneous(&level.lift(p), 1.0);
    let points = curve.control_points().iter().map(lift).collect();
    NurbsCurve::new(BSplineCurve::new(KnotVec::from(curve.knots()), points))
}

fn polyline(points: &[Point3<f64>; 2]) -> NurbsCurve<Vector4> {
    let points = points.iter().map(|p| homogeneous(p, 1.0)).collect();
    NurbsCurve::new(BSplineCurve::new(KnotVec::bezier_knot(1), points))
}

/// A piece of a section lifted onto its level, as exactly as STEP can say it.
pub(super) fn lifted(piece: &Piece, level: &Level) -> Curve {
    match piece {
        Piece::Line { .. } => Curve::Line,
        Piece::Arc(arc) => Curve::Conic(Conic::lifted(arc, level)),
        Piece::Spline(curve) => Curve::Spline(lifted_spline(curve, level)),
    }
}
