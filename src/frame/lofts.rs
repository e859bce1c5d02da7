//! Shapes that change along a beam: the family of its profile, sized at stations.
//!
//! ```text
//!    end 0     station     end 1         places of one beam
//!   ╭──────────────────────────╮
//!   │                          │         sizes that agree between equal beams, either way round,
//!   ╰──────────────────────────╯         are made one
//! ```

use std::collections::BTreeMap;

use super::beam_section::BeamSection;
use super::moments::Moments;
use super::params::ProfileParams;
use super::shape::{Loft, ShapeStation};
use super::{Beam, Frame};
use crate::section::catalogue::Catalogue;
use crate::section::contours::Contours;
use crate::section::matching::{
    MEANT_EQUAL, MatchError, MatchTarget, ProfileChoice, equalize, match_profile,
};
use crate::section::{Profile, Shape};

/// A place along a beam, and what is to stand there.
struct Place {
    beam: usize,
    at: f64,
    target: MatchTarget,
}

/// Shapes the beams of a group, which have one profile, along their sections, unless `keep_on` asks to
/// stop.
pub(super) fn shape(
    frame: &mut Frame,
    group: &[usize],
    params: &ProfileParams,
    catalogue: &Catalogue,
    mut keep_on: impl FnMut() -> Result<(), MatchError>,
) -> Result<(), MatchError> {
    let Some(&first) = group.first() else { return Ok(()) };
    let profile = &frame.beams[first].shape.profile;
    if profile.designation.is_some() {
        return Ok(()); // it is rolled, and the same all along
    }
    let profile = profile.clone();
    let mut sized: BTreeMap<usize, Vec<(f64, Profile)>> = BTreeMap::new();
    for places in alike(places(frame, group, params.loft)).into_values() {
        let targets: Vec<(MatchTarget, f64)> =
            places.iter().map(|p| (p.target.clone(), 1.0)).collect();
        let equal = equalize(&targets, MEANT_EQUAL);
        let profiles: Vec<Profile> = equal
            .targets
            .iter()
            .map(|target| {
                keep_on()?;
                sized_as(&profile, target, params, catalogue)
            })
            .collect::<Result<_, _>>()?;
        for (place, &size) in places.iter().zip(&equal.group_of) {
            sized.entry(place.beam).or_default().push((place.at, profiles[size].clone()));
        }
    }
    for (beam, mut sizes) in sized {
        sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_one_size = sizes.iter().all(|s| s.1 == sizes[0].1);
        let beam = &mut frame.beams[beam];
        if is_one_size && beam.section.twist == 0.0 {
            continue;
        }
        let station = |(at, profile): &(f64, Profile)| {
            let region = profile.region().turned(beam.section.turn_at(*at));
            ShapeStation { at: *at, profile: profile.clone(), region }
        };
        beam.shape.stations = sizes.iter().map(station).collect();
    }
    Ok(())
}

/// A profile of the same family for another place: a freeform outline grows as it is, so that
/// equal beams keep one outline; others are matched anew.
fn sized_as(
    profile: &Profile,
    target: &MatchTarget,
    params: &ProfileParams,
    catalogue: &Catalogue,
) -> Result<Profile, MatchError> {
    if let Shape::Freeform(_) = profile.shape {
        let grown = target.area / profile.properties()?.area;
        return Ok(Profile::new(profile.shape.scaled(grown.sqrt()))?);
    }
    let choice: ProfileChoice = profile.family().parse().unwrap_or_default();
    Ok(match_profile(target, &choice, params.mode, catalogue)?.profile)
}

fn places(frame: &Frame, group: &[usize], loft: Loft) -> Vec<Vec<Place>> {
    group
        .iter()
        .filter_map(|&beam| {
            let Beam { section, measured, .. } = &frame.beams[beam];
            let own = measured.as_ref()?;
            let places = match loft {
                Loft::Constant => Vec::new(),
                Loft::Taper => from_end_to_end(section),
                Loft::Multi => along(section),
            };
            let place = |(at, there)| Place { beam, at, target: scaled_target(own, &there) };
            Some(places.into_iter().map(place).collect())
        })
        .collect()
}

/// Places as far from an end as each other, on beams of as many places: those that symmetry may
/// make equal.
fn alike(beams: Vec<Vec<Place>>) -> BTreeMap<(usize, usize), Vec<Place>> {
    let mut alike: BTreeMap<(usize, usize), Vec<Place>> = BTreeMap::new();
    for places in beams {
        let count = places.len();
        for (i, place) in places.into_iter().enumerate() {
            alike.entry((count, i.min(count - 1 - i))).or_default().push(place);
        }
    }
    alike
}

/// The target with the area and moments of another place and the contour grown alike.
fn scaled_target(own: &MatchTarget, there: &Moments) -> MatchTarget {
    let grown = there.area / own.area;
    let (i_1, i_2, _) = there.principal();
    let side = grown.sqrt();
    let contours =
        own.contours.as_ref().map(|c| Contours::solid(c.outer.iter().map(|p| p * side).collect()));
    MatchTarget {
        area: there.area,
        i_1,
        i_2,
        j: own.j * grown * grown,
        principal_angle: own.principal_angle,
        contours,
        facets: own.facets,
        worn: own.worn,
    }
}

/// Largest turn between two outlines of a twisted beam, rad: 15°. The ruled surface between them
/// is thinner in the middle by a hundredth.
const LARGEST_TURN: f64 = 0.27;

/// End values, and as many between them as a twist needs.
fn from_end_to_end(section: &BeamSection) -> Vec<(f64, Moments)> {
    let parts = (section.twist.abs() / LARGEST_TURN).ceil().max(1.0) as usize;
    let [start, end] = [0, 1].map(|e| section.ends[e].turned(-section.turn_at(e as f64)));
    (0..=parts)
        .map(|k| k as f64 / parts as f64)
        .map(|at| (at, Moments::between(&start, &end, at)))
        .collect()
}

/// End values and up to three means between them, each over the eighths beside a quarter point.
fn along(section: &BeamSection) -> Vec<(f64, Moments)> {
    let inner = section.stations.iter().filter(|s| !s.is_outlier());
    let inner: Vec<(f64, Moments)> = inner.map(|s| (s.at, s.moments)).collect();
    let mut places = vec![(0.0, section.ends[0])];
    for k in 1..4 {
        let middle = f64::from(k) / 4.0;
        let near: Vec<&(f64, Moments)> =
            inner.iter().filter(|(at, _)| (at - middle).abs() <= 0.125).collect();
        if near.is_empty() {
            continue;
        }
        let share = 1.0 / near.len() as f64;
        places.push((middle, Moments::mean(near.iter().map(|n| (share, n.1)))));
    }
    places.push((1.0, section.ends[1]));
    places
}
