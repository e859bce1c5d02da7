//! Keeps nodes and axes in the material.
//!
//! The axes of beams that meet at an acute angle, or bend before they meet, cross far from their
//! junction: beyond an interface section, or outside of the object; where a branch bends little, its
//! corner slides along it. A node that left is held more
//! firmly to its place in the skeleton, which lies inside, until it stays.

use super::NodeKind;
use super::pieces::{Making, Piece};
use crate::mesh::TriangleTree;

/// Factor by which a node that left is held more firmly.
const FIRMER: f64 = 3.0;

/// Hold at which a node stays where the skeleton has it.
const FIRMEST: f64 = 1e2;

/// Part of a beam's length left out at both ends when its axis is looked at: the ends of a beam may
/// lie in the surface.
const ENDS: f64 = 0.01;

/// Holds nodes that left the material more firmly; whether there was any.
pub(super) fn hold_nodes_inside(making: &mut Making<'_>, tree: &TriangleTree) -> bool {
    let mut pieces_at: Vec<Vec<&Piece>> = vec![Vec::new(); making.nodes.len()];
    for piece in &making.pieces {
        piece.ends.iter().for_each(|&n| pieces_at[n].push(piece));
    }
    let mut leaving: Vec<bool> =
        pieces_at.iter().enumerate().map(|(n, pieces)| has_left(making, n, pieces, tree)).collect();
    for piece in &making.pieces {
        if leaves_material(making, piece, tree) {
            piece.ends.iter().for_each(|&n| leaving[n] = true);
        }
    }
    let mut held = false;
    for (anchor, leaves) in making.anchors.iter_mut().zip(leaving) {
        if leaves && anchor.hold < FIRMEST {
            anchor.hold *= FIRMER;
            held = true;
        }
    }
    held
}

fn has_left(making: &Making<'_>, node: usize, pieces: &[&Piece], tree: &TriangleTree) -> bool {
    let (at, anchor) = (making.nodes[node].position, &making.anchors[node]);
    match making.nodes[node].kind {
        NodeKind::Interface => {
            (at - anchor.place).norm() > anchor.slide || (anchor.is_free && !tree.contains(&at))
        }
        NodeKind::End => false,
        NodeKind::Bend if (at - anchor.place).norm() > anchor.slide => true,
        NodeKind::Junction | NodeKind::Bend => {
            !tree.contains(&at) || pieces.iter().any(|p| making.is_beyond_an_interface(node, p))
        }
    }
}

/// Whether the axis of a piece leaves the material between its ends.
pub(super) fn leaves_material(making: &Making<'_>, piece: &Piece, tree: &TriangleTree) -> bool {
    let [a, b] = making.axis(piece);
    let (from, to) = (a + (b - a) * ENDS, b - (b - a) * ENDS);
    a != b && (!tree.contains(&from) || tree.is_crossed_by(&from, &to))
}
