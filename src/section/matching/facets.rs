//! Round bars that a CAD program meshed with flat facets, all alike: how much thicker they were.
//!
//! ```text
//!        ╭┄┄●┄┄╮       Such a mesh has its corners ● on the true surface and its facets inside
//!      ●╱───────╲●     of it. Cut across, it is a regular polygon, or an ellipse's, stretched in
//!     ┊│    +    │┊    one direction. With 12 sides it has 4.5 % less area than the bar and 9 %
//!      ●╲───────╱●     less stiffness. Meshes of volume data are no regular polygons: their
//!        ╰┄┄●┄┄╯       corners lie on both sides of the surface, and nothing is added to them.
//! ```

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix2, Point2};

use crate::section::contours::{Contours, sides};

/// Fewest and most sides. A bar of six sides is meant so, while one of seven is no product; 48
/// facets take 0.3 % off the area, and nobody needs that back.
const SIDES: [usize; 2] = [7, 48];

/// Largest departure of a corner from the mean radius, and of the turn at a corner from the mean
/// turn, as parts of them. A tessellated bar keeps to a thousandth; the circle that marching
/// cubes lay through a grid of a third of its radius is off by half of the mean turn.
const UNEVEN: [f64; 2] = [0.01, 0.1];

/// Part of the radius within which points are one: a third of the shortest side or less.
const SAME_POINT: f64 = 0.04;

/// Turn at a point in the middle of a facet as a part of the least turn at a corner.
const STRAIGHT: f64 = 0.25;

/// Number of sides of a contour that is a regular polygon, stretched in one direction or not.
pub(crate) fn facets(contour: &[Point2<f64>]) -> Option<u32> {
    let round = unstretched(contour)?;
    let radius = |p: &Point2<f64>| p.coords.norm();
    let mean = round.iter().map(radius).sum::<f64>() / round.len() as f64;
    let mut corners = apart(&round, SAME_POINT * mean);
    let least = STRAIGHT * TAU / SIDES[1] as f64;
    let turns = turns_at(&corners);
    let mut is_corner = turns.iter().map(|turn| turn.abs() > least);
    corners.retain(|_| is_corner.next() == Some(true));
    let n = corners.len();
    if !(SIDES[0]..=SIDES[1]).contains(&n) {
        return None;
    }
    let turn = TAU / n as f64;
    let mean = corners.iter().map(radius).sum::<f64>() / n as f64;
    let is_even = corners.iter().all(|p| (radius(p) - mean).abs() <= UNEVEN[0] * mean)
        && turns_at(&corners).iter().all(|t| (t - turn).abs() <= UNEVEN[1] * turn);
    is_even.then_some(n as u32)
}

/// Diameter of the circle through the corners of a regular polygon over that of the circle with
/// its second moment n R⁴ sin φ (2 + cos φ)/24, φ = 2π/n.
pub(super) fn growth(facets: u32) -> f64 {
    let n = f64::from(facets);
    let (sin, cos) = (TAU / n).sin_cos();
    let moment = n * sin * (2.0 + cos) / 24.0;
    (PI / (4.0 * moment)).powf(0.25)
}

/// The contour about its centroid, counter-clockwise, stretched to equal moments in all directions.
fn unstretched(contour: &[Point2<f64>]) -> Option<Vec<Point2<f64>>> {
    let whole = Contours::solid(contour.to_vec()).moments().ok()?;
    let (centroid, m) = (whole.centroid(), whole.central());
    let spread = Matrix2::new(m.i_yy, m.i_xy, m.i_xy, m.i_xx) / m.area;
    let inverse = spread.cholesky()?.l().try_inverse()?;
    let mut round: Vec<Point2<f64>> =
        contour.iter().map(|p| Point2::from(inverse * (p - centroid))).collect();
    if crate::section::contours::signed_area(&round) < 0.0 {
        round.reverse();
    }
    Some(round)
}

/// The points without those that are next to one farther out.
fn apart(points: &[Point2<f64>], same: f64) -> Vec<Point2<f64>> {
    let radius = |p: &Point2<f64>| p.coords.norm();
    let mut kept: Vec<Point2<f64>> = Vec::with_capacity(points.len());
    // From the farthest point on, so that where the list begins makes no difference.
    let farthest =
        (0..points.len()).max_by(|&a, &b| radius(&points[a]).total_cmp(&radius(&points[b])));
    for p in points.iter().cycle().skip(farthest.unwrap_or(0)).take(points.len()) {
        match kept.last_mut() {
            Some(last) if (p - *last).norm() < same => {
                if radius(p) > radius(last) {
                    *last = *p;
                }
            }
            _ => kept.push(*p),
        }
    }
    if kept.len() > 1 && (kept[kept.len() - 1] - kept[0]).norm() < same {
        kept.pop();
    }
    kept
}

/// The turn at every corner of a polygon, rad.
fn turns_at(polygon: &[Point2<f64>]) -> Vec<f64> {
    let along: Vec<_> = sides(polygon).map(|(p, q)| q - p).collect();
    (0..along.len())
        .map(|i| {
            let (before, after) = (along[(i + along.len() - 1) % along.len()], along[i]);
            before.perp(&after).atan2(before.dot(&after))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::super::fit::fitted;
    use super::super::{MatchMode, MatchTarget, ProfileChoice};
    use super::*;
    use crate::section::Shape;

    /// A polygon with its corners on an ellipse and points on its sides, as a cut through a
    /// tessellated bar has them.
    fn tessellated(b: f64, h: f64, n: usize) -> Vec<Point2<f64>> {
        let corner = |i: usize| {
            let (sin, cos) = (TAU * (i as f64 + 0.3) / n as f64).sin_cos();
            Point2::new(0.5 * b * cos, 0.5 * h * sin)
        };
        let side = |i: usize| {
            let (p, q) = (corner(i), corner(i + 1));
            let diagonal = (0.17 * i as f64).fract();
            [p, p + (q - p) * diagonal]
        };
        let turned = |p: Point2<f64>| nalgebra::Rotation2::new(0.4) * p + Vector2::new(7.0, -3.0);
        (0..n).flat_map(side).map(turned).collect()
    }

    #[test]
    fn tessellated_bars_have_the_circle_through_their_corners() {
        for n in [7, 8, 12, 16, 24, 48] {
            let contour = tessellated(10.0, 10.0, n);
            assert_eq!(facets(&contour), Some(n as u32));
            let target = MatchTarget::of_contours(Contours::solid(contour)).unwrap();
            let found = fitted(&ProfileChoice::Round, &target, MatchMode::Stiffness).unwrap();
            let Shape::Round { d } = found else { panic!("{found}") };
            assert!((d - 10.0).abs() < 1e-9, "{n} sides: {d}");
            let found = fitted(&ProfileChoice::Round, &target, MatchMode::Area).unwrap();
            let Shape::Round { d } = found else { panic!("{found}") };
            assert!((PI * d * d / 4.0 / target.area - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn tessellated_ellipses_have_the_ellipse_through_their_corners() {
        for n in [9, 12, 20] {
            let target =
                MatchTarget::of_contours(Contours::solid(tessellated(8.0, 15.0, n))).unwrap();
            let found = fitted(&ProfileChoice::Ellipse, &target, MatchMode::Stiffness).unwrap();
            let Shape::Ellipse { b, h } = found else { panic!("{found}") };
            assert!((b - 8.0).abs() < 1e-9 && (h - 15.0).abs() < 1e-9, "{n} sides: {b} x {h}");
        }
    }

    #[test]
    fn contours_through_a_grid_and_bars_of_six_sides_are_left_alone() {
        // Corners where the lines of a grid cross the circle, as marching cubes have them.
        for (radius, shift) in [(3.0, 0.0), (3.0, 0.37), (2.2, 0.5), (4.1, 0.21)] {
            let mut angles: Vec<f64> = Vec::new();
            for line in -5..=5 {
                let at = (f64::from(line) + shift) / radius;
                if at.abs() < 1.0 {
                    angles.extend([at.acos(), -at.acos(), at.asin(), PI - at.asin()]);
                }
            }
            angles.iter_mut().for_each(|a| *a = a.rem_euclid(TAU));
            angles.sort_by(f64::total_cmp);
            let circle: Vec<Point2<f64>> =
                angles.iter().map(|a| Point2::new(radius * a.cos(), radius * a.sin())).collect();
            assert_eq!(facets(&circle), None, "radius {radius}, shift {shift}");
        }
        assert_eq!(facets(&tessellated(10.0, 10.0, 6)), None);
        assert_eq!(facets(&tessellated(10.0, 10.0, 4)), None);
    }
}
