//! Lays branches anew whose beams would stick out of the material.
//!
//! A beam that is off by the wanted deviation is good enough for a slim strut; a fat leg that bows
//! as much sticks out by a sixth of its volume. Two things help: its ends leave the middle of their
//! interface sections (`free_ends`), or it is broken where it bends by less than else:
//!
//! ```text
//!    ╭────────╮           ╭────────╮
//!    ●━━━━━━━━━━━●        ●━━━╲
//!    ╰────╯   ╰──╲        ╰──╯╲╲──
//! ```
//!
//! Every way is tried, and each branch keeps the one of least cost:
//!
//! ```text
//!   cost = part of its volume outside  +  price · pieces
//! ```

use std::ops::ControlFlow;

use super::bend::offsets_from;
use super::filled::Filled;
use super::pieces::Making;
use crate::mesh::{Shadow, Surface};

/// Price of a piece: a corner must take away more than this part of the volume of its branch. The
/// bent legs of a tripod gain 4 by theirs, rough cast struts one.
const PRICE: f64 = 0.02;

/// Most a branch that does not stick out may bow to be called straight, in half-depths: struts that
/// leave one pad bow by 0.002, the legs of a rough cantilever by 0.03.
const STRAIGHT: f64 = 0.02;

/// How a branch is laid.
#[derive(Clone, Copy, PartialEq)]
struct Laying {
    /// Whether its ends at interface sections go where it meets their planes.
    free_ends: bool,
    /// How far it may bend from its pieces, in parts of what is wanted.
    closer: f64,
}

/// Free ends alone, which take corners away.
const FREE_ENDS: Laying = Laying { free_ends: true, closer: 1.0 };

/// What is tried: ways with fewer pieces come first.
const LAYINGS: [Laying; 5] = [
    FREE_ENDS,
    Laying { free_ends: false, closer: 0.7 },
    Laying { free_ends: false, closer: 0.5 },
    Laying { free_ends: true, closer: 0.7 },
    Laying { free_ends: true, closer: 0.5 },
];

/// The best way found for a branch.
struct Choice {
    now: Filled,
    cost: f64,
    laying: Option<Laying>,
}

impl Choice {
    fn new(now: Filled) -> Self {
        Self { now, cost: cost(&now), laying: None }
    }

    /// Takes a way if it costs less.
    fn consider(&mut self, laying: Laying, then: &Filled) {
        if then.pieces > 0 && cost(then) < self.cost {
            (self.cost, self.laying) = (cost(then), Some(laying));
        }
    }
}

fn cost(filled: &Filled) -> f64 {
    filled.part_outside() + PRICE * f64::from(filled.pieces)
}

/// What a frame fills, and what its branches cost together, each as much as its volume.
pub(super) fn frame_cost(making: &Making<'_>, shadow: &Shadow<'_>) -> (Filled, f64) {
    let branches = 0..making.skeleton.branches.len();
    let filled = branches.map(|branch| Filled::at_a_glance(making, branch, shadow));
    filled.fold((Filled::default(), 0.0), |(sum, costs), branch| {
        (sum.and(&branch), costs + cost(&branch) * branch.volume)
    })
}

/// Lays branches anew: those that stick out too far, and straight ones with a corner that only
/// leads to the middle of an interface section.
///
/// `settle` moves and breaks the pieces until they follow their branches, or asks to stop.
pub(super) fn lay_anew<'a>(
    making: &mut Making<'a>,
    surface: &Surface,
    shadow: &Shadow<'_>,
    mut settle: impl FnMut(&mut Making<'a>) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let branches = 0..making.skeleton.branches.len();
    let now = |branch| {
        // Only of those that are tried the cost is asked.
        let is_tried = is_broken_at_interface(making, branch);
        let measure = if is_tried { Filled::of_branch } else { Filled::at_a_glance };
        Choice::new(measure(making, branch, shadow))
    };
    let mut choices: Vec<Choice> = branches.clone().map(now).collect();
    for laying in LAYINGS {
        let is_tried = |&b: &usize| {
            choices[b].now.sticks_out()
                || (laying == FREE_ENDS && is_broken_at_interface(making, b))
        };
        let tried: Vec<usize> = branches.clone().filter(is_tried).collect();
        if tried.is_empty() {
            continue;
        }
        let ways: Vec<(usize, Laying)> = tried.iter().map(|&b| (b, laying)).collect();
        let trial = laid(making, &ways, surface, &mut settle)?;
        for branch in tried {
            let choice = &mut choices[branch];
            // However well it fills the material, it costs more.
            if PRICE * f64::from(Filled::count(&trial, branch)) >= choice.cost {
                continue;
            }
            let then = Filled::of_branch(&trial, branch, shadow);
            let is_plain = || then.pieces < choice.now.pieces && bow(&trial, branch) < STRAIGHT;
            if choice.now.sticks_out() || is_plain() {
                choice.consider(laying, &then);
            }
        }
    }
    let numbered = choices.into_iter().enumerate();
    let ways: Vec<_> = numbered.filter_map(|(branch, c)| c.laying.map(|l| (branch, l))).collect();
    if !ways.is_empty() {
        *making = laid(making, &ways, surface, &mut settle)?;
    }
    ControlFlow::Continue(())
}

/// The pieces with some branches laid in other ways.
fn laid<'a>(
    making: &Making<'a>,
    ways: &[(usize, Laying)],
    surface: &Surface,
    settle: &mut impl FnMut(&mut Making<'a>) -> ControlFlow<()>,
) -> ControlFlow<(), Making<'a>> {
    let mut making = making.clone();
    for &(branch, laying) in ways {
        making.tolerances[branch] *= laying.closer;
        if laying.free_ends {
            making.free_ends(branch);
        }
    }
    making.drop_unused_nodes();
    settle(&mut making)?;
    if ways.iter().any(|(_, laying)| laying.free_ends) && making.reach_caps(surface) {
        settle(&mut making)?;
    }
    ControlFlow::Continue(making)
}

/// Whether a branch has a corner on the way from an interface section.
fn is_broken_at_interface(making: &Making<'_>, branch: usize) -> bool {
    let mut own = making.pieces.iter().filter(|p| p.branch == branch);
    let leads = |from: usize, to: usize| {
        making.is_interface(from) && making.corner_points.contains_key(&to)
    };
    own.any(|p| leads(p.ends[0], p.ends[1]) || leads(p.ends[1], p.ends[0]))
}

/// Root mean square of the distances of the centroids of a branch from its pieces, in half-depths.
fn bow(making: &Making<'_>, branch: usize) -> f64 {
    let own = making.pieces.iter().filter(|p| p.branch == branch);
    let offsets: Vec<f64> = own.flat_map(|p| offsets_from(making, p, making.axis(p))).collect();
    let squares: f64 = offsets.iter().map(|o| o * o).sum();
    (squares / offsets.len().max(1) as f64).sqrt()
}
