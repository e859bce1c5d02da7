//! The curve skeleton by the marching identifier box (thesis chapter 3).
//!
//! ```text
//!   interface ▐█━━━━●━━━━●━━━━●━━━╮           ● skeletal point: centroid of one section
//!   section                      ◆━━━●━━━━●   ◆ junction: where the axes of its branches meet
//!             ▐█━━━━●━━━━●━━━━●━━━╯           ▐ non-design skeletal point
//! ```
//!
//! | module | what |
//! |---|---|
//! | [`local`] | the box turns with the branch (§5.2.2): the default |
//! | [`global`] | the box stays aligned with the axes (§3.4): the thesis as written |
//! | [`graph`] | the result: points joined to branches |
//! | [`verify`] | what always has to hold of it |
//! | `coverage` | what of the part it says nothing about |
//!
//! Everything is relative to the size of the part; nothing depends on the frame it is given in.

mod coverage;
mod detour;
pub mod error;
pub mod global;
pub mod graph;
pub mod identifier_box;
pub(crate) mod inside;
pub mod local;
pub mod params;
mod places;
mod reach;
pub mod verify;
mod watch;

pub use error::SkeletonError;
pub use graph::{Branch, PointKind, SkeletalPoint, Skeleton};
pub use params::{Junctions, Orientation, SkeletonParams};

use crate::finding::Finding;
use crate::mesh::Surface;
use crate::observer::Observer;

/// A skeleton and what is odd about it.
#[derive(Clone, Debug, Default)]
pub struct Marched {
    /// The skeleton.
    pub skeleton: Skeleton,
    /// What the user should know; a breach where a promise does not hold.
    pub findings: Vec<Finding>,
}

/// Marches the skeleton of a surface and checks it.
///
/// # Errors
/// A parameter out of its range; a part that is nowhere beam-like; the observer asked to stop.
pub fn march(
    surface: &Surface,
    params: &SkeletonParams,
    observer: &mut impl Observer,
) -> Result<Marched, SkeletonError> {
    params.check()?;
    reach::check(surface)?;
    let mut marched = match params.orientation {
        Orientation::Local => local::skeleton(surface, params, observer)?,
        Orientation::Global => global::skeleton(surface, params, observer)?,
    };
    marched.findings.extend(verify::verify(surface, &marched.skeleton, observer)?);
    marched.findings.extend(coverage::uncovered(surface, &marched.skeleton, observer)?);
    Ok(marched)
}
