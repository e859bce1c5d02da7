//! Finds all tubes: asks the surface place by place, marches where a rod is, and looks closer
//! wherever the remaining pieces hide something.

use std::ops::ControlFlow;

use super::march::{March, Tube};
use super::patch::{Patches, patches};
use super::seed::{Place, places};
use crate::mesh::contour::Contour;
use crate::mesh::{InterfaceKind, Surface};
use crate::observer::{Observer, Stage};
use crate::skeleton::error::SkeletonError;

/// One way of looking: how dense, and how long a tube must be to count.
struct Look {
    /// Distance of places, in mean radii of the design part.
    spacing: f64,
    /// Shortest tube, in its radii.
    shortest: f64,
}

/// First everywhere, for tubes at least as long as their radius: shorter ones are found in every
/// rounded corner. Struts of a third of the mean radius still get a dozen places.
const EVERYWHERE: Look = Look { spacing: 1.0, shortest: 1.0 };

/// Then in pieces with many ends or a handle: short struts between junctions.
const CLOSER: Look = Look { spacing: 0.5, shortest: 0.5 };

/// At last in pieces with a handle: any section across the handle will do.
const CLOSEST: Look = Look { spacing: 0.25, shortest: 0.0 };

/// The tubes of a surface and the pieces between them.
#[derive(Debug)]
pub(crate) struct Found {
    pub(crate) tubes: Vec<Tube>,
    pub(crate) patches: Patches,
}

/// Looks for tubes until every piece is free of handles, or nothing more is found.
pub(crate) fn find_tubes(
    march: &mut March<'_>,
    mean_radius: f64,
    observer: &mut impl Observer,
) -> Result<Found, SkeletonError> {
    let surface = march.surface;
    let mut tubes = Vec::new();
    for (round, look) in [EVERYWHERE, CLOSER, CLOSEST].iter().enumerate() {
        let found = (round > 0).then(|| cut_open(surface, &tubes));
        let wanted = |f: crate::mesh::id::FaceId| {
            surface.labels.is_design(f)
                && found.as_ref().is_none_or(|p| {
                    p.of_face[f.index()].is_none_or(|i| is_worth_a_look(p, i as usize, round, surface))
                })
        };
        if found.as_ref().is_some_and(|p| {
            (0..p.all.len()).all(|i| !is_worth_a_look(p, i, round, surface))
        }) {
            break;
        }
        let area_each = (look.spacing * mean_radius).powi(2);
        let places = places(&surface.mesh, wanted, area_each);
        search(march, &places, look, round, &mut tubes, observer)?;
    }
    let patches = cut_open(surface, &tubes);
    Ok(Found { tubes, patches })
}

/// Cuts the surface along the middle contour of every tube.
fn cut_open(surface: &Surface, tubes: &[Tube]) -> Patches {
    let cuts: Vec<&Contour> = tubes.iter().map(|t| &t.middle().contour).collect();
    patches(&surface.mesh, |f| surface.labels.is_design(f), &cuts, &surface.interfaces)
}

/// Whether a piece may hide a tube.
fn is_worth_a_look(patches: &Patches, piece: usize, round: usize, surface: &Surface) -> bool {
    let patch = &patches.all[piece];
    let sections = patch
        .interfaces
        .iter()
        .filter(|&&i| surface.interfaces[i].kind == InterfaceKind::Section)
        .count();
    patch.genus > 0
        || (round == 1
            && (patch.cuts.len() + sections >= 4 || (sections > 0 && patch.cuts.len() != 1)))
}

fn search(
    march: &mut March<'_>,
    places: &[Place],
    look: &Look,
    round: usize,
    tubes: &mut Vec<Tube>,
    observer: &mut impl Observer,
) -> Result<(), SkeletonError> {
    for (i, place) in places.iter().enumerate() {
        if i % 64 == 0 {
            let done = 1000 * round + 1000 * i / places.len();
            if let ControlFlow::Break(()) = observer.progress(Stage::Skeleton, done, 4000) {
                return Err(SkeletonError::Cancelled);
            }
        }
        if march.claims.holds(place.face, &place.point) {
            continue;
        }
        let Some(front) = march.section_at(place) else { continue };
        if !march.is_free(&front) {
            continue;
        }
        let shortest = look.shortest * front.extent.radius();
        let mark = march.claims.mark();
        let tube = march.both_ways(front);
        if tube.length() < shortest {
            march.claims.take_back(mark);
        } else {
            tubes.push(tube);
        }
    }
    Ok(())
}
