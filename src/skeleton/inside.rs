//! Keeps the skeleton inside the object (thesis §5.2.5).

use nalgebra::{Point3, Vector3};

use super::detour::detour;
use super::error::SkeletonError;
use super::watch::Watch;
use crate::mesh::id::FaceId;
use crate::mesh::{HalfEdgeMesh, InterfaceSection, Surface, TriangleTree};
use crate::observer::Observer;

/// Halvings of a segment that leaves the object. A quarter circle in a ring is followed within a
/// thousandth of its radius after six.
const HALVINGS: usize = 6;

/// Where the centre of an interface section lies on the surface, its branch stops this part of the
/// radius behind it, the first that is inside. On a plane face a trifle is enough: far more than the
/// rounding of coordinates, far less than anybody measures. A rough face bulges by hundredths.
const BEHIND_FACE: [f64; 4] = [1e-6, 1e-3, 1e-2, 1e-1];

/// Where a branch ends in an interface section: its centre.
///
/// Where the non-design part is a mere face, without any thickness, the centre lies on the surface
/// or a little off it, and is taken a little behind it.
pub(crate) fn end_in(surface: &Surface, section: &InterfaceSection) -> Point3<f64> {
    let trifle = BEHIND_FACE[0] * section.radius();
    let is_within = |p: &Point3<f64>| {
        let foot = surface.tree.nearest(p).map(|n| (n.0 - p).norm());
        surface.tree.contains(p) && foot.is_none_or(|distance| distance >= 0.5 * trifle)
    };
    if is_within(&section.centroid) {
        return section.centroid;
    }
    BEHIND_FACE
        .iter()
        .map(|part| section.centroid + section.normal * (part * section.radius()))
        .find(is_within)
        .unwrap_or(section.centroid)
}

/// Whether a segment runs inside, its ends included.
pub(crate) fn is_inside(tree: &TriangleTree, a: &Point3<f64>, b: &Point3<f64>) -> bool {
    tree.contains(a) && tree.contains(b) && !tree.is_crossed_by(a, b)
}

/// Points between `a` and `b` over which the way stays inside; empty when the straight way does,
/// and as good as possible when none is found.
pub(crate) fn way_inside(
    surface: &Surface,
    a: &Point3<f64>,
    b: &Point3<f64>,
    watch: &mut Watch<'_, impl Observer>,
) -> Result<Vec<Point3<f64>>, SkeletonError> {
    let Surface { mesh, tree, .. } = surface;
    let mut halved = Vec::new();
    if !tree.is_crossed_by(a, b) {
        return Ok(halved);
    }
    halve(surface, a, b, HALVINGS, &mut halved);
    halved.push(*b);
    let (mut way, mut at) = (Vec::new(), *a);
    for next in halved {
        if tree.is_crossed_by(&at, &next) {
            let ends = [&at, &next];
            let found = watch.detour(ends, |watch| detour(mesh, tree, ends, watch))?;
            way.extend(found.unwrap_or_default());
        }
        way.push(next);
        at = next;
    }
    way.pop();
    Ok(way)
}

/// Halves a way that leaves the object at the middles of walls, and the halves that still do.
fn halve(
    surface: &Surface,
    a: &Point3<f64>,
    b: &Point3<f64>,
    left: usize,
    way: &mut Vec<Point3<f64>>,
) {
    let Surface { mesh, tree, .. } = surface;
    let Some(middle) = middle_of_wall(mesh, tree, &nalgebra::center(a, b)) else { return };
    let halve_on = |from: &Point3<f64>, to: &Point3<f64>, way: &mut Vec<Point3<f64>>| {
        if left > 1 && tree.is_crossed_by(from, to) {
            halve(surface, from, to, left - 1, way);
        }
    };
    halve_on(a, &middle, way);
    way.push(middle);
    halve_on(&middle, b, way);
}

/// The middle of the material nearest to a point: half-way through the wall behind its nearest
/// surface point.
pub(crate) fn middle_of_wall(
    mesh: &HalfEdgeMesh,
    tree: &TriangleTree,
    point: &Point3<f64>,
) -> Option<Point3<f64>> {
    let (foot, _, face) = tree.nearest(point)?;
    let inwards = -mesh.doubled_area_vector(FaceId(face)).try_normalize(0.0)?;
    let thickness = wall_thickness(tree, &foot, &inwards)?;
    Some(foot + inwards * (0.5 * thickness))
}

/// Way from a surface point along `inwards` to the far side, mm.
fn wall_thickness(tree: &TriangleTree, foot: &Point3<f64>, inwards: &Vector3<f64>) -> Option<f64> {
    let mut nearest = f64::INFINITY;
    tree.visit_crossings(foot, inwards, |c| {
        if c.sign > 0 && c.at > 0.0 {
            nearest = nearest.min(c.at);
        }
    });
    nearest.is_finite().then_some(nearest)
}
