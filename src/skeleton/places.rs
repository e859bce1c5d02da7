//! Places spread evenly over the surface.

use nalgebra::Point3;

use crate::mesh::Surface;
use crate::mesh::id::FaceId;

/// A place on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) face: FaceId,
    pub(crate) point: Point3<f64>,
}

impl Place {
    /// The middle of a part of a triangle.
    fn within(face: FaceId, [a, b, c]: &[Point3<f64>; 3]) -> Self {
        Self { face, point: Point3::from((a.coords + b.coords + c.coords) / 3.0) }
    }
}

/// Most places of one mesh. Parts of a thousand struts have some ten thousand; a single corner far
/// out in space would ask for more than there is memory.
const MOST_PLACES: f64 = 65_536.0;

/// Places spread over the design faces, one for about `area_each` mm², [`MOST_PLACES`] at most.
///
/// Small triangles share a place; large ones are cut in halves until each part has one. Only faces
/// that are wanted get places.
pub(crate) fn places(
    surface: &Surface,
    is_wanted: impl Fn(FaceId) -> bool,
    area_each: f64,
) -> Vec<Place> {
    let area_each = area_each.max(surface.design_area() / MOST_PLACES);
    let mut places = Vec::new();
    // Parts of the triangle that are still to be looked at.
    let mut left: Vec<[Point3<f64>; 3]> = Vec::new();
    let mut due = 0.5;
    let mut is_due = |area: f64| {
        due += area / area_each;
        let is_due = due >= 1.0;
        due -= f64::from(u8::from(is_due));
        is_due
    };
    let is_large = |area: f64| area > area_each && area.is_finite();
    let is_design = |f: &FaceId| surface.labels.is_design(*f);
    for face in surface.mesh.faces().filter(is_design).filter(|f| is_wanted(*f)) {
        let area = surface.face_area(face);
        if !is_large(area) {
            if is_due(area) {
                places.push(Place::within(face, &surface.mesh.corners(face)));
            }
            continue;
        }
        left.push(surface.mesh.corners(face));
        while let Some([a, b, c]) = left.pop() {
            let area = 0.5 * (b - a).cross(&(c - a)).norm();
            if is_large(area) {
                let [first, second] = halves([a, b, c]);
                left.extend([second, first]);
            } else if is_due(area) {
                places.push(Place::within(face, &[a, b, c]));
            }
        }
    }
    places
}

/// A triangle cut in two across its longest side.
fn halves(corners: [Point3<f64>; 3]) -> [[Point3<f64>; 3]; 2] {
    let first = longest_side(&corners);
    let [a, b, c] = [0, 1, 2].map(|i| corners[(first + i) % 3]);
    let m = nalgebra::center(&a, &b);
    [[a, m, c], [m, b, c]]
}

/// The first of the longest sides of a triangle, equal ones found equal in spite of rounding.
pub(super) fn longest_side([a, b, c]: &[Point3<f64>; 3]) -> usize {
    let lengths = [(b - a).norm(), (c - b).norm(), (a - c).norm()];
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    lengths.iter().position(|l| *l >= (1.0 - 1e-6) * longest).unwrap_or(0)
}
