//! Beams that are one piece: alike in section, length and cuts, however they lie.
//!
//! ```text
//!    ╱▔▔▔▔▔▔▔▔▔▏   turned end for end:   ▕▔▔▔▔▔▔▔▔▔╱   one piece of a round bar, two of an angle
//!   ╱▁▁▁▁▁▁▁▁▁▁▏                         ▕▁▁▁▁▁▁▁▁▁▁╲
//! ```
//!
//! A mesh is never quite symmetric, so that equal members of a symmetric part come out a little
//! different. Beams are one kind where no corner of one lies farther from that of another, *laid into*
//! its place ([`laid`]), than [`SAME_PIECE`], unless they fall into two kinds with a gap between them.
//! The first beam of a kind is its *model*; the others are made as it is. A piece and its mirror image
//! are two pieces where no motion brings one onto the other.

mod laid;
#[cfg(test)]
mod tests;

use nalgebra::Isometry3;

use super::CutBeam;
use crate::cluster;
use crate::frame::Frame;
use laid::Member;

/// Farthest a corner of a beam may lie from that of its model, in section radii. Equal members of
/// parts meshed three elements to a radius differ by half of it at oblique cuts; the gap it may
/// leave at a joint of a bar of 60 mm, 3 mm, is the widest root gap a weld is made with.
pub const SAME_PIECE: f64 = 0.1;

/// Beams of one kind follow each other by less than this, in section radii: half of
/// [`SAME_PIECE`]. Members that were drawn to differ by more, with nothing between, stay apart
/// however near their lengths and angles are.
const NEXT_PIECE: f64 = 0.05;

/// Beams nearer than this, in section radii, are compared with the others as one: what a saw can do.
const NO_OTHER: f64 = 0.01;

/// The piece a beam is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alike {
    /// Number of the kind; kinds are numbered by their first beam.
    pub kind: usize,
    /// The beam the piece is made after: the first of its kind.
    pub model: usize,
    /// From the solid of the model to that of the beam, both in their own coordinates: the first
    /// two across (y and z of the beam turned by its roll), the third along, from the first node.
    pub motion: Isometry3<f64>,
    /// Farthest a corner of the beam lies from that of the model laid into it, mm.
    pub off: f64,
}

/// Finds the beams that are one piece.
pub(super) fn alike(frame: &Frame, cuts: &[CutBeam]) -> Vec<Alike> {
    let all: Vec<Member<'_>> =
        frame.beams.iter().zip(cuts).map(|(beam, cut)| Member::new(beam, cut)).collect();
    let group_of = groups(&all);
    let mut models: Vec<usize> = Vec::new();
    let mut found: Vec<Alike> = Vec::with_capacity(all.len());
    for (i, own) in all.iter().enumerate() {
        let of_group = models.iter().enumerate().filter(|(_, m)| group_of[**m] == group_of[i]);
        let fitting = of_group
            .filter_map(|(kind, &model)| {
                // A beam that stands for another is up to so much nearer to the rest.
                let laid = all[model].laid_into(own, SAME_PIECE + 2.0 * NO_OTHER)?;
                Some(Alike { kind, model, motion: laid.motion, off: laid.off * own.radius })
            })
            .next();
        found.push(fitting.unwrap_or_else(|| {
            models.push(i);
            Alike { kind: models.len() - 1, model: i, motion: own.centring(), off: 0.0 }
        }));
    }
    found
}

/// Number of the group of each member.
///
/// Of members that hardly differ only the first is compared with the rest: a frame has few kinds.
fn groups(all: &[Member<'_>]) -> Vec<usize> {
    let mut leaders: Vec<usize> = Vec::new();
    let mut leader_of = Vec::with_capacity(all.len());
    for (i, own) in all.iter().enumerate() {
        let is_other = |&&l: &&usize| all[l].laid_into(own, NO_OTHER).is_some();
        let leader = leaders.iter().position(|l| is_other(&l)).unwrap_or_else(|| {
            leaders.push(i);
            leaders.len() - 1
        });
        leader_of.push(leader);
    }
    let distance = |a: usize, b: usize| {
        all[leaders[a]].laid_into(&all[leaders[b]], SAME_PIECE).map(|laid| laid.off)
    };
    let groups = cluster::groups(leaders.len(), distance, SAME_PIECE, NEXT_PIECE);
    let mut group_of_leader = vec![0; leaders.len()];
    for (g, group) in groups.iter().enumerate() {
        group.iter().for_each(|&l| group_of_leader[l] = g);
    }
    leader_of.into_iter().map(|l| group_of_leader[l]).collect()
}
