//! The outline of a section as a ring: one closed chain of smooth pieces, checked.
//!
//! An outline may run either way round; its ring runs counter-clockwise. Every kind stays exact:
//!
//! | outline    | pieces              | swept straight gives                  |
//! |------------|---------------------|---------------------------------------|
//! | `Circle`   | one full arc        | cylinder or cone                      |
//! | `Ellipse`  | one full arc        | extruded ellipse, or ruled if tapered |
//! | `Path`     | lines, circular arcs| planes and cylinders                  |
//! | `Freeform` | one closed spline   | ruled B-spline                        |

use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use super::closed_spline::ClosedSpline;
use super::crossing::first_crossing;
use super::error::{BodyError, positive};
use super::piece::{Arc, Piece, signed_area};
use super::tolerance::SHORTEST;
use crate::section::outline::{Outline, Path, Segment, arc_centre};

/// One closed outline: counter-clockwise outside, clockwise as a hole.
pub(super) type Ring = Vec<Piece>;

/// Least turn of an arc, and least it lacks of a full circle, rad: beyond, its centre cannot be told
/// from its ends.
const LEAST_SWEEP: f64 = 1e-6;

/// The pieces of an outline, counter-clockwise, checked one by one and as a whole.
///
/// # Errors
/// If the outline encloses no area, crosses itself or is not finite.
pub(super) fn ring(outline: &Outline) -> Result<Ring, BodyError> {
    let pieces = pieces(outline)?;
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
    let may_cross = pieces.len() > 1 || matches!(outline, Outline::Freeform(_));
    if may_cross && let Some([(_, first), (_, second)]) = first_crossing(&[&pieces]) {
        return Err(BodyError::SelfCrossing { first, second });
    }
    Ok(if area > 0.0 { pieces } else { reversed(&pieces) })
}

fn pieces(outline: &Outline) -> Result<Ring, BodyError> {
    match outline {
        Outline::Circle { centre, radius } => {
            positive("a radius", *radius)?;
            Ok(vec![full_arc(*centre, Vector2::x() * *radius, Vector2::y() * *radius)?])
        }
        Outline::Ellipse { centre, half_axes: [a, b], turn } => {
            positive("a half-axis", *a)?;
            positive("a half-axis", *b)?;
            let (sin, cos) = turn.sin_cos();
            let (p, q) = (Vector2::new(cos, sin) * *a, Vector2::new(-sin, cos) * *b);
            Ok(vec![full_arc(*centre, p, q)?])
        }
        Outline::Path(path) => along(path),
        Outline::Freeform(curve) => Ok(vec![Piece::Spline(ClosedSpline::through(curve.points())?)]),
    }
}

fn along(path: &Path) -> Result<Ring, BodyError> {
    let mut from = path.start;
    let mut pieces = Vec::with_capacity(path.segments.len() + 1);
    for segment in &path.segments {
        pieces.push(match *segment {
            Segment::Line { to } => Piece::Line { from, to },
            Segment::Arc { to, sweep } => arc_between(from, to, sweep)?,
        });
        from = segment.end();
    }
    if from != path.start {
        pieces.push(Piece::Line { from, to: path.start });
    }
    if pieces.len() < 2 { Err(BodyError::NoArea) } else { Ok(pieces) }
}

/// The circular arc from one point to another that turns by `sweep`, rad.
fn arc_between(from: Point2<f64>, to: Point2<f64>, sweep: f64) -> Result<Piece, BodyError> {
    if !sweep.is_finite() {
        return Err(BodyError::NotFinite { what: "the sweep of an arc" });
    }
    let size = sweep.abs();
    if !(LEAST_SWEEP..TAU - LEAST_SWEEP).contains(&size) {
        return Err(BodyError::BadSweep { radians: sweep });
    }
    let centre = arc_centre(from, to, sweep);
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
pub(super) fn reversed(pieces: &[Piece]) -> Ring {
    pieces.iter().rev().map(Piece::reversed).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;
    use crate::section::freeform::Freeform;

    fn polygon(corners: &[(f64, f64)]) -> Outline {
        Outline::polygon(&corners.iter().map(|&(x, y)| Point2::new(x, y)).collect::<Vec<_>>())
    }

    fn area(outline: &Outline) -> Result<f64, BodyError> {
        ring(outline).map(|pieces| signed_area(&pieces))
    }

    #[test]
    fn areas_are_those_of_the_formulas() {
        assert!((area(&Outline::circle(3.0)).unwrap() - 9.0 * PI).abs() < 1e-13);
        assert!((area(&Outline::ellipse(2.0, 5.0)).unwrap() - 10.0 * PI).abs() < 1e-13);
        let triangle = polygon(&[(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)]);
        assert!((area(&triangle).unwrap() - 6.0).abs() < 1e-14);
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
        let triangle = polygon(&[(0.0, 0.0), (0.0, 3.0), (4.0, 0.0)]);
        assert!((area(&triangle).unwrap() - 6.0).abs() < 1e-14);
    }

    #[test]
    fn freeform_area_is_that_of_its_spans() {
        let points = (0..20).map(|i| {
            let (sin, cos) = (TAU * f64::from(i) / 20.0).sin_cos();
            Point2::new(9.0 * cos + (3.0 * cos).sin(), 7.0 * sin)
        });
        let outline = Outline::Freeform(Freeform::through(points.collect()).unwrap());
        let ring = ring(&outline).unwrap();
        let [Piece::Spline(curve)] = &ring[..] else { panic!("{ring:?}") };
        // ½ ∮ x dy − y dx of a Bézier cubic, by its control points.
        let span = |b: [Point2<f64>; 4]| {
            let w = |i: usize, j: usize| b[i].coords.perp(&b[j].coords);
            let (near, far) = (w(0, 1) + w(2, 3), w(0, 2) + w(1, 2) + w(1, 3));
            (6.0 * near + 3.0 * far + w(0, 3)) / 20.0
        };
        let meant: f64 = curve.spans().map(span).sum();
        assert!((signed_area(&ring) / meant - 1.0).abs() < 1e-12);
    }

    #[test]
    fn bad_outlines_are_named() {
        assert!(matches!(area(&Outline::circle(-1.0)), Err(BodyError::NotPositive { .. })));
        assert!(matches!(area(&Outline::circle(f64::NAN)), Err(BodyError::NotFinite { .. })));
        let bow = [(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 3.0)];
        assert!(matches!(area(&polygon(&bow)), Err(BodyError::SelfCrossing { .. })));
        assert_eq!(area(&polygon(&bow[..2])), Err(BodyError::NoArea));
    }
}
