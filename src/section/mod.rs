//! Sections.
pub mod error;
pub mod freeform;
pub mod outline;
mod piece;
pub mod profile;
pub mod properties;
mod rays;
pub mod torsion;

pub use error::SectionError;
pub use outline::{Outline, Path, Region, Segment};
pub use profile::{Designation, Moduli, Profile, Shape};
pub use properties::{Contours, SectionProperties};
