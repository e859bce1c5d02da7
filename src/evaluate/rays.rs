//! The 36 rays of the criterion (thesis §4.4) and their 18 pairs.
//!
//! ```text
//!           C₂ ·──────· C₁            C    crossings, ordered by angle about their mean point
//!          ╱      θ  ╱ ╲              •    skeletal point
//!         ╱   ╲  │  ╱   ╲             the first ray goes to the first crossing, the others follow
//!     C₃ ·     ╲ │ ╱     · C₀         at 10°; their ends are interpolated by angle between the
//!         ╲     ╲│╱─────╱             two crossings on either side
//!          ╲     •     ╱
//!           ·─────────·               pair j: rays j and j + 18, which run opposite ways
//! ```
//!
//! Seen from a point outside, part of the contour is run through backwards (the convex slice of
//! figure 4.18). It is left out; rays that only it would stop have length 0.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector2;

/// Number of rays (thesis §4.4).
pub(super) const RAYS: usize = 36;

/// Number of pairs of opposite rays.
pub(super) const PAIRS: usize = RAYS / 2;

/// Angle between two rays.
const STEP: f64 = TAU / RAYS as f64;

/// A ray that misses a piece by less than this angle meets it: every tenth crossing of a circle of
/// 360 lies on a ray, and rounding must not let it slip between two pieces.
const SLACK: f64 = 1e-7;

/// Lengths below this part of the largest one are rounding.
const ROUNDING: f64 = 1e-9;

/// Length of each ray, mm.
pub(super) type Lengths = [f64; RAYS];

/// Crossings in the order of their angle about their mean point, begun at number `first`.
pub(super) fn ordered(crossings: &[Vector2<f64>], first: usize) -> Vec<Vector2<f64>> {
    let mean = crossings.iter().sum::<Vector2<f64>>() / crossings.len() as f64;
    let angle = |c: &Vector2<f64>| (c.y - mean.y).atan2(c.x - mean.x);
    let start = angle(&crossings[first]);
    let mut turned: Vec<(f64, Vector2<f64>)> =
        crossings.iter().map(|c| ((angle(c) - start).rem_euclid(TAU), *c)).collect();
    turned.sort_by(|a, b| a.0.total_cmp(&b.0));
    turned.into_iter().map(|t| t.1).collect()
}

/// A piece of the contour between two ordered crossings that is seen forwards from the origin.
struct Piece {
    from: Vector2<f64>,
    to: Vector2<f64>,
    /// Angle of `from`.
    start: f64,
    /// Angle by which `to` is farther.
    width: f64,
}

/// Lengths of the rays to a contour of ordered crossings, by interpolation in the angle.
///
/// # Examples
/// See the demonstration of §4.4.1 in the tests.
pub(super) fn polar(contour: &[Vector2<f64>]) -> Lengths {
    let mut lengths = [0.0; RAYS];
    let pieces = forward_pieces(contour);
    let Some(first) = pieces.first().map(|p| p.start) else { return lengths };
    let mut found = [false; RAYS];
    for piece in &pieces {
        let start = (piece.start - first).rem_euclid(TAU);
        let (from, to) = (start - SLACK, start + piece.width + SLACK);
        for j in (from / STEP).ceil() as i64..=(to / STEP).floor() as i64 {
            let ray = j.rem_euclid(RAYS as i64) as usize;
            if std::mem::replace(&mut found[ray], true) {
                continue;
            }
            let t = ((j as f64 * STEP - start) / piece.width).clamp(0.0, 1.0);
            lengths[ray] = (piece.from + (piece.to - piece.from) * t).norm();
        }
    }
    lengths
}

fn forward_pieces(contour: &[Vector2<f64>]) -> Vec<Piece> {
    let size = contour.iter().map(|c| c.norm()).fold(0.0, f64::max);
    let next = contour.iter().cycle().skip(1);
    contour
        .iter()
        .zip(next)
        .filter(|(c, d)| c.perp(d) > 0.0 && c.norm().min(d.norm()) > ROUNDING * size)
        .map(|(&from, &to)| Piece {
            from,
            to,
            start: from.y.atan2(from.x),
            width: from.perp(&to).atan2(from.dot(&to)),
        })
        .collect()
}

/// Which of several hits of a ray counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hit {
    /// The wall about a point inside.
    Nearest,
    /// The far wall, seen from a point outside: the rule of figure 4.18.
    Farthest,
}

/// The directions of the rays that are cast against the real section.
pub(super) fn directions() -> [Vector2<f64>; RAYS] {
    std::array::from_fn(|j| {
        let (s, c) = (j as f64 * STEP).sin_cos();
        Vector2::new(c, s)
    })
}

/// Lengths of rays from the origin to the polygons; 0 for a ray that hits none.
pub(super) fn cast<'a>(
    polygons: impl Iterator<Item = &'a [Vector2<f64>]>,
    directions: &[Vector2<f64>; RAYS],
    hit: Hit,
) -> Lengths {
    let none = if hit == Hit::Nearest { f64::INFINITY } else { 0.0 };
    let mut lengths = [none; RAYS];
    for polygon in polygons {
        let Some(mut a) = polygon.last().copied() else { continue };
        let mut start = a.y.atan2(a.x);
        for &b in polygon {
            let end = b.y.atan2(b.x);
            for j in rays_between(start, end) {
                let ray = j.rem_euclid(RAYS as i64) as usize;
                if let Some(t) = distance_along(&directions[ray], &a, &b) {
                    let length = &mut lengths[ray];
                    *length = if hit == Hit::Nearest { length.min(t) } else { length.max(t) };
                }
            }
            (a, start) = (b, end);
        }
    }
    lengths.map(|l| if l.is_finite() { l } else { 0.0 })
}

/// The rays that may meet a piece between two angles: all of them when it passes so close to the
/// origin that its side cannot be told.
fn rays_between(start: f64, end: f64) -> std::ops::RangeInclusive<i64> {
    let turn = (end - start + PI).rem_euclid(TAU) - PI;
    if PI - turn.abs() < 1e-6 {
        return 0..=RAYS as i64 - 1;
    }
    let (low, high) = (start.min(start + turn) - SLACK, start.max(start + turn) + SLACK);
    (low / STEP).ceil() as i64..=(high / STEP).floor() as i64
}

/// Where the ray from the origin meets the piece a b.
fn distance_along(direction: &Vector2<f64>, a: &Vector2<f64>, b: &Vector2<f64>) -> Option<f64> {
    let s = b - a;
    let across = direction.perp(&s);
    let t = a.perp(&s) / across;
    let u = a.perp(direction) / across;
    (t.is_finite() && t > 0.0 && (-ROUNDING..=1.0 + ROUNDING).contains(&u)).then_some(t)
}

/// Largest difference of the two rays of a pair, max |dⱼ − dⱼ₊₁₈|, mm.
pub(super) fn largest_difference(lengths: &Lengths) -> f64 {
    pairs(lengths).map(|(d, e)| (d - e).abs()).fold(0.0, f64::max)
}

/// The pairs of opposite rays.
pub(super) fn pairs(lengths: &Lengths) -> impl Iterator<Item = (f64, f64)> + '_ {
    (0..PAIRS).map(|j| (lengths[j], lengths[j + PAIRS]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit circle of figure 4.19, seen from (x, 0).
    fn circle_seen_from(x: f64) -> Vec<Vector2<f64>> {
        let crossing = |k: usize| (PI + k as f64 * TAU / 360.0).sin_cos();
        (0..360).map(crossing).map(|(s, c)| Vector2::new(c - x, s)).collect()
    }

    fn rays_above_0(lengths: &Lengths) -> usize {
        lengths.iter().filter(|l| **l > 1e-9).count()
    }

    #[test]
    fn the_demonstration_of_section_4_4_1_gives_1_2_and_3() {
        for (x, expected, rays) in [(0.5, 1.0, 36), (1.0, 2.0, 17), (2.0, 3.0, 7)] {
            let lengths = polar(&ordered(&circle_seen_from(x), 0));
            assert!((largest_difference(&lengths) - expected).abs() < 1e-6, "at {x}");
            assert_eq!(rays_above_0(&lengths), rays, "at {x}");
        }
    }

    #[test]
    fn rays_cast_against_the_circle_agree_with_the_demonstration() {
        for (x, hit, expected) in
            [(0.5, Hit::Nearest, 1.0), (1.0, Hit::Farthest, 2.0), (2.0, Hit::Farthest, 3.0)]
        {
            let circle = circle_seen_from(x);
            let lengths = cast([&circle[..]].into_iter(), &directions(), hit);
            assert!((largest_difference(&lengths) - expected).abs() < 1e-6, "at {x}");
        }
    }

    #[test]
    fn the_centre_of_a_circle_is_centred() {
        let lengths = polar(&ordered(&circle_seen_from(0.0), 17));
        assert!(largest_difference(&lengths) < 1e-3 && rays_above_0(&lengths) == RAYS);
    }

    #[test]
    fn order_is_by_angle_about_the_mean_point_whatever_the_order_given() {
        let circle = circle_seen_from(0.3);
        let shuffled: Vec<_> = (0..360).map(|k| circle[k * 77 % 360]).collect();
        assert_eq!(ordered(&shuffled, 0), ordered(&circle, 0));
    }

    #[test]
    fn a_ray_between_two_crossings_ends_on_their_chord() {
        let square: [Vector2<f64>; 4] =
            [[1., 1.], [-1., 1.], [-1., -1.], [1., -1.]].map(Vector2::from);
        let lengths = polar(&square);
        // Interpolation by angle: 40 of the 90 degrees, not where the ray meets the chord.
        let expected: f64 = Vector2::new(1.0f64 - 2.0 * 4.0 / 9.0, 1.0).norm();
        assert!((lengths[4] - expected).abs() < 1e-12);
    }
}
