//! How near is the same, and how far a cut may lean: what the writer asks of every body.

/// Shortest edge that is written, in mm.
///
/// Kernels based on Parasolid tell points apart from 1e-5 mm on, OCCT from
/// 1e-7 mm on; a shorter edge would come back as an invalid solid.
pub const SHORTEST: f64 = 1e-5;

/// How far two measures may differ, relative to their size, and count as equal.
pub(super) const SAME: f64 = 1e-12;

/// Largest angle between an end cut and a square one.
///
/// At 80° the cut face is already 5.8 times as long as the beam is thick.
pub(super) const MOST_OBLIQUE_DEGREES: f64 = 80.0;
