//! What a profile is matched to, and how far it is off.

use std::f64::consts::PI;

use super::{MatchError, MatchMode};
use crate::section::contours::Contours;
use crate::section::error::SectionError;
use crate::section::profile::Shape;
use crate::section::properties::SectionProperties;

/// The measured section of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct MatchTarget {
    /// Area A, mm².
    pub area: f64,
    /// Largest second moment I_1, mm⁴.
    pub i_1: f64,
    /// Smallest second moment I_2, mm⁴.
    pub i_2: f64,
    /// Torsion constant J, mm⁴.
    pub j: f64,
    /// Angle from the first coordinate of the section plane to axis 1, rad.
    pub principal_angle: f64,
    /// The measured contour in the section plane, or the mean of several; it tells shapes apart
    /// and settles what the principal axes leave open.
    pub contours: Option<Contours>,
    /// Sides of a contour that is an evenly tessellated circle or ellipse.
    pub facets: Option<u32>,
    /// Distances between the flat sides of a rectangle with worn corners over the b and h that
    /// match its moments, the smaller size first.
    pub worn: Option<[f64; 2]>,
}

/// Relative errors of a profile: its value over the measured one, less 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MatchErrors {
    /// Error of the area.
    pub area: f64,
    /// Error of I_1.
    pub i_1: f64,
    /// Error of I_2.
    pub i_2: f64,
    /// Error of J.
    pub j: f64,
}

impl MatchTarget {
    /// A target without a contour.
    pub fn of_properties(properties: &SectionProperties) -> Self {
        Self {
            area: properties.area,
            i_1: properties.i_1,
            i_2: properties.i_2,
            j: properties.j,
            principal_angle: properties.principal_angle,
            contours: None,
            facets: None,
            worn: None,
        }
    }

    /// A target measured on one contour.
    ///
    /// # Errors
    /// As [`SectionProperties::of_contours`].
    pub fn of_contours(contours: Contours) -> Result<Self, SectionError> {
        let properties = SectionProperties::of_contours(&contours)?;
        let mut target = Self::of_properties(&properties);
        if contours.holes.is_empty() {
            target.facets = super::facets(&contours.outer);
            target.worn = super::worn(&contours.outer);
        }
        Ok(Self { contours: Some(contours), ..target })
    }

    pub(crate) fn check(&self) -> Result<(), MatchError> {
        let all = [("area", self.area), ("I1", self.i_1), ("I2", self.i_2), ("J", self.j)];
        for (what, value) in all {
            if !(value.is_finite() && value > 0.0) {
                return Err(MatchError::BadTarget { what, value });
            }
        }
        Ok(())
    }

    /// √(I_1 I_2): what a section without a strong axis would need, mm⁴.
    pub(crate) fn mean_moment(&self) -> f64 {
        (self.i_1 * self.i_2).sqrt()
    }

    /// A² / √(I_1 I_2): 4π for every ellipse, 12 for every rectangle, less if hollow or open.
    pub(crate) fn fullness(&self) -> f64 {
        self.area * self.area / self.mean_moment()
    }

    /// Factor on all sizes of a shape of the given properties that `mode` asks for after its
    /// stiffness has been fitted.
    pub(crate) fn scale(&self, own: &SectionProperties, mode: MatchMode) -> f64 {
        match mode {
            MatchMode::Stiffness => 1.0,
            MatchMode::Area => (self.area / own.area).sqrt(),
            MatchMode::NotWeaker => {
                let moments = [(self.i_1, own.i_1), (self.i_2, own.i_2), (self.j, own.j)];
                let needed = moments.into_iter().map(|(goal, is)| (goal / is).sqrt().sqrt());
                needed.fold((self.area / own.area).sqrt(), f64::max) * (1.0 + ROUNDING)
            }
        }
    }

    /// The shape scaled as `mode` asks for.
    pub(crate) fn scaled(&self, shape: Shape, mode: MatchMode) -> Result<Shape, SectionError> {
        if mode == MatchMode::Stiffness {
            return Ok(shape);
        }
        let own = super::Profile::new(shape.clone())?.properties()?;
        Ok(shape.scaled(self.scale(&own, mode)))
    }
}

/// Rounding of the numbers on the way through a fit; a profile that is less by this much is not.
pub(crate) const ROUNDING: f64 = 1e-9;

impl MatchErrors {
    /// Errors of a profile with the given properties.
    pub fn of(own: &SectionProperties, target: &MatchTarget) -> Self {
        Self {
            area: own.area / target.area - 1.0,
            i_1: own.i_1 / target.i_1 - 1.0,
            i_2: own.i_2 / target.i_2 - 1.0,
            j: own.j / target.j - 1.0,
        }
    }

    /// Of each property the error that is larger in size.
    pub fn worst(&self, other: &Self) -> Self {
        let worse = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
        Self {
            area: worse(self.area, other.area),
            i_1: worse(self.i_1, other.i_1),
            i_2: worse(self.i_2, other.i_2),
            j: worse(self.j, other.j),
        }
    }

    /// √(ε_I1² + ε_I2²).
    pub fn stiffness(&self) -> f64 {
        self.i_1.hypot(self.i_2)
    }

    /// Whether none of the four properties is less than measured, but for rounding.
    pub fn is_not_weaker(&self) -> bool {
        [self.area, self.i_1, self.i_2, self.j].into_iter().all(|error| error >= -ROUNDING)
    }
}

/// An angle brought into (−period/2, period/2]; 0 if the period is 0.
pub(crate) fn folded_angle(angle: f64, period: f64) -> f64 {
    if period == 0.0 {
        return 0.0;
    }
    let folded = angle.rem_euclid(period);
    if folded > 0.5 * period + ROUNDING * PI { folded - period } else { folded }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fullness_of_ellipse_and_rectangle_is_that_of_the_formula() {
        for (shape, exact) in [
            (Shape::Ellipse { b: 8.0, h: 15.0 }, 4.0 * PI),
            (Shape::Rectangle { b: 8.0, h: 15.0 }, 12.0),
        ] {
            let own = super::super::Profile::new(shape).unwrap().properties().unwrap();
            assert!((MatchTarget::of_properties(&own).fullness() - exact).abs() < 1e-9);
        }
    }

    #[test]
    fn angles_fold_into_the_period_of_the_shape() {
        assert!((folded_angle(3.0, PI) - (3.0 - PI)).abs() < 1e-15);
        assert!((folded_angle(-2.0, PI) - (PI - 2.0)).abs() < 1e-15);
        assert_eq!(folded_angle(1.234, 0.0), 0.0);
    }
}
