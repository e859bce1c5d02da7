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

impl Making<'_> {
    /// Holds all junctions where the skeleton has them: none is drawn into an interface section next
    /// to it, where the axes of its branches would meet.
    pub(super) fn hold_junctions(&mut self) {
        for (node, anchor) in self.nodes.iter().zip(&mut self.anchors) {
            if node.kind == NodeKind::Junction {
                anchor.hold = FIRMEST;
            }
        }
    }
}

/// Holds nodes that left the material more firmly; whether there was any.
pub(super) fn hold_nodes_inside(making: &mut Making<'_>, tree: &TriangleTree) -> bool {
    let mut pieces_at: Vec<Vec<&Piece>> = vec![Vec::new(); making.nodes.len()];
    for piece in &making.pieces {
        piece.ends.iter().for_each(|&n| pieces_at[n].push(piece));
    }
    // What is as firm as can be need not be asked again, nor what is known to leave: in a noisy mesh
    // that crosses itself these are most, and a ray meets many triangles.
    let is_loose = |n: usize| making.anchors[n].hold < FIRMEST;
    let leaves =
        |(n, pieces): (usize, &Vec<&Piece>)| is_loose(n) && has_left(making, n, pieces, tree);
    let mut leaving: Vec<bool> = pieces_at.iter().enumerate().map(leaves).collect();
    for piece in &making.pieces {
        let is_open = piece.ends.iter().any(|&n| is_loose(n) && !leaving[n]);
        if is_open && leaves_material(making, piece, tree) {
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

#[cfg(test)]
mod tests {
    use nalgebra::{Point3, Vector3};

    use super::*;
    use crate::frame::params::FrameParams;
    use crate::frame::section_at::Section;
    use crate::mesh::contour::Plane;
    use crate::skeleton::{Branch, PointKind, SkeletalPoint, Skeleton};

    #[test]
    fn held_junctions_stay_where_the_skeleton_has_them() {
        // Square sections across z whose centroids lie beside the skeleton.
        let at = |i: u32| Point3::new(0.0, 0.0, 2.0 * f64::from(i));
        let kind = |i: u32| if i == 8 { PointKind::Junction } else { PointKind::Branch };
        let points = (0..9).map(|i| SkeletalPoint { position: at(i), radius: 1.0, kind: kind(i) });
        let skeleton = Skeleton {
            points: points.collect(),
            branches: vec![Branch { points: (0..9).collect() }],
        };
        let section = |i: u32| {
            let centroid = at(i) + Vector3::new(0.4, 0.0, 0.0);
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            let contour = corners.map(|[x, y]| centroid + Vector3::new(x, y, 0.0)).to_vec();
            let plane = Plane::new(at(i), Vector3::z_axis());
            (1..8).contains(&i).then_some(Section { point: i, plane, contour, area: 4.0, centroid })
        };
        let sections: Vec<Option<Section>> = (0..9).map(section).collect();
        let off = |is_held: bool| {
            let mut making = Making::new(&skeleton, &sections, &[], &FrameParams::default());
            if is_held {
                making.hold_junctions();
            }
            making.solve();
            let junction = making.nodes.iter().find(|n| n.kind == NodeKind::Junction);
            (junction.expect("a junction").position - at(8)).norm()
        };
        assert!((off(false) - 0.4).abs() < 0.01, "{}", off(false));
        assert!(off(true) < 0.02, "{}", off(true));
    }
}
