//! How deep a section is in each direction: what an offset of the axis is measured against.
//!
//! A section of area A and second moments I has the same moments as an ellipse with the half-axes
//! 2 √(I/A). An axis that is off by half of the smaller one of a plank is as far out of the middle
//! as one off by half the radius of a round bar.

use nalgebra::{Matrix3, Vector3};

use super::moments::Moments;
use super::section_at::Section;

/// The ellipse of a section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Depths {
    /// Unit vectors along the half-axes.
    along: [Vector3<f64>; 2],
    /// The half-axes, mm.
    half: [f64; 2],
}

/// Smallest half-axis against the larger one that counts: thinner, a mesh says nothing of it.
const FLATTEST: f64 = 0.1;

impl Section {
    /// How deep the section is in each direction.
    pub(super) fn depths(&self) -> Depths {
        let (u, v) = self.plane.axes();
        let m = Moments::of_polygon(&self.outline());
        let (i_1, i_2, angle) = m.principal();
        let (sin, cos) = angle.sin_cos();
        // The section is deep across the axis about which its second moment is large.
        let (axis_1, axis_2) = (u * cos + v * sin, v * cos - u * sin);
        let half = |i: f64| 2.0 * (i.max(0.0) / m.area).sqrt();
        let deep = half(i_1).max(f64::MIN_POSITIVE);
        Depths { along: [axis_2, axis_1], half: [deep, half(i_2).max(FLATTEST * deep)] }
    }
}

impl Depths {
    /// An offset in half-depths of the section in its direction; across the section, where there is
    /// none, in those of a round one of its area.
    pub(super) fn in_depths(&self, offset: &Vector3<f64>) -> f64 {
        let part = |i: usize| offset.dot(&self.along[i]) / self.half[i];
        let normal = self.along[0].cross(&self.along[1]);
        let across = offset.dot(&normal) / (self.half[0] * self.half[1]).sqrt();
        part(0).hypot(part(1)).hypot(across)
    }

    /// What offsets weigh by direction: the identity for a round section.
    pub(super) fn metric(&self) -> Matrix3<f64> {
        let mean = self.half[0] * self.half[1];
        let part =
            |i: usize| self.along[i] * self.along[i].transpose() * (mean / self.half[i].powi(2));
        part(0) + part(1)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;
    use crate::mesh::contour::Plane;

    #[test]
    fn a_plank_is_left_sooner_across_its_thin_side() {
        let plane = Plane::new(Point3::origin(), Vector3::x_axis());
        let corners = [[-8.0, -1.0], [8.0, -1.0], [8.0, 1.0], [-8.0, 1.0]];
        let contour = corners.map(|[y, z]| Point3::new(0.0, y, z)).to_vec();
        let plank = Section { point: 0, plane, contour, area: 32.0, centroid: Point3::origin() };
        let depths = plank.depths();
        let half = 2.0 * 2.0 / 12f64.sqrt();
        assert!((depths.in_depths(&Vector3::new(0.0, 0.0, 1.0)) - 1.0 / half).abs() < 1e-9);
        assert!((depths.in_depths(&Vector3::new(0.0, 8.0, 0.0)) - 1.0 / half).abs() < 1e-9);
        let metric = depths.metric();
        assert!((metric[(2, 2)] / metric[(1, 1)] - 64.0).abs() < 1e-9);
    }

    #[test]
    fn a_beam_that_passes_below_a_section_is_no_nearer_than_it_is() {
        let plane = Plane::new(Point3::origin(), Vector3::z_axis());
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let contour = corners.map(|[x, y]| Point3::new(x, y, 0.0)).to_vec();
        let square = Section { point: 0, plane, contour, area: 4.0, centroid: Point3::origin() };
        let depths = square.depths();
        let (below, beside) = (Vector3::new(0.0, 0.0, -7.0), Vector3::new(7.0, 0.0, 0.0));
        assert!((depths.in_depths(&below) - depths.in_depths(&beside)).abs() < 1e-9);
    }
}
