//! Rectangles whose corners the mesh has worn: how much larger they were.
//!
//! ```text
//!     ╭───────────╮ ┄ flat side       A mesh cannot follow a sharp corner. What it cuts off makes
//!     │           │                   the area of the contour too small and its second moments
//!     │     ●     │ h                 more so; the flat sides stay where they were. The rectangle
//!     │           │                   has the distances between them as its sizes, as calipers
//!     ╰───────────╯                   would read them.
//!           b
//! ```
//!
//! Only the *ratio* of these sizes to those that match the moments of the same contour is taken
//! from it. The sizes of a beam then follow its own moments, also where it is a mean of several
//! beams, or the end of a taper that grows in one direction only.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Point2, Rotation2};

use super::fit::rectangle;
use crate::section::contours::{Contours, sides};

/// Largest angle between a piece of contour and the side it counts for, rad: 10°. An averaged
/// contour of a voxel part waves by 3 to 5° about a flat side; a circle has a sixth of its width
/// within 10°.
const ALONG: f64 = 0.17;

/// Least part of its side that is flat. A bar 6 mm wide whose corners are round by 1.5 mm has 0.5
/// and a little; a circle 0.17 and the long side of an ellipse of 1 to 2 has 0.33.
const LEAST_FLAT: f64 = 0.4;

/// Largest part of the rectangle that its corners lack. A square bar of 6 mm meshed at 1 mm lacks
/// 3 to 5 %; one whose corners are round by a quarter of its width 5.4 %, by a third 9.5 %: that
/// is a shape of its own, and a sharp bar would be much heavier.
const MOST_LACKING: f64 = 0.06;

/// Lengths between the flat sides of a worn rectangle over the b and h that match its moments,
/// the smaller size first; `None` if the contour is no such rectangle.
pub(crate) fn worn(contour: &[Point2<f64>]) -> Option<[f64; 2]> {
    let turn = turn_of_sides(contour);
    let upright = Contours::solid(contour.to_vec()).moved(-turn, nalgebra::zero());
    let moments = upright.moments().ok()?.central();
    let (flat_b, flat_h) = (between(&upright.outer, 0)?, between(&upright.outer, 1)?);
    let [b, h] = [flat_b.distance, flat_h.distance];
    let lacking = 1.0 - moments.area / (b * h);
    // A side across b runs along h.
    let is_flat = flat_b.least_flat >= LEAST_FLAT * h && flat_h.least_flat >= LEAST_FLAT * b;
    if !is_flat || !(0.0..=MOST_LACKING).contains(&lacking) {
        return None;
    }
    let [own_b, own_h] = rectangle(moments.i_xx, moments.i_yy);
    let [of_b, of_h] = [b / own_b, h / own_h];
    Some(if own_b <= own_h { [of_b, of_h] } else { [of_h, of_b] })
}

/// The angle mod 90° that the pieces of a contour keep to, by their lengths.
fn turn_of_sides(polygon: &[Point2<f64>]) -> f64 {
    let (mut sin, mut cos) = (0.0, 0.0);
    for (p, q) in sides(polygon) {
        let d = q - p;
        let four = 4.0 * d.y.atan2(d.x);
        sin += d.norm() * four.sin();
        cos += d.norm() * four.cos();
    }
    sin.atan2(cos) / 4.0
}

/// Two flat sides that face each other.
struct Between {
    distance: f64,
    /// Length of contour along the side that has less of it.
    least_flat: f64,
}

/// The flat sides square to a coordinate axis; `None` where a contour has none.
fn between(polygon: &[Point2<f64>], axis: usize) -> Option<Between> {
    // Outward normals along the positive and the negative axis.
    let mut flats = [Vec::new(), Vec::new()];
    let orientation = crate::section::contours::signed_area(polygon).signum();
    for (p, q) in sides(polygon) {
        let outward = Rotation2::new(-orientation * FRAC_PI_2) * (q - p);
        let length = outward.norm();
        if length > 0.0 && outward[axis].abs() >= ALONG.cos() * length {
            let place = 0.5 * (p[axis] + q[axis]);
            flats[usize::from(outward[axis] < 0.0)].push((place, length));
        }
    }
    let [high, low] = flats.map(middle);
    let ((high, long_high), (low, long_low)) = (high?, low?);
    Some(Between { distance: high - low, least_flat: f64::min(long_high, long_low) })
}

/// The mean of the middle half of weighted places, and the sum of the weights: what lies about a
/// corner falls out, and what waves about the side evens out.
fn middle(mut places: Vec<(f64, f64)>) -> Option<(f64, f64)> {
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = places.iter().map(|p| p.1).sum();
    let (from, to) = (0.25 * total, 0.75 * total);
    let (mut behind, mut sum) = (0.0, 0.0);
    for (place, weight) in places {
        let inside = f64::min(behind + weight, to) - f64::max(behind, from);
        sum += place * inside.max(0.0);
        behind += weight;
    }
    (total > 0.0).then(|| (sum / (to - from), total))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use nalgebra::Vector2;

    use super::super::fit::fitted;
    use super::super::{MatchMode, MatchTarget, ProfileChoice};
    use super::*;
    use crate::section::Shape;

    /// A rectangle with round corners, its sides parted into pieces.
    fn rounded(b: f64, h: f64, r: f64) -> Vec<Point2<f64>> {
        let mut points = Vec::new();
        for (k, (x, y)) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].iter().enumerate() {
            let centre = Point2::new(x * (0.5 * b - r), y * (0.5 * h - r));
            for i in 0..=12 {
                let angle = FRAC_PI_2 * (k as f64 + f64::from(i) / 12.0);
                points.push(centre + Vector2::new(angle.cos(), angle.sin()) * r);
            }
        }
        points
    }

    fn target(outer: Vec<Point2<f64>>) -> MatchTarget {
        let contours = Contours::solid(outer).moved(0.7, Vector2::new(3.0, -2.0));
        MatchTarget::of_contours(contours).unwrap()
    }

    fn sizes(target: &MatchTarget, mode: MatchMode) -> [f64; 2] {
        match fitted(&ProfileChoice::Rectangle, target, mode).unwrap() {
            Shape::Rectangle { b, h } => [b, h],
            other => panic!("{other}"),
        }
    }

    #[test]
    fn worn_corners_leave_the_sides_where_they_are() {
        for (b, h, r) in [(6.0, 12.0, 1.0), (6.0, 12.0, 1.6), (10.0, 10.0, 2.5), (8.0, 40.0, 2.0)] {
            let [found_b, found_h] = sizes(&target(rounded(b, h, r)), MatchMode::Stiffness);
            assert!((found_b / b - 1.0).abs() < 0.003, "{b} x {h}, {r}: {found_b}");
            assert!((found_h / h - 1.0).abs() < 0.003, "{b} x {h}, {r}: {found_h}");
        }
    }

    #[test]
    fn corners_that_are_a_shape_of_their_own_stay() {
        let no_side = rounded(6.0, 24.0, 3.0); // a flat bar with round edges
        for outer in [rounded(10.0, 10.0, 3.4), no_side, rounded(10.0, 10.0, 5.0)] {
            let own = target(outer);
            let [b, h] = sizes(&own, MatchMode::Stiffness);
            assert!((b * h.powi(3) / 12.0 / own.i_1 - 1.0).abs() < 1e-9);
            assert!((h * b.powi(3) / 12.0 / own.i_2 - 1.0).abs() < 1e-9);
        }
        for (b, h) in [(8.0, 15.0), (8.0, 40.0), (8.0, 8.5)] {
            let ellipse = Contours::of_region(&Shape::Ellipse { b, h }.region(), 24);
            assert_eq!(worn(&ellipse.outer), None);
        }
    }

    #[test]
    fn area_and_strength_are_kept_where_they_are_asked_for() {
        let own = target(rounded(6.0, 12.0, 1.4));
        let [b, h] = sizes(&own, MatchMode::Area);
        assert!((b * h / own.area - 1.0).abs() < 1e-12 && (h / b - 2.0).abs() < 0.01);
        let [b, h] = sizes(&own, MatchMode::NotWeaker);
        let least = (b * h / own.area).min(b * h.powi(3) / 12.0 / own.i_1);
        assert!(least.min(h * b.powi(3) / 12.0 / own.i_2) >= 1.0 - 1e-9);
    }

    #[test]
    fn a_contour_turned_and_run_the_other_way_grows_alike() {
        let outer = rounded(7.0, 11.0, 1.3);
        let there = worn(&outer).unwrap();
        let mut back = outer;
        back.reverse();
        for angle in [0.3, 1.2, FRAC_PI_2, 2.5, PI] {
            let turned = Contours::solid(back.clone()).moved(angle, Vector2::new(5.0, 1.0));
            let found = worn(&turned.outer).unwrap();
            assert!((found[0] - there[0]).abs() < 1e-9 && (found[1] - there[1]).abs() < 1e-9);
        }
    }
}
