//! The identifier box: confines a cut to one branch.
//!
//! A cutting plane across a branch would cut every other rod of the part as well. The box is
//! carried along with the branch, a little wider than it; what leaves the box is not the branch.
//!
//! # What differs from the thesis
//!
//! * The box is round across its direction. The width of a square box depends on its turn about
//!   the branch, and so would the place where a junction is seen.

use nalgebra::{Point3, Unit, Vector3};

/// An oriented box round a piece of one branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IdentifierBox {
    centre: Point3<f64>,
    direction: Unit<Vector3<f64>>,
    half_width: f64,
    half_length: f64,
}

impl IdentifierBox {
    /// Places a box round `centre`.
    ///
    /// * `direction`: marching direction.
    /// * `half_width`: radius across the direction, mm.
    /// * `half_length`: half the length along the direction, mm.
    pub fn new(
        centre: Point3<f64>,
        direction: Unit<Vector3<f64>>,
        half_width: f64,
        half_length: f64,
    ) -> Self {
        Self { centre, direction, half_width, half_length }
    }

    /// Whether a point lies in the box.
    ///
    /// ```
    /// # use beamwright::skeleton::identifier_box::IdentifierBox;
    /// # use nalgebra::{Point3, Vector3};
    /// let b = IdentifierBox::new(Point3::origin(), Vector3::x_axis(), 2.0, 5.0);
    /// assert!(b.contains(&Point3::new(4.9, 1.0, -1.0)));
    /// assert!(!b.contains(&Point3::new(5.1, 0.0, 0.0)));
    /// assert!(!b.contains(&Point3::new(0.0, 1.5, 1.5)));
    /// ```
    pub fn contains(&self, p: &Point3<f64>) -> bool {
        self.spans(p) && (p - self.centre).dot(&self.direction).abs() <= self.half_length
    }

    /// Whether a point lies within the width of the box, before or behind it or inside.
    pub fn spans(&self, p: &Point3<f64>) -> bool {
        let to = p - self.centre;
        let along = to.dot(&self.direction);
        to.norm_squared() - along * along <= self.half_width * self.half_width
    }
}
