//! Parallel projection of the model onto a panel.

use nalgebra::{Matrix3, Point3, Vector3};

/// From where the model is seen; z is up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Projection {
    /// From the front, right and above.
    Isometric,
    /// Along +y.
    Front,
    /// Along −z.
    Top,
    /// Along −x.
    Side,
}

impl Projection {
    /// Right, up and towards the viewer as rows.
    fn axes(self) -> Matrix3<f64> {
        let (right, towards) = match self {
            Self::Isometric => (Vector3::new(1.0, 1.0, 0.0), Vector3::new(1.0, -1.0, 1.0)),
            Self::Front => (Vector3::x(), -Vector3::y()),
            Self::Top => (Vector3::x(), Vector3::z()),
            Self::Side => (Vector3::y(), Vector3::x()),
        };
        let (right, towards) = (right.normalize(), towards.normalize());
        let up = towards.cross(&right);
        Matrix3::from_rows(&[right.transpose(), up.transpose(), towards.transpose()])
    }
}

/// Room left free round the model, as a part of the panel.
const MARGIN: f64 = 0.08;

/// From mm to pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    axes: Matrix3<f64>,
    scale: f64,
    shift: [f64; 2],
}

impl Camera {
    /// Fits points into a panel of left, top, width, height.
    pub(super) fn fit(
        projection: Projection,
        points: &[Point3<f64>],
        [left, top, width, height]: [f64; 4],
    ) -> Self {
        let axes = projection.axes();
        let seen: Vec<Point3<f64>> = points.iter().map(|p| axes * p).collect();
        let (low, high) = crate::output::view::bounds(&seen);
        let extent = high - low;
        let room = 1.0 - 2.0 * MARGIN;
        let per = |pixels: f64, mm: f64| if mm > 0.0 { room * pixels / mm } else { f64::INFINITY };
        let scale = per(width, extent.x).min(per(height, extent.y));
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let middle = nalgebra::center(&low, &high);
        let shift = [left + width / 2.0 - scale * middle.x, top + height / 2.0 + scale * middle.y];
        Self { axes, scale, shift }
    }

    /// Pixels to the right and down, and depth in pixels towards the viewer.
    pub(super) fn project(&self, p: &Point3<f64>) -> Point3<f64> {
        let seen = self.axes * p;
        Point3::new(
            self.shift[0] + self.scale * seen.x,
            self.shift[1] - self.scale * seen.y,
            self.scale * seen.z,
        )
    }

    /// A direction in the axes of the picture: right, up, towards the viewer.
    pub(super) fn turn(&self, v: &Vector3<f64>) -> Vector3<f64> {
        self.axes * v
    }

    /// Unit normal of a triangle in the axes of the picture; zero without area.
    pub(super) fn normal(&self, [a, b, c]: &[Point3<f64>; 3]) -> Vector3<f64> {
        let normal = self.turn(&(b - a).cross(&(c - a)));
        normal.try_normalize(0.0).unwrap_or_else(Vector3::zeros)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_fills_the_panel_but_for_the_margin() {
        let points = [Point3::new(-10.0, 0.0, 0.0), Point3::new(30.0, 5.0, 10.0)];
        let camera = Camera::fit(Projection::Front, &points, [100.0, 50.0, 200.0, 200.0]);
        let [a, b] = [0, 1].map(|i| camera.project(&points[i]));
        assert!((b.x - a.x - 168.0).abs() < 1e-9 && ((a.x + b.x) / 2.0 - 200.0).abs() < 1e-9);
        assert!(b.y < a.y, "up is up");
    }

    #[test]
    fn the_axes_are_right_handed_for_every_view() {
        for view in [Projection::Isometric, Projection::Front, Projection::Top, Projection::Side] {
            assert!((view.axes().determinant() - 1.0).abs() < 1e-12, "{view:?}");
        }
    }
}
