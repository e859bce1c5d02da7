//! The catalogue profile nearest to a measured section.

use super::{MatchError, MatchErrors, MatchMode, MatchTarget};
use crate::section::catalogue::{Catalogue, Entry};
use crate::section::profile::Profile;

/// Errors of A, I_1, I_2, J within which a catalogue profile is taken to be the one the section
/// was made from: the scatter of sections measured on meshes two elements fine. Neighbours in the
/// tables lie 10 % apart in one of the four at least.
const RECOGNISED: MatchErrors = MatchErrors { area: 0.02, i_1: 0.04, i_2: 0.04, j: 0.08 };

/// The profile of a catalogue that `mode` asks for.
pub(super) fn nearest<'c>(
    target: &MatchTarget,
    mode: MatchMode,
    catalogue: &'c Catalogue,
) -> Result<&'c Profile, MatchError> {
    let entries = catalogue.entries();
    if entries.is_empty() {
        return Err(MatchError::EmptyCatalogue);
    }
    let against = |target: &MatchTarget| -> Vec<(&'c Entry, MatchErrors)> {
        entries.iter().map(|e| (e, MatchErrors::of(&e.properties, target))).collect()
    };
    let unworn = || target.unworn().map(|unworn| against(&unworn));
    let recognised = |all: &[_]| least(all, is_recognised, |e| [scatter(e), 0.0]);
    let found = match mode {
        MatchMode::NotWeaker => {
            least(&against(target), |e| e.is_not_weaker(), |e| [e.area, e.stiffness()])
        }
        MatchMode::Stiffness => {
            let all = unworn()?;
            recognised(&all).or_else(|| least(&all, |_| true, |e| [e.stiffness(), e.area.abs()]))
        }
        MatchMode::Area => recognised(&unworn()?)
            .or_else(|| least(&against(target), |_| true, |e| [e.area.abs(), e.stiffness()])),
    };
    found.ok_or(MatchError::NoneStrongEnough { profiles: entries.len(), area: target.area })
}

/// The profile with the least key among those allowed; the first of equals.
fn least<'c>(
    all: &[(&'c Entry, MatchErrors)],
    allowed: impl Fn(&MatchErrors) -> bool,
    key: impl Fn(&MatchErrors) -> [f64; 2],
) -> Option<&'c Profile> {
    all.iter()
        .filter(|(_, errors)| allowed(errors))
        .min_by(|(_, a), (_, b)| {
            let (a, b) = (key(a), key(b));
            a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
        })
        .map(|(entry, _)| &entry.profile)
}

/// The four errors, each over what [`RECOGNISED`] allows.
fn parts(e: &MatchErrors) -> [f64; 4] {
    let r = RECOGNISED;
    [e.area / r.area, e.i_1 / r.i_1, e.i_2 / r.i_2, e.j / r.j]
}

fn is_recognised(errors: &MatchErrors) -> bool {
    parts(errors).into_iter().all(|part| part.abs() <= 1.0)
}

fn scatter(errors: &MatchErrors) -> f64 {
    parts(errors).into_iter().map(|part| part * part).sum()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use nalgebra::Point2;

    use super::*;
    use crate::section::contours::Contours;
    use crate::section::profile::Shape;

    fn name(target: &MatchTarget, mode: MatchMode, families: &[&str]) -> String {
        let catalogue = Catalogue::builtin().of_families(families).unwrap();
        nearest(target, mode, &catalogue).unwrap().to_string()
    }

    fn round(d: f64) -> MatchTarget {
        let bar = Profile::new(Shape::Round { d }).unwrap();
        MatchTarget::of_properties(&bar.properties().unwrap())
    }

    #[test]
    fn round_bar_gets_the_tube_of_nearest_bending_stiffness() {
        for d in [12.0, 25.0, 33.3, 47.0, 80.0] {
            let target = round(d);
            let tubes = Catalogue::builtin().of_families(&["CHS"]).unwrap();
            let off = |entry: &&Entry| (entry.properties.i_1 - target.i_1).abs();
            let exact = tubes.entries().iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
            assert_eq!(name(&target, MatchMode::Stiffness, &["CHS"]), exact.name());
        }
    }

    #[test]
    fn lightest_profile_that_is_not_weaker_is_found() {
        let target = round(40.0);
        let catalogue = Catalogue::builtin();
        let found = catalogue.find(&name(&target, MatchMode::NotWeaker, &[])).unwrap();
        assert!(MatchErrors::of(&found.properties, &target).is_not_weaker());
        for entry in catalogue.entries() {
            if MatchErrors::of(&entry.properties, &target).is_not_weaker() {
                assert!(entry.properties.area >= found.properties.area, "{}", entry.name());
            }
        }
    }

    #[test]
    fn flat_bars_and_round_bars_that_the_mesh_has_worn_are_recognised() {
        // Corners cut off by a mesh a third as fine as the bar is thick: 4 % of the area.
        let worn = |b: f64, h: f64, cut: f64| {
            let [x, y] = [0.5 * b, 0.5 * h];
            let corners = [
                [x - cut, -y],
                [x, cut - y],
                [x, y - cut],
                [x - cut, y],
                [cut - x, y],
                [-x, y - cut],
                [-x, cut - y],
                [cut - x, -y],
            ];
            corners.map(|[x, y]| Point2::new(x, y)).to_vec()
        };
        let faceted = |d: f64, sides: usize| {
            let corner = |i: usize| TAU * i as f64 / sides as f64;
            let at = |angle: f64| Point2::new(0.5 * d * angle.cos(), 0.5 * d * angle.sin());
            (0..sides).map(|i| at(corner(i))).collect::<Vec<_>>()
        };
        for mode in [MatchMode::Stiffness, MatchMode::Area] {
            for (contour, bar) in [
                (worn(12.0, 30.0, 2.6), "Flat 30x12"),
                (worn(10.0, 20.0, 2.0), "Flat 20x10"),
                (worn(15.0, 20.0, 2.4), "Flat 20x15"),
                (faceted(20.0, 12), "Round 20"),
            ] {
                let target = MatchTarget::of_contours(Contours::solid(contour)).unwrap();
                assert_eq!(name(&target, mode, &["FLAT", "ROUND"]), bar, "{mode:?}");
            }
        }
    }

    #[test]
    fn giant_section_is_refused_with_its_area() {
        let fault = nearest(&round(5000.0), MatchMode::NotWeaker, Catalogue::builtin());
        assert!(matches!(fault, Err(MatchError::NoneStrongEnough { .. })));
    }
}
