//! Through-going members: pieces that run straight on across a junction become one.

use nalgebra::Point3;

use super::NodeKind;
use super::beam_section::BeamSection;
use super::params::FrameParams;
use super::pieces::{Making, Piece};
use crate::segment;

/// Largest turn of a member at a node it runs through, as the cosine: 15°.
const STRAIGHT_ON: f64 = 0.966;

/// Largest ratio of the areas of two pieces of one member: diameters within 5 %. The bays of a
/// chord measured on a mesh are within 3 %, a leg that is set off by a tenth of its diameter is at
/// 23 %.
const SAME_SECTION: f64 = 1.1;

/// Two pieces that meet at a node, as candidates for one member.
struct Pair {
    pieces: [usize; 2],
    node: usize,
    cosine: f64,
}

/// Joins pieces to members, the straightest first; whether any were joined.
pub(super) fn join(making: &mut Making<'_>, params: &FrameParams) -> bool {
    let mut joined = false;
    while let Some(pair) = best_pair(making, params) {
        let [first, second] = pair.pieces;
        let piece = chained(&making.pieces[first], &making.pieces[second], pair.node);
        making.pieces[first] = piece;
        making.pieces.remove(second);
        joined = true;
    }
    joined
}

fn best_pair(making: &Making<'_>, params: &FrameParams) -> Option<Pair> {
    let sections: Vec<BeamSection> = making.pieces.iter().map(|p| making.beam_section(p)).collect();
    let mut best: Option<Pair> = None;
    for first in 0..making.pieces.len() {
        for second in first + 1..making.pieces.len() {
            let areas = [first, second].map(|i| sections[i].mean.area);
            let alike = areas[0].max(areas[1]) <= SAME_SECTION * areas[0].min(areas[1]);
            let pair = alike.then(|| pair(making, params, [first, second])).flatten();
            if pair.as_ref().is_some_and(|p| best.as_ref().is_none_or(|b| p.cosine > b.cosine)) {
                best = pair;
            }
        }
    }
    best
}

/// The pair of two pieces if they share a junction and run straight on across it.
fn pair(making: &Making<'_>, params: &FrameParams, pieces: [usize; 2]) -> Option<Pair> {
    let [a, b] = pieces.map(|i| &making.pieces[i]);
    let node = *a.ends.iter().find(|n| b.ends.contains(n))?;
    let far = [a, b].map(|p| if p.ends[0] == node { p.ends[1] } else { p.ends[0] });
    if making.nodes[node].kind != NodeKind::Junction || far[0] == far[1] || far.contains(&node) {
        return None;
    }
    let at = |n: usize| making.nodes[n].position;
    let [to, from] = far.map(|n| (at(n) - at(node)).normalize());
    let cosine = -to.dot(&from);
    let axis = far.map(at);
    let tolerance = params.max_deviation * making.radius(a).min(making.radius(b));
    let is_near = |p: &Point3<f64>| segment::distance(p, &axis[0], &axis[1]) <= tolerance;
    let passed = a.passes.iter().chain(&b.passes).map(|p| p.0).chain([node]);
    let straight = cosine >= STRAIGHT_ON && passed.map(at).all(|p| is_near(&p));
    straight.then_some(Pair { pieces, node, cosine })
}

/// One piece of two, that runs from the far end of the first to the far end of the second.
fn chained(first: &Piece, second: &Piece, node: usize) -> Piece {
    let mut first = if first.ends[1] == node { first.clone() } else { reversed(first) };
    let second = if second.ends[0] == node { second.clone() } else { reversed(second) };
    first.passes.push((node, second.branch));
    first.passes.extend(second.passes);
    first.points.extend(second.points);
    first.ends[1] = second.ends[1];
    first
}

fn reversed(piece: &Piece) -> Piece {
    let mut branches: Vec<usize> =
        std::iter::once(piece.branch).chain(piece.passes.iter().map(|p| p.1)).rev().collect();
    let nodes = piece.passes.iter().rev().map(|p| p.0);
    let branch = branches.remove(0);
    Piece {
        ends: [piece.ends[1], piece.ends[0]],
        branch,
        passes: nodes.zip(branches).collect(),
        points: piece.points.iter().rev().copied().collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_member_turned_round_passes_the_same_nodes_the_other_way() {
        let piece = Piece {
            ends: [0, 3],
            branch: 7,
            passes: vec![(1, 8), (2, 9)],
            points: vec![10, 11, 12],
        };
        let back = reversed(&piece);
        assert_eq!((back.ends, back.branch), ([3, 0], 9));
        assert_eq!(back.passes, [(2, 8), (1, 7)]);
        assert_eq!(reversed(&back).passes, piece.passes);
    }

    #[test]
    fn two_pieces_chain_over_their_node_whichever_way_they_run() {
        let piece = |ends, branch, points| Piece { ends, branch, passes: Vec::new(), points };
        let one = chained(&piece([5, 1], 0, vec![1, 2]), &piece([9, 5], 1, vec![3, 4]), 5);
        assert_eq!((one.ends, one.branch), ([1, 9], 0));
        assert_eq!(one.passes, [(5, 1)]);
        assert_eq!(one.points, [2, 1, 4, 3]);
    }
}
