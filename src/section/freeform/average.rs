//! The mean outline of several contours of one branch.
//!
//! 1. Each contour is centred on its own centroid; directions are those of the common frame.
//! 2. If every contour is seen from its centroid whole (each ray meets it once), the mean outline
//!    has in every direction the root mean square of the radii: its area is the mean area.
//!    Otherwise contours are paired by the part of the way around, from where the strong axis
//!    leaves them, and averaged point by point. If that mean crosses itself, as that of contours
//!    that fold in different places does, the farthest radii are taken after all.
//! 3. The outline is sampled at equal distances and stretched along its principal axes and turned
//!    such that the spline through the samples has the mean area, the mean principal direction and
//!    the mean ratio of I_1 to I_2.

use std::f64::consts::PI;

use nalgebra::{Matrix2, Point2, Rotation2, Vector2};

use super::Freeform;
use crate::section::contours::{Contours, sides, signed_area};
use crate::section::error::SectionError;
use crate::section::moments::Moments;
use crate::section::outline::Outline;
use crate::section::rays::{Fan, Rays, crossings};

/// Why contours have no mean outline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AverageError {
    /// There are no contours.
    #[error("no contours to average")]
    NoContours,

    /// Too few points were asked for.
    #[error("a mean outline needs at least {least} points, but {asked} were asked for", least = FEWEST_POINTS)]
    TooFewPoints {
        /// Points asked for.
        asked: usize,
    },

    /// A contour is not a region.
    #[error("contour {index} of a branch: {fault}")]
    Contour {
        /// Which one, counted from 0.
        index: usize,
        /// What is wrong with it.
        fault: SectionError,
    },

    /// Every smooth outline that was tried crosses itself.
    #[error("no smooth outline follows the contours without crossing itself")]
    NoSimpleOutline,
}

/// Fewest points of an outline: a spline through 8 points is a circle to 0.2 %.
const FEWEST_POINTS: usize = 8;

/// Rays, or places along the contour, for each point of the mean outline. Four follow the corners
/// of a square bar to 1 % of its width at 48 points.
const SAMPLES_PER_POINT: usize = 4;

/// Ratio of I_1 to I_2 below which a section has no strong axis of its own to be turned to.
const NO_STRONG_AXIS: f64 = 1.02;

/// Averages contours, given in a common frame, to a closed curve about the origin.
///
/// * `contours`: polygons without holes, mm, each about its own centroid or anywhere.
/// * `points`: points of the curve, at least 8; 32 to 64 follow a real contour well.
///
/// # Errors
/// Without contours, with a contour that has no area, or with fewer than eight points.
///
/// # Examples
/// ```
/// # use beamwright::section::freeform::average_outline;
/// # use nalgebra::Point2;
/// let square = |a: f64| [(-a, -a), (a, -a), (a, a), (-a, a)].map(|(x, y)| Point2::new(x, y)).to_vec();
/// let mean = average_outline(&[square(9.0), square(11.0)], 48)?;
/// assert_eq!(mean.points().len(), 48);
/// # Ok::<(), beamwright::section::freeform::AverageError>(())
/// ```
pub fn average_outline(
    contours: &[Vec<Point2<f64>>],
    points: usize,
) -> Result<Freeform, AverageError> {
    if contours.is_empty() {
        return Err(AverageError::NoContours);
    }
    if points < FEWEST_POINTS {
        return Err(AverageError::TooFewPoints { asked: points });
    }
    let mut goal = Moments::default();
    let mut centred = Vec::with_capacity(contours.len());
    for (index, contour) in contours.iter().enumerate() {
        let region = Contours::solid(contour.clone());
        let moments = region.moments().map_err(|fault| AverageError::Contour { index, fault })?;
        goal.add_mean(&moments.central(), contours.len());
        centred.push(about_centroid(contour, moments.centroid()));
    }
    let samples = SAMPLES_PER_POINT * points;
    let curve = |mean: Vec<Point2<f64>>| smooth(&mean, points, &goal);
    let rays = Rays::new(0.0, samples);
    let fans: Vec<Fan> = centred.iter().map(|c| rays.cast([c], Point2::origin())).collect();
    let mean = by_rays(&fans, &rays).unwrap_or_else(|| by_way_around(&centred, samples, &goal));
    curve(mean).or_else(|| curve(by_farthest(&fans, &rays))).ok_or(AverageError::NoSimpleOutline)
}

/// The spline along a mean outline with the moments of `goal`; `None` if it crosses itself.
fn smooth(mean: &[Point2<f64>], points: usize, goal: &Moments) -> Option<Freeform> {
    let corners = evenly_spaced(mean, mean[0], points);
    let curve = Freeform::through(corners).ok().filter(Freeform::is_simple)?;
    let curve = with_area_of(&with_moments_of(&with_moments_of(&curve, goal), goal), goal);
    curve.points().iter().all(|p| p.x.is_finite() && p.y.is_finite()).then_some(curve)
}

/// The contour about the origin, counter-clockwise.
fn about_centroid(contour: &[Point2<f64>], centroid: Point2<f64>) -> Vec<Point2<f64>> {
    let mut moved: Vec<Point2<f64>> = contour.iter().map(|p| (p - centroid).into()).collect();
    if signed_area(&moved) < 0.0 {
        moved.reverse();
    }
    moved
}

/// Root mean square of the radii over even directions; `None` if a ray meets a contour twice.
fn by_rays(fans: &[Fan], rays: &Rays) -> Option<Vec<Point2<f64>>> {
    let is_single = |fan: &Fan| fan.rays().iter().all(|crossings| crossings.len() == 1);
    fans.iter().all(is_single).then(|| by_farthest(fans, rays))
}

/// Root mean square of the farthest radii over even directions: an outline without folds.
fn by_farthest(fans: &[Fan], rays: &Rays) -> Vec<Point2<f64>> {
    let point = |(i, direction): (usize, &Vector2<f64>)| {
        let farthest = |fan: &Fan| fan.rays()[i].last().copied().unwrap_or(0.0);
        let squares: f64 = fans.iter().map(|fan| farthest(fan).powi(2)).sum();
        (direction * (squares / fans.len() as f64).sqrt()).into()
    };
    rays.directions().iter().enumerate().map(point).collect()
}

/// Mean of the points at equal parts of the way around, from where axis 1 leaves each contour.
fn by_way_around(
    contours: &[Vec<Point2<f64>>],
    samples: usize,
    goal: &Moments,
) -> Vec<Point2<f64>> {
    let (sin, cos) = goal.principal().2.sin_cos();
    let axis = Vector2::new(cos, sin);
    let mut mean = vec![Vector2::zeros(); samples];
    for contour in contours {
        let farthest = crossings(contour, Point2::origin(), axis).last().copied();
        let start = farthest.map_or(contour[0], |r| (axis * r).into());
        for (sum, p) in mean.iter_mut().zip(evenly_spaced(contour, start, samples)) {
            *sum += p.coords / contours.len() as f64;
        }
    }
    mean.into_iter().map(Point2::from).collect()
}

/// Points at equal parts of the length of a closed polygon, from a point on it.
fn evenly_spaced(polygon: &[Point2<f64>], start: Point2<f64>, count: usize) -> Vec<Point2<f64>> {
    let all: Vec<_> = sides(polygon).collect();
    let first = nearest_side(&all, start);
    let mut chain = vec![start, all[first].1];
    let rest = all[first + 1..].iter().chain(&all[..first]);
    chain.extend(rest.map(|side| side.1));
    chain.push(start);
    let length: f64 = chain.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let step = length / count as f64;
    let mut points = Vec::with_capacity(count);
    let mut behind = 0.0;
    for w in chain.windows(2) {
        let side = (w[1] - w[0]).norm();
        while points.len() < count && points.len() as f64 * step < behind + side {
            let along = points.len() as f64 * step - behind;
            points.push(w[0] + (w[1] - w[0]) * (along / side));
        }
        behind += side;
    }
    points
}

fn nearest_side(sides: &[(Point2<f64>, Point2<f64>)], to: Point2<f64>) -> usize {
    let distance = |&(p, q): &(Point2<f64>, Point2<f64>)| {
        let side = q - p;
        let t = ((to - p).dot(&side) / side.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (p + side * t - to).norm_squared()
    };
    let ranked = sides.iter().map(distance).enumerate();
    ranked.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i)
}

/// The curve centred, turned and stretched to the area, principal angle and I_1/I_2 of `goal`.
fn with_moments_of(curve: &Freeform, goal: &Moments) -> Freeform {
    let own = Moments::of_pieces(&Outline::Freeform(curve.clone()).pieces());
    let (centroid, central) = (own.centroid(), own.central());
    let (i_1, i_2, angle) = central.principal();
    let (g_1, g_2, goal_angle) = goal.principal();
    let has_axis = g_1 > NO_STRONG_AXIS * g_2 && i_1 > NO_STRONG_AXIS * i_2;
    // Stretching axis 1 by s and axis 2 by 1/s changes I_1/I_2 by s⁻⁴.
    let s = if has_axis { (g_1 * i_2 / (g_2 * i_1)).powf(-0.25) } else { 1.0 };
    let size = (goal.area / central.area).abs().sqrt();
    let stretch = Matrix2::from_diagonal(&Vector2::new(size * s, size / s));
    let from = if has_axis { angle } else { 0.0 };
    // An axis has two directions: the smaller turn keeps what is left of it on its side.
    let lesser = |turn: f64| turn - (turn / PI).round() * PI;
    let to = if has_axis { from + lesser(goal_angle - from) } else { 0.0 };
    let map = Rotation2::new(to).matrix() * stretch * Rotation2::new(-from).matrix();
    curve.mapped(|p| (map * (p - centroid)).into())
}

/// The curve scaled to the area of `goal`. Stretching changes the spline between its points a
/// little; scaling does not.
fn with_area_of(curve: &Freeform, goal: &Moments) -> Freeform {
    let own = Moments::of_pieces(&Outline::Freeform(curve.clone()).pieces());
    let scale = (goal.area / own.area).abs().sqrt();
    curve.mapped(|p| p * scale)
}

impl Moments {
    fn add_mean(&mut self, other: &Self, of: usize) {
        let weight = 1.0 / of as f64;
        self.area += weight * other.area;
        self.i_xx += weight * other.i_xx;
        self.i_yy += weight * other.i_yy;
        self.i_xy += weight * other.i_xy;
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn ellipse(a: f64, b: f64, turn: f64, n: usize) -> Vec<Point2<f64>> {
        (0..n)
            .map(|i| {
                let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
                Rotation2::new(turn) * Point2::new(a * cos, b * sin) + Vector2::new(3.0, -2.0)
            })
            .collect()
    }

    fn moments(curve: &Freeform) -> Moments {
        Moments::of_pieces(&Outline::Freeform(curve.clone()).pieces())
    }

    #[test]
    fn mean_has_the_mean_area_and_the_common_axes() {
        let turn = 0.4;
        let contours = [ellipse(8.0, 4.0, turn, 200), ellipse(7.0, 3.5, turn, 137)];
        let mean = moments(&average_outline(&contours, 48).unwrap());
        let exact: f64 =
            contours.iter().map(|c| signed_area(c)).sum::<f64>() / contours.len() as f64;
        assert!((mean.area / exact - 1.0).abs() < 1e-12);
        // The long half-axis lies at 0.4, so the strong axis is square to it.
        let angle = mean.central().principal().2;
        assert!((angle - (turn - 0.5 * std::f64::consts::PI)).abs() < 1e-6, "{angle}");
        assert!(mean.centroid().coords.norm() < 1e-3);
    }

    #[test]
    fn shape_that_folds_back_is_followed_the_way_around() {
        let channel = [
            (0.0, 0.0),
            (10.0, 0.0),
            (10.0, 2.0),
            (2.0, 2.0),
            (2.0, 18.0),
            (10.0, 18.0),
            (10.0, 20.0),
            (0.0, 20.0),
        ];
        let channel = channel.map(|(x, y)| Point2::new(x, y)).to_vec();
        let exact = Contours::solid(channel.clone()).moments().unwrap().central();
        let mean = moments(&average_outline(&[channel.clone(), channel], 64).unwrap()).central();
        assert!((mean.area / exact.area - 1.0).abs() < 1e-9);
        assert!((mean.i_xx / exact.i_xx - 1.0).abs() < 0.05);
        assert!((mean.i_yy / exact.i_yy - 1.0).abs() < 0.05);
    }

    /// An egg, whose strong axis lies along y: its angle is 90° or −90° as roundings fall.
    #[test]
    fn outline_is_not_turned_end_for_end() {
        for tilt in [-1e-3, -1e-6, 0.0, 1e-6, 1e-3] {
            let egg: Vec<Point2<f64>> = (0..96)
                .map(|i| {
                    let (sin, cos) = (TAU * f64::from(i) / 96.0).sin_cos();
                    Rotation2::new(tilt) * Point2::new(6.0 * cos + 0.8 * cos * cos, 4.0 * sin)
                })
                .collect();
            let centroid = Contours::solid(egg.clone()).moments().unwrap().centroid();
            let farthest = |points: &mut dyn Iterator<Item = f64>| points.fold(0.0, f64::max);
            let reach = farthest(&mut egg.iter().map(|p| p.x - centroid.x));
            let mean = average_outline(&[egg], 48).unwrap();
            let own = farthest(&mut mean.points().iter().map(|p| p.x));
            assert!((own / reach - 1.0).abs() < 0.01, "tilt {tilt}: {own} for {reach}");
        }
    }

    #[test]
    fn bad_contours_are_named() {
        assert_eq!(average_outline(&[], 32), Err(AverageError::NoContours));
        let fault = average_outline(&[ellipse(1.0, 1.0, 0.0, 20), vec![]], 32).unwrap_err();
        assert!(matches!(fault, AverageError::Contour { index: 1, .. }));
        let few = average_outline(&[ellipse(1.0, 1.0, 0.0, 20)], 5).unwrap_err();
        assert_eq!(few, AverageError::TooFewPoints { asked: 5 });
    }
}
