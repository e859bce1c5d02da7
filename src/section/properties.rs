//! Area properties of a plane region: area, centroid, second moments, torsion constant.
//!
//! ```text
//!        y ▲      2                    x, y  axes of the section plane
//!          │     ╱  ▗▄▄▖               1     axis about which the second moment is largest
//!          │    ╱▗▟████▛               2     axis about which it is smallest
//!          │   ╱▟█████▛                θ     principal angle, from x to 1
//!          │  ▗▟██●██▛╲
//!          │  ▟████▛▘   ╲  ) θ < 0
//!          └──────────────╲──► x       ●     centroid
//!                           1
//! ```
//!
//! Moments are taken about axes through the centroid:
//! I_xx = ∫ y² dA, I_yy = ∫ x² dA, I_xy = ∫ x y dA.
//! In the local axes y, z of a profile the first coordinate is y and the second z, so that `i_xx`
//! is what standards call I_y and `i_yy` what they call I_z.
//!
//! Everything but the torsion constant is exact for polygons (Green's theorem); the torsion
//! constant is computed as [`torsion`](super::torsion) says.

use std::f64::consts::PI;

use nalgebra::{Point2, Vector2};

use super::error::SectionError;
use super::outline::Region;
use super::piece::Piece;
use super::torsion::torsion_constant;

/// A region of the section plane given as polygons.
///
/// The polygons may run either way round; the last corner is not repeated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contours {
    /// The outer contour, mm.
    pub outer: Vec<Point2<f64>>,
    /// Contours of the holes, mm.
    pub holes: Vec<Vec<Point2<f64>>>,
}

/// Area properties of a region.
///
/// Invariant: `i_1 ≥ i_2`, `principal_angle` lies in (−π/2, π/2].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionProperties {
    /// Area A, mm².
    pub area: f64,
    /// Centroid of the area.
    pub centroid: Point2<f64>,
    /// ∫ y² dA about the centroid, mm⁴ (I_y of a profile).
    pub i_xx: f64,
    /// ∫ x² dA about the centroid, mm⁴ (I_z of a profile).
    pub i_yy: f64,
    /// ∫ x y dA about the centroid, mm⁴.
    pub i_xy: f64,
    /// Largest second moment, mm⁴.
    pub i_1: f64,
    /// Smallest second moment, mm⁴.
    pub i_2: f64,
    /// Angle from the first coordinate to axis 1, rad.
    pub principal_angle: f64,
    /// Polar moment I_1 + I_2, mm⁴.
    pub i_p: f64,
    /// Torsion constant J of Saint-Venant, mm⁴.
    pub j: f64,
    /// Length of all outlines, mm.
    pub perimeter: f64,
    /// Largest distance of the outline from the centroid, mm.
    pub reach: f64,
}

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
    /// A region without holes.
    pub fn solid(outer: Vec<Point2<f64>>) -> Self {
        Self { outer, holes: Vec::new() }
    }

    /// The polygons of a region with curved outlines; see [`Outline::to_polygon`] for the fineness.
    ///
    /// [`Outline::to_polygon`]: super::outline::Outline::to_polygon
    pub fn of_region(region: &Region, per_quarter: usize) -> Self {
        let polygon = |outline: &super::outline::Outline| outline.to_polygon(per_quarter);
        Self { outer: polygon(&region.outer), holes: region.holes.iter().map(polygon).collect() }
    }

    /// All polygons, the outer one first.
    pub fn polygons(&self) -> impl Iterator<Item = &Vec<Point2<f64>>> {
        std::iter::once(&self.outer).chain(&self.holes)
    }

    /// The region turned about the origin by an angle in rad and then shifted.
    pub fn moved(&self, angle: f64, shift: Vector2<f64>) -> Self {
        let turn = nalgebra::Rotation2::new(angle);
        let moved = |polygon: &Vec<Point2<f64>>| polygon.iter().map(|p| turn * p + shift).collect();
        Self { outer: moved(&self.outer), holes: self.holes.iter().map(moved).collect() }
    }

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

/// The sides of a polygon as (start, end).
pub(crate) fn sides(
    polygon: &[Point2<f64>],
) -> impl Iterator<Item = (Point2<f64>, Point2<f64>)> + '_ {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

/// Signed area ½ Σ (xᵢ yᵢ₊₁ − xᵢ₊₁ yᵢ), mm²; positive if counter-clockwise.
pub fn signed_area(polygon: &[Point2<f64>]) -> f64 {
    0.5 * sides(polygon).map(|(p, q)| p.x * q.y - q.x * p.y).sum::<f64>()
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

impl SectionProperties {
    /// Measures a region given as polygons.
    ///
    /// # Errors
    /// If a coordinate is not finite, a polygon has fewer than three points or no area, the holes
    /// are larger than the outline, or the contours cross so badly that they cannot be
    /// triangulated for the torsion constant.
    ///
    /// # Examples
    /// ```
    /// # use beamwright::section::{Contours, SectionProperties};
    /// # use nalgebra::Point2;
    /// let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 20.0), (0.0, 20.0)];
    /// let rectangle = Contours::solid(corners.map(|(x, y)| Point2::new(x, y)).to_vec());
    /// let p = SectionProperties::of_contours(&rectangle)?;
    /// assert!((p.i_1 - 10.0 * 20.0_f64.powi(3) / 12.0).abs() < 1e-9); // about the axis x
    /// assert!(p.principal_angle.abs() < 1e-9);
    /// # Ok::<(), beamwright::section::SectionError>(())
    /// ```
    pub fn of_contours(contours: &Contours) -> Result<Self, SectionError> {
        let moments = contours.moments()?;
        let j = torsion_constant(contours)?;
        let centroid = moments.centroid();
        let lengths = contours.polygons().flat_map(|p| sides(p)).map(|(p, q)| (q - p).norm());
        let reach = contours.outer.iter().map(|p| (p - centroid).norm()).fold(0.0, f64::max);
        Ok(Self::assemble(&moments, j, lengths.sum(), reach))
    }

    /// Puts the properties together from moments about the origin and the rest.
    pub(crate) fn assemble(moments: &Moments, j: f64, perimeter: f64, reach: f64) -> Self {
        let central = moments.central();
        let (i_1, i_2, principal_angle) = central.principal();
        Self {
            area: central.area,
            centroid: moments.centroid(),
            i_xx: central.i_xx,
            i_yy: central.i_yy,
            i_xy: central.i_xy,
            i_1,
            i_2,
            principal_angle,
            i_p: i_1 + i_2,
            j,
            perimeter,
            reach,
        }
    }

    /// Radius of the disc of equal area √(A/π), mm.
    pub fn radius(&self) -> f64 {
        (self.area / PI).sqrt()
    }

    /// Radii of gyration √(I/A) about the axes 1 and 2, mm.
    pub fn radii_of_gyration(&self) -> [f64; 2] {
        [self.i_1, self.i_2].map(|i| (i / self.area).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let outline = super::super::outline::Outline::ellipse(3.0, 5.0);
        let m = Moments::of_pieces(&outline.pieces());
        assert!((m.area - 15.0 * PI).abs() < 1e-12);
        assert!((m.i_xx - PI * 3.0 * 125.0 / 4.0).abs() < 1e-10);
        assert!((m.i_yy - PI * 5.0 * 27.0 / 4.0).abs() < 1e-10);
        assert!(m.i_xy.abs() < 1e-10);
    }

    #[test]
    fn bad_contours_are_named() {
        let fault = |c: Contours| SectionProperties::of_contours(&c).unwrap_err();
        assert_eq!(fault(Contours::default()), SectionError::TooFewPoints { points: 0 });
        let nan = points(&[(0.0, f64::NAN), (1.0, 0.0), (0.0, 1.0)]);
        assert!(matches!(fault(Contours::solid(nan)), SectionError::NotFinite { .. }));
        let flat = points(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]);
        assert_eq!(fault(Contours::solid(flat)), SectionError::NoArea);
        let small = points(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
        let large = points(&[(0.0, 0.0), (3.0, 0.0), (0.0, 3.0)]);
        let inverted = Contours { outer: small, holes: vec![large] };
        assert!(matches!(fault(inverted), SectionError::HolesTooLarge { .. }));
    }
}
