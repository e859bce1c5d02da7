//! Fewer different profiles over a whole frame, at least cost.
//!
//! Every beam gets one of at most N profiles out of a pool. The cost of a choice is
//!
//! | mode         | cost of a beam of length ℓ                        | unit |
//! |--------------|---------------------------------------------------|------|
//! | `stiffness`  | ℓ (√(ln² I_1/I_1ᵐ + ln² I_2/I_2ᵐ) + ε │ln A/Aᵐ│)   | mm   |
//! | `area`       | ℓ (│ln A/Aᵐ│ + ε √(ln² I_1/I_1ᵐ + ln² I_2/I_2ᵐ))   | mm   |
//! | `not-weaker` | ℓ A, where no property is less; else not allowed  | mm³  |
//!
//! (ᵐ: measured; ε = 0.01 decides between profiles that are as good). For small errors ln x/xᵐ is
//! the relative error. To choose N out of a pool is the weighted N-median problem. With few enough
//! choices all are tried, and the result is the least. Otherwise profiles are added greedily and
//! then exchanged one by one for any other of the pool while that lowers the cost (vertex
//! substitution; Teitz and Bart, Oper. Res. 16, 1968): no single exchange can improve the result,
//! and for the first two modes, whose costs are distances, it costs at most five times the least
//! (Arya et al., SIAM J. Comput. 33, 2004); in practice it is the least or nearly so.

use super::{MatchError, MatchErrors, MatchMode, MatchTarget};
use crate::section::profile::Profile;
use crate::section::properties::SectionProperties;

/// Sums up to which all choices are tried, a sum being one profile for one beam: a tenth of a
/// second.
const TRY_ALL: usize = 20_000_000;

/// Part of the second measure in the cost: 1 % of it is worth 0.01 % of the first, less than
/// sections are measured to.
const SECOND: f64 = 0.01;

/// Rounds of exchanges; each lowers the cost, and more than ten have not been seen.
const MOST_ROUNDS: usize = 100;

/// A beam that needs a profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirement {
    /// Its measured section.
    pub target: MatchTarget,
    /// Its length, mm.
    pub length: f64,
}

/// The chosen profiles and who gets which.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduction {
    /// The chosen profiles, in the order of the pool.
    pub profiles: Vec<Profile>,
    /// Profile of each beam.
    pub profile_of: Vec<usize>,
    /// Total cost, see the table above for the unit.
    pub cost: f64,
    /// Whether no other choice costs less for certain.
    pub is_least: bool,
}

/// Chooses at most `max` profiles out of a pool for all beams.
///
/// * `pool`: the profiles matched to the beams one by one, and any others that may be used, such
///   as the families of a catalogue. Equal ones count once.
///
/// # Errors
/// If `max` is 0, the pool is empty, a target is not positive, or, for `not-weaker`, no `max`
/// profiles of the pool are strong enough for all beams.
///
/// # Examples
/// ```
/// # use beamwright::section::matching::{MatchMode, MatchTarget, Requirement, reduce_profiles};
/// # use beamwright::section::{Profile, Shape};
/// let bars = [10.0, 10.2, 16.0].map(|d| Profile::new(Shape::Round { d }).unwrap());
/// let requirements: Vec<_> = bars
///     .iter()
///     .map(|bar| MatchTarget::of_properties(&bar.properties().unwrap()))
///     .map(|target| Requirement { target, length: 100.0 })
///     .collect();
/// let two = reduce_profiles(&requirements, &bars, 2, MatchMode::NotWeaker)?;
/// assert_eq!(two.profile_of, [0, 0, 1]);
/// assert_eq!(two.profiles[0].to_string(), "Round 10.2");
/// # Ok::<(), beamwright::section::matching::MatchError>(())
/// ```
pub fn reduce_profiles(
    requirements: &[Requirement],
    pool: &[Profile],
    max: usize,
    mode: MatchMode,
) -> Result<Reduction, MatchError> {
    reduce_watched(requirements, pool, max, mode, &mut || Ok(()))
}

/// Asked within long loops; an error ends them.
pub(super) type KeepOn<'k> = &'k mut dyn FnMut() -> Result<(), MatchError>;

/// The same, unless `keep_on` asks to stop.
pub(super) fn reduce_watched(
    requirements: &[Requirement],
    pool: &[Profile],
    max: usize,
    mode: MatchMode,
    keep_on: KeepOn<'_>,
) -> Result<Reduction, MatchError> {
    if max == 0 {
        return Err(MatchError::NoProfilesAllowed);
    }
    requirements.iter().try_for_each(|beam| beam.target.check())?;
    let pool = distinct(pool, keep_on)?;
    if pool.is_empty() {
        return Err(MatchError::EmptyCatalogue);
    }
    let properties: Vec<SectionProperties> =
        pool.iter().map(|profile| weighed(profile, keep_on)).collect::<Result<_, _>>()?;
    let costs: Vec<Vec<f64>> = properties
        .iter()
        .map(|own| requirements.iter().map(|beam| cost(own, beam, mode)).collect())
        .collect();
    let max = max.min(pool.len());
    let sums = choices(pool.len(), max).saturating_mul(max * requirements.len());
    let is_least = sums <= TRY_ALL;
    let mut chosen =
        if is_least { try_all(&costs, max) } else { greedy_then_exchange(&costs, max, keep_on)? };
    chosen.sort_unstable();
    let profile_of: Vec<usize> =
        (0..requirements.len()).map(|beam| cheapest(&costs, &chosen, beam)).collect();
    let total = Total::of(&costs, &chosen);
    if total.unserved > 0 {
        let area = requirements.iter().map(|beam| beam.target.area).fold(0.0, f64::max);
        return Err(MatchError::NoneStrongEnough { profiles: pool.len(), area });
    }
    Ok(reduction(&pool, &chosen, &profile_of, total.cost, is_least))
}

/// Leaves out chosen profiles that nobody got.
fn reduction(
    pool: &[&Profile],
    chosen: &[usize],
    profile_of: &[usize],
    cost: f64,
    is_least: bool,
) -> Reduction {
    let used: Vec<usize> = (0..chosen.len()).filter(|place| profile_of.contains(place)).collect();
    let renumbered = |place: &usize| used.binary_search(place).unwrap_or(0);
    Reduction {
        profiles: used.iter().map(|&place| pool[chosen[place]].clone()).collect(),
        profile_of: profile_of.iter().map(renumbered).collect(),
        cost,
        is_least,
    }
}

fn distinct<'p>(pool: &'p [Profile], keep_on: KeepOn<'_>) -> Result<Vec<&'p Profile>, MatchError> {
    let mut kept: Vec<&Profile> = Vec::new();
    for profile in pool {
        keep_on()?;
        if !kept.contains(&profile) {
            kept.push(profile);
        }
    }
    Ok(kept)
}

fn weighed(profile: &Profile, keep_on: KeepOn<'_>) -> Result<SectionProperties, MatchError> {
    keep_on()?;
    Ok(profile.properties()?)
}

fn cost(own: &SectionProperties, beam: &Requirement, mode: MatchMode) -> f64 {
    let target = &beam.target;
    let log = |is: f64, goal: f64| (is / goal).ln();
    let stiffness = log(own.i_1, target.i_1).hypot(log(own.i_2, target.i_2));
    let area = log(own.area, target.area).abs();
    beam.length
        * match mode {
            MatchMode::Stiffness => stiffness + SECOND * area,
            MatchMode::Area => area + SECOND * stiffness,
            MatchMode::NotWeaker if MatchErrors::of(own, target).is_not_weaker() => own.area,
            MatchMode::NotWeaker => f64::INFINITY,
        }
}

/// Cost of a choice: first the beams it leaves without a profile, then the sum of the rest.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Total {
    unserved: usize,
    cost: f64,
}

impl Total {
    fn of(costs: &[Vec<f64>], chosen: &[usize]) -> Self {
        let beams = costs.first().map_or(0, Vec::len);
        let least =
            |beam: usize| chosen.iter().map(|&p| costs[p][beam]).fold(f64::INFINITY, f64::min);
        Self::sum((0..beams).map(least))
    }

    fn sum(costs: impl Iterator<Item = f64>) -> Self {
        let mut total = Self { unserved: 0, cost: 0.0 };
        for cost in costs {
            if cost.is_finite() {
                total.cost += cost;
            } else {
                total.unserved += 1;
            }
        }
        total
    }
}

/// Place in `chosen` of the cheapest profile for a beam; the first of equals.
fn cheapest(costs: &[Vec<f64>], chosen: &[usize], beam: usize) -> usize {
    let by_cost =
        |&a: &usize, &b: &usize| costs[chosen[a]][beam].total_cmp(&costs[chosen[b]][beam]);
    (0..chosen.len()).min_by(by_cost).unwrap_or(0)
}

/// Ways to choose k of n, or more than [`TRY_ALL`].
fn choices(n: usize, k: usize) -> usize {
    let mut ways: usize = 1;
    for i in 0..k {
        ways = ways.saturating_mul(n - i) / (i + 1);
        if ways > TRY_ALL {
            return ways;
        }
    }
    ways
}

fn try_all(costs: &[Vec<f64>], k: usize) -> Vec<usize> {
    let n = costs.len();
    let mut chosen: Vec<usize> = (0..k).collect();
    let mut best = (Total::of(costs, &chosen), chosen.clone());
    // The next choice in dictionary order, until the last place cannot move any more.
    while let Some(place) = (0..k).rev().find(|&i| chosen[i] < n - k + i) {
        chosen[place] += 1;
        for i in place + 1..k {
            chosen[i] = chosen[i - 1] + 1;
        }
        let total = Total::of(costs, &chosen);
        if total < best.0 {
            best = (total, chosen.clone());
        }
    }
    best.1
}

fn greedy_then_exchange(
    costs: &[Vec<f64>],
    k: usize,
    keep_on: KeepOn<'_>,
) -> Result<Vec<usize>, MatchError> {
    let mut chosen = Vec::with_capacity(k);
    while chosen.len() < k {
        chosen.push(0);
        let place = chosen.len() - 1;
        keep_on()?;
        exchange(costs, &mut chosen, place);
    }
    for _ in 0..MOST_ROUNDS {
        let before = Total::of(costs, &chosen);
        for place in 0..k {
            keep_on()?;
            exchange(costs, &mut chosen, place);
        }
        if Total::of(costs, &chosen) >= before {
            break;
        }
    }
    Ok(chosen)
}

/// Puts the best profile of the pool into one place.
fn exchange(costs: &[Vec<f64>], chosen: &mut [usize], place: usize) {
    let others = chosen.iter().enumerate().filter(|&(i, _)| i != place).map(|(_, &p)| p);
    // What every beam costs without the place.
    let mut rest = vec![f64::INFINITY; costs[chosen[place]].len()];
    for p in others {
        rest.iter_mut().zip(&costs[p]).for_each(|(least, cost)| *least = least.min(*cost));
    }
    let with = |p: usize| Total::sum(rest.iter().zip(&costs[p]).map(|(a, b)| a.min(*b)));
    let mut best = (with(chosen[place]), chosen[place]);
    for candidate in 0..costs.len() {
        let total = with(candidate);
        if total < best.0 {
            best = (total, candidate);
        }
    }
    chosen[place] = best.1;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::section::catalogue::Catalogue;
    use crate::section::profile::Shape;

    fn bars(diameters: &[f64]) -> (Vec<Requirement>, Vec<Profile>) {
        let profiles: Vec<Profile> =
            diameters.iter().map(|&d| Profile::new(Shape::Round { d }).unwrap()).collect();
        let requirements = profiles
            .iter()
            .map(|bar| Requirement {
                target: MatchTarget::of_properties(&bar.properties().unwrap()),
                length: 100.0,
            })
            .collect();
        (requirements, profiles)
    }

    #[test]
    fn enough_profiles_cost_nothing() {
        let (beams, pool) = bars(&[5.0, 8.0, 5.0, 13.0]);
        let all = reduce_profiles(&beams, &pool, 5, MatchMode::Stiffness).unwrap();
        assert_eq!((all.cost, all.profiles.len()), (0.0, 3));
        assert_eq!(all.profile_of, [0, 1, 0, 2]);
    }

    #[test]
    fn exchange_finds_what_trying_all_finds() {
        let diameters: Vec<f64> = (0..18).map(|i| 6.0 + f64::from(i * i % 19)).collect();
        let (beams, pool) = bars(&diameters);
        for mode in [MatchMode::Stiffness, MatchMode::Area, MatchMode::NotWeaker] {
            let costs: Vec<Vec<f64>> = pool
                .iter()
                .map(|p| p.properties().unwrap())
                .map(|own| beams.iter().map(|beam| cost(&own, beam, mode)).collect())
                .collect();
            for k in 1..5 {
                let least = Total::of(&costs, &try_all(&costs, k));
                let found =
                    Total::of(&costs, &greedy_then_exchange(&costs, k, &mut || Ok(())).unwrap());
                assert_eq!(found.unserved, least.unserved);
                assert!(found.cost <= 1.02 * least.cost, "{mode} {k}: {found:?} {least:?}");
            }
        }
    }

    #[test]
    fn reduced_profiles_are_not_weaker_for_anyone() {
        let (beams, _) = bars(&[10.0, 14.0, 22.0, 30.0, 31.0, 44.0]);
        let pool: Vec<Profile> = Catalogue::builtin()
            .of_families(&["CHS", "SHS"])
            .unwrap()
            .entries()
            .iter()
            .map(|entry| entry.profile.clone())
            .collect();
        let two = reduce_profiles(&beams, &pool, 2, MatchMode::NotWeaker).unwrap();
        assert_eq!(two.profiles.len(), 2);
        for (beam, &place) in beams.iter().zip(&two.profile_of) {
            let own = two.profiles[place].properties().unwrap();
            assert!(MatchErrors::of(&own, &beam.target).is_not_weaker());
        }
    }

    #[test]
    fn impossible_reductions_are_refused() {
        let (beams, pool) = bars(&[10.0, 14.0]);
        let none = reduce_profiles(&beams, &pool, 0, MatchMode::Area);
        assert_eq!(none, Err(MatchError::NoProfilesAllowed));
        let weak = reduce_profiles(&beams, &pool[..1], 1, MatchMode::NotWeaker);
        assert!(matches!(weak, Err(MatchError::NoneStrongEnough { .. })));
        let empty = reduce_profiles(&beams, &[], 1, MatchMode::Area);
        assert_eq!(empty, Err(MatchError::EmptyCatalogue));
    }
}
