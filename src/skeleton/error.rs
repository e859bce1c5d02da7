//! Why no skeleton could be made.

use nalgebra::Point3;

use super::params::OutOfRange;

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

    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
}
