//! The mean section of a beam, measured on the sections that are its own.

use nalgebra::{Point2, Rotation2};

use super::beam_section::BeamSection;
use super::beam_station::BeamStation;
use crate::section::MatchTarget;
use crate::section::contours::Contours;
use crate::section::freeform::average_outline;
use crate::section::matching::{facets, worn};
use crate::section::properties::SectionProperties;

/// Points of an averaged contour: a round one is followed within a thousandth of its radius.
const OUTLINE_POINTS: usize = 48;

/// Points of the contour whose flat sides are looked at. With 48 the corners of a rectangle are cut
/// so much that its sides lie a quarter percent too far out; four times as many leave a sixteenth.
const FINE_POINTS: usize = 192;

/// What the sections of a beam say together; `None` without a section, or where they are torn so that
/// no bar can have what they say.
///
/// A and the second moments are means over the sections, J is that of the mean contour.
pub(super) fn measured(section: &BeamSection) -> Option<MatchTarget> {
    let contour = mean_contour(section)?;
    let properties = SectionProperties::of_contours(&Contours::solid(contour.clone())).ok()?;
    let (i_1, i_2, principal_angle) = section.mean.principal();
    // J grows with the square of the area, and the area is the mean of the areas.
    let scale = section.mean.area / properties.area;
    // Most beams are no rectangles; they need no second look.
    let worn = worn(&contour).and_then(|coarse| {
        let outline = average_outline(&contours(section), FINE_POINTS).ok();
        outline.and_then(|fine| worn(fine.points())).or(Some(coarse))
    });
    let target = MatchTarget {
        area: section.mean.area,
        i_1,
        i_2,
        j: properties.j * scale * scale,
        principal_angle,
        contours: Some(Contours::solid(contour)),
        facets: tessellated(section),
        worn,
    };
    target.check().is_ok().then_some(target)
}

/// Sides of the polygon that more than half of the sections of a beam are.
fn tessellated(section: &BeamSection) -> Option<u32> {
    let clean = section.stations.iter().filter(|s| !s.is_outlier());
    let mut counts: Vec<Option<u32>> = clean.map(|s| facets(&s.contour)).collect();
    counts.sort_unstable();
    let middle = counts.get(counts.len() / 2).copied().flatten();
    let same = counts.iter().filter(|&&count| count == middle).count();
    middle.filter(|_| 2 * same > counts.len())
}

/// The averaged contour of the sections that belong to the beam alone; where they have none, the
/// contour whose area is nearest to the mean.
pub(super) fn mean_contour(section: &BeamSection) -> Option<Vec<Point2<f64>>> {
    if let Ok(outline) = average_outline(&contours(section), OUTLINE_POINTS) {
        return Some(outline.points().to_vec());
    }
    let off = |s: &BeamStation| (s.moments.area - section.mean.area).abs();
    let nearest = section.stations.iter().min_by(|a, b| off(a).total_cmp(&off(b)))?;
    Some(nearest.contour.clone())
}

/// The contours of the sections that belong to the beam alone, or of all if none does, in axes that
/// turn along with a twisted beam.
fn contours(section: &BeamSection) -> Vec<Vec<Point2<f64>>> {
    let is_clean = |s: &&BeamStation| !s.is_outlier();
    let all_swollen = !section.stations.iter().any(|s| is_clean(&s));
    section
        .stations
        .iter()
        .filter(|s| all_swollen || is_clean(s))
        .map(|s| {
            let untwist = Rotation2::new(-section.turn_at(s.at));
            s.contour.iter().map(|p| untwist * p).collect()
        })
        .collect()
}
