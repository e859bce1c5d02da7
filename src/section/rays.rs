//! Rays from a point through a region: where they are in the material.

use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use super::contours::sides;

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
        .filter_map(|(p, q)| crossing(&(p - centre), &(q - centre), &direction))
        .collect();
    found.sort_by(f64::total_cmp);
    found
}

/// Where a ray from the origin crosses the side `p q`.
fn crossing(p: &Vector2<f64>, q: &Vector2<f64>, direction: &Vector2<f64>) -> Option<f64> {
    let (hp, hq) = (direction.perp(p), direction.perp(q));
    if (hp >= 0.0) == (hq >= 0.0) {
        return None;
    }
    let t = hp / (hp - hq);
    let r = direction.dot(&(p + (q - p) * t));
    (r > 0.0).then_some(r)
}

/// Evenly spaced rays from one point.
pub(crate) struct Rays {
    turn: f64,
    directions: Vec<Vector2<f64>>,
}

/// A corner of a polygon: from the centre of the rays, and its place among them.
type Corner = (Vector2<f64>, f64);

impl Rays {
    /// `count` rays, the first along the first coordinate turned by `turn`.
    pub(crate) fn new(turn: f64, count: usize) -> Self {
        let direction = |i: usize| {
            let (sin, cos) = (turn + TAU * i as f64 / count as f64).sin_cos();
            Vector2::new(cos, sin)
        };
        Self { turn, directions: (0..count).map(direction).collect() }
    }

    /// Their unit vectors.
    pub(crate) fn directions(&self) -> &[Vector2<f64>] {
        &self.directions
    }

    /// Casts them from `centre` through the region between polygons.
    pub(crate) fn cast<'p>(
        &self,
        polygons: impl IntoIterator<Item = &'p Vec<Point2<f64>>>,
        centre: Point2<f64>,
    ) -> Fan {
        // Most rays cross a region once.
        let mut all: Vec<Vec<f64>> =
            self.directions.iter().map(|_| Vec::with_capacity(1)).collect();
        for polygon in polygons {
            let corners: Vec<Corner> = polygon.iter().map(|p| self.corner(p - centre)).collect();
            for (p, q) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                for i in self.near(p, q) {
                    all[i].extend(crossing(&p.0, &q.0, &self.directions[i]));
                }
            }
        }
        all.iter_mut().for_each(|found| found.sort_by(f64::total_cmp));
        Fan(all)
    }

    fn corner(&self, at: Vector2<f64>) -> Corner {
        (at, (at.y.atan2(at.x) - self.turn) / TAU * self.directions.len() as f64)
    }

    /// The rays that may cross a side: those between its ends, and one more on either side for
    /// rounding.
    fn near(&self, &(_, from): &Corner, &(_, to): &Corner) -> impl Iterator<Item = usize> + use<> {
        let count = self.directions.len();
        let n = count as f64;
        // The side is seen the shorter way round.
        let span = to - from - ((to - from) / n).round() * n;
        let first = from.min(from + span).floor() - 1.0;
        let rays = span.abs().ceil() + 4.0;
        // One that passes the centre closely may be seen either way round.
        let is_clear = span.abs() < 0.5 * n - 2.0 && rays < n;
        let (first, rays) =
            if is_clear { (first.rem_euclid(n), rays as usize) } else { (0.0, count) };
        (0..rays).map(move |i| (first as usize + i) % count)
    }
}

/// What evenly spaced rays see of a region: the crossings of each ray, ascending.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fan(Vec<Vec<f64>>);

impl Fan {
    /// Rays of the fan.
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// The crossings of each ray.
    pub(crate) fn rays(&self) -> &[Vec<f64>] {
        &self.0
    }

    /// Area that belongs to one of two regions only, ½ Σ ∫ |1_a − 1_b| d(r²) Δθ, mm².
    ///
    /// * `shift`: rays by which `other` is turned counter-clockwise.
    pub(crate) fn difference(&self, other: &Self, shift: usize) -> f64 {
        let n = self.len();
        let sum: f64 =
            (0..n).map(|i| ray_difference(&self.0[i], &other.0[(i + n - shift % n) % n])).sum();
        0.5 * sum * TAU / n as f64
    }
}

/// ∫ |1_a − 1_b| d(r²) along one ray.
///
/// The crossings of both, ascending, toggle whether the ray is in one region only. The centre of a
/// hollow region is outside; the count of crossings tells.
fn ray_difference(a: &[f64], b: &[f64]) -> f64 {
    let mut one_only = !(a.len() + b.len()).is_multiple_of(2);
    let (mut sum, mut from) = (0.0, 0.0);
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        let r = if j == b.len() || (i < a.len() && a[i] <= b[j]) {
            i += 1;
            a[i - 1]
        } else {
            j += 1;
            b[j - 1]
        };
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
    use crate::section::contours::Contours;
    use crate::section::outline::{Outline, Region};

    fn circle(radius: f64) -> Contours {
        Contours::of_region(&Region::solid(Outline::circle(radius)), 90)
    }

    #[test]
    fn circles_differ_by_the_ring_between_them() {
        let rays = Rays::new(0.0, 90);
        let [a, b] = [2.0, 3.0].map(|r| rays.cast(circle(r).polygons(), Point2::origin()));
        assert!((a.difference(&b, 0) - 5.0 * PI).abs() < 0.01);
        assert!(a.difference(&a, 7) < 0.01);
    }

    #[test]
    fn tube_differs_from_its_bar_by_the_bore() {
        let rays = Rays::new(0.0, 90);
        let tube = Contours { outer: circle(3.0).outer, holes: vec![circle(2.0).outer] };
        let tube = rays.cast(tube.polygons(), Point2::origin());
        let bar = rays.cast(circle(3.0).polygons(), Point2::origin());
        assert!((tube.difference(&bar, 0) - 4.0 * PI).abs() < 0.01);
    }

    #[test]
    fn fan_finds_what_each_ray_finds_alone() {
        // A star far off the centre of the fan, one round it, and one whose side runs through it.
        let star = |centre: Point2<f64>, size: f64| -> Vec<Point2<f64>> {
            let corner = |i: usize| size * if i.is_multiple_of(2) { 1.0 } else { 0.3 };
            let rays = Rays::new(0.2, 14);
            let at = rays.directions().iter().enumerate();
            at.map(|(i, direction)| centre + direction * corner(i)).collect()
        };
        let origin = Point2::origin();
        let square = [(-2.0, 0.0), (3.0, 0.0), (3.0, 4.0), (-2.0, 4.0)];
        let square = square.map(|(x, y)| Point2::new(x, y)).to_vec();
        for polygon in [star(origin, 5.0), star(Point2::new(7.0, -3.0), 4.0), square] {
            for (turn, count) in [(0.0, 7), (-2.9, 192), (11.0, 360)] {
                let rays = Rays::new(turn, count);
                let fan = rays.cast([&polygon], origin);
                for (found, direction) in fan.rays().iter().zip(rays.directions()) {
                    assert_eq!(*found, crossings(&polygon, origin, *direction), "{turn} {count}");
                }
            }
        }
    }

    #[test]
    fn ray_through_a_corner_crosses_once() {
        let diamond = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
        let diamond = diamond.map(|(x, y)| Point2::new(x, y));
        assert_eq!(crossings(&diamond, Point2::origin(), Vector2::x()), [1.0]);
    }
}
