//! How a profile is turned onto the measured section.

use std::f64::consts::{PI, TAU};

use nalgebra::Point2;

use super::target::folded_angle;
use super::{MatchError, MatchErrors, MatchMode, MatchTarget, Matched};
use crate::section::contours::Contours;
use crate::section::freeform::average_outline;
use crate::section::profile::{Profile, Shape};
use crate::section::properties::SectionProperties;
use crate::section::rays::{Fan, Rays};

/// I_1/I_2 below which a section has no strong axis to speak of, and a profile with corners is
/// turned by its outline instead. A square bar off by 3 % in one side has 1.06.
const NO_STRONG_AXIS: f64 = 1.1;

/// Rays of a fan: one for each degree.
const RAYS: usize = 360;

/// Corners for each quarter turn of an arc when a profile is compared with a contour: the polygon
/// takes 0.05 % off a circle.
const CORNERS_PER_QUARTER: usize = 24;

/// Points of a freeform outline: enough for the corners of a square bar to be round by no more
/// than a tenth of its width.
pub(super) const FREEFORM_POINTS: usize = 48;

impl Matched {
    /// The profile, turned onto the target.
    ///
    /// # Errors
    /// If the profile or the contour of the target has no area properties.
    pub fn of(profile: Profile, target: &MatchTarget) -> Result<Self, MatchError> {
        let properties = profile.properties()?;
        Self::with_properties(profile, properties, target)
    }

    /// The matched profile, turned onto a section that it was not matched to itself.
    ///
    /// # Errors
    /// If the contour of the target has no area properties.
    pub(crate) fn turned_onto(&self, target: &MatchTarget) -> Result<Self, MatchError> {
        Self::with_properties(self.profile.clone(), self.properties, target)
    }

    fn with_properties(
        profile: Profile,
        properties: SectionProperties,
        target: &MatchTarget,
    ) -> Result<Self, MatchError> {
        let errors = MatchErrors::of(&properties, target);
        let symmetry = profile.shape.symmetry();
        let roll = folded_angle(target.principal_angle - properties.principal_angle, symmetry);
        let (roll, uncovered) = match &target.contours {
            None => (roll, None),
            Some(contours) => {
                let outline = Outlines::new(&profile, contours)?;
                let free = target.i_1 < NO_STRONG_AXIS * target.i_2;
                let (roll, uncovered) = outline.best(roll, symmetry, free);
                (folded_angle(roll, symmetry), Some(uncovered / target.area))
            }
        };
        Ok(Self { profile, roll, properties, errors, uncovered })
    }
}

/// A profile and a measured contour, both as fans from their centroids.
struct Outlines {
    profile: Contours,
    measured: Fan,
}

impl Outlines {
    fn new(profile: &Profile, measured: &Contours) -> Result<Self, MatchError> {
        let centre = measured.moments()?.centroid();
        Ok(Self {
            profile: Contours::of_region(&profile.region(), CORNERS_PER_QUARTER),
            measured: Rays::new(0.0, RAYS).cast(measured.polygons(), centre),
        })
    }

    /// The profile turned by an angle, as a fan.
    fn fan(&self, roll: f64) -> Fan {
        Rays::new(-roll, RAYS).cast(self.profile.polygons(), Point2::origin())
    }

    /// The roll among the possible ones that leaves least uncovered, and how much that is, mm².
    ///
    /// * `free`: the principal axes say nothing, all rolls are possible; otherwise only `roll`
    ///   and, for a shape without symmetry, its opposite.
    fn best(&self, roll: f64, symmetry: f64, free: bool) -> (f64, f64) {
        let fan = self.fan(roll);
        let difference = |shift: usize| self.measured.difference(&fan, shift);
        if symmetry == 0.0 {
            return (roll, difference(0));
        }
        let shifts: Vec<usize> = if free {
            (0..(symmetry / TAU * RAYS as f64).round() as usize).collect()
        } else if symmetry > PI {
            vec![0, RAYS / 2]
        } else {
            vec![0]
        };
        let all: Vec<f64> = shifts.iter().map(|&shift| difference(shift)).collect();
        let least = (0..all.len()).min_by(|&a, &b| all[a].total_cmp(&all[b])).unwrap_or(0);
        let step = TAU / RAYS as f64;
        if !free {
            return (roll + shifts[least] as f64 * step, all[least]);
        }
        let n = all.len();
        let part = vertex([all[(least + n - 1) % n], all[least], all[(least + 1) % n]]);
        let roll = roll + (shifts[least] as f64 + part) * step;
        (roll, self.measured.difference(&self.fan(roll), 0).min(all[least]))
    }
}

/// Where a curve with three values at −1, 0, 1 and a sharp minimum near 0 is least.
///
/// The uncovered area grows with the amount of turn either way: the curve is a V, not a parabola.
fn vertex([before, at, after]: [f64; 3]) -> f64 {
    let steeper = (before - at).max(after - at);
    if steeper > 0.0 { 0.5 * (before - after) / steeper } else { 0.0 }
}

/// The smooth outline of the measured contour, in its principal axes.
pub(super) fn freeform(target: &MatchTarget, mode: MatchMode) -> Result<Matched, MatchError> {
    let contours = target.contours.as_ref().ok_or(MatchError::NeedsContour)?;
    let mean = average_outline(std::slice::from_ref(&contours.outer), FREEFORM_POINTS)?;
    let roll = target.principal_angle;
    let shape = Shape::Freeform(mean.turned(-roll));
    let own = Profile::new(shape.clone())?.properties()?;
    // The outline has the area of one contour; the target may be a mean over many.
    let scale = match mode {
        MatchMode::NotWeaker => target.scale(&own, mode),
        MatchMode::Stiffness | MatchMode::Area => target.scale(&own, MatchMode::Area),
    };
    let profile = Profile::new(shape.scaled(scale))?;
    let properties = profile.properties()?;
    let errors = MatchErrors::of(&properties, target);
    let outlines = Outlines::new(&profile, contours)?;
    let uncovered = outlines.measured.difference(&outlines.fan(roll), 0) / target.area;
    Ok(Matched { profile, roll, properties, errors, uncovered: Some(uncovered) })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    fn turned(shape: &Shape, angle: f64) -> MatchTarget {
        let contours =
            Contours::of_region(&shape.region(), 12).moved(angle, Vector2::new(4.0, -7.0));
        MatchTarget::of_contours(contours).unwrap()
    }

    #[test]
    fn profile_is_turned_back_onto_its_own_outline() {
        let shapes = [
            Shape::Rectangle { b: 8.0, h: 14.0 },
            Shape::Rectangle { b: 10.0, h: 10.0 },
            Shape::C { h: 80.0, b: 50.0, t_w: 4.0, t_f: 7.0, r: 10.0 },
            Shape::L { h: 80.0, b: 80.0, t: 8.0, r_1: 10.0, r_2: 5.0 },
            Shape::L { h: 80.0, b: 60.0, t: 8.0, r_1: 10.0, r_2: 5.0 },
        ];
        for shape in shapes {
            for angle in [-2.9, -1.1, 0.0, 0.4, 1.3, 2.5] {
                let profile = Profile::new(shape.clone()).unwrap();
                let matched = Matched::of(profile, &turned(&shape, angle)).unwrap();
                let symmetry = shape.symmetry();
                let off = folded_angle(matched.roll - angle, symmetry).abs();
                assert!(off < 0.01, "{shape} at {angle}: {}", matched.roll);
                assert!(matched.uncovered.unwrap() < 0.02, "{shape}: {:?}", matched.uncovered);
            }
        }
    }

    #[test]
    fn freeform_keeps_area_and_axes_of_the_contour() {
        let shape = Shape::Ellipse { b: 8.0, h: 15.0 };
        let matched = freeform(&turned(&shape, 0.7), MatchMode::Stiffness).unwrap();
        assert!((matched.roll - 0.7).abs() < 1e-6);
        assert!(matched.properties.principal_angle.abs() < 1e-4);
        let e = matched.errors;
        assert!(e.area.abs() < 1e-9 && e.i_1.abs() < 5e-3 && e.i_2.abs() < 5e-3, "{e:?}");
        assert!(e.j.abs() < 5e-3 && matched.uncovered.unwrap() < 0.01);
    }
}
