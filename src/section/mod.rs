//! Sections.
pub mod catalogue;
pub mod error;
pub mod freeform;
pub mod matching;
pub mod outline;
mod piece;
pub mod profile;
pub mod properties;
mod rays;
pub mod torsion;

pub use catalogue::Catalogue;
pub use error::SectionError;
pub use matching::{MatchMode, MatchTarget, Matched, ProfileChoice, match_profile};
pub use outline::{Outline, Path, Region, Segment};
pub use profile::{Designation, Moduli, Profile, Shape};
pub use properties::{Contours, SectionProperties};
