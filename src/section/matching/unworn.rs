//! Sections before the mesh wore them: what it took off their shapes, given back.
//!
//! | what a contour tells          | module   | families that grow |
//! |-------------------------------|----------|--------------------|
//! | flat sides with worn corners  | `worn`   | rectangle          |
//! | even facets                   | `facets` | round, ellipse     |
//!
//! A fitted shape grows by it, a catalogue is searched for what has grown, and a beam that changes
//! its profile for another needs one that has.

use super::fit::fitted;
use super::{MatchError, MatchMode, MatchTarget, Matched, ProfileChoice, facets};
use crate::section::profile::{Profile, Shape};
use crate::section::properties::SectionProperties;

impl MatchTarget {
    /// A shape that matches the moments, with the sizes it had before the mesh wore it.
    pub(super) fn grown(&self, shape: Shape) -> Shape {
        let facets = self.facets.map_or(1.0, facets::growth);
        match shape {
            Shape::Round { d } => Shape::Round { d: facets * d },
            Shape::Ellipse { b, h } => Shape::Ellipse { b: facets * b, h: facets * h },
            Shape::Rectangle { b, h } => {
                let [of_b, of_h] = self.worn.unwrap_or([1.0; 2]);
                Shape::Rectangle { b: b * of_b, h: h * of_h }
            }
            other => other,
        }
    }

    /// The section before the mesh wore it; the measured one where nothing tells.
    pub(super) fn unworn(&self) -> Result<Self, MatchError> {
        let family = match (self.worn, self.facets) {
            (Some(_), _) => ProfileChoice::Rectangle,
            (None, Some(_)) => ProfileChoice::Ellipse,
            (None, None) => return Ok(self.clone()),
        };
        let own = Profile::new(fitted(&family, self, MatchMode::Stiffness)?)?;
        Ok(self.with_properties(&own.properties()?))
    }

    /// What a beam needs that has a profile and may get another: one that has grown is stiffer than
    /// the contour, and shall not be outdone by one that has not.
    pub(crate) fn required(&self, own: &Matched, mode: MatchMode) -> Result<Self, MatchError> {
        let shape = &own.profile.shape;
        if mode != MatchMode::Stiffness {
            Ok(self.clone())
        } else if own.profile.designation.is_some() {
            self.unworn()
        } else if self.grown(shape.clone()) != *shape {
            Ok(self.with_properties(&own.properties))
        } else {
            Ok(self.clone())
        }
    }

    fn with_properties(&self, properties: &SectionProperties) -> Self {
        Self {
            principal_angle: self.principal_angle,
            contours: self.contours.clone(),
            ..Self::of_properties(properties)
        }
    }
}
