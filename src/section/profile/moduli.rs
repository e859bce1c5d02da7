//! Section moduli and extents of a region bounded by lines, arcs and cubics.

use nalgebra::{Point2, Vector2};

use super::super::moments::Moments;
use super::super::piece::{Piece, bisect};

/// Section moduli about the local axes through the centroid, mm³.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli {
    /// Elastic modulus I_y / max |z|.
    pub w_el_y: f64,
    /// Elastic modulus I_z / max |y|.
    pub w_el_z: f64,
    /// Plastic modulus ∫ |z − z_p| dA about the axis that halves the area.
    pub w_pl_y: f64,
    /// Plastic modulus ∫ |y − y_p| dA about the axis that halves the area.
    pub w_pl_z: f64,
}

impl Moduli {
    /// Moduli of the region on the left of the pieces.
    pub(crate) fn of(pieces: &[Piece]) -> Self {
        let moments = Moments::of_pieces(pieces);
        let central = moments.central();
        let farthest = |axis: usize| {
            let [low, high] = extent(pieces, axis);
            let centroid = moments.centroid()[axis];
            (high - centroid).max(centroid - low)
        };
        Self {
            w_el_y: central.i_xx / farthest(1),
            w_el_z: central.i_yy / farthest(0),
            w_pl_y: plastic_modulus(pieces, 1, central.area),
            w_pl_z: plastic_modulus(pieces, 0, central.area),
        }
    }
}

/// Largest distance of the pieces from a point.
pub(crate) fn reach(pieces: &[Piece], from: Point2<f64>) -> f64 {
    let turning = |piece: &Piece| piece.roots(|p, d| (p - from).dot(&d));
    let distance = |p: Point2<f64>| (p - from).norm();
    extremes(pieces, turning).map(distance).fold(0.0, f64::max)
}

/// Smallest and largest coordinate.
pub(crate) fn extent(pieces: &[Piece], axis: usize) -> [f64; 2] {
    let turning = |piece: &Piece| piece.roots(|_, d| d[axis]);
    extremes(pieces, turning)
        .fold([f64::MAX, f64::MIN], |[low, high], p| [low.min(p[axis]), high.max(p[axis])])
}

/// Starts of the pieces and the points where a distance along them turns.
fn extremes<'p>(
    pieces: &'p [Piece],
    turning: impl Fn(&Piece) -> Vec<f64> + 'p,
) -> impl Iterator<Item = Point2<f64>> + 'p {
    pieces.iter().flat_map(move |piece| {
        // Along a line both distances and coordinates are greatest at an end.
        let mut at = if matches!(piece, Piece::Line { .. }) { Vec::new() } else { turning(piece) };
        at.push(0.0);
        at.into_iter().map(|t| piece.at(t).0)
    })
}

/// ∫ |s − s_p| dA, s being one coordinate and s_p halving the area.
fn plastic_modulus(pieces: &[Piece], axis: usize, area: f64) -> f64 {
    let [low, high] = extent(pieces, axis);
    let above = |s: f64| integrate_above(pieces, axis, s, |_| 1.0);
    let halving = low
        + (high - low) * bisect([0.0, 1.0], |part| above(low + (high - low) * part) - 0.5 * area);
    let over = integrate_above(pieces, axis, halving, |s| s - halving);
    let all = integrate_above(pieces, axis, low - 1.0, |s| s - halving);
    2.0 * over - all
}

/// ∬ g(s) dA over the part where the coordinate s exceeds a limit.
///
/// With the other coordinate o, ∬ g dA = ± ∮ o g ds; pieces are split where they pass the limit.
fn integrate_above(pieces: &[Piece], axis: usize, limit: f64, g: impl Fn(f64) -> f64) -> f64 {
    let sign = if axis == 1 { 1.0 } else { -1.0 };
    let form = |p: Point2<f64>, d: Vector2<f64>| sign * p[1 - axis] * g(p[axis]) * d[axis];
    let mut sum = 0.0;
    for piece in pieces {
        let mut cuts = vec![0.0];
        cuts.extend(piece.roots(|p, _| p[axis] - limit));
        cuts.push(1.0);
        for part in cuts.windows(2) {
            if piece.at(0.5 * (part[0] + part[1])).0[axis] > limit {
                sum += piece.integrate([part[0], part[1]], form);
            }
        }
    }
    // The cut along the limit closes the part; it runs across and adds nothing since ds = 0.
    sum
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::super::Shape;
    use super::*;

    fn moduli(shape: &Shape) -> Moduli {
        Moduli::of(&shape.region().pieces())
    }

    #[track_caller]
    fn near(value: f64, exact: f64) {
        assert!((value / exact - 1.0).abs() < 1e-9, "{value}, exact {exact}");
    }

    /// Gere and Goodno, Mechanics of Materials: Z = b h² / 4, S = b h² / 6; Z = d³ / 6,
    /// S = π d³ / 32; tube Z = (D³ − d³) / 6.
    #[test]
    fn solid_shapes_have_the_textbook_moduli() {
        let bar = moduli(&Shape::Rectangle { b: 10.0, h: 20.0 });
        near(bar.w_pl_y, 1000.0);
        near(bar.w_el_y, 4000.0 / 6.0);
        near(bar.w_pl_z, 500.0);
        let round = moduli(&Shape::Round { d: 12.0 });
        near(round.w_pl_y, 288.0);
        near(round.w_el_z, PI * 54.0);
        near(moduli(&Shape::Tube { d: 12.0, t: 1.0 }).w_pl_z, (1728.0 - 1000.0) / 6.0);
    }

    /// ArcelorMittal, Sections and Merchant Bars: IPE 200 has W_el,y 194.3, W_pl,y 220.6,
    /// W_el,z 28.47, W_pl,z 44.61 cm³.
    #[test]
    fn ipe_200_has_the_tabulated_moduli() {
        let m = moduli(&Shape::I { h: 200.0, b: 100.0, t_w: 5.6, t_f: 8.5, r: 12.0 });
        for (value, published) in
            [(m.w_el_y, 194.3), (m.w_pl_y, 220.6), (m.w_el_z, 28.47), (m.w_pl_z, 44.61)]
        {
            assert!((value / 1e3 / published - 1.0).abs() < 0.001, "{value}");
        }
    }

    #[test]
    fn reach_of_an_ellipse_is_its_longer_half_axis() {
        let pieces = Shape::Ellipse { b: 6.0, h: 10.0 }.region().pieces();
        near(reach(&pieces, Point2::origin()), 5.0);
        near(extent(&pieces, 0)[1], 3.0);
    }
}
