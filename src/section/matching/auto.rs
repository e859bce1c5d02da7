//! The simplest family that a measured section belongs to.

use std::f64::consts::PI;

use super::fit::fitted;
use super::{MatchError, MatchMode, MatchTarget, Matched, ProfileChoice, roll};
use crate::section::profile::Profile;
use crate::section::properties::SectionProperties;

/// Largest uncovered part of the area at which a section still counts as of a family.
///
/// A rectangle whose corners a mesh of 1 mm has rounded leaves 1 to 4 %, a circle against the
/// square of its area 18 %; a bar of half circle and half square would leave 9 % against both.
const MOST_UNCOVERED: f64 = 0.06;

/// By how much less an ellipse must leave uncovered to be preferred to a circle: an ellipse of
/// axes 0.97 apart leaves 0.02 against its circle, the scatter of a circle meshed coarsely.
const WORTH_A_SIZE: f64 = 0.02;

/// I_1/I_2 up to which a section known by its properties only counts as round; axes 0.97 apart.
const ROUND_RATIO: f64 = 1.063;

/// A²/√(I_1 I_2) below which a section known by its properties only counts as hollow: a tube of
/// t/d = 0.3 has 9.1, a rectangle 12.
const HOLLOW_FULLNESS: f64 = 9.5;

/// The simplest family within tolerance, else the freeform outline; of a hollow section the nearer
/// of tube and box, since a freeform outline has no bore.
pub(super) fn simplest(target: &MatchTarget, mode: MatchMode) -> Result<Matched, MatchError> {
    let Some(contours) = &target.contours else {
        let family = by_properties(target)?;
        return Matched::of(Profile::new(fitted(&family, target, mode)?)?, target);
    };
    if !contours.holes.is_empty() {
        let (_, family) = least_uncovered(target, &[ProfileChoice::Tube, ProfileChoice::Box])?;
        return Matched::of(Profile::new(fitted(&family, target, mode)?)?, target);
    }
    let families = [ProfileChoice::Round, ProfileChoice::Rectangle, ProfileChoice::Ellipse];
    let (uncovered, family) = least_uncovered(target, &families)?;
    if uncovered <= MOST_UNCOVERED {
        Matched::of(Profile::new(fitted(&family, target, mode)?)?, target)
    } else {
        roll::freeform(target, mode).or_else(|fault| match fault {
            // The best of the families, however much it leaves uncovered.
            MatchError::Average(_) => {
                Matched::of(Profile::new(fitted(&family, target, mode)?)?, target)
            }
            fault => Err(fault),
        })
    }
}

/// The family that, fitted to the area or the stiffness, leaves least uncovered, and how much that
/// is.
fn least_uncovered(
    target: &MatchTarget,
    families: &[ProfileChoice],
) -> Result<(f64, ProfileChoice), MatchError> {
    let mut best = (f64::INFINITY, ProfileChoice::Round);
    for family in families {
        let mut uncovered = f64::MAX;
        for mode in [MatchMode::Area, MatchMode::Stiffness] {
            let matched = Matched::of(Profile::new(fitted(family, target, mode)?)?, target)?;
            uncovered = matched.uncovered.map_or(uncovered, |part| part.min(uncovered));
        }
        let is_more_complex = best.1 == ProfileChoice::Round && *family == ProfileChoice::Ellipse;
        let gain = if is_more_complex { WORTH_A_SIZE } else { 0.0 };
        if uncovered + gain < best.0 {
            best = (uncovered, family.clone());
        }
    }
    Ok(best)
}

/// The family whose A²/√(I_1 I_2) and J (I_1 + I_2) / (4 I_1 I_2) are nearest, in ratio.
///
/// | family    | A²/√(I_1 I_2) | J (I_1 + I_2) / (4 I_1 I_2) |
/// |-----------|---------------|-----------------------------|
/// | ellipse   | 4π            | 1                           |
/// | rectangle | 12            | 0.84 (square) to 1 (thin)   |
fn by_properties(target: &MatchTarget) -> Result<ProfileChoice, MatchError> {
    let is_round = target.i_1 <= ROUND_RATIO * target.i_2;
    if target.fullness() < HOLLOW_FULLNESS {
        let is_tube = is_round && target.j > 0.95 * (target.i_1 + target.i_2);
        return Ok(if is_tube { ProfileChoice::Tube } else { ProfileChoice::Box });
    }
    let rectangle = fitted(&ProfileChoice::Rectangle, target, MatchMode::Stiffness)?;
    let own = Profile::new(rectangle)?.properties()?;
    let stiff = |j: f64| j * (target.i_1 + target.i_2) / (4.0 * target.i_1 * target.i_2);
    let off = |fullness: f64, stiffness: f64| {
        (target.fullness() / fullness).ln().abs() + (stiff(target.j) / stiffness).ln().abs()
    };
    Ok(if off(12.0, stiff_of(&own)) < off(4.0 * PI, 1.0) {
        ProfileChoice::Rectangle
    } else if is_round {
        ProfileChoice::Round
    } else {
        ProfileChoice::Ellipse
    })
}

fn stiff_of(p: &SectionProperties) -> f64 {
    p.j * p.i_p / (4.0 * p.i_1 * p.i_2)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point2, Vector2};

    use super::*;
    use crate::section::contours::Contours;
    use crate::section::profile::Shape;

    fn family(target: &MatchTarget) -> &'static str {
        simplest(target, MatchMode::Stiffness).unwrap().profile.shape.family()
    }

    /// The polygon of a shape, its corners cut and every point moved about like on a mesh.
    fn meshed(shape: &Shape, noise: f64) -> MatchTarget {
        let fine = Contours::of_region(&shape.region(), 16).outer;
        let mut points = Vec::new();
        for (i, p) in fine.iter().enumerate() {
            let q = fine[(i + 1) % fine.len()];
            for t in [0.1, 0.5, 0.9] {
                let k = points.len() as f64;
                let shift = Vector2::new((k * 12.9898).sin(), (k * 78.233).sin()) * noise;
                points.push(p + (q - p) * t + shift);
            }
        }
        MatchTarget::of_contours(Contours::solid(points).moved(0.6, Vector2::zeros())).unwrap()
    }

    #[test]
    fn families_are_told_apart_on_rough_contours() {
        let cases = [
            (Shape::Round { d: 10.0 }, "round"),
            (Shape::Rectangle { b: 8.0, h: 14.0 }, "rectangle"),
            (Shape::Rectangle { b: 10.0, h: 10.0 }, "rectangle"),
            (Shape::Ellipse { b: 8.0, h: 15.0 }, "ellipse"),
            (Shape::Ellipse { b: 8.0, h: 9.5 }, "ellipse"),
        ];
        for (shape, expected) in cases {
            for noise in [0.0, 0.05, 0.1] {
                assert_eq!(family(&meshed(&shape, noise)), expected, "{shape}, noise {noise}");
            }
        }
    }

    #[test]
    fn families_are_told_apart_by_properties_alone() {
        let cases = [
            (Shape::Round { d: 10.0 }, "round"),
            (Shape::Rectangle { b: 7.0, h: 13.0 }, "rectangle"),
            (Shape::Rectangle { b: 10.0, h: 10.0 }, "rectangle"),
            (Shape::Ellipse { b: 8.0, h: 15.0 }, "ellipse"),
            (Shape::Tube { d: 60.3, t: 4.0 }, "tube"),
            (Shape::Box { b: 50.0, h: 90.0, t: 5.0, r_o: 0.0, r_i: 0.0 }, "box"),
        ];
        for (shape, expected) in cases {
            let own = Profile::new(shape).unwrap().properties().unwrap();
            assert_eq!(family(&MatchTarget::of_properties(&own)), expected);
        }
    }

    #[test]
    fn heart_becomes_freeform() {
        let heart = (0..80).map(|i| {
            let t = std::f64::consts::TAU * f64::from(i) / 80.0;
            let y =
                13.0 * t.cos() - 5.0 * (2.0 * t).cos() - 2.0 * (3.0 * t).cos() - (4.0 * t).cos();
            Point2::new(16.0 * t.sin().powi(3), y)
        });
        let target = MatchTarget::of_contours(Contours::solid(heart.collect())).unwrap();
        assert_eq!(family(&target), "freeform");
    }

    #[test]
    fn hollow_contours_become_tube_and_box() {
        for (shape, expected) in [
            (Shape::Tube { d: 60.3, t: 4.0 }, "tube"),
            (Shape::Box { b: 50.0, h: 90.0, t: 5.0, r_o: 7.5, r_i: 5.0 }, "box"),
        ] {
            let contours = Contours::of_region(&shape.region(), 16);
            assert_eq!(family(&MatchTarget::of_contours(contours).unwrap()), expected);
        }
    }
}
