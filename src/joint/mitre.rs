//! Two beams that meet: both are cut in the plane that halves their angle.

use nalgebra::Unit;

use super::{End, EndCut};

/// The cuts of two ends; a straight joint is cut square.
///
/// ```text
///    away₁ ◄──────╲          n = away₁ − away₂ points along the longer side of the plane's normal:
///                 ╲│         both ends lean from it by the same angle
///                  ▼ away₂
/// ```
pub(super) fn cuts(at: &[End]) -> Vec<Option<EndCut>> {
    let [a, b] = at else { return at.iter().map(|_| None).collect() };
    let normal = Unit::try_new(a.away.into_inner() - b.away.into_inner(), 1e-6);
    at.iter().map(|end| normal.map(|n| EndCut::in_plane(0.0, n, &end.away))).collect()
}
