//! What the pieces of a branch fill, and how much of it sticks out of the material.

use nalgebra::Rotation2;

use super::beam_axes::BeamAxes;
use super::direction;
use super::measured::mean_contour;
use super::pieces::{Making, Piece};
use super::volume::{is_in, spread};
use crate::mesh::Shadow;
use crate::section::contours::signed_area;

/// Part of its volume from which on a branch sticks out too far.
const MOST_OUTSIDE: f64 = 0.08;

/// Samples of the box round a piece: its part outside is known within some thousandths.
const SAMPLES: usize = 1024;

/// Samples inside each piece that tell of a branch that hardly sticks out: its part outside is known
/// within a hundredth.
const FEW_SAMPLES: usize = 200;

/// Part of its volume, found with few samples, up to which a branch hardly sticks out.
const HARDLY_OUTSIDE: f64 = 0.5 * MOST_OUTSIDE;

/// What the pieces of a branch fill, each built with the mean contour of its sections.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Filled {
    /// Number of pieces.
    pub(super) pieces: u32,
    /// Volume, mm³.
    pub(super) volume: f64,
    /// What of it lies outside of the material, mm³.
    outside: f64,
}

impl Filled {
    /// Number of pieces of a branch.
    pub(super) fn count(making: &Making<'_>, branch: usize) -> u32 {
        making.pieces.iter().filter(|p| p.branch == branch).count() as u32
    }

    /// Measures a branch.
    pub(super) fn of_branch(making: &Making<'_>, branch: usize, shadow: &Shadow<'_>) -> Self {
        Self::sampled(making, branch, shadow, SAMPLES)
    }

    /// Measures a branch roughly, and as well as others only where it might stick out too far.
    pub(super) fn at_a_glance(making: &Making<'_>, branch: usize, shadow: &Shadow<'_>) -> Self {
        let rough = Self::sampled(making, branch, shadow, FEW_SAMPLES);
        if rough.part_outside() <= HARDLY_OUTSIDE {
            return rough;
        }
        Self::of_branch(making, branch, shadow)
    }

    /// * `most`: samples inside each piece, at most.
    fn sampled(making: &Making<'_>, branch: usize, shadow: &Shadow<'_>, most: usize) -> Self {
        let mut sum = Self::default();
        for piece in making.pieces.iter().filter(|p| p.branch == branch) {
            sum.pieces += 1;
            sum.add(making, piece, shadow, most);
        }
        sum
    }

    /// Adds what another branch fills.
    pub(super) fn and(&self, other: &Self) -> Self {
        Self {
            pieces: self.pieces + other.pieces,
            volume: self.volume + other.volume,
            outside: self.outside + other.outside,
        }
    }

    /// Adds a piece; one without sections fills nothing that is known.
    fn add(&mut self, making: &Making<'_>, piece: &Piece, shadow: &Shadow<'_>, most: usize) {
        let section = making.own_beam_section(piece);
        let Some(outline) = mean_contour(&section) else { return };
        // Samples that lie along the section tell the same of a part however it is turned.
        let (.., angle) = section.mean.principal();
        let roll = Rotation2::new(angle);
        let [start, end] = making.axis(piece);
        let axes = BeamAxes::along(direction(&start, &end));
        let reach = outline.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
        let all = spread(SAMPLES).map(|(t, across)| (t, roll * across * reach));
        let (mut inside, mut outside) = (0_u32, 0_u32);
        for (t, across) in all.filter(|(_, across)| is_in(&outline, across)).take(most) {
            let at = start + (end - start) * t + *axes.y * across.x + *axes.z * across.y;
            let hit = if shadow.contains(&at) { &mut inside } else { &mut outside };
            *hit += 1;
        }
        let volume = signed_area(&outline).abs() * (end - start).norm();
        self.volume += volume;
        self.outside += volume * f64::from(outside) / f64::from((inside + outside).max(1));
    }

    /// Whether too much sticks out.
    pub(super) fn sticks_out(&self) -> bool {
        self.outside > MOST_OUTSIDE * self.volume
    }

    /// The part that sticks out.
    pub(super) fn part_outside(&self) -> f64 {
        if self.volume > 0.0 { self.outside / self.volume } else { 0.0 }
    }
}
