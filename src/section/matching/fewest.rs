//! The profiles a frame could be built from, and the few of them that serve it best.
//!
//! Candidates are all profiles that the user's choice allows, not only those matched to single
//! beams:
//!
//! | choice      | candidates                                                                     |
//! |-------------|--------------------------------------------------------------------------------|
//! | catalogue   | every profile of its families                                                  |
//! | a family    | sizes fitted to every beam, to every pair of beams, and to the beams that share a profile, until that costs no less (Lloyd, IEEE Trans. Inf. Theory 28, 1982) |
//! | `auto`      | the same for every family that was matched                                     |
//! | freeform    | every outline at every size                                                    |

use super::fit::fitted;
use super::reduce::{KeepOn, reduce_watched};
use super::together::together;
use super::{MatchError, MatchMode, ProfileChoice, Reduction, Requirement};
use crate::section::catalogue::Catalogue;
use crate::section::profile::{Profile, Shape};

/// Beams up to which sizes are fitted to every pair: 300 candidates of a family.
const MOST_PAIRED: usize = 24;

/// Times sizes are fitted to the beams that share a profile; five have been enough.
const MOST_ROUNDS: usize = 20;

/// Beams that are to share profiles, and what these may be.
///
/// # Examples
/// ```
/// # use beamwright::section::matching::{
/// #     FewProfiles, MatchMode, MatchTarget, ProfileChoice, Requirement };
/// # use beamwright::section::{Catalogue, Profile, Shape};
/// let flats = [(10.0, 24.0), (16.0, 16.0)];
/// let flats = flats.map(|(b, h)| Profile::new(Shape::Rectangle { b, h }).unwrap());
/// let requirements: Vec<_> = flats
///     .iter()
///     .map(|flat| MatchTarget::of_properties(&flat.properties().unwrap()))
///     .map(|target| Requirement { target, length: 100.0 })
///     .collect();
/// let wanted = FewProfiles {
///     requirements: &requirements,
///     matched: &flats,
///     max: 1,
///     choice: &ProfileChoice::Rectangle,
///     mode: MatchMode::NotWeaker,
///     catalogue: Catalogue::builtin(),
/// };
/// // Neither flat is as strong as the other; what both need is a third one.
/// assert!(!flats.contains(&wanted.choose()?.profiles[0]));
/// # Ok::<(), beamwright::section::matching::MatchError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FewProfiles<'a> {
    /// The beams.
    pub requirements: &'a [Requirement],
    /// The profile matched to each beam by itself.
    pub matched: &'a [Profile],
    /// Most profiles, 1 or more.
    pub max: usize,
    /// What the user allows.
    pub choice: &'a ProfileChoice,
    /// What counts.
    pub mode: MatchMode,
    /// Where the families of a catalogue are looked up.
    pub catalogue: &'a Catalogue,
}

impl FewProfiles<'_> {
    /// Chooses the profiles, of all that are allowed.
    ///
    /// # Errors
    /// As [`reduce_profiles`](super::reduce_profiles), and if a family is not in the catalogue.
    pub fn choose(&self) -> Result<Reduction, MatchError> {
        self.choose_watched(&mut || Ok(()))
    }

    /// The same, unless `keep_on` asks to stop.
    pub(crate) fn choose_watched(&self, keep_on: KeepOn<'_>) -> Result<Reduction, MatchError> {
        let Self { requirements, matched, max, mode, .. } = *self;
        requirements.iter().try_for_each(|beam| beam.target.check())?;
        let mut pool = matched.to_vec();
        if let ProfileChoice::Catalogue(families) = self.choice {
            let catalogue = self.catalogue.of_families(families)?;
            pool.extend(catalogue.entries().iter().map(|entry| entry.profile.clone()));
            return reduce_watched(requirements, &pool, max, mode, keep_on);
        }
        let families = families(matched);
        let alone: Vec<Vec<&Requirement>> = requirements.iter().map(|r| vec![r]).collect();
        pool.extend(fits(&families, &alone, mode, keep_on)?);
        if requirements.len() <= MOST_PAIRED {
            pool.extend(fits(&families, &pairs(requirements), mode, keep_on)?);
        }
        pool.extend(outlines(matched, requirements, mode, keep_on)?);
        let mut best = reduce_watched(requirements, &pool, max, mode, keep_on)?;
        for _ in 0..MOST_ROUNDS {
            pool.extend(fits(&families, &sharing(requirements, &best), mode, keep_on)?);
            let next = reduce_watched(requirements, &pool, max, mode, keep_on)?;
            if next.cost >= best.cost {
                break;
            }
            best = next;
        }
        Ok(best)
    }
}

/// The families of sizes among profiles, in their order.
fn families(matched: &[Profile]) -> Vec<ProfileChoice> {
    let mut families: Vec<ProfileChoice> = Vec::new();
    let sized = matched.iter().filter(|p| !matches!(p.shape, Shape::Freeform(_)));
    for family in sized.filter_map(|p| p.shape.family().parse().ok()) {
        if !families.contains(&family) {
            families.push(family);
        }
    }
    families
}

fn pairs(requirements: &[Requirement]) -> Vec<Vec<&Requirement>> {
    let with = |(i, a)| requirements[i + 1..].iter().map(move |b| vec![a, b]);
    requirements.iter().enumerate().flat_map(with).collect()
}

/// The beams of each profile.
fn sharing<'r>(requirements: &'r [Requirement], found: &Reduction) -> Vec<Vec<&'r Requirement>> {
    let mut shared: Vec<Vec<&Requirement>> = vec![Vec::new(); found.profiles.len()];
    for (beam, &profile) in requirements.iter().zip(&found.profile_of) {
        shared[profile].push(beam);
    }
    shared
}

/// A size of every family for every set of beams.
fn fits(
    families: &[ProfileChoice],
    sets: &[Vec<&Requirement>],
    mode: MatchMode,
    keep_on: KeepOn<'_>,
) -> Result<Vec<Profile>, MatchError> {
    let mut found = Vec::with_capacity(families.len() * sets.len());
    for set in sets {
        keep_on()?;
        let target = together(set, mode);
        for family in families {
            found.push(Profile::new(fitted(family, &target, mode)?)?);
        }
    }
    Ok(found)
}

/// Freeform outlines at all sizes, each of which takes some milliseconds to weigh: a frame of 60 kinds
/// of beams has every outline at the size of every beam.
const MOST_OUTLINES: usize = 4096;

/// Every freeform outline, scaled to what every beam needs, or to what every so many of the beams do.
fn outlines(
    matched: &[Profile],
    requirements: &[Requirement],
    mode: MatchMode,
    keep_on: KeepOn<'_>,
) -> Result<Vec<Profile>, MatchError> {
    let mut found = Vec::new();
    let freeform = || matched.iter().filter(|p| matches!(p.shape, Shape::Freeform(_)));
    let mut sizes: Vec<&Requirement> = requirements.iter().collect();
    let stride = (freeform().count() * sizes.len()).div_ceil(MOST_OUTLINES);
    if stride > 1 {
        sizes.sort_by(|a, b| a.target.area.total_cmp(&b.target.area));
        sizes = sizes.into_iter().skip(stride / 2).step_by(stride).collect();
    }
    for outline in freeform() {
        keep_on()?;
        let own = outline.properties()?;
        for Requirement { target, .. } in &sizes {
            let scale = match mode {
                MatchMode::Stiffness => {
                    (target.mean_moment() / (own.i_1 * own.i_2).sqrt()).powf(0.25)
                }
                MatchMode::Area | MatchMode::NotWeaker => target.scale(&own, mode),
            };
            found.push(Profile::new(outline.shape.scaled(scale))?);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::section::matching::{MatchErrors, MatchTarget};
    use crate::section::properties::SectionProperties;

    const MODES: [MatchMode; 3] = [MatchMode::Stiffness, MatchMode::Area, MatchMode::NotWeaker];

    fn properties(shape: &Shape) -> SectionProperties {
        Profile::new(shape.clone()).unwrap().properties().unwrap()
    }

    fn beams(shapes: &[(Shape, f64)]) -> (Vec<Requirement>, Vec<Profile>) {
        let need = |(shape, length): &(Shape, f64)| Requirement {
            target: MatchTarget::of_properties(&properties(shape)),
            length: *length,
        };
        let own = shapes.iter().map(|(shape, _)| Profile::new(shape.clone()).unwrap());
        (shapes.iter().map(need).collect(), own.collect())
    }

    fn rounds(bars: &[(f64, f64)]) -> (Vec<Requirement>, Vec<Profile>) {
        let shapes: Vec<_> = bars.iter().map(|&(d, l)| (Shape::Round { d }, l)).collect();
        beams(&shapes)
    }

    fn chosen(
        requirements: &[Requirement],
        matched: &[Profile],
        max: usize,
        choice: &ProfileChoice,
        mode: MatchMode,
    ) -> Reduction {
        let catalogue = Catalogue::builtin();
        FewProfiles { requirements, matched, max, choice, mode, catalogue }.choose().unwrap()
    }

    /// The cost of one profile for one beam, written out once more.
    fn cost(own: &SectionProperties, beam: &Requirement, mode: MatchMode) -> f64 {
        let t = &beam.target;
        let stiffness = ((own.i_1 / t.i_1).ln().powi(2) + (own.i_2 / t.i_2).ln().powi(2)).sqrt();
        let area = (own.area / t.area).ln().abs();
        beam.length
            * match mode {
                MatchMode::Stiffness => stiffness + 0.01 * area,
                MatchMode::Area => area + 0.01 * stiffness,
                MatchMode::NotWeaker if MatchErrors::of(own, t).is_not_weaker() => own.area,
                MatchMode::NotWeaker => f64::INFINITY,
            }
    }

    /// The least cost of two profiles out of a pool.
    fn least_of_two(pool: &[SectionProperties], beams: &[Requirement], mode: MatchMode) -> f64 {
        let mut least = f64::INFINITY;
        for a in pool {
            for b in pool {
                let best = |r: &Requirement| cost(a, r, mode).min(cost(b, r, mode));
                least = least.min(beams.iter().map(best).sum());
            }
        }
        least
    }

    #[test]
    fn two_of_a_catalogue_are_the_least_of_all_pairs() {
        let (beams, _) = rounds(&[(21.0, 300.0), (30.0, 900.0), (34.0, 200.0), (52.0, 500.0)]);
        let choice: ProfileChoice = "catalogue:CHS".parse().unwrap();
        let tubes = Catalogue::builtin().of_families(&["CHS"]).unwrap();
        let pool: Vec<_> = tubes.entries().iter().map(|e| e.properties).collect();
        for mode in MODES {
            let two = chosen(&beams, &[], 2, &choice, mode);
            let least = least_of_two(&pool, &beams, mode);
            assert!(two.is_least && two.profiles.len() <= 2);
            assert!((two.cost / least - 1.0).abs() < 1e-9, "{mode}: {} for {least}", two.cost);
        }
    }

    #[test]
    fn a_profile_nobody_was_matched_to_may_serve_all() {
        // Between two tubes lies a third that is nearer to both than they are to each other.
        let (beams, _) = rounds(&[(24.0, 100.0), (32.0, 100.0)]);
        let choice: ProfileChoice = "catalogue:CHS".parse().unwrap();
        let of = |target: &MatchTarget| {
            let mode = MatchMode::NotWeaker;
            super::super::match_profile(target, &choice, mode, Catalogue::builtin()).unwrap()
        };
        let matched: Vec<Profile> = beams.iter().map(|b| of(&b.target).profile).collect();
        let all = |mode| chosen(&beams, &matched, 1, &choice, mode);
        assert!(!matched.contains(&all(MatchMode::Stiffness).profiles[0]));
        assert_eq!(all(MatchMode::NotWeaker).profiles[0], matched[1]);
    }

    #[test]
    fn one_bar_for_all_is_the_median_bar_by_length() {
        let one = |bars: &[(f64, f64)], mode| {
            let (beams, own) = rounds(bars);
            let choice = ProfileChoice::Round;
            let all = chosen(&beams, &own, 1, &choice, mode);
            all.profiles[0].to_string()
        };
        let bars = [(10.0, 100.0), (12.0, 100.0), (20.0, 100.0)];
        assert_eq!(one(&bars, MatchMode::Stiffness), "Round 12");
        assert_eq!(one(&bars, MatchMode::Area), "Round 12");
        assert_eq!(one(&bars, MatchMode::NotWeaker), "Round 20");
        let long = [(10.0, 100.0), (12.0, 100.0), (20.0, 250.0)];
        assert_eq!(one(&long, MatchMode::Stiffness), "Round 20");
    }

    #[test]
    fn flats_none_of_which_can_stand_for_the_other_get_one_that_can() {
        let flat = |b: f64, h: f64| (Shape::Rectangle { b, h }, 100.0);
        let (beams, own) = beams(&[flat(10.0, 24.0), flat(16.0, 16.0), flat(12.0, 12.0)]);
        let choice = ProfileChoice::Rectangle;
        for max in [1, 2] {
            let mode = MatchMode::NotWeaker;
            let found = chosen(&beams, &own, max, &choice, mode);
            for (beam, &place) in beams.iter().zip(&found.profile_of) {
                let own = found.profiles[place].properties().unwrap();
                assert!(MatchErrors::of(&own, &beam.target).is_not_weaker());
                assert!(own.area <= 16.0 * 24.0);
            }
        }
    }

    #[test]
    fn two_flats_for_many_cost_no_more_than_the_best_two_of_them() {
        let shapes: Vec<_> = (0..30)
            .map(|i| {
                let (b, h) = (8.0 + f64::from(i * i % 7), 12.0 + f64::from(i * 5 % 11));
                (Shape::Rectangle { b, h }, 50.0 + f64::from(i * 13 % 40))
            })
            .collect();
        let (beams, own) = beams(&shapes);
        let pool: Vec<_> = shapes.iter().map(|s| properties(&s.0)).collect();
        for mode in MODES {
            let choice = ProfileChoice::Rectangle;
            let two = chosen(&beams, &own, 2, &choice, mode);
            assert!(two.cost <= least_of_two(&pool, &beams, mode) * (1.0 + 1e-9), "{mode}");
        }
    }
}
