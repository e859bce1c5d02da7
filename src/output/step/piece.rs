//! The smooth pieces an outline consists of: line, elliptic arc, closed spline.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Point2, Vector2};

use super::closed_spline::ClosedSpline;
use super::gauss;
use super::tolerance::SAME;

/// One smooth piece of an outline.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Piece {
    /// Straight from one point to another.
    Line { from: Point2<f64>, to: Point2<f64> },
    /// `centre + p cos θ + q sin θ` for θ from 0 to `sweep`, which is positive.
    Arc(Arc),
    /// A closed freeform curve; the only piece of its outline.
    Spline(ClosedSpline),
}

/// An elliptic arc by two conjugate half-diameters; a circle if p ⟂ q, |p| = |q|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arc {
    pub(super) centre: Point2<f64>,
    pub(super) p: Vector2<f64>,
    pub(super) q: Vector2<f64>,
    pub(super) sweep: f64,
}

/// A point of a curve and its derivative there.
pub(super) type Sample = (Point2<f64>, Vector2<f64>);

impl Arc {
    pub(super) fn at(&self, theta: f64) -> Sample {
        let (sin, cos) = theta.sin_cos();
        self.toward(cos, sin)
    }

    /// The point at an angle given by its cosine and sine.
    fn toward(&self, cos: f64, sin: f64) -> Sample {
        (self.centre + self.p * cos + self.q * sin, self.q * cos - self.p * sin)
    }

    pub(super) fn is_full(&self) -> bool {
        self.sweep == TAU
    }

    pub(super) fn is_circular(&self) -> bool {
        let (p, q) = (self.p.norm(), self.q.norm());
        (p - q).abs() <= SAME * p && self.p.dot(&self.q).abs() <= SAME * p * q
    }

    /// Whether the arc runs counter-clockwise.
    pub(super) fn is_left(&self) -> bool {
        self.p.perp(&self.q) > 0.0
    }

    fn reversed(&self) -> Self {
        if self.is_full() {
            return Self { q: -self.q, ..*self };
        }
        let (end, tangent) = self.at(self.sweep);
        Self { p: end - self.centre, q: -tangent, ..*self }
    }

    /// The same full ellipse, begun where `(cos, sin)` says.
    pub(super) fn begun_at(&self, cos: f64, sin: f64) -> Self {
        Self { p: self.p * cos + self.q * sin, q: self.q * cos - self.p * sin, ..*self }
    }
}

impl Piece {
    pub(super) fn start(&self) -> Point2<f64> {
        match self {
            Self::Line { from, .. } => *from,
            Self::Arc(arc) => arc.centre + arc.p,
            Self::Spline(curve) => curve.control_points()[0],
        }
    }

    /// Whether the piece alone is a closed outline.
    pub(super) fn is_closed(&self) -> bool {
        match self {
            Self::Line { .. } => false,
            Self::Arc(arc) => arc.is_full(),
            Self::Spline(_) => true,
        }
    }

    pub(super) fn reversed(&self) -> Self {
        match self {
            Self::Line { from, to } => Self::Line { from: *to, to: *from },
            Self::Arc(arc) => Self::Arc(arc.reversed()),
            Self::Spline(curve) => Self::Spline(curve.reversed()),
        }
    }

    /// Weights of the quadrature along the piece, node by node.
    pub(super) fn weights(&self) -> Vec<f64> {
        let times = |rule: &[(f64, f64)], count: usize, scale: f64| {
            (0..count).flat_map(|_| rule.iter().map(|(_, w)| w * scale)).collect()
        };
        match self {
            Self::Line { .. } => times(&gauss::SIXTEEN, 1, 1.0), // a cut makes it rational
            Self::Arc(arc) if arc.is_full() => {
                vec![TAU / gauss::TURN.len() as f64; gauss::TURN.len()]
            }
            Self::Arc(arc) => {
                let count = arc_parts(arc.sweep);
                times(&gauss::SIXTEEN, count, arc.sweep / count as f64)
            }
            Self::Spline(curve) => times(&gauss::FIVE, curve.breaks().len() - 1, 1.0),
        }
    }

    /// Points and derivatives at the nodes that belong to [`weights`](Self::weights).
    pub(super) fn samples(&self) -> Vec<Sample> {
        match self {
            Self::Line { from, to } => {
                let along = to - from;
                gauss::SIXTEEN.iter().map(|(u, _)| (from + along * *u, along)).collect()
            }
            Self::Arc(arc) if arc.is_full() => {
                gauss::TURN.iter().map(|(cos, sin)| arc.toward(*cos, *sin)).collect()
            }
            Self::Arc(arc) => {
                let count = arc_parts(arc.sweep);
                let step = arc.sweep / count as f64;
                (0..count)
                    .flat_map(|i| gauss::SIXTEEN.iter().map(move |(u, _)| step * (i as f64 + u)))
                    .map(|theta| arc.at(theta))
                    .collect()
            }
            Self::Spline(curve) => curve
                .spans()
                .flat_map(|b| gauss::FIVE.iter().map(move |(u, _)| ClosedSpline::bezier_at(&b, *u)))
                .collect(),
        }
    }

    /// The numbers that make up the piece, for telling how far two are apart.
    ///
    /// Pieces whose numbers are affine in a third parameter are so themselves.
    pub(super) fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Line { from, to } => vec![from.x, from.y, to.x, to.y],
            Self::Arc(Arc { centre: c, p, q, .. }) => vec![c.x, c.y, p.x, p.y, q.x, q.y],
            Self::Spline(curve) => curve.control_points().iter().flat_map(|p| [p.x, p.y]).collect(),
        }
    }

    /// Whether a surface can connect the two pieces point by point.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Line { .. }, Self::Line { .. }) => true,
            (Self::Arc(a), Self::Arc(b)) => {
                (a.sweep - b.sweep).abs() <= 1e-9 && a.is_left() == b.is_left()
            }
            (Self::Spline(a), Self::Spline(b)) => a.breaks() == b.breaks(),
            _ => false,
        }
    }

    /// Corners of a polygon along the piece, its end left out, for crossing tests.
    pub(super) fn polygon(&self) -> Vec<Point2<f64>> {
        match self {
            Self::Line { from, .. } => vec![*from],
            Self::Arc(arc) => {
                let count = (arc.sweep / (TAU / 36.0)).ceil().max(1.0);
                let at = |i: usize| arc.at(arc.sweep * i as f64 / count).0;
                (0..count as usize).map(at).collect()
            }
            Self::Spline(curve) => {
                curve.spans().flat_map(|b| [b[0], ClosedSpline::bezier_at(&b, 0.5).0]).collect()
            }
        }
    }

    /// Length of the polygon along the piece; a lower bound of its own length.
    pub(super) fn chord_length(&self) -> f64 {
        match self {
            Self::Line { from, to } => (to - from).norm(),
            Self::Arc(arc) => arc.p.norm().min(arc.q.norm()) * arc.sweep.min(1.0),
            Self::Spline(_) => f64::INFINITY, // each step was checked when it was made
        }
    }
}

/// In how many parts an arc is integrated: at most 90° each.
fn arc_parts(sweep: f64) -> usize {
    (sweep / FRAC_PI_2 - 1e-9).ceil().max(1.0) as usize
}

/// Signed area ½ ∮ (x dy − y dx) of a closed chain of pieces, mm².
pub(super) fn signed_area(pieces: &[Piece]) -> f64 {
    let Some(origin) = pieces.first().map(Piece::start) else { return 0.0 };
    let part = |piece: &Piece| -> f64 {
        let terms = piece.samples().into_iter().zip(piece.weights());
        terms.map(|((at, along), w)| w * (at - origin).perp(&along)).sum()
    };
    0.5 * pieces.iter().map(part).sum::<f64>()
}
