//! A ray against a triangle, watertight: what passes between two triangles meets their edge.

use nalgebra::{Point2, Point3, Vector3};

/// Directions for the inside test, far from the axes along which CAD models have their faces. The
/// second is taken when the first meets an edge or a corner exactly, and so on.
pub(super) const DIRECTIONS: [[f64; 3]; 4] = [
    [0.367_879_441, 0.577_215_664, 0.729_153_2],
    [-0.618_033_988, 0.309_016_994, 0.726_2],
    [0.271_828_182, -0.683_012_70, 0.667_7],
    [0.141_421_356, 0.235_711_131, -0.961_5],
];

/// A ray in the shape the watertight triangle test wants it: sheared so that it runs along z.
///
/// Woop, Benthin, Wald: *Watertight Ray/Triangle Intersection*, JCGT 2 (2013).
pub(super) struct Ray {
    origin: Point3<f64>,
    inverse: Vector3<f64>,
    axes: [usize; 3],
    shear: [f64; 3],
}

/// How a ray meets a triangle.
pub(super) enum Hit {
    Miss,
    /// It meets an edge or a corner exactly, or runs in the plane of the triangle.
    Edge,
    /// Distance in lengths of the direction; +1 where the ray leaves the body, −1 where it enters.
    At(f64, i32),
}

impl Ray {
    pub(super) fn new(origin: &Point3<f64>, direction: &Vector3<f64>) -> Self {
        let z = direction.iamax();
        let (x, y) = if direction[z] < 0.0 {
            ((z + 2) % 3, (z + 1) % 3)
        } else {
            ((z + 1) % 3, (z + 2) % 3)
        };
        let d = direction;
        Self {
            origin: *origin,
            inverse: d.map(|c| 1.0 / c),
            axes: [x, y, z],
            shear: [d[x] / d[z], d[y] / d[z], 1.0 / d[z]],
        }
    }

    /// Whether the first part of the ray, `reach` of its direction long, may pass through a box.
    pub(super) fn may_meet(&self, low: &[f32; 3], high: &[f32; 3], reach: f64) -> bool {
        // A NaN (0 · ∞) is neither less nor more: it leaves the interval as it is.
        let less = |a: f64, b: f64| if a < b { a } else { b };
        let more = |a: f64, b: f64| if a > b { a } else { b };
        let (mut enter, mut leave) = (0.0, reach);
        for k in 0..3 {
            let to_low = (f64::from(low[k]) - self.origin[k]) * self.inverse[k];
            let to_high = (f64::from(high[k]) - self.origin[k]) * self.inverse[k];
            enter = more(less(to_low, to_high), enter);
            leave = less(more(to_low, to_high), leave);
        }
        enter <= leave
    }

    /// A vector seen along the ray.
    pub(super) fn flat(&self, v: &Vector3<f64>) -> Point2<f64> {
        let [x, y, z] = self.axes;
        Point2::new(v[x] - self.shear[0] * v[z], v[y] - self.shear[1] * v[z])
    }

    /// Where the ray passes through a triangle.
    pub(super) fn cross(&self, corners: &[Point3<f64>; 3]) -> Hit {
        let [x, y, z] = self.axes;
        let [sx, sy, sz] = self.shear;
        let [a, b, c] = corners.map(|p| p - self.origin);
        let flat = |p: &Vector3<f64>| (p[x] - sx * p[z], p[y] - sy * p[z]);
        let ((ax, ay), (bx, by), (cx, cy)) = (flat(&a), flat(&b), flat(&c));
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let some_negative = u < 0.0 || v < 0.0 || w < 0.0;
        let some_positive = u > 0.0 || v > 0.0 || w > 0.0;
        if some_negative && some_positive {
            return Hit::Miss;
        }
        let det = u + v + w;
        let at = (u * a[z] + v * b[z] + w * c[z]) * sz / det;
        if det == 0.0 || u == 0.0 || v == 0.0 || w == 0.0 {
            return if at >= 0.0 || at.is_nan() { Hit::Edge } else { Hit::Miss };
        }
        if at < 0.0 {
            return Hit::Miss;
        }
        Hit::At(at, if det > 0.0 { -1 } else { 1 })
    }
}
