//! What normalization can be told.

use super::shape::Loft;
use crate::section::{MatchMode, ProfileChoice};
use crate::skeleton::params::OutOfRange;

/// Parameters of normalization (thesis §5.2.3).
#[derive(Clone, Debug, PartialEq)]
pub struct FrameParams {
    /// Farthest a branch may bend away from one straight beam, in section radii.
    ///
    /// Smaller gives more and shorter beams that follow the branch more closely.
    /// Range: `[0.05, 5]`.  Default: `0.5`.
    pub max_deviation: f64,
    /// Whether members that run straight on across a junction are kept in one piece.
    /// Default: no; every beam ends at its nodes.
    pub continuous: bool,
}

impl Default for FrameParams {
    fn default() -> Self {
        Self { max_deviation: 0.5, continuous: false }
    }
}

impl FrameParams {
    /// Checks every parameter against its range.
    ///
    /// # Errors
    /// The first parameter that is out of its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        if (0.05..=5.0).contains(&self.max_deviation) {
            Ok(())
        } else {
            Err(OutOfRange {
                name: "--max-deviation",
                range: "[0.05, 5]",
                value: self.max_deviation,
            })
        }
    }
}

/// Which profiles the beams get.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProfileParams {
    /// Which profiles a beam may get.  Default: the simplest that covers its contour.
    pub choice: ProfileChoice,
    /// What must agree between profile and section.  Default: the bending stiffness.
    pub mode: MatchMode,
    /// How the shape runs along a beam.  Default: constant.
    pub loft: Loft,
    /// Most different profiles over the whole frame.  Default: no bound.
    pub max_profiles: Option<usize>,
}
