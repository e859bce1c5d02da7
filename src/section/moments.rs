//! Area and moments of a plane region, from polygons or from smooth pieces, by Green's theorem: both
//! exact.
//!
//! I_xx = ∫ y² dA, I_yy = ∫ x² dA, I_xy = ∫ x y dA.

use std::f64::consts::PI;

use nalgebra::{Point2, Vector2};

use super::contours::{Contours, sides};
use super::error::SectionError;
use super::piece::Piece;

/// Area and first and second moments about the origin of the coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Moments {
    pub(crate) area: f64,
    pub(crate) first: Vector2<f64>,
    pub(crate) i_xx: f64,
    pub(crate) i_yy: f64,
    pub(crate) i_xy: f64,
}

impl Contours {
    /// Moments about the origin of the coordinates.
    ///
    /// # Errors
    /// If a coordinate is not finite, a polygon has fewer than three points or no area, or the holes
    /// are larger than the outline.
    pub(crate) fn moments(&self) -> Result<Moments, SectionError> {
        for polygon in self.polygons() {
            check_polygon(polygon)?;
        }
        let about = self.outer[0];
        let outer = Moments::of_polygon(&self.outer, about);
        if outer.area == 0.0 {
            return Err(SectionError::NoArea);
        }
        let mut region = outer;
        for hole in &self.holes {
            region.subtract(&Moments::of_polygon(hole, about));
        }
        if region.area <= 0.0 {
            return Err(SectionError::HolesTooLarge {
                holes: outer.area - region.area,
                outer: outer.area,
            });
        }
        Ok(region.shifted(about.coords))
    }
}

fn check_polygon(polygon: &[Point2<f64>]) -> Result<(), SectionError> {
    if polygon.iter().any(|p| !(p.x.is_finite() && p.y.is_finite())) {
        return Err(SectionError::NotFinite { what: "a coordinate of a contour" });
    }
    if polygon.len() < 3 {
        return Err(SectionError::TooFewPoints { points: polygon.len() });
    }
    Ok(())
}

impl Moments {
    /// Moments of a polygon about a point, as if it ran counter-clockwise.
    ///
    /// With wᵢ = xᵢ yᵢ₊₁ − xᵢ₊₁ yᵢ:
    /// A = ½ Σ wᵢ, S_x = ⅙ Σ wᵢ (xᵢ + xᵢ₊₁),
    /// I_xx = ¹⁄₁₂ Σ wᵢ (yᵢ² + yᵢ yᵢ₊₁ + yᵢ₊₁²),
    /// I_xy = ¹⁄₂₄ Σ wᵢ (xᵢ yᵢ₊₁ + 2 xᵢ yᵢ + 2 xᵢ₊₁ yᵢ₊₁ + xᵢ₊₁ yᵢ).
    fn of_polygon(polygon: &[Point2<f64>], about: Point2<f64>) -> Self {
        let mut m = Self::default();
        for (p, q) in sides(polygon) {
            let (p, q) = (p - about, q - about);
            let w = p.perp(&q);
            m.area += w / 2.0;
            m.first += (p + q) * (w / 6.0);
            m.i_xx += w * (p.y * p.y + p.y * q.y + q.y * q.y) / 12.0;
            m.i_yy += w * (p.x * p.x + p.x * q.x + q.x * q.x) / 12.0;
            m.i_xy += w * (p.x * q.y + 2.0 * p.x * p.y + 2.0 * q.x * q.y + q.x * p.y) / 24.0;
        }
        if m.area < 0.0 { m.scaled(-1.0) } else { m }
    }

    /// Moments of the region on the left of a chain of pieces:
    /// A = ½ ∮ (x dy − y dx), S_x = ½ ∮ x² dy, S_y = −½ ∮ y² dx, I_xx = ∮ x y² dy,
    /// I_yy = ⅓ ∮ x³ dy, I_xy = ½ ∮ x² y dy.
    pub(crate) fn of_pieces(pieces: &[Piece]) -> Self {
        let mut m = Self::default();
        for piece in pieces {
            piece.visit([0.0, 1.0], |p, d, weight| {
                let (dx, dy) = (weight * d.x, weight * d.y);
                m.area += 0.5 * (p.x * dy - p.y * dx);
                m.first.x += 0.5 * p.x * p.x * dy;
                m.first.y -= 0.5 * p.y * p.y * dx;
                m.i_xx += p.x * p.y * p.y * dy;
                m.i_yy += p.x * p.x * p.x * dy / 3.0;
                m.i_xy += 0.5 * p.x * p.x * p.y * dy;
            });
        }
        m
    }

    fn scaled(self, s: f64) -> Self {
        Self {
            area: s * self.area,
            first: self.first * s,
            i_xx: s * self.i_xx,
            i_yy: s * self.i_yy,
            i_xy: s * self.i_xy,
        }
    }

    fn subtract(&mut self, other: &Self) {
        self.area -= other.area;
        self.first -= other.first;
        self.i_xx -= other.i_xx;
        self.i_yy -= other.i_yy;
        self.i_xy -= other.i_xy;
    }

    /// The same region moved by `by`.
    fn shifted(&self, by: Vector2<f64>) -> Self {
        let (s, a) = (self.first, self.area);
        Self {
            area: a,
            first: s + by * a,
            i_xx: self.i_xx + 2.0 * by.y * s.y + by.y * by.y * a,
            i_yy: self.i_yy + 2.0 * by.x * s.x + by.x * by.x * a,
            i_xy: self.i_xy + by.x * s.y + by.y * s.x + by.x * by.y * a,
        }
    }

    pub(crate) fn centroid(&self) -> Point2<f64> {
        (self.first / self.area).into()
    }

    /// The moments about the centroid (Steiner).
    pub(crate) fn central(&self) -> Self {
        self.shifted(-self.centroid().coords)
    }

    /// Principal moments and angle: (I_1, I_2, θ).
    ///
    /// I_1,2 = ½ (I_xx + I_yy) ± √(¼ (I_xx − I_yy)² + I_xy²), tan 2θ = −2 I_xy / (I_xx − I_yy).
    pub(crate) fn principal(&self) -> (f64, f64, f64) {
        let mean = 0.5 * (self.i_xx + self.i_yy);
        let difference = 0.5 * (self.i_xx - self.i_yy);
        let radius = difference.hypot(self.i_xy);
        let mut angle = 0.5 * (-self.i_xy).atan2(difference);
        if angle <= -0.5 * PI {
            angle += PI;
        }
        (mean + radius, mean - radius, angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::section::outline::Outline;

    fn points(corners: &[(f64, f64)]) -> Vec<Point2<f64>> {
        corners.iter().map(|&(x, y)| Point2::new(x, y)).collect()
    }

    /// Gere and Goodno, Mechanics of Materials, appendix: triangle of base b and height h has
    /// I = b h³ / 36 about the centroid, and I_xy = b² h² / 72 · (−1) for the right angle at the
    /// origin.
    #[test]
    fn right_triangle_has_b_h_cubed_over_36() {
        let (b, h) = (6.0, 9.0);
        let region = Contours::solid(points(&[(0.0, 0.0), (b, 0.0), (0.0, h)]));
        let m = region.moments().unwrap();
        let c = m.central();
        assert!((m.centroid() - Point2::new(b / 3.0, h / 3.0)).norm() < 1e-14);
        assert!((c.i_xx - b * h.powi(3) / 36.0).abs() < 1e-10);
        assert!((c.i_yy - h * b.powi(3) / 36.0).abs() < 1e-10);
        assert!((c.i_xy + b * b * h * h / 72.0).abs() < 1e-10);
    }

    #[test]
    fn hole_takes_its_moments_away() {
        let square = |a: f64| points(&[(-a, -a), (a, -a), (a, a), (-a, a)]);
        let frame = Contours { outer: square(3.0), holes: vec![square(2.0)] };
        let c = frame.moments().unwrap().central();
        assert!((c.area - 20.0).abs() < 1e-12);
        assert!((c.i_xx - (6.0f64.powi(4) - 4.0f64.powi(4)) / 12.0).abs() < 1e-10);
    }

    #[test]
    fn direction_of_a_polygon_does_not_matter() {
        let mut ring = points(&[(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (0.0, 3.0)]);
        let there = Contours::solid(ring.clone()).moments().unwrap();
        ring.reverse();
        let back = Contours::solid(ring).moments().unwrap();
        assert!((there.i_xy - back.i_xy).abs() < 1e-12);
        assert!(back.area > 0.0);
    }

    #[test]
    fn moments_of_curved_pieces_are_those_of_the_ellipse() {
        let outline = Outline::ellipse(3.0, 5.0);
        let m = Moments::of_pieces(&outline.pieces());
        assert!((m.area - 15.0 * PI).abs() < 1e-12);
        assert!((m.i_xx - PI * 3.0 * 125.0 / 4.0).abs() < 1e-10);
        assert!((m.i_yy - PI * 5.0 * 27.0 / 4.0).abs() < 1e-10);
        assert!(m.i_xy.abs() < 1e-10);
    }
}
