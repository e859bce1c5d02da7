//! Matching: from the measured section of a beam to the profile it is built from.
//!
//! A beam is replaced by one whose area A, principal second moments I_1, I_2 and torsion constant
//! J are near the measured ones, turned (*roll*) so that its strong axis lies on the measured one
//! (thesis §5.2.3: a standard beam that matches the mean area and second moment).
//!
//! | [`ProfileChoice`]       | what may vary          | what agrees exactly (mode `stiffness`)    |
//! |-------------------------|------------------------|-------------------------------------------|
//! | `round`                 | d                      | √(I_1 I_2)                                |
//! | `tube`                  | d, t                   | A, √(I_1 I_2); if solid: √(I_1 I_2), t/d = 0.1 |
//! | `ellipse`               | b, h                   | I_1, I_2                                  |
//! | `rectangle`             | b, h                   | the flat sides of the contour; if it has none: I_1, I_2 |
//! | `box`, `i`, `c`, `l`    | b, h, wall             | I_1, I_2 and, if the section is thin enough, A |
//! | `freeform`              | the outline            | A, I_1/I_2                                |
//! | `catalogue`             | the entry              | nothing; the nearest is taken             |
//! | `auto`                  | the simplest of round, rectangle, ellipse (tube, box) that covers the contour, else freeform ||
//!
//! | [`MatchMode`] | fitted shapes                          | catalogues                              |
//! |---------------|----------------------------------------|-----------------------------------------|
//! | `stiffness`   | as above                               | least √(ε_I1² + ε_I2²)                  |
//! | `area`        | then scaled to the area                | least ε_A                               |
//! | `not-weaker`  | then scaled until none of the four is less | lightest with none of the four less |
//!
//! What the mesh has worn off is given back in the mode `stiffness` (`unworn`): corners of rectangles,
//! and round bars between the corners of even facets.
//!
//! A catalogue profile that agrees in all four with what is given back, within the scatter of sections
//! measured on meshes, is taken to be the one the section was made from, in the modes `stiffness` and
//! `area`.

mod auto;
mod choice;
mod equal;
mod facets;
mod fewest;
mod fit;
mod nearest;
mod reduce;
mod roll;
mod target;
mod together;
mod unworn;
mod worn;

use super::catalogue::{Catalogue, CatalogueError};
use super::error::SectionError;
use super::freeform::AverageError;
use super::profile::Profile;
use super::properties::SectionProperties;
pub use choice::{MatchMode, ProfileChoice, UnknownChoice};
pub use equal::{Equalized, MEANT_EQUAL, equalize};
pub(crate) use facets::facets;
pub use fewest::FewProfiles;
pub use reduce::{Reduction, Requirement, reduce_profiles};
pub(crate) use target::folded_angle;
pub use target::{MatchErrors, MatchTarget};
pub(crate) use worn::worn;

/// A matched profile and how well it fits.
#[derive(Clone, Debug, PartialEq)]
pub struct Matched {
    /// The profile.
    pub profile: Profile,
    /// Angle from the first coordinate of the section plane to the local axis y, rad.
    pub roll: f64,
    /// Properties of the profile about its local axes.
    pub properties: SectionProperties,
    /// Relative errors against the measured section.
    pub errors: MatchErrors,
    /// Area that only one of profile and measured contour covers, as a part of the measured area;
    /// `None` if no contour was given.
    pub uncovered: Option<f64>,
}

/// Why no profile matches.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MatchError {
    /// A freeform outline needs a measured contour.
    #[error("a freeform profile needs the measured contour of the beam")]
    NeedsContour,

    /// No profile of the catalogue is as strong as the section.
    #[error(
        "no profile of the catalogue ({} tried) is as strong as the section (A = {area:.1} mm²); \
         allow more families or match by stiffness",
        profiles
    )]
    NoneStrongEnough {
        /// Profiles that were tried.
        profiles: usize,
        /// Area of the section, mm².
        area: f64,
    },

    /// The catalogue has no profiles.
    #[error("the catalogue has no profiles")]
    EmptyCatalogue,

    /// A property of the measured section is not positive.
    #[error("the {what} of the measured section is {value}; it must be positive")]
    BadTarget {
        /// The property in words.
        what: &'static str,
        /// Its value.
        value: f64,
    },

    /// At least one profile must be allowed.
    #[error("at least one profile must be allowed")]
    NoProfilesAllowed,

    /// A family that is not in the catalogue.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),

    /// A fitted shape has no properties.
    #[error(transparent)]
    Section(#[from] SectionError),

    /// The measured contour has no smooth outline.
    #[error(transparent)]
    Average(#[from] AverageError),

    /// Whoever watches asked to stop.
    #[error("cancelled")]
    Cancelled,
}

/// Finds the profile for a measured section.
///
/// * `catalogue`: searched when the choice is `catalogue`.
///
/// # Errors
/// If the target has a property that is not positive, a family is unknown, no catalogue profile is
/// strong enough, or a freeform outline is asked for without a contour. A contour that no smooth
/// outline follows gets the simplest family instead.
///
/// # Examples
/// ```
/// # use beamwright::section::matching::{MatchMode, MatchTarget, ProfileChoice, match_profile};
/// # use beamwright::section::{Catalogue, Profile, Shape};
/// let bar = Profile::new(Shape::Round { d: 40.0 })?.properties()?;
/// let target = MatchTarget::of_properties(&bar);
/// let choice: ProfileChoice = "catalogue:CHS".parse()?;
/// let matched = match_profile(&target, &choice, MatchMode::Stiffness, Catalogue::builtin())?;
/// assert_eq!(matched.profile.to_string(), "CHS 48.3x3.2"); // I = 11.6 cm⁴ for 12.6 cm⁴
/// assert!(matched.errors.area < -0.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn match_profile(
    target: &MatchTarget,
    choice: &ProfileChoice,
    mode: MatchMode,
    catalogue: &Catalogue,
) -> Result<Matched, MatchError> {
    target.check()?;
    let profile = match choice {
        ProfileChoice::Auto => return auto::simplest(target, mode),
        ProfileChoice::Freeform => {
            return roll::freeform(target, mode).or_else(|fault| match fault {
                MatchError::Average(_) => auto::simplest(target, mode),
                fault => Err(fault),
            });
        }
        ProfileChoice::Catalogue(families) => {
            nearest::nearest(target, mode, &catalogue.of_families(families)?)?.clone()
        }
        family => Profile::new(fit::fitted(family, target, mode)?)?,
    };
    Matched::of(profile, target)
}
