//! A smooth closed curve through given points, the outline of a freeform beam.
//!
//! The curve is the periodic C² cubic spline through the points, its parameter
//! growing about as the distance from point to point does, which keeps it from
//! bulging where points are unevenly spaced.  It is held exactly as it is
//! written to the file: as a clamped cubic B-spline with simple inner knots.
//! To keep files small, parameters are rounded to ten decimals before the
//! spline is solved, and control points to eleven digits after it: the area is
//! that of the spline through the given points ([`Freeform`](crate::section::Freeform))
//! to about 1e-10.  What is drawn and integrated is that same rounded curve.

use nalgebra::{Point2, Vector2};

use super::error::BodyError;
use super::spline::{clamped_ordinates, closed_second_derivatives};
use super::tolerance::SHORTEST;

/// Decimals of a parameter.
const DECIMALS: i32 = 10;

/// Digits of the largest coordinate of a control point.
const DIGITS: i32 = 11;

/// Breaks closer than this, in the unit parameter, are one break: those of a curve and of the same
/// curve at another scale may be rounded to different sides.
const SAME_BREAK: f64 = 3e-10;

/// A closed C² cubic B-spline in the plane of a section.
///
/// Invariant: breaks ascend from 0 to 1; there are two more control points
/// than breaks; the last control point is the first.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClosedSpline {
    breaks: Vec<f64>,
    control: Vec<Point2<f64>>,
}

impl ClosedSpline {
    /// Lays the curve through points given in order around the outline.
    ///
    /// # Errors
    /// With fewer than three points, with two equal points in a row, or with a
    /// coordinate that is not finite.
    pub(crate) fn through(points: &[Point2<f64>]) -> Result<Self, BodyError> {
        let parameters = rounded(&chord_fractions(points)?);
        Ok(Self::interpolate(&parameters, points))
    }

    /// Solves the periodic spline over `breaks`, one more than points.
    fn interpolate(breaks: &[f64], points: &[Point2<f64>]) -> Self {
        let ordinates = |axis: usize| {
            let open: Vec<f64> = points.iter().map(|p| p[axis]).collect();
            let second = closed_second_derivatives(breaks, &open);
            let around: Vec<f64> = open.iter().chain(&open[..1]).copied().collect();
            clamped_ordinates(breaks, &around, &second)
        };
        let (x, y) = (ordinates(0), ordinates(1));
        let decimals = decimals_of(points);
        let mut control: Vec<_> = x
            .into_iter()
            .zip(y)
            .map(|(x, y)| Point2::new(round_to(x, decimals), round_to(y, decimals)))
            .collect();
        let last = control.len() - 1;
        control[last] = control[0];
        Self { breaks: breaks.to_vec(), control }
    }

    /// Parameters where one cubic span ends and the next begins, from 0 to 1.
    pub(super) fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Control points on the clamped [`knots`](Self::knots).
    pub(super) fn control_points(&self) -> &[Point2<f64>] {
        &self.control
    }

    /// The full knot vector: the breaks, with the first and last four times.
    pub(super) fn knots(&self) -> Vec<f64> {
        let n = self.breaks.len();
        (0..n + 6).map(|i| self.knot(i)).collect()
    }

    fn knot(&self, i: usize) -> f64 {
        self.breaks[i.saturating_sub(3).min(self.breaks.len() - 1)]
    }

    /// The cubic spans in order, each as its four Bézier points.
    pub(super) fn spans(&self) -> impl Iterator<Item = [Point2<f64>; 4]> + '_ {
        self.breaks.windows(2).enumerate().map(|(i, w)| {
            let (a, b) = (w[0], w[1]);
            [[a, a, a], [a, a, b], [a, b, b], [b, b, b]].map(|at| self.blossom(i, at))
        })
    }

    /// The point at a parameter of `[0, 1]`.
    pub(crate) fn point(&self, t: f64) -> Point2<f64> {
        let after = self.breaks.partition_point(|&b| b <= t);
        self.blossom(after.clamp(1, self.breaks.len() - 1) - 1, [t; 3])
    }

    /// Polar form of one span at three parameters (de Boor's algorithm).
    fn blossom(&self, span: usize, at: [f64; 3]) -> Point2<f64> {
        let mut d: [Point2<f64>; 4] = std::array::from_fn(|j| self.control[span + j]);
        for (round, t) in at.into_iter().enumerate() {
            for j in 0..3 - round {
                let low = self.knot(span + 1 + round + j);
                let high = self.knot(span + 4 + j);
                d[j] += (d[j + 1] - d[j]) * ((t - low) / (high - low));
            }
        }
        d[0]
    }

    /// The same curve run backwards.
    pub(super) fn reversed(&self) -> Self {
        Self {
            breaks: self.breaks.iter().rev().map(|b| round_to(1.0 - b, 12)).collect(),
            control: self.control.iter().rev().copied().collect(),
        }
    }

    /// The same curve with further breaks: those of `other`.
    pub(super) fn refined(&self, other: &Self) -> Self {
        let mut refined = self.clone();
        for &t in &other.breaks {
            refined.insert_break(t);
        }
        refined
    }

    /// The same curve on the breaks of `union`, which has all of its own.
    pub(super) fn on_breaks_of(&self, union: &Self) -> Self {
        let refined = self.refined(union);
        if refined.breaks.len() != union.breaks.len() {
            return refined;
        }
        Self { breaks: union.breaks.clone(), control: refined.control }
    }

    /// Inserts one simple knot (Boehm's algorithm), unless it is there.
    fn insert_break(&mut self, t: f64) {
        let after = self.breaks.partition_point(|&b| b < t - SAME_BREAK);
        if self.breaks.get(after).is_none_or(|b| (b - t).abs() <= SAME_BREAK) {
            return;
        }
        let span = after - 1;
        let between: Vec<_> = (span + 1..span + 4)
            .map(|j| {
                let (low, high) = (self.knot(j), self.knot(j + 3));
                let before = self.control[j - 1];
                before + (self.control[j] - before) * ((t - low) / (high - low))
            })
            .collect();
        self.control.splice(span + 1..span + 3, between);
        self.breaks.insert(after, t);
    }

    /// Position and derivative in the unit parameter of a span.
    pub(super) fn bezier_at(b: &[Point2<f64>; 4], u: f64) -> (Point2<f64>, Vector2<f64>) {
        let v = 1.0 - u;
        let quadratic = [0, 1, 2].map(|i| b[i] + (b[i + 1] - b[i]) * u);
        let linear = [0, 1].map(|i| quadratic[i] * v + quadratic[i + 1].coords * u);
        (linear[0] * v + linear[1].coords * u, (linear[1] - linear[0]) * 3.0)
    }
}

/// Fraction of the chord length at each point, with 1 for the return to the first.
fn chord_fractions(points: &[Point2<f64>]) -> Result<Vec<f64>, BodyError> {
    if points.iter().any(|p| !p.coords.iter().all(|x| x.is_finite())) {
        return Err(BodyError::NotFinite { what: "an outline point" });
    }
    if points.len() < 3 {
        return Err(BodyError::NoArea);
    }
    let mut reached = vec![0.0];
    for (i, p) in points.iter().enumerate() {
        let length = (points[(i + 1) % points.len()] - p).norm();
        if length < SHORTEST {
            return Err(BodyError::TinyEdge { piece: i, length });
        }
        reached.push(reached[i] + length);
    }
    let whole = reached[points.len()];
    if !whole.is_finite() {
        return Err(BodyError::NotFinite { what: "the length of an outline" });
    }
    Ok(reached.into_iter().map(|length| length / whole).collect())
}

/// Rounds parameters, the first and last of which are 0 and 1.
fn rounded(parameters: &[f64]) -> Vec<f64> {
    parameters.iter().map(|&t| round_to(t, DECIMALS)).collect()
}

/// Decimals that leave so many digits to the largest coordinate.
fn decimals_of(points: &[Point2<f64>]) -> i32 {
    let size = points.iter().map(|p| p.coords.amax()).fold(f64::MIN_POSITIVE, f64::max);
    DIGITS - 1 - size.log10().floor() as i32
}

/// Rounds to a number of decimals, which may be negative.
fn round_to(x: f64, decimals: i32) -> f64 {
    let scale = 10f64.powi(decimals.abs());
    if !scale.is_finite() {
        x
    } else if decimals >= 0 {
        (x * scale).round() / scale
    } else {
        (x / scale).round() * scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wavy(n: usize, phase: f64) -> Vec<Point2<f64>> {
        (0..n)
            .map(|i| {
                let t = std::f64::consts::TAU * i as f64 / n as f64;
                let r = 10.0 + 2.0 * (3.0 * t + phase).cos();
                Point2::new(r * t.cos(), 0.7 * r * t.sin())
            })
            .collect()
    }

    #[test]
    fn curve_passes_through_its_points_in_order() {
        let points = wavy(17, 0.3);
        let curve = ClosedSpline::through(&points).unwrap();
        for (t, p) in curve.breaks().iter().zip(&points) {
            assert!((curve.point(*t) - p).norm() < 1e-6);
        }
    }

    #[test]
    fn curve_is_smooth_where_it_closes() {
        let curve = ClosedSpline::through(&wavy(12, 1.0)).unwrap();
        let spans: Vec<_> = curve.spans().collect();
        let h = |i: usize| curve.breaks()[i + 1] - curve.breaks()[i];
        let end = (spans[11][3] - spans[11][2]) / h(11);
        let start = (spans[0][1] - spans[0][0]) / h(0);
        assert!((end - start).norm() < 1e-4 * start.norm(), "{end} {start}");
    }

    #[test]
    fn refining_does_not_move_the_curve() {
        let (a, b) = (wavy(9, 0.0), wavy(11, 2.0));
        let (a, b) = (ClosedSpline::through(&a).unwrap(), ClosedSpline::through(&b).unwrap());
        let refined = a.refined(&b);
        assert!(refined.breaks().len() > a.breaks().len());
        assert_eq!(refined.control_points().len(), refined.breaks().len() + 2);
        for i in 0..=100 {
            let t = f64::from(i) / 100.0;
            assert!((refined.point(t) - a.point(t)).norm() < 1e-12);
        }
    }

    #[test]
    fn reversed_curve_has_the_same_points() {
        let a = ClosedSpline::through(&wavy(9, 0.0)).unwrap();
        let r = a.reversed();
        for i in 0..=50 {
            let t = f64::from(i) / 50.0;
            assert!((r.point(t) - a.point(1.0 - t)).norm() < 1e-12);
        }
    }

    #[test]
    fn equal_neighbours_are_refused() {
        let mut points = wavy(8, 0.0);
        points[3] = points[2];
        let fault = ClosedSpline::through(&points).unwrap_err();
        assert!(matches!(fault, BodyError::TinyEdge { piece: 2, .. }));
    }

    #[test]
    fn rounding_keeps_few_decimals() {
        assert_eq!(round_to(12.345_678_9, 3), 12.346);
        assert_eq!(round_to(123_456.0, -2), 123_500.0);
        let t = rounded(&[0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]);
        assert_eq!(t, [0.0, 0.333_333_333_3, 0.666_666_666_7, 1.0]);
    }
}
