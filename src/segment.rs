//! Straight lines between points, in the plane or in space.

use nalgebra::{Point, SVector};

/// Part 0..1 of the way from `a` to `b` that is next to `p`; 0 where the ends coincide.
pub(crate) fn part<const D: usize>(p: &Point<f64, D>, a: &Point<f64, D>, b: &Point<f64, D>) -> f64 {
    let along = b - a;
    let squared = along.norm_squared();
    if squared > 0.0 { ((p - a).dot(&along) / squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// From `p` to the nearest place between `a` and `b`.
pub(crate) fn offset<const D: usize>(
    p: &Point<f64, D>,
    a: &Point<f64, D>,
    b: &Point<f64, D>,
) -> SVector<f64, D> {
    a + (b - a) * part(p, a, b) - p
}

/// Distance of `p` from the nearest place between `a` and `b`.
pub(crate) fn distance<const D: usize>(
    p: &Point<f64, D>,
    a: &Point<f64, D>,
    b: &Point<f64, D>,
) -> f64 {
    offset(p, a, b).norm()
}

/// Adds the points a chain bends at between two of its points, and the latter of these: no point is
/// farther than a tolerance from the straight line between two that are kept (Ramer; Douglas and
/// Peucker).
pub(crate) fn bends<const D: usize>(
    chain: &[Point<f64, D>],
    from: usize,
    to: usize,
    tolerance: f64,
    kept: &mut Vec<usize>,
) {
    let farthest = (from + 1..to)
        .map(|i| (i, distance(&chain[i], &chain[from], &chain[to])))
        .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
    match farthest {
        Some((i, distance)) if distance > tolerance => {
            bends(chain, from, i, tolerance, kept);
            bends(chain, i, to, tolerance, kept);
        }
        _ => kept.push(to),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point2, Point3, Vector2};

    #[test]
    fn distance_is_that_to_the_nearer_end_or_to_the_line() {
        let [a, b] = [Point3::origin(), Point3::new(10.0, 0.0, 0.0)];
        assert_eq!(distance(&Point3::new(5.0, 3.0, 4.0), &a, &b), 5.0);
        assert_eq!(distance(&Point3::new(-3.0, 0.0, 4.0), &a, &b), 5.0);
        assert_eq!(distance(&Point3::new(13.0, -4.0, 0.0), &a, &b), 5.0);
    }

    #[test]
    fn a_chain_keeps_the_points_it_bends_at() {
        let chain = [[0.0, 0.0], [1.0, 0.1], [2.0, 0.0], [2.1, 1.0], [2.0, 2.0]];
        let chain = chain.map(|[x, y]| Point2::new(x, y));
        let mut kept = vec![0];
        bends(&chain, 0, 4, 0.2, &mut kept);
        assert_eq!(kept, [0, 2, 4]);
    }

    #[test]
    fn ends_that_coincide_are_a_point() {
        let a = Point2::new(1.0, 1.0);
        assert_eq!(offset(&Point2::new(4.0, 5.0), &a, &a), Vector2::new(-3.0, -4.0));
    }
}
