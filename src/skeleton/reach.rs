//! Whether a mesh reaches so far that nothing in it is a strut any more.
//!
//! One corner far out in space, from a broken file or a unit that was mixed up, makes a needle of the
//! part. A needle is marched as well as any rod, up to where the digits of a number end.

use nalgebra::{Point3, Vector3};

use super::error::SkeletonError;
use crate::mesh::Surface;

/// Farthest extent, in mean strut radii. A hundred metres of wire of one millimetre reach 200,000
/// radii; a corner that a flipped bit moves reaches 10⁹ and more.
const FARTHEST: f64 = 1e6;

/// An error for a surface that reaches too far, or has no design part to be told against; it names a
/// point to look at.
pub(super) fn check(surface: &Surface) -> Result<(), SkeletonError> {
    let positions = surface.mesh.positions();
    let mean_radius = surface.mean_radius();
    if mean_radius.is_nan() || mean_radius <= 0.0 {
        return Err(SkeletonError::NoDesign { near: positions[0] });
    }
    let ratio = surface.report.extent / mean_radius;
    if ratio <= FARTHEST {
        return Ok(());
    }
    let sum: Vector3<f64> = positions.iter().map(|p| p.coords).sum();
    let middle = Point3::from(sum / positions.len() as f64);
    let far = |p: &Point3<f64>| (p - middle).norm();
    let farthest = positions.iter().copied().max_by(|a, b| far(a).total_cmp(&far(b)));
    Err(SkeletonError::TooSlender { ratio, farthest: farthest.unwrap_or(middle) })
}
