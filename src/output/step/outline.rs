//! Outlines of sections: what a station of a loft is cut to.
//!
//! Coordinates are those of the section plane, mm; an outline may run either
//! way round.  Every kind ends up as a chain of smooth pieces, and stays exact:
//!
//! | outline    | pieces              | swept straight gives                  |
//! |------------|---------------------|---------------------------------------|
//! | `Circle`   | one full arc        | cylinder or cone                      |
//! | `Ellipse`  | one full arc        | extruded ellipse, or ruled if tapered |
//! | `Path`     | lines, circular arcs| planes and cylinders                  |
//! | `Freeform` | one closed spline   | ruled B-spline                        |

use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use super::crossing::first_crossing;
use super::error::BodyError;
use super::freeform::Freeform;
use super::piece::{Arc, Piece, SHORTEST, centroid, signed_area};

/// A closed curve in the plane of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A circle.
    Circle {
        /// Centre.
        centre: Point2<f64>,
        /// Radius.
        radius: f64,
    },
    /// An ellipse.
    Ellipse {
        /// Centre.
        centre: Point2<f64>,
        /// The two half-axes, in any order.
        half_axes: [f64; 2],
        /// Turn of the first half-axis from x, in radians.
        turn: f64,
    },
    /// Lines and circular arcs.
    Path(Path),
    /// A smooth curve through points.
    Freeform(Freeform),
}

/// A chain of lines and circular arcs; its end is joined to its start by a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Where the chain begins.
    pub start: Point2<f64>,
    /// The pieces, each from the end of the one before.
    pub segments: Vec<Segment>,
}

/// One piece of a [`Path`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// Straight to a point.
    Line {
        /// End of the piece.
        to: Point2<f64>,
    },
    /// Along a circle to a point.
    Arc {
        /// End of the piece.
        to: Point2<f64>,
        /// Angle of the arc in radians, within ±2π; positive is counter-clockwise.
        sweep: f64,
    },
}

impl Outline {
    /// A circle about the beam axis.
    pub fn circle(radius: f64) -> Self {
        Self::Circle { centre: Point2::origin(), radius }
    }

    /// An ellipse about the beam axis with its half-axes along x and y.
    pub fn ellipse(half_x: f64, half_y: f64) -> Self {
        Self::Ellipse { centre: Point2::origin(), half_axes: [half_x, half_y], turn: 0.0 }
    }

    /// A polygon through the given corners.
    pub fn polygon(corners: &[Point2<f64>]) -> Self {
        let mut corners = corners.iter().copied();
        let start = corners.next().unwrap_or_default();
        Self::Path(Path { start, segments: corners.map(|to| Segment::Line { to }).collect() })
    }

    /// Enclosed area, mm².
    ///
    /// # Errors
    /// If the outline encloses none, crosses itself or is not finite.
    pub fn area(&self) -> Result<f64, BodyError> {
        Ok(signed_area(&self.ring()?))
    }

    /// Centroid of the enclosed area.
    ///
    /// # Errors
    /// As [`area`](Self::area).
    pub fn centroid(&self) -> Result<Point2<f64>, BodyError> {
        Ok(centroid(&self.ring()?))
    }

    /// The pieces, counter-clockwise, checked one by one and as a whole.
    pub(super) fn ring(&self) -> Result<Vec<Piece>, BodyError> {
        let pieces = self.pieces()?;
        for (piece, length) in pieces.iter().map(Piece::chord_length).enumerate() {
            if length.is_nan() {
                return Err(BodyError::NotFinite { what: "an outline" });
            }
            if length < SHORTEST {
                return Err(BodyError::TinyEdge { piece, length });
            }
        }
        let area = signed_area(&pieces);
        if !area.is_finite() {
            return Err(BodyError::NotFinite { what: "the area of an outline" });
        }
        if area.abs() < SHORTEST * SHORTEST {
            return Err(BodyError::NoArea);
        }
        let may_cross = pieces.len() > 1 || matches!(self, Self::Freeform(_));
        if may_cross && let Some([(_, first), (_, second)]) = first_crossing(&[&pieces]) {
            return Err(BodyError::SelfCrossing { first, second });
        }
        Ok(if area > 0.0 { pieces } else { reversed(&pieces) })
    }

    fn pieces(&self) -> Result<Vec<Piece>, BodyError> {
        match self {
            Self::Circle { centre, radius } => {
                positive("a radius", *radius)?;
                Ok(vec![full_arc(*centre, Vector2::x() * *radius, Vector2::y() * *radius)?])
            }
            Self::Ellipse { centre, half_axes: [a, b], turn } => {
                positive("a half-axis", *a)?;
                positive("a half-axis", *b)?;
                let (sin, cos) = turn.sin_cos();
                let (p, q) = (Vector2::new(cos, sin) * *a, Vector2::new(-sin, cos) * *b);
                Ok(vec![full_arc(*centre, p, q)?])
            }
            Self::Path(path) => path.pieces(),
            Self::Freeform(curve) => Ok(vec![Piece::Spline(curve.clone())]),
        }
    }
}

impl Path {
    fn pieces(&self) -> Result<Vec<Piece>, BodyError> {
        let mut from = self.start;
        let mut pieces = Vec::with_capacity(self.segments.len() + 1);
        for segment in &self.segments {
            let (piece, to) = match *segment {
                Segment::Line { to } => (Piece::Line { from, to }, to),
                Segment::Arc { to, sweep } => (arc_between(from, to, sweep)?, to),
            };
            pieces.push(piece);
            from = to;
        }
        if from != self.start {
            pieces.push(Piece::Line { from, to: self.start });
        }
        if pieces.len() < 2 { Err(BodyError::NoArea) } else { Ok(pieces) }
    }
}

/// The circular arc from one point to another that turns by `sweep`.
///
/// Its centre lies off the middle of the chord c by ½|c| / tan(sweep/2).
fn arc_between(from: Point2<f64>, to: Point2<f64>, sweep: f64) -> Result<Piece, BodyError> {
    if !sweep.is_finite() {
        return Err(BodyError::NotFinite { what: "the sweep of an arc" });
    }
    let size = sweep.abs();
    if !(1e-6..TAU - 1e-6).contains(&size) {
        return Err(BodyError::BadSweep { radians: sweep });
    }
    let chord = to - from;
    let off = Vector2::new(-chord.y, chord.x) * (0.5 / (0.5 * sweep).tan());
    let centre = from + chord * 0.5 + off;
    let p = from - centre;
    let q = Vector2::new(-p.y, p.x) * sweep.signum();
    Ok(Piece::Arc(Arc { centre, p, q, sweep: size }))
}

fn full_arc(centre: Point2<f64>, p: Vector2<f64>, q: Vector2<f64>) -> Result<Piece, BodyError> {
    if !(centre.coords + p + q).iter().all(|x| x.is_finite()) {
        return Err(BodyError::NotFinite { what: "an outline" });
    }
    Ok(Piece::Arc(Arc { centre, p, q, sweep: TAU }))
}

/// The chain run backwards from the same start.
pub(super) fn reversed(pieces: &[Piece]) -> Vec<Piece> {
    pieces.iter().rev().map(Piece::reversed).collect()
}

/// Refuses what is not a positive finite number.
pub(super) fn positive(what: &'static str, value: f64) -> Result<(), BodyError> {
    if !value.is_finite() {
        Err(BodyError::NotFinite { what })
    } else if value <= 0.0 {
        Err(BodyError::NotPositive { what, value })
    } else {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn areas_are_those_of_the_formulas() {
        assert!((Outline::circle(3.0).area().unwrap() - 9.0 * PI).abs() < 1e-13);
        assert!((Outline::ellipse(2.0, 5.0).area().unwrap() - 10.0 * PI).abs() < 1e-13);
        let corners = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)].map(|(x, y)| Point2::new(x, y));
        assert!((Outline::polygon(&corners).area().unwrap() - 6.0).abs() < 1e-14);
    }

    #[test]
    fn quarter_arc_has_its_centre_in_the_corner() {
        let (from, to) = (Point2::new(5.0, 1.0), Point2::new(4.0, 2.0));
        let Piece::Arc(arc) = arc_between(from, to, FRAC_PI_2).unwrap() else { panic!() };
        assert!((arc.centre - Point2::new(4.0, 1.0)).norm() < 1e-15);
        assert!((arc.at(arc.sweep).0 - to).norm() < 1e-15);
        let Piece::Arc(arc) = arc_between(from, to, -FRAC_PI_2).unwrap() else { panic!() };
        assert!((arc.centre - Point2::new(5.0, 2.0)).norm() < 1e-15);
        assert!((arc.at(arc.sweep).0 - to).norm() < 1e-15);
    }

    #[test]
    fn clockwise_outline_is_turned_around() {
        let corners = [(0.0, 0.0), (0.0, 3.0), (4.0, 0.0)].map(|(x, y)| Point2::new(x, y));
        let ring = Outline::polygon(&corners).ring().unwrap();
        assert_eq!(ring[0].start(), corners[0]);
        assert!(signed_area(&ring) > 0.0);
    }

    #[test]
    fn bad_outlines_are_named() {
        assert!(matches!(Outline::circle(-1.0).area(), Err(BodyError::NotPositive { .. })));
        assert!(matches!(Outline::circle(f64::NAN).area(), Err(BodyError::NotFinite { .. })));
        let bow = [(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 3.0)].map(|(x, y)| Point2::new(x, y));
        assert!(matches!(Outline::polygon(&bow).area(), Err(BodyError::SelfCrossing { .. })));
        assert_eq!(Outline::polygon(&bow[..2]).area(), Err(BodyError::NoArea));
    }
}
