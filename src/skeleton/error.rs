//! Why no skeleton could be made.

use nalgebra::Point3;

use super::params::OutOfRange;
use crate::observer::Observer;
use crate::wording::counted;

/// Why a march could not produce a skeleton.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SkeletonError {
    /// A parameter is outside its range.
    #[error(transparent)]
    Params(#[from] OutOfRange),

    /// No part of the surface looks like a rod.
    #[error(
        "no beam found: nowhere is the part long and thin (looked near ({:.2}, {:.2}, {:.2}) mm \
         and everywhere else); beamwright needs a beam-like result", near.x, near.y, near.z
    )]
    NotBeamLike {
        /// A point of the surface.
        near: Point3<f64>,
    },

    /// What could be a strut encloses nothing.
    #[error(
        "the design part, which is what is not labelled non-design, encloses no volume (the part has a \
         point at ({:.2}, {:.2}, {:.2}) mm); check the labels and the scale of each axis",
        near.x, near.y, near.z
    )]
    NoDesign {
        /// A point of the surface.
        near: Point3<f64>,
    },

    /// The mesh reaches so far that what is thick in it cannot be told from nothing.
    #[error(
        "the mesh reaches {ratio:.1e} times as far as it is thick; the point at ({:.2}, {:.2}, {:.2}) \
         mm lies farthest from the rest: remove it if it is a stray one, or split the part",
        farthest.x, farthest.y, farthest.z
    )]
    TooSlender {
        /// Its extent in mean strut radii.
        ratio: f64,
        /// The point farthest from the middle.
        farthest: Point3<f64>,
    },

    /// The march in the global frame found nothing to follow.
    #[error(
        "the march in the global frame found no branch from any of {}; try --orientation local, which \
         turns with the part", counted(*starts, "start", "starts")
    )]
    NoBranch {
        /// Places it began at.
        starts: usize,
    },

    /// The march in the global frame goes on and on.
    #[error(
        "the march in the global frame does not end: it has looked {looks} times at every point of the \
         part and found {}; try --orientation local", counted(*branches, "branch", "branches")
    )]
    Endless {
        /// Times it looked at every point.
        looks: usize,
        /// Branches found so far.
        branches: usize,
    },

    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
}

/// An error as soon as the observer asks to stop; cheap enough for every turn of a loop.
pub(crate) fn keep_on(observer: &mut impl Observer) -> Result<(), SkeletonError> {
    if observer.keep_on().is_break() { Err(SkeletonError::Cancelled) } else { Ok(()) }
}
