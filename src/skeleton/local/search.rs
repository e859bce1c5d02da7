//! Finds all tubes: asks the surface place by place, marches where a rod is, and looks closer
//! wherever the remaining pieces hide something.

use nalgebra::Point3;

use super::axis::{Axis, all_pass, axis_at_start};
use super::band::Front;
use super::draft::{Station, reversed, stations_of};
use super::handles::open_handles;
use super::junction::meeting_point;
use super::march::March;
use super::patch::{CutSide, Patch, Patches, patches};
use super::way::Tube;
use crate::mesh::contour::Contour;
use crate::mesh::id::FaceId;
use crate::mesh::{InterfaceKind, Surface};
use crate::observer::{Observer, Stage};
use crate::skeleton::error::{SkeletonError, keep_on};
use crate::skeleton::places::{Place, places};

/// One way of looking: how dense, and how long a tube must be to count.
struct Look {
    /// Distance of places, in mean radii of the design part.
    spacing: f64,
    /// Sections that reach farther are not followed, in mean radii.
    reach: f64,
    /// Shortest tube, in its radii.
    shortest: f64,
    /// Whether all places are cut before the first march.
    thinnest_first: bool,
    /// Which pieces of the cut surface are looked at; `None`: all of it, uncut.
    pieces: Option<fn(&Seen<'_>, &Patch) -> bool>,
}

/// The looks, one after the other.
///
/// First everywhere, for tubes at least twice as long as their radius: shorter ones are found in
/// every rounded corner. Struts of a third of the mean radius still get a dozen places, and
/// sections up to three mean radii close within the reach. Then for thicker members, where the
/// first look left much surface. Then for short struts between junctions, in pieces that do not
/// look like one junction, the thinnest section first: a neck tells more than what surrounds it. At
/// last, in pieces with a handle, any section across the handle will do.
const LOOKS: [Look; 4] = [
    Look { spacing: 1.0, reach: 6.0, shortest: 2.0, thinnest_first: false, pieces: None },
    Look { spacing: 3.0, reach: 40.0, shortest: 1.0, thinnest_first: false, pieces: None },
    Look {
        spacing: 0.5,
        reach: 6.0,
        shortest: 0.5,
        thinnest_first: true,
        pieces: Some(may_hide_a_strut),
    },
    Look {
        spacing: 0.25,
        reach: 40.0,
        shortest: 0.0,
        thinnest_first: true,
        pieces: Some(|_, piece| piece.genus > 0),
    },
];

/// A piece reaches no farther than this from its middle, in radii of its ends, when it is one
/// junction: a joint of six struts at right angles has its ends at two, a fork of 25° at five.
const LARGE: f64 = 3.5;

/// Axes of one junction miss each other by tenths of a radius; those of an H, whose tie has not
/// been found, by half its height.
const MISSES: f64 = 0.5;

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
    // The surface cut along all tubes, once it has been needed since the last was found.
    let mut cut: Option<Patches> = None;
    for (round, look) in LOOKS.iter().enumerate() {
        keep_on(observer)?;
        let area_each = (look.spacing * mean_radius).powi(2);
        let places = if let Some(is_wanted) = look.pieces {
            let cut = cut.get_or_insert_with(|| cut_open(surface, &tubes));
            let seen = Seen { surface, tubes: &tubes };
            let open: Vec<bool> = cut.all.iter().map(|p| is_wanted(&seen, p)).collect();
            if !open.contains(&true) {
                continue;
            }
            let is_open = |f: FaceId| cut.of_face(f).is_none_or(|piece| open[piece]);
            places(surface, is_open, area_each)
        } else {
            places(surface, |_| true, area_each)
        };
        let before = tubes.len();
        search(march, &places, round, mean_radius, &mut tubes, observer)?;
        if tubes.len() > before {
            cut = None;
        }
    }
    keep_on(observer)?;
    let patches = cut.unwrap_or_else(|| cut_open(surface, &tubes));
    open_handles(march, Found { tubes, patches }, mean_radius, observer)
}

/// Cuts the surface along the middle contour of every tube.
pub(super) fn cut_open(surface: &Surface, tubes: &[Tube]) -> Patches {
    let cuts: Vec<&Contour> = tubes.iter().map(|t| &t.middle().contour).collect();
    patches(&surface.mesh, |f| surface.labels.is_design(f), &cuts, &surface.interfaces)
}

/// Whether a piece may hide a strut: it has a handle, its ends lie farther apart than at one
/// junction, or their axes do not meet in one point.
fn may_hide_a_strut(seen: &Seen<'_>, piece: &Patch) -> bool {
    if piece.genus > 0 {
        return true;
    }
    let legs: Vec<Vec<Station>> = piece
        .cuts
        .iter()
        .map(|&(tube, side)| {
            let stations = stations_of(&seen.tubes[tube]);
            if side == CutSide::Below { stations } else { reversed(&stations) }
        })
        .collect();
    let sections = piece
        .interfaces
        .iter()
        .map(|&i| &seen.surface.interfaces[i])
        .filter(|i| i.kind == InterfaceKind::Section)
        .map(|i| (i.centroid, i.radius()));
    let ends: Vec<(Point3<f64>, f64)> =
        legs.iter().map(|leg| (leg[0].centroid, leg[0].radius)).chain(sections).collect();
    if ends.is_empty() {
        return false;
    }
    let count = ends.len() as f64;
    let middle =
        Point3::from(ends.iter().map(|e| e.0.coords).sum::<nalgebra::Vector3<f64>>() / count);
    let radius = ends.iter().map(|e| e.1).sum::<f64>() / count;
    ends.iter().any(|e| (e.0 - middle).norm() > LARGE * radius) || !meet(&legs, &middle)
}

/// Whether the axes of all legs pass one point.
fn meet(legs: &[Vec<Station>], middle: &Point3<f64>) -> bool {
    let axes: Vec<Axis> = legs.iter().filter_map(|leg| axis_at_start(leg)).collect();
    let meeting = meeting_point(&axes, middle);
    all_pass(&axes, &meeting, MISSES)
}

fn search(
    march: &mut March<'_>,
    places: &[Place],
    round: usize,
    mean_radius: f64,
    tubes: &mut Vec<Tube>,
    observer: &mut impl Observer,
) -> Result<(), SkeletonError> {
    let look = &LOOKS[round];
    let reach = look.reach * mean_radius;
    let mut cut: Vec<Front> = Vec::new();
    for (i, place) in places.iter().enumerate() {
        keep_on(observer)?;
        if i % 64 == 0 {
            let done = round * 100 + 100 * i / places.len();
            if observer.progress(Stage::Skeleton, done, LOOKS.len() * 100).is_break() {
                return Err(SkeletonError::Cancelled);
            }
        }
        if march.claims.holds(place.face, &place.point) {
            continue;
        }
        let Some(front) = march.section_at(place, reach) else { continue };
        if look.thinnest_first {
            cut.push(front);
        } else {
            try_front(march, front, look, tubes, observer)?;
        }
    }
    cut.sort_by(|a, b| a.extent.area.total_cmp(&b.extent.area));
    cut.into_iter().try_for_each(|front| try_front(march, front, look, tubes, observer))
}

/// Marches from a front and keeps the tube if it is long enough.
fn try_front(
    march: &mut March<'_>,
    front: Front,
    look: &Look,
    tubes: &mut Vec<Tube>,
    observer: &mut impl Observer,
) -> Result<(), SkeletonError> {
    keep_on(observer)?;
    if march.is_free(&front) {
        let shortest = look.shortest * front.extent.radius();
        tubes.extend(march.both_ways(front, shortest, observer)?);
    }
    Ok(())
}
