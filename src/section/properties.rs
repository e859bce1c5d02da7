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

use nalgebra::Point2;

use super::contours::{Contours, sides};
use super::error::SectionError;
use super::moments::Moments;
use super::torsion::torsion_constant;

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
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(corners: &[(f64, f64)]) -> Vec<Point2<f64>> {
        corners.iter().map(|&(x, y)| Point2::new(x, y)).collect()
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
