//! Closed smooth outlines through averaged real contours.
//!
//! The curve is the periodic C² cubic spline through its points, with the parameter growing as
//! the distance from point to point. Any program that lays such a spline through the same points
//! draws the same curve; all properties here are those of the curve, not of the polygon of its
//! points.

mod average;
mod simple;

use nalgebra::{Point2, Rotation2, Vector2};

use super::error::SectionError;
pub use average::{AverageError, average_outline};

/// A closed C² cubic curve through points.
///
/// Invariant: at least three points, finite, no two in a row the same; counter-clockwise or
/// clockwise as given.
#[derive(Clone, Debug, PartialEq)]
pub struct Freeform {
    points: Vec<Point2<f64>>,
}

/// Most sweeps over the equations of the spline. Each brings the slopes nearer by a factor of 2 at
/// least, since the diagonal is twice the sum of the rest: 60 reach the rounding of the numbers.
const SWEEPS: usize = 60;

impl Freeform {
    /// Lays the curve through points given in order around the outline.
    ///
    /// # Errors
    /// With fewer than three points, two equal points in a row, or a coordinate that is not
    /// finite.
    pub fn through(points: Vec<Point2<f64>>) -> Result<Self, SectionError> {
        if points.iter().any(|p| !(p.x.is_finite() && p.y.is_finite())) {
            return Err(SectionError::NotFinite { what: "a coordinate of an outline" });
        }
        let n = points.len();
        let distinct = (0..n).filter(|&i| points[i] != points[(i + 1) % n]).count();
        if distinct < n.max(3) {
            return Err(SectionError::TooFewPoints { points: distinct });
        }
        Ok(Self { points })
    }

    /// The points the curve goes through.
    pub fn points(&self) -> &[Point2<f64>] {
        &self.points
    }

    /// The cubic between each point and the next, as Bézier points.
    pub fn spans(&self) -> Vec<[Point2<f64>; 4]> {
        let n = self.points.len();
        let slopes = self.slopes();
        (0..n)
            .map(|i| {
                let (p, q) = (self.points[i], self.points[(i + 1) % n]);
                let third = (q - p).norm() / 3.0;
                [p, p + slopes[i] * third, q - slopes[(i + 1) % n] * third, q]
            })
            .collect()
    }

    /// Slopes mᵢ at the points such that second derivatives agree:
    /// mᵢ₋₁/hᵢ₋₁ + 2 (1/hᵢ₋₁ + 1/hᵢ) mᵢ + mᵢ₊₁/hᵢ = 3 (Δᵢ₋₁/hᵢ₋₁² + Δᵢ/hᵢ²).
    fn slopes(&self) -> Vec<Vector2<f64>> {
        let n = self.points.len();
        let chords: Vec<Vector2<f64>> =
            (0..n).map(|i| self.points[(i + 1) % n] - self.points[i]).collect();
        let lengths: Vec<f64> = chords.iter().map(Vector2::norm).collect();
        let sides: Vec<_> = (0..n)
            .map(|i| {
                let before = (i + n - 1) % n;
                let (g, h) = (lengths[before], lengths[i]);
                let right = (chords[before] / (g * g) + chords[i] / (h * h)) * 3.0;
                (g, h, right, 2.0 / g + 2.0 / h)
            })
            .collect();
        let mut slopes = vec![Vector2::zeros(); n];
        for _ in 0..SWEEPS {
            let mut moved = false;
            for (i, (g, h, right, diagonal)) in sides.iter().enumerate() {
                let rest = slopes[(i + n - 1) % n] / *g + slopes[(i + 1) % n] / *h;
                let slope = (right - rest) / *diagonal;
                moved |= slope != slopes[i];
                slopes[i] = slope;
            }
            if !moved {
                break;
            }
        }
        slopes
    }

    /// The curve with every point mapped.
    pub(crate) fn mapped(&self, map: impl Fn(Point2<f64>) -> Point2<f64>) -> Self {
        Self { points: self.points.iter().map(|&p| map(p)).collect() }
    }

    /// The curve turned about the origin by an angle in rad.
    pub fn turned(&self, angle: f64) -> Self {
        let turn = Rotation2::new(angle);
        self.mapped(|p| turn * p)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::section::outline::Outline;
    use crate::section::piece::Piece;

    #[test]
    fn sixteen_points_make_a_circle_to_a_ten_thousandth() {
        let points = (0..16).map(|i| {
            let (sin, cos) = (TAU * f64::from(i) / 16.0).sin_cos();
            Point2::new(3.0 * cos, 3.0 * sin)
        });
        let curve = Freeform::through(points.collect()).unwrap();
        let area = Piece::area(&Outline::Freeform(curve).pieces());
        assert!((area / (9.0 * TAU / 2.0) - 1.0).abs() < 1e-4, "{area}");
    }

    #[test]
    fn spans_join_with_equal_slope_and_curvature() {
        let points = [(0.0, 0.0), (5.0, -1.0), (7.0, 2.0), (4.0, 5.0), (0.0, 4.0)];
        let points: Vec<_> = points.map(|(x, y)| Point2::new(x, y)).to_vec();
        let lengths: Vec<f64> = (0..5).map(|i| (points[(i + 1) % 5] - points[i]).norm()).collect();
        let spans = Freeform::through(points).unwrap().spans();
        for i in 0..5 {
            let (a, b) = (spans[i], spans[(i + 1) % 5]);
            let (g, h) = (lengths[i], lengths[(i + 1) % 5]);
            assert!(((a[3] - a[2]) / g - (b[1] - b[0]) / h).norm() < 1e-12);
            let second_a = (a[3] - a[2]) - (a[2] - a[1]);
            let second_b = (b[2] - b[1]) - (b[1] - b[0]);
            assert!((second_a / (g * g) - second_b / (h * h)).norm() < 1e-12);
        }
    }

    #[test]
    fn repeated_point_is_refused() {
        let points = [(0.0, 0.0), (0.0, 0.0), (1.0, 0.0), (0.0, 1.0)];
        let points = points.map(|(x, y)| Point2::new(x, y)).to_vec();
        assert_eq!(Freeform::through(points), Err(SectionError::TooFewPoints { points: 3 }));
    }
}
