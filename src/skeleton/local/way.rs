//! The fronts that a march has come along.

use super::band::Front;

/// The way of a march in one direction.
#[derive(Default)]
pub(super) struct Way {
    /// The fronts so far, the seed first.
    pub(super) fronts: Vec<Front>,
    /// The step to try next, in wanted ones.
    pub(super) part: f64,
}

impl Way {
    pub(super) fn from(seed: Front) -> Self {
        Self { fronts: vec![seed], part: 1.0 }
    }
}

/// A marched piece of branch: fronts from one end to the other.
#[derive(Clone, Debug)]
pub(crate) struct Tube {
    pub(crate) fronts: Vec<Front>,
}

impl Tube {
    /// The front in the middle.
    pub(crate) fn middle(&self) -> &Front {
        &self.fronts[self.fronts.len() / 2]
    }
}

/// Length of a march across its fronts, mm: centroids that wander sideways, as those of slant cuts
/// through a joint do, come no farther. `which` of the two fronts of a step says what is across.
pub(super) fn length(fronts: &[Front], which: usize) -> f64 {
    fronts
        .windows(2)
        .map(|w| (w[1].extent.centroid - w[0].extent.centroid).dot(&w[which].plane.normal))
        .sum()
}

/// The front at least `distance` behind the last one, or the first.
pub(super) fn behind(fronts: &[Front], distance: f64) -> &Front {
    let last = fronts[fronts.len() - 1].extent.centroid;
    fronts
        .iter()
        .rev()
        .find(|f| (f.extent.centroid - last).norm() >= distance)
        .unwrap_or(&fronts[0])
}
