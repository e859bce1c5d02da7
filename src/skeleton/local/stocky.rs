//! The point of a run no longer than it is thick: a foot between a junction and its pad, in which no
//! rod was found.

use nalgebra::{Unit, center};

use super::draft::Hub;
use super::sample::Sample;
use super::section_near::extent_in_design;
use crate::mesh::Surface;
use crate::mesh::contour::{Plane, contour_round};

/// The centroid of the section half-way between two hubs, if that is of design faces only and reaches
/// no farther than the run is long: a wider one holds other branches as well.
pub(crate) fn middle_of(surface: &Surface, hubs: [&Hub; 2]) -> Option<Sample> {
    let [a, b] = hubs.map(|hub| hub.position);
    let length = (b - a).norm();
    let plane = Plane::new(center(&a, &b), Unit::try_new(b - a, 0.0)?);
    let Surface { mesh, tree, .. } = surface;
    let contour = contour_round(mesh, tree, &plane, length)?;
    let section = extent_in_design(surface, &contour, &plane)?;
    let position = section.centroid;
    tree.contains(&position).then(|| Sample { position, radius: section.radius() })
}
