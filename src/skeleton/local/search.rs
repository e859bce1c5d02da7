//! Finds all tubes: asks the surface place by place, marches where a rod is, and looks closer
//! wherever the remaining pieces hide something.

use std::ops::ControlFlow;

use nalgebra::Point3;

use super::march::{March, Tube};
use super::patch::{CutSide, Patch, Patches, patches};
use super::seed::{Place, places};
use crate::mesh::contour::Contour;
use crate::mesh::id::FaceId;
use crate::mesh::{InterfaceKind, Surface};
use crate::observer::{Observer, Stage};
use crate::skeleton::error::SkeletonError;

/// One way of looking: how dense, and how long a tube must be to count.
struct Look {
    /// Distance of places, in mean radii of the design part.
    spacing: f64,
    /// Sections that reach farther are not followed, in mean radii.
    reach: f64,
    /// Shortest tube, in its radii.
    shortest: f64,
    /// Which pieces are looked at; the first look has no pieces yet.
    pieces: fn(&Seen<'_>, &Patch) -> bool,
}

/// The looks, one after the other.
///
/// First everywhere, for tubes at least as long as their radius: shorter ones are found in every
/// rounded corner. Struts of a third of the mean radius still get a dozen places, and sections up
/// to three mean radii close within the reach. Then for thicker members, where the first look left
/// much surface. Then for short struts between junctions, in pieces too large for one. At last, in
/// pieces with a handle, any section across the handle will do.
const LOOKS: [Look; 4] = [
    Look { spacing: 1.0, reach: 6.0, shortest: 1.0, pieces: |_, _| true },
    Look { spacing: 3.0, reach: 40.0, shortest: 1.0, pieces: |_, _| true },
    Look { spacing: 0.5, reach: 6.0, shortest: 0.5, pieces: is_large_or_handled },
    Look { spacing: 0.25, reach: 40.0, shortest: 0.0, pieces: |_, piece| piece.genus > 0 },
];

/// A piece reaches no farther than this from its middle, in radii of its ends, when it is one
/// junction: a joint of six struts at right angles has its ends at two, a fork of 25° at five.
const LARGE: f64 = 3.5;

/// What the looks so far have found.
struct Seen<'a> {
    surface: &'a Surface,
    tubes: &'a [Tube],
}

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
    let mut cut = cut_open(surface, &tubes);
    for (round, look) in LOOKS.iter().enumerate() {
        let seen = Seen { surface, tubes: &tubes };
        let open: Vec<bool> = cut.all.iter().map(|p| (look.pieces)(&seen, p)).collect();
        if !open.contains(&true) {
            continue;
        }
        let wanted = |f: FaceId| {
            surface.labels.is_design(f)
                && cut.of_face[f.index()].is_none_or(|piece| open[piece as usize])
        };
        let area_each = (look.spacing * mean_radius).powi(2);
        let places = places(&surface.mesh, wanted, area_each);
        let before = tubes.len();
        let mut progress = |done| match observer.progress(
            Stage::Skeleton,
            round * 100 + 100 * done / places.len().max(1),
            LOOKS.len() * 100,
        ) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(SkeletonError::Cancelled),
        };
        search(march, &places, look, mean_radius, &mut tubes, &mut progress)?;
        if tubes.len() > before {
            cut = cut_open(surface, &tubes);
        }
    }
    Ok(Found { tubes, patches: cut })
}

/// Cuts the surface along the middle contour of every tube.
fn cut_open(surface: &Surface, tubes: &[Tube]) -> Patches {
    let cuts: Vec<&Contour> = tubes.iter().map(|t| &t.middle().contour).collect();
    patches(&surface.mesh, |f| surface.labels.is_design(f), &cuts, &surface.interfaces)
}

/// Whether a piece may hide a strut: it has a handle, or its ends lie farther apart than at one
/// junction, or an interface section opens into it without a tube of its own.
fn is_large_or_handled(seen: &Seen<'_>, piece: &Patch) -> bool {
    let tube_ends = piece.cuts.iter().map(|&(tube, side)| {
        let fronts = &seen.tubes[tube].fronts;
        let front = if side == CutSide::Below { &fronts[0] } else { &fronts[fronts.len() - 1] };
        (front.extent.centroid, front.extent.radius())
    });
    let sections = piece
        .interfaces
        .iter()
        .map(|&i| &seen.surface.interfaces[i])
        .filter(|i| i.kind == InterfaceKind::Section)
        .map(|i| (i.centroid, i.radius()));
    let ends: Vec<(Point3<f64>, f64)> = tube_ends.chain(sections).collect();
    if piece.genus > 0 || ends.is_empty() {
        return piece.genus > 0;
    }
    let count = ends.len() as f64;
    let middle =
        Point3::from(ends.iter().map(|e| e.0.coords).sum::<nalgebra::Vector3<f64>>() / count);
    let radius = ends.iter().map(|e| e.1).sum::<f64>() / count;
    ends.iter().any(|e| (e.0 - middle).norm() > LARGE * radius)
}

fn search(
    march: &mut March<'_>,
    places: &[Place],
    look: &Look,
    mean_radius: f64,
    tubes: &mut Vec<Tube>,
    progress: &mut impl FnMut(usize) -> Result<(), SkeletonError>,
) -> Result<(), SkeletonError> {
    for (i, place) in places.iter().enumerate() {
        if i % 64 == 0 {
            progress(i)?;
        }
        if march.claims.holds(place.face, &place.point) {
            continue;
        }
        let Some(front) = march.section_at(place, look.reach * mean_radius) else { continue };
        if !march.is_free(&front) || (look.shortest > 0.0 && !march.goes_on(&front)) {
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
