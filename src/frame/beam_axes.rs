//! The axes of a beam.

use nalgebra::{Point2, Unit, Vector3};

/// The axes of a beam: x along it, y and z across.
///
/// ```text
///        z ▲  ╱ x  from the first node to the second
///          │ ╱
///          ●────► y
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamAxes {
    /// Along the beam.
    pub x: Unit<Vector3<f64>>,
    /// Across.
    pub y: Unit<Vector3<f64>>,
    /// Across; x × y.
    pub z: Unit<Vector3<f64>>,
}

impl BeamAxes {
    /// Axes along `x`, with `y` turned to nothing in particular.
    pub fn along(x: Unit<Vector3<f64>>) -> Self {
        let mut across = Vector3::zeros();
        across[x.iamin()] = 1.0;
        let y = Unit::new_normalize(x.cross(&across));
        Self { x, y, z: Unit::new_normalize(x.cross(&y)) }
    }

    /// The axes turned about x by `angle`, rad.
    pub fn rolled(&self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self {
            x: self.x,
            y: Unit::new_normalize(*self.y * cos + *self.z * sin),
            z: Unit::new_normalize(*self.z * cos - *self.y * sin),
        }
    }

    /// Coordinates y, z of a vector.
    pub fn across(&self, v: &Vector3<f64>) -> Point2<f64> {
        Point2::new(v.dot(&self.y), v.dot(&self.z))
    }
}
