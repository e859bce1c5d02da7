//! Area and second moments of plane sections in the axes of a beam.

use nalgebra::Point2;

/// Area and second moments of a section in the axes of its beam, about its own centroid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// ∫ dA, mm².
    pub area: f64,
    /// ∫ z² dA, mm⁴.
    pub i_yy: f64,
    /// ∫ y² dA, mm⁴.
    pub i_zz: f64,
    /// ∫ y z dA, mm⁴.
    pub i_yz: f64,
}

/// Part by which rounding may bring the moments of a round section below those of the disc: polygons of
/// a thousand corners lie above it by 1e-11.
const ROUNDING: f64 = 1e-9;

impl Moments {
    /// Moments of a polygon about its centroid (Green's theorem); counter-clockwise is positive.
    pub fn of_polygon(polygon: &[Point2<f64>]) -> Self {
        let mut m = Self::default();
        let (mut s_y, mut s_z) = (0.0, 0.0);
        for (i, p) in polygon.iter().enumerate() {
            let q = polygon[(i + 1) % polygon.len()];
            let w = p.x * q.y - q.x * p.y;
            m.area += w / 2.0;
            s_y += w * (p.x + q.x) / 6.0;
            s_z += w * (p.y + q.y) / 6.0;
            m.i_yy += w * (p.y * p.y + p.y * q.y + q.y * q.y) / 12.0;
            m.i_zz += w * (p.x * p.x + p.x * q.x + q.x * q.x) / 12.0;
            m.i_yz += w * (p.x * q.y + 2.0 * (p.x * p.y + q.x * q.y) + q.x * p.y) / 24.0;
        }
        if m.area != 0.0 {
            m.i_yy -= s_z * s_z / m.area;
            m.i_zz -= s_y * s_y / m.area;
            m.i_yz -= s_y * s_z / m.area;
        }
        m
    }

    /// Whether a region of the plane can have them: its second moments are positive, and no less than
    /// those of the ellipse that has its area, I_1 I_2 ≥ (A² / 4π)².
    ///
    /// Loops of a contour that crosses itself count against each other, or twice.
    pub(crate) fn is_of_a_region(&self) -> bool {
        let (_, i_2, _) = self.principal();
        let product = self.i_yy * self.i_zz - self.i_yz * self.i_yz;
        let least = self.area * self.area / (4.0 * std::f64::consts::PI);
        let is_as_large = product >= (1.0 - ROUNDING) * least * least;
        self.area > 0.0 && i_2 > 0.0 && is_as_large && product.is_finite()
    }

    /// Σ of parts, each times its factor; a mean where the factors add up to 1.
    pub(crate) fn mean(parts: impl Iterator<Item = (f64, Self)>) -> Self {
        parts.fold(Self::default(), |s, (f, m)| Self {
            area: s.area + f * m.area,
            i_yy: s.i_yy + f * m.i_yy,
            i_zz: s.i_zz + f * m.i_zz,
            i_yz: s.i_yz + f * m.i_yz,
        })
    }

    /// Of the same section turned by an angle, rad.
    pub fn turned(&self, angle: f64) -> Self {
        let (mean, half) = (0.5 * (self.i_yy + self.i_zz), 0.5 * (self.i_yy - self.i_zz));
        let (sin, cos) = (2.0 * angle).sin_cos();
        let turned = half * cos + self.i_yz * sin;
        Self {
            area: self.area,
            i_yy: mean + turned,
            i_zz: mean - turned,
            i_yz: self.i_yz * cos - half * sin,
        }
    }

    /// A part 0..1 of the way from one section to another: √A and the moments in squares of the
    /// area go straight.
    pub fn between(from: &Self, to: &Self, part: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * part;
        let area = mix(from.area.sqrt(), to.area.sqrt()).powi(2);
        let grown = |m: fn(&Self) -> f64| {
            mix(m(from) / from.area.powi(2), m(to) / to.area.powi(2)) * area * area
        };
        Self { area, i_yy: grown(|m| m.i_yy), i_zz: grown(|m| m.i_zz), i_yz: grown(|m| m.i_yz) }
    }

    /// Radius of the disc of equal area, mm.
    pub fn radius(&self) -> f64 {
        (self.area.max(0.0) / std::f64::consts::PI).sqrt()
    }

    /// Largest and smallest second moment I₁ ≥ I₂, mm⁴, and the angle from y to the axis about
    /// which it is largest, rad in (−π/2, π/2].
    pub fn principal(&self) -> (f64, f64, f64) {
        let mean = 0.5 * (self.i_yy + self.i_zz);
        let half = 0.5 * (self.i_yy - self.i_zz);
        let spread = half.hypot(self.i_yz);
        // I(φ) = mean + half cos 2φ − I_yz sin 2φ is largest there.
        (mean + spread, mean - spread, 0.5 * (-self.i_yz).atan2(half))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(b: f64, h: f64, turn: f64) -> Vec<Point2<f64>> {
        let (sin, cos) = turn.sin_cos();
        [(-b, -h), (b, -h), (b, h), (-b, h)]
            .map(|(y, z)| Point2::new((y * cos - z * sin) / 2.0, (y * sin + z * cos) / 2.0))
            .to_vec()
    }

    #[test]
    fn rectangle_has_b_h_cubed_over_12() {
        let m = Moments::of_polygon(&rectangle(6.0, 10.0, 0.0));
        assert!((m.area - 60.0).abs() < 1e-9);
        assert!((m.i_yy - 6.0 * 1000.0 / 12.0).abs() < 1e-9);
        assert!((m.i_zz - 10.0 * 216.0 / 12.0).abs() < 1e-9);
    }

    #[test]
    fn a_contour_whose_loops_count_against_each_other_bounds_no_region() {
        let points = |corners: &[[f64; 2]]| -> Vec<Point2<f64>> {
            corners.iter().map(|&[y, z]| Point2::new(y, z)).collect()
        };
        let round = |turns: f64| -> Vec<Point2<f64>> {
            let at = |i: u32| turns * std::f64::consts::TAU * f64::from(i) / 2000.0;
            (0..2000).map(|i| Point2::new(at(i).cos(), at(i).sin())).collect()
        };
        let eight = [[0.0, 0.0], [10.0, 0.0], [10.0, 4.0], [-9.0, -20.0], [-9.0, 20.0], [0.0, 5.0]];
        for (contour, is_region) in [
            (rectangle(6.0, 10.0, 0.3), true),
            (rectangle(1e-3, 10.0, 0.3), true),
            (round(1.0), true),
            (round(2.0), false),
            (points(&eight), false),
            (points(&[[0.0, 0.0], [4.0, 0.0], [8.0, 0.0]]), false),
        ] {
            let found = Moments::of_polygon(&contour);
            assert_eq!(found.is_of_a_region(), is_region, "{found:?}");
        }
    }

    #[test]
    fn the_principal_angle_turns_with_the_section() {
        for turn in [-1.2, -0.3, 0.0, 0.4, 1.5] {
            let (i_1, i_2, angle) = Moments::of_polygon(&rectangle(6.0, 10.0, turn)).principal();
            assert!((i_1 - 500.0).abs() < 1e-9 && (i_2 - 180.0).abs() < 1e-9);
            assert!((angle - turn).sin().abs() < 1e-12, "{turn}: {angle}");
        }
    }

    #[test]
    fn moments_turn_as_their_polygon_does() {
        let m = Moments::of_polygon(&rectangle(6.0, 10.0, 0.2)).turned(0.5);
        let exact = Moments::of_polygon(&rectangle(6.0, 10.0, 0.7));
        assert!((m.i_yy - exact.i_yy).abs() < 1e-9 && (m.i_yz - exact.i_yz).abs() < 1e-9);
    }
}
