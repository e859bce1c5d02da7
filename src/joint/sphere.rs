//! A ball at a node: beams end square, with their corners on it.

use super::{End, EndCut};
use crate::frame::NodeId;

/// A ball that beams are welded to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its centre.
    pub node: NodeId,
    /// Its radius, mm.
    pub radius: f64,
}

/// A ball is larger than its thickest beam by this factor: room for the weld.
const ROOM: f64 = 1.1;

/// No ball is larger than its thickest beam by more: beams at less than 30° overlap in it instead.
const LARGEST: f64 = 2.0;

/// The ball of a node and the cuts of its beams; `None` where fewer than two beams meet.
///
/// Beams of radius r at an angle α are clear of each other beyond r / sin(α/2) from the node.
pub(super) fn ball(node: NodeId, at: &[End]) -> Option<(Ball, Vec<Option<EndCut>>)> {
    if at.len() < 2 {
        return None;
    }
    let reaches: Vec<f64> = at.iter().map(End::reach).collect();
    let thickest = reaches.iter().copied().fold(0.0, f64::max);
    let mut radius = ROOM * thickest;
    for (i, a) in at.iter().enumerate() {
        for (b, reach) in at.iter().zip(&reaches).take(i) {
            let half = 0.5 * a.away.angle(&b.away);
            radius = radius.max(0.5 * (reaches[i] + reach) / half.sin());
        }
    }
    radius = radius.min(LARGEST * thickest);
    let cut = |reach: &f64| {
        let setback = (radius * radius - reach * reach).max(0.0).sqrt();
        Some(EndCut { setback, ..EndCut::SQUARE })
    };
    Some((Ball { node, radius }, reaches.iter().map(cut).collect()))
}
