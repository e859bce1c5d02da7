//! Rays from a point through a region: where they are in the material.

use nalgebra::{Point2, Vector2};

use super::properties::{Contours, sides};

/// Distances, ascending, at which a ray from `centre` crosses a polygon.
///
/// A corner on the ray belongs to the side that ends to its left only, so that a ray through a
/// corner crosses once where the contour goes through and twice or never where it turns back.
pub(crate) fn crossings(
    polygon: &[Point2<f64>],
    centre: Point2<f64>,
    direction: Vector2<f64>,
) -> Vec<f64> {
    let mut found: Vec<f64> = sides(polygon)
        .filter_map(|(p, q)| {
            let (p, q) = (p - centre, q - centre);
            let (hp, hq) = (direction.perp(&p), direction.perp(&q));
            if (hp >= 0.0) == (hq >= 0.0) {
                return None;
            }
            let t = hp / (hp - hq);
            Some(direction.dot(&(p + (q - p) * t)))
        })
        .filter(|&r| r > 0.0)
        .collect();
    found.sort_by(f64::total_cmp);
    found
}

/// What a fan of evenly spaced rays sees of a region: the crossings of each ray, ascending.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fan(Vec<Vec<f64>>);

impl Fan {
    /// Casts `count` rays from `centre`, the first along the first coordinate turned by `turn`.
    pub(crate) fn cast(contours: &Contours, centre: Point2<f64>, turn: f64, count: usize) -> Self {
        Self(
            (0..count)
                .map(|i| {
                    let angle = turn + std::f64::consts::TAU * i as f64 / count as f64;
                    let direction = Vector2::new(angle.cos(), angle.sin());
                    let mut all: Vec<f64> = contours
                        .polygons()
                        .flat_map(|polygon| crossings(polygon, centre, direction))
                        .collect();
                    all.sort_by(f64::total_cmp);
                    all
                })
                .collect(),
        )
    }

    /// Rays of the fan.
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Area that belongs to one of two regions only, ½ Σ ∫ |1_a − 1_b| d(r²) Δθ, mm².
    ///
    /// * `shift`: rays by which `other` is turned counter-clockwise.
    pub(crate) fn difference(&self, other: &Self, shift: usize) -> f64 {
        let n = self.len();
        let sum: f64 =
            (0..n).map(|i| ray_difference(&self.0[i], &other.0[(i + n - shift % n) % n])).sum();
        0.5 * sum * std::f64::consts::TAU / n as f64
    }
}

/// ∫ |1_a − 1_b| d(r²) along one ray.
///
/// Both sets of crossings together, sorted, toggle whether the ray is in one region only. The
/// centre of a hollow region is outside; the count of crossings tells.
fn ray_difference(a: &[f64], b: &[f64]) -> f64 {
    let mut merged: Vec<f64> = a.iter().chain(b).copied().collect();
    merged.sort_by(f64::total_cmp);
    let mut one_only = !merged.len().is_multiple_of(2);
    let (mut sum, mut from) = (0.0, 0.0);
    for r in merged {
        if one_only {
            sum += r * r - from;
        }
        one_only = !one_only;
        from = r * r;
    }
    sum
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::section::outline::{Outline, Region};

    fn circle(radius: f64) -> Contours {
        Contours::of_region(&Region::solid(Outline::circle(radius)), 90)
    }

    #[test]
    fn circles_differ_by_the_ring_between_them() {
        let [a, b] = [2.0, 3.0].map(|r| Fan::cast(&circle(r), Point2::origin(), 0.0, 90));
        assert!((a.difference(&b, 0) - 5.0 * PI).abs() < 0.01);
        assert!(a.difference(&a, 7) < 0.01);
    }

    #[test]
    fn tube_differs_from_its_bar_by_the_bore() {
        let tube = Contours { outer: circle(3.0).outer, holes: vec![circle(2.0).outer] };
        let tube = Fan::cast(&tube, Point2::origin(), 0.0, 90);
        let bar = Fan::cast(&circle(3.0), Point2::origin(), 0.0, 90);
        assert!((tube.difference(&bar, 0) - 4.0 * PI).abs() < 0.01);
    }

    #[test]
    fn ray_through_a_corner_crosses_once() {
        let diamond = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
        let diamond = diamond.map(|(x, y)| Point2::new(x, y));
        assert_eq!(crossings(&diamond, Point2::origin(), Vector2::x()), [1.0]);
    }
}
