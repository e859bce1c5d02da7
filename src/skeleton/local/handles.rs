//! Handles that no tube runs through: the rim of a pinhole in a fillet, which the march passes as
//! roughness.
//!
//! Any section across the handle will do, as long as it crosses no other: it needs no length, and lies
//! on surface that a tube may have passed.

use super::band::Front;
use super::claim::Claims;
use super::march::March;
use super::search::{Found, cut_open};
use super::way::Tube;
use crate::mesh::id::FaceId;
use crate::observer::Observer;
use crate::skeleton::error::{SkeletonError, keep_on};
use crate::skeleton::places::places;

/// Distance of places, in mean radii of the design part: a strand a third as wide still gets some.
const SPACING: f64 = 0.25;

/// Sections that reach farther are not followed, in mean radii.
const REACH: f64 = 6.0;

/// Sections tried, the thinnest first. Each asks the whole surface whether it crosses a handle; meshes
/// that cross themselves over and over have thousands that do not.
const MOST_TRIED: usize = 256;

/// Adds a tube of one front for each handle that a section crosses.
pub(super) fn open_handles(
    march: &mut March<'_>,
    mut found: Found,
    mean_radius: f64,
    observer: &mut impl Observer,
) -> Result<Found, SkeletonError> {
    if found.patches.genus() == 0 {
        return Ok(found);
    }
    let surface = march.surface;
    march.claims = Claims::new(&surface.mesh);
    found.tubes.iter().for_each(|tube| march.claim_round(tube.middle()));
    let mut tried = 0;
    for front in candidates(march, &found, mean_radius, observer)? {
        if found.patches.genus() == 0 || tried == MOST_TRIED {
            break;
        }
        keep_on(observer)?;
        if !march.is_free(&front) {
            continue;
        }
        tried += 1;
        march.claim_round(&front);
        found.tubes.push(Tube { fronts: vec![front] });
        let patches = cut_open(surface, &found.tubes);
        if patches.genus() < found.patches.genus() {
            found.patches = patches;
        } else {
            found.tubes.pop();
        }
    }
    Ok(found)
}

/// Sections at places of the pieces with a handle, the thinnest first.
fn candidates(
    march: &mut March<'_>,
    found: &Found,
    mean_radius: f64,
    observer: &mut impl Observer,
) -> Result<Vec<Front>, SkeletonError> {
    let has_handle =
        |f: FaceId| found.patches.of_face(f).is_some_and(|p| found.patches.all[p].genus > 0);
    let mut fronts = Vec::new();
    for place in places(march.surface, has_handle, (SPACING * mean_radius).powi(2)) {
        keep_on(observer)?;
        fronts.extend(march.section_at(&place, REACH * mean_radius));
    }
    fronts.sort_by(|a, b| a.extent.area.total_cmp(&b.extent.area));
    Ok(fronts)
}
