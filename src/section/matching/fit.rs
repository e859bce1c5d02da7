//! Sizes of a family that match a measured section.

use std::f64::consts::PI;

use super::{MatchMode, MatchTarget, ProfileChoice};
use crate::section::error::SectionError;
use crate::section::moments::Moments;
use crate::section::piece::bisect;
use crate::section::profile::Shape;

/// Wall over the smaller outer size that a hollow or open profile gets when the measured section
/// is solid and its area says nothing about a wall: the middle of the usual range, CHS 60.3 × 5
/// (0.08) to SHS 40 × 5 (0.125).
const USUAL_WALL: f64 = 0.1;

/// Thinnest and thickest wall, over the smaller outer size, that is taken from the measured area.
/// Beyond them nothing is sold: CHS 323.9 × 6 has 0.019, CHS 21.3 × 3.2 and HD 400 × 1299 have
/// 0.15 to 0.3.
const WALLS: [f64; 2] = [0.015, 0.3];

/// Web over flange thickness of a fitted I or C: IPE 200 has 0.66, HEB 200 0.6, UPE 200 0.55.
const WEB_OVER_FLANGE: f64 = 0.6;

/// Range of b/h in which I_1/I_2 is matched; a flange is not wider than twice the height.
const ASPECTS: [f64; 2] = [0.05, 2.0];

/// The shape of a family that matches the target.
pub(super) fn fitted(
    family: &ProfileChoice,
    target: &MatchTarget,
    mode: MatchMode,
) -> Result<Shape, SectionError> {
    let shape = match family {
        ProfileChoice::Round => Shape::Round { d: round(target) },
        ProfileChoice::Tube => tube(target),
        ProfileChoice::Ellipse => {
            let [b, h] = sides(target.i_1, target.i_2, 64.0 / PI);
            Shape::Ellipse { b, h }
        }
        ProfileChoice::Box => walled(target, |h, b, t| Shape::Box { b, h, t, r_o: 0.0, r_i: 0.0 }),
        ProfileChoice::I => {
            walled(target, |h, b, t_f| Shape::I { h, b, t_w: WEB_OVER_FLANGE * t_f, t_f, r: 0.0 })
        }
        ProfileChoice::C => {
            walled(target, |h, b, t_f| Shape::C { h, b, t_w: WEB_OVER_FLANGE * t_f, t_f, r: 0.0 })
        }
        ProfileChoice::L => walled(target, |h, b, t| Shape::L { h, b, t, r_1: 0.0, r_2: 0.0 }),
        // Auto, freeform and catalogue are not families of sizes; their callers see to them.
        _ => {
            let [b, h] = rectangle(target.i_1, target.i_2);
            Shape::Rectangle { b, h }
        }
    };
    target.scaled(target.grown(shape), mode)
}

/// d = (64 √(I_1 I_2) / π)^¼.
fn round(target: &MatchTarget) -> f64 {
    (64.0 * target.mean_moment() / PI).powf(0.25)
}

/// b and h with b h³ = 12 i_y and h b³ = 12 i_z.
pub(super) fn rectangle(i_y: f64, i_z: f64) -> [f64; 2] {
    sides(i_y, i_z, 12.0)
}

/// b and h with b h³ = k i_y and h b³ = k i_z; k is 12 for rectangles, 64/π for ellipses.
fn sides(i_y: f64, i_z: f64, k: f64) -> [f64; 2] {
    let ratio = (i_y / i_z).sqrt();
    let h = (k * i_y * ratio).powf(0.25);
    [h / ratio, h]
}

/// D² = 8 I/A + 2 A/π, d² = 8 I/A − 2 A/π.
fn tube(target: &MatchTarget) -> Shape {
    let (i, area) = (target.mean_moment(), target.area);
    let outer = (8.0 * i / area + 2.0 * area / PI).sqrt();
    let inner = (8.0 * i / area - 2.0 * area / PI).max(0.0).sqrt();
    let wall = 0.5 * (outer - inner);
    if wall <= WALLS[1] * outer {
        return Shape::Tube { d: outer, t: wall };
    }
    let bore = 1.0 - 2.0 * USUAL_WALL;
    let d = (64.0 * i / (PI * (1.0 - bore.powi(4)))).powf(0.25);
    Shape::Tube { d, t: USUAL_WALL * d }
}

/// Height, width and wall of a thin-walled shape with the I_1 and I_2 of the target, and with its
/// area if some wall within [`WALLS`] gives it.
fn walled(target: &MatchTarget, shape: impl Fn(f64, f64, f64) -> Shape) -> Shape {
    let with_wall = |wall: f64| proportioned(target, |h, b| shape(h, b, wall * h.min(b)));
    let excess = |wall: f64| moments(&with_wall(wall)).area / target.area - 1.0;
    if excess(WALLS[0]) < 0.0 && excess(WALLS[1]) > 0.0 {
        with_wall(bisect(WALLS, excess))
    } else {
        with_wall(USUAL_WALL)
    }
}

/// The shape with the I_1/I_2 and then the √(I_1 I_2) of the target; the ratio falls with b/h.
fn proportioned(target: &MatchTarget, shape: impl Fn(f64, f64) -> Shape) -> Shape {
    let goal = target.i_1 / target.i_2;
    let ratio = |aspect: f64| {
        let unit = shape(1.0, aspect);
        let m = moments(&unit);
        let (i_1, i_2, _) = m.principal();
        // Beyond the aspect at which the axes change places the ratio goes on falling.
        let upright = matches!(unit, Shape::L { .. }) || m.i_xx >= m.i_yy;
        if upright { i_1 / i_2 } else { i_2 / i_1 }
    };
    let widest = if matches!(shape(1.0, 1.0), Shape::L { .. }) { 1.0 } else { ASPECTS[1] };
    let range = [ASPECTS[0], widest];
    let aspect = if goal >= ratio(range[0]) {
        range[0]
    } else if goal <= ratio(range[1]) {
        range[1]
    } else {
        bisect(range, |aspect| goal - ratio(aspect))
    };
    let unit = shape(1.0, aspect);
    let (i_1, i_2, _) = moments(&unit).principal();
    unit.scaled((target.mean_moment() / (i_1 * i_2).sqrt()).powf(0.25))
}

fn moments(shape: &Shape) -> Moments {
    Moments::of_pieces(&shape.region().pieces()).central()
}

#[cfg(test)]
mod tests {
    use super::super::MatchErrors;
    use super::*;
    use crate::section::profile::Profile;

    fn target(shape: Shape) -> MatchTarget {
        MatchTarget::of_properties(&Profile::new(shape).unwrap().properties().unwrap())
    }

    fn errors(shape: Shape, target: &MatchTarget) -> MatchErrors {
        MatchErrors::of(&Profile::new(shape).unwrap().properties().unwrap(), target)
    }

    #[test]
    fn families_find_their_own_sizes_again() {
        let cases = [
            (ProfileChoice::Round, Shape::Round { d: 12.5 }),
            (ProfileChoice::Tube, Shape::Tube { d: 60.3, t: 4.0 }),
            (ProfileChoice::Rectangle, Shape::Rectangle { b: 8.0, h: 14.0 }),
            (ProfileChoice::Ellipse, Shape::Ellipse { b: 8.0, h: 15.0 }),
            (ProfileChoice::Box, Shape::Box { b: 50.0, h: 90.0, t: 5.0, r_o: 0.0, r_i: 0.0 }),
            (ProfileChoice::I, Shape::I { h: 200.0, b: 100.0, t_w: 6.0, t_f: 10.0, r: 0.0 }),
            (ProfileChoice::C, Shape::C { h: 200.0, b: 80.0, t_w: 6.0, t_f: 10.0, r: 0.0 }),
            (ProfileChoice::L, Shape::L { h: 100.0, b: 75.0, t: 8.0, r_1: 0.0, r_2: 0.0 }),
        ];
        for (family, shape) in cases {
            let target = target(shape.clone());
            let found = fitted(&family, &target, MatchMode::Stiffness).unwrap();
            let e = errors(found, &target);
            for error in [e.area, e.i_1, e.i_2, e.j] {
                assert!(error.abs() < 1e-6, "{shape}: {e:?}");
            }
        }
    }

    #[test]
    fn solid_bar_becomes_a_tube_of_equal_stiffness() {
        let target = target(Shape::Round { d: 20.0 });
        for family in [ProfileChoice::Tube, ProfileChoice::Box, ProfileChoice::I, ProfileChoice::C]
        {
            let e = errors(fitted(&family, &target, MatchMode::Stiffness).unwrap(), &target);
            assert!(e.i_1.abs() < 1e-6 && e.i_2.abs() < 1e-6 && e.area < -0.3, "{family}: {e:?}");
        }
    }

    #[test]
    fn modes_match_the_area_or_none_less() {
        let target = target(Shape::Ellipse { b: 8.0, h: 15.0 });
        for family in [ProfileChoice::Round, ProfileChoice::Rectangle, ProfileChoice::Tube] {
            let e = errors(fitted(&family, &target, MatchMode::Area).unwrap(), &target);
            assert!(e.area.abs() < 1e-12, "{family}: {e:?}");
            let e = errors(fitted(&family, &target, MatchMode::NotWeaker).unwrap(), &target);
            let least = e.area.min(e.i_1).min(e.i_2).min(e.j);
            assert!((0.0..1e-6).contains(&least), "{family}: {e:?}");
        }
    }
}
