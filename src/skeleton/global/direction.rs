//! The six marching directions of the global frame (thesis §3.4.3.1, fig. 3.27).

use nalgebra::{Point3, Vector3};

/// One of the six directions; the investigation of a junction goes through them in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Direction {
    /// 0, 1, 2 for x, y, z.
    pub(crate) axis: usize,
    /// Whether it points to larger coordinates.
    pub(crate) is_positive: bool,
}

impl Direction {
    /// x_m, x_p, y_m, y_p, z_m, z_p.
    pub(crate) const ALL: [Self; 6] = [
        Self::new(0, false),
        Self::new(0, true),
        Self::new(1, false),
        Self::new(1, true),
        Self::new(2, false),
        Self::new(2, true),
    ];

    const fn new(axis: usize, is_positive: bool) -> Self {
        Self { axis, is_positive }
    }

    /// The direction nearest to a vector: of the interface plane, the one across it (§3.4.2.1).
    pub(crate) fn nearest(vector: &Vector3<f64>) -> Self {
        let axis = vector.iamax();
        Self::new(axis, vector[axis] >= 0.0)
    }

    /// The opposite direction.
    pub(crate) fn reversed(self) -> Self {
        Self { is_positive: !self.is_positive, ..self }
    }

    /// The other directions, those across this one first, the opposite one left out.
    pub(crate) fn alternatives(self) -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(move |d| d.axis != self.axis)
    }

    /// The two axes across the direction.
    pub(crate) fn axes_across(self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    /// How far a point lies in this direction.
    pub(crate) fn height(self, point: &Point3<f64>) -> f64 {
        if self.is_positive { point[self.axis] } else { -point[self.axis] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_direction_across_an_interface_is_the_nearest_axis() {
        let d = Direction::nearest(&Vector3::new(0.1, -0.9, 0.3));
        assert_eq!((d.axis, d.is_positive), (1, false));
        assert_eq!(d.reversed(), Direction::ALL[3]);
        assert_eq!(d.alternatives().count(), 4);
    }
}
