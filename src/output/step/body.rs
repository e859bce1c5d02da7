//! The shapes a part can have.

use std::f64::consts::PI;

use super::error::{BodyError, positive};
use super::facets::Facets;
use super::loft::Loft;
use crate::section::outline::Outline;

/// The shape of a part, in its own coordinates, mm.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A beam along +z.
    Loft(Loft),
    /// A ball about the origin.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A solid of flat faces and round holes.
    Facets(Facets),
}

impl Body {
    /// A round bar from z = 0 to `length`.
    pub fn round_bar(radius: f64, length: f64) -> Self {
        Self::Loft(Loft::prism(Outline::circle(radius), Vec::new(), length))
    }

    /// A round tube from z = 0 to `length`.
    pub fn tube(outer_radius: f64, inner_radius: f64, length: f64) -> Self {
        let bore = Outline::circle(inner_radius);
        Self::Loft(Loft::prism(Outline::circle(outer_radius), vec![bore], length))
    }

    /// Volume, mm³, by formula or by integration over the exact surface.
    ///
    /// # Errors
    /// If the body is not a solid.
    ///
    /// # Examples
    /// ```
    /// # use beamwright::output::step::{Body, Loft};
    /// # use beamwright::section::outline::Outline;
    /// # use nalgebra::Vector3;
    /// // A mitre through the axis takes away as much as it leaves.
    /// let bar = Loft::prism(Outline::circle(5.0), vec![], 100.0);
    /// let mitred = bar.clone().cut(Vector3::z(), Vector3::new(1.0, 0.0, 1.0));
    /// let (bar, mitred) = (Body::Loft(bar).volume()?, Body::Loft(mitred).volume()?);
    /// assert!((bar - mitred).abs() < 1e-9 * bar);
    /// # Ok::<(), beamwright::output::step::BodyError>(())
    /// ```
    pub fn volume(&self) -> Result<f64, BodyError> {
        match self {
            Self::Loft(loft) => loft.volume(),
            Self::Sphere { radius } => {
                positive("a radius", *radius)?;
                Ok(4.0 / 3.0 * PI * radius.powi(3))
            }
            Self::Facets(facets) => facets.volume(),
        }
    }
}
