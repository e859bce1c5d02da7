//! The point of a run no longer than it is thick: a foot between a junction and its pad, in which no
//! rod was found.

use nalgebra::{Unit, center};

use super::draft::Hub;
use super::sample::Sample;
use crate::mesh::Surface;
use crate::mesh::contour::{Extent, Plane, contour_round};

/// The centroid of the section half-way between two hubs, if that is of design faces only and reaches
/// no farther than the run is long: a wider one holds other branches as well.
pub(crate) fn middle_of(surface: &Surface, hubs: [&Hub; 2]) -> Option<Sample> {
    let [a, b] = hubs.map(|hub| hub.position);
    let length = (b - a).norm();
    let plane = Plane::new(center(&a, &b), Unit::try_new(b - a, 0.0)?);
    let Surface { mesh, tree, labels, .. } = surface;
    let contour = contour_round(mesh, tree, &plane, length)?;
    let Extent { centroid, area, .. } = Extent::of(&contour, &plane);
    let is_design = contour.half_edges.iter().all(|h| labels.is_design(h.face()));
    let is_section = is_design && area > 0.0 && tree.contains(&centroid);
    let radius = (area / std::f64::consts::PI).sqrt();
    is_section.then_some(Sample { position: centroid, radius })
}
