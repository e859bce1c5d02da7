//! Sections and profiles: from a measured contour to something one can order.
//!
//! A beam of the frame has a section, measured across the branch it came from: closed contours in
//! a plane. Here its properties are computed, and the profile is found that the beam is built
//! from.
//!
//! ```text
//!   contours ──► properties ──► target ──► matching ──► profile, roll, errors
//!      │         A, I_1, I_2, J, θ            ▲
//!      └──► mean outline (freeform) ──────────┤
//!                           catalogue ────────┘
//! ```
//!
//! | module         | what it finds or makes                                         | thesis  |
//! |----------------|----------------------------------------------------------------|---------|
//! | [`contours`]   | regions bounded by polygons, as they are measured              |         |
//! | [`properties`] | area, centroid, second moments, principal axes of contours     | §5.2.3  |
//! | [`torsion`]    | torsion constant J of any contours                             |         |
//! | [`outline`]    | lines, arcs and splines that bound a profile                   |         |
//! | [`profile`]    | shapes with exact properties, section moduli and names         | §5.2.3  |
//! | [`freeform`]   | smooth outline through averaged contours                       |         |
//! | [`catalogue`]  | tables of standard profiles, compiled in or the user's own     | §5.2.3  |
//! | [`matching`]   | the profile that matches a section; equal beams; fewer profiles| §5.2.3  |
//!
//! # What differs from the thesis
//!
//! * The thesis matches a standard beam by the mean area and second moment. Here both principal
//!   second moments and the torsion constant count, and the profile is turned onto the measured
//!   principal axes.
//!
//! # References
//!
//! * Thesis: *Automatic skeleton construction from beam-like topology optimization results*, UQTR,
//!   §5.2.3.

pub mod catalogue;
pub mod contours;
pub mod error;
pub mod freeform;
pub mod matching;
mod moments;
pub mod outline;
mod piece;
pub mod profile;
pub mod properties;
mod rays;
pub mod torsion;

pub use catalogue::Catalogue;
pub use contours::Contours;
pub use error::SectionError;
pub use freeform::Freeform;
pub use matching::{MatchMode, MatchTarget, Matched, ProfileChoice, match_profile};
pub use outline::{Outline, Path, Region, Segment};
pub use profile::{Designation, Moduli, Profile, Shape};
pub use properties::SectionProperties;
