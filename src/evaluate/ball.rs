//! The bounding sphere of the shape, of which eq. (2.2) takes the radius.
//!
//! The smallest ball about a set of points is that of at most four of them. They are found by
//! Welzl's recursion with the move to the front; it only sees the points that were farthest out in
//! an earlier round, a few dozen even of a million.
//!
//! # References
//!
//! * Welzl: *Smallest enclosing disks (balls and ellipsoids)*, LNCS 555 (1991).
//! * Gärtner: *Fast and robust smallest enclosing balls*, LNCS 1643 (1999): pivots, and the rule
//!   which points of the support are left out.

use nalgebra::{Point3, Vector3};

/// A point outside by less than this part of the radius counts as inside.
const TOLERANCE: f64 = 1e-12;

/// A point nearer to the hull of the support than this part of its distance adds nothing to it:
/// four points of one circle, rounded, would else give any ball through the circle.
const FLAT: f64 = 1e-9;

/// Rounds after which the ball is taken as it is; some twenty are needed.
const ROUNDS: usize = 1000;

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its centre, mm.
    pub centre: Point3<f64>,
    /// Its radius, mm; negative for the ball that holds nothing.
    pub radius: f64,
}

impl Ball {
    const NOTHING: Self = Self { centre: Point3::new(0.0, 0.0, 0.0), radius: -1.0 };

    /// The smallest ball that holds all points; radius 0 without any.
    ///
    /// # Examples
    /// ```
    /// # use beamwright::evaluate::Ball;
    /// # use nalgebra::Point3;
    /// let obtuse = [[0., 0., 0.], [4., 0., 0.], [2., 1., 0.]].map(Point3::from);
    /// let ball = Ball::smallest(&obtuse); // the third point does not count
    /// assert_eq!((ball.centre, ball.radius), (Point3::new(2., 0., 0.), 2.));
    /// ```
    pub fn smallest(points: &[Point3<f64>]) -> Self {
        let Some(&first) = points.first() else { return Self { radius: 0.0, ..Self::NOTHING } };
        let mut ball = Self { centre: first, radius: 0.0 };
        let mut outermost = vec![first];
        for _ in 0..ROUNDS {
            let farthest = ball.farthest(points);
            if ball.holds(&farthest) {
                break;
            }
            outermost.insert(0, farthest);
            let all = outermost.len();
            let grown = smallest_with(&mut outermost, all, &mut Vec::new());
            if grown.radius <= ball.radius {
                break;
            }
            ball = grown;
        }
        ball
    }

    /// The ball about the centre of the bounding box.
    pub fn box_centred(points: &[Point3<f64>]) -> Self {
        let Some(&first) = points.first() else { return Self { radius: 0.0, ..Self::NOTHING } };
        let (low, high) = points.iter().fold((first, first), |(l, h), p| (l.inf(p), h.sup(p)));
        let ball = Self { centre: nalgebra::center(&low, &high), radius: 0.0 };
        Self { radius: (ball.farthest(points) - ball.centre).norm(), ..ball }
    }

    fn farthest(&self, points: &[Point3<f64>]) -> Point3<f64> {
        let squared = |p: &Point3<f64>| (p - self.centre).norm_squared();
        points.iter().fold(points[0], |f, p| if squared(p) > squared(&f) { *p } else { f })
    }

    fn holds(&self, p: &Point3<f64>) -> bool {
        (p - self.centre).norm() <= self.radius * (1.0 + TOLERANCE)
    }

    /// The smallest ball with all points of `support` on it; `None` when one of them adds nothing.
    ///
    /// Point by point the centre moves at right angles to the hull of the points before, by t with
    /// |p − c|² = r² + 2 t z, where z is the distance of p from the hull.
    fn through(support: &[Point3<f64>]) -> Option<Self> {
        let Some((&first, others)) = support.split_first() else { return Some(Self::NOTHING) };
        let (mut centre, mut squared) = (first, 0.0);
        let mut hull: Vec<Vector3<f64>> = Vec::with_capacity(3);
        for p in others {
            let mut out = p - first;
            let length = out.norm();
            hull.iter().for_each(|e| out -= e * e.dot(&out));
            let z = out.norm();
            if z <= FLAT * length {
                return None;
            }
            let t = ((p - centre).norm_squared() - squared) / (2.0 * z);
            centre += out * (t / z);
            squared += t * t;
            hull.push(out / z);
        }
        Some(Self { centre, radius: squared.sqrt() })
    }
}

/// The smallest ball that holds the first `count` points and has all of `support` on it.
fn smallest_with(points: &mut [Point3<f64>], count: usize, support: &mut Vec<Point3<f64>>) -> Ball {
    let mut ball = Ball::through(support).unwrap_or(Ball::NOTHING);
    if support.len() == 4 {
        return ball;
    }
    for i in 0..count {
        let p = points[i];
        if ball.holds(&p) {
            continue;
        }
        support.push(p);
        if Ball::through(support).is_some() {
            ball = smallest_with(points, i, support);
            points[..=i].rotate_right(1);
        }
        support.pop();
    }
    ball
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_of_a_cube_lie_on_their_ball() {
        let corners: Vec<Point3<f64>> = (0..8)
            .map(|k| Point3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2 & 1) as f64))
            .collect();
        for ball in [Ball::smallest(&corners), Ball::box_centred(&corners)] {
            assert!((ball.centre - Point3::new(0.5, 0.5, 0.5)).norm() < 1e-12);
            assert!((ball.radius - 0.75f64.sqrt()).abs() < 1e-12);
        }
    }

    #[test]
    fn a_regular_triangle_has_a_smaller_ball_than_that_of_its_box() {
        let points = [[0., 0., 0.], [1., 0., 0.], [0.5, 0.75f64.sqrt(), 0.]].map(Point3::from);
        assert!((Ball::smallest(&points).radius - 1.0 / 3f64.sqrt()).abs() < 1e-12);
        assert!(Ball::box_centred(&points).radius > 0.66);
    }

    #[test]
    fn points_on_one_circle_have_the_ball_of_the_circle() {
        let points: Vec<Point3<f64>> = (0..1000)
            .map(|k| f64::from(k).sin_cos())
            .map(|(s, c)| Point3::new(1e3 + 5.0 * c, 5.0 * s, 2.0))
            .collect();
        let ball = Ball::smallest(&points);
        assert!((ball.radius - 5.0).abs() < 1e-4 && ball.radius <= 5.0 + 1e-9, "{ball:?}");
    }

    #[test]
    fn no_point_and_one_point_have_a_ball_of_radius_0() {
        assert_eq!(Ball::smallest(&[]).radius, 0.0);
        let p = Point3::new(1.0, 2.0, 3.0);
        assert_eq!(Ball::smallest(&[p, p]), Ball { centre: p, radius: 0.0 });
    }
}
