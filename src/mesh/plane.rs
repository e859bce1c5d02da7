//! An oriented plane, which cuts the surface.

use nalgebra::{Point3, Unit, Vector3};

/// An oriented plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// A point of the plane, mm.
    pub point: Point3<f64>,
    /// Unit normal: the upper side.
    pub normal: Unit<Vector3<f64>>,
}

impl Plane {
    /// The plane through `point` with its upper side towards `normal`.
    pub fn new(point: Point3<f64>, normal: Unit<Vector3<f64>>) -> Self {
        Self { point, normal }
    }

    /// Signed distance of a point, mm; points on the plane count as above.
    pub fn height(&self, p: &Point3<f64>) -> f64 {
        (p - self.point).dot(&self.normal)
    }

    /// Two unit vectors that span the plane; with the normal they are right-handed.
    pub fn axes(&self) -> (Vector3<f64>, Vector3<f64>) {
        let n = self.normal.into_inner();
        let mut across = Vector3::zeros();
        across[n.iamin()] = 1.0;
        let u = n.cross(&across).normalize();
        (u, n.cross(&u))
    }
}
