//! Why no skeleton could be made.

use nalgebra::Point3;

use super::params::OutOfRange;
use crate::observer::Observer;

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

    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
}

/// An error as soon as the observer asks to stop; cheap enough for every turn of a loop.
pub(crate) fn keep_on(observer: &mut impl Observer) -> Result<(), SkeletonError> {
    if observer.keep_on().is_break() { Err(SkeletonError::Cancelled) } else { Ok(()) }
}
