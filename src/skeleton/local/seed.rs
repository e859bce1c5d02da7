//! Whether a march may start at a place of the surface: whether it lies on a rod.
//!
//! At a place of the surface the direction of the rod is unknown. Planes through the place in a few
//! tangent directions are cut; each is then turned across the direction that its contour's surface
//! normals have least of (on a rod the normals are all across its axis), and the smallest section
//! is taken. Thesis §5.2.2: the frame is found locally.

use nalgebra::{Matrix3, Point3, SymmetricEigen, Unit, Vector3};

use super::band::Front;
use super::march::March;
use crate::mesh::HalfEdgeMesh;
use crate::mesh::contour::{Contour, Extent, Plane, entry};
use crate::mesh::id::FaceId;
use crate::skeleton::places::{Place, longest_side};

/// Tangent directions tried at a place: 45° apart. A plane up to 22° off the rod's section still
/// cuts a closed curve, from which the turning finds the axis.
const DIRECTIONS: usize = 4;

/// Turns until the plane lies across the rod; each turn squares the error on a plain rod.
const TURNS: usize = 4;

/// Contours of more than this reach over the best one found are not followed to their end.
const REACH_OVER_BEST: f64 = 1.5;

impl March<'_> {
    /// The section across the rod at a place, or `None` where no section closes within `limit` mm.
    pub(crate) fn section_at(&mut self, place: &Place, limit: f64) -> Option<Front> {
        let normal = Unit::try_new(self.surface.mesh.doubled_area_vector(place.face), 0.0)?;
        let (u, v) = tangents(&self.surface.mesh, place.face, &normal);
        let mut best: Option<Cut> = None;
        for k in 0..DIRECTIONS {
            let angle = std::f64::consts::PI * k as f64 / DIRECTIONS as f64;
            let direction = Unit::new_normalize(u * angle.cos() + v * angle.sin());
            let limit =
                best.as_ref().map_or(limit, |b| limit.min(2.0 * REACH_OVER_BEST * b.extent.reach));
            let Some(cut) = self.section_through(place, direction, limit) else { continue };
            if best.as_ref().is_none_or(|b| cut.extent.area < b.extent.area) {
                best = Some(cut);
                std::mem::swap(&mut self.contour, &mut self.best);
            }
        }
        let Cut { plane, extent } = self.turned_across(place, best?, limit);
        Some(Front { plane, contour: self.best.clone(), extent })
    }

    /// Turns the plane of the best contour so far across the rod.
    fn turned_across(&mut self, place: &Place, mut best: Cut, limit: f64) -> Cut {
        for _ in 0..TURNS {
            let Some(axis) = axis_of(&self.surface.mesh, &self.best) else { break };
            let axis = if axis.dot(&best.plane.normal) < 0.0 { -axis } else { axis };
            let cosine = axis.dot(&best.plane.normal);
            let Some(turned) = self.section_through(place, axis, limit) else { break };
            best = turned;
            std::mem::swap(&mut self.contour, &mut self.best);
            if cosine > 0.999_9 {
                break;
            }
        }
        best
    }

    /// Cuts the surface across `direction` at a place; leaves the contour in `self.contour`.
    fn section_through(
        &mut self,
        place: &Place,
        direction: Unit<Vector3<f64>>,
        limit: f64,
    ) -> Option<Cut> {
        let plane = Plane::new(place.point, direction);
        let start = entry(&self.surface.mesh, &plane, place.face)?;
        let is_near = |p: &Point3<f64>| (p - place.point).norm_squared() <= limit * limit;
        let extent = self.follow(&plane, start, is_near)?;
        Some(Cut { plane, extent })
    }
}

/// A plane and what its contour encloses.
struct Cut {
    plane: Plane,
    extent: Extent,
}

/// Tangents tied to the triangle, so that they turn with the model.
fn tangents(
    mesh: &HalfEdgeMesh,
    face: FaceId,
    normal: &Unit<Vector3<f64>>,
) -> (Vector3<f64>, Vector3<f64>) {
    let corners = mesh.corners(face);
    let first = longest_side(&corners);
    let u = (corners[(first + 1) % 3] - corners[first]).normalize();
    (u, normal.cross(&u))
}

/// The direction that the surface normals along a contour vary least in.
///
/// On a rod they all lie across the axis; on a cone they lean by the same angle, hence "vary".
fn axis_of(mesh: &HalfEdgeMesh, contour: &Contour) -> Option<Unit<Vector3<f64>>> {
    let mut sum = Vector3::zeros();
    // xx, xy, xz, yy, yz, zz
    let mut squares = [0.0; 6];
    let mut weight = 0.0;
    let next = contour.points.iter().cycle().skip(1);
    for ((h, point), next) in contour.half_edges.iter().zip(&contour.points).zip(next) {
        let length = (next - point).norm();
        let Some(normal) = mesh.doubled_area_vector(h.face()).try_normalize(0.0) else { continue };
        sum += normal * length;
        let [x, y, z] = normal.into();
        for (sum, product) in squares.iter_mut().zip([x * x, x * y, x * z, y * y, y * z, z * z]) {
            *sum += product * length;
        }
        weight += length;
    }
    if weight <= 0.0 {
        return None;
    }
    let [xx, xy, xz, yy, yz, zz] = squares;
    let squares = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let spread = squares / weight - (sum / weight) * (sum / weight).transpose();
    let eigen = SymmetricEigen::new(spread);
    let least = eigen.eigenvalues.imin();
    Unit::try_new(eigen.eigenvectors.column(least).into_owned(), 0.5)
}
