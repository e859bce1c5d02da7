//! Ends of branches that leave the middle of their interface section.
//!
//! ```text
//!   ▔▔▔▔▔▔▔▔▔▔▔▔▔        ▔▔▔▔▔▔▔▔▔▔▔▔▔
//!    ╭──●  ●──╮           ●─╮   ╭─●         the legs of a table end each by itself where their
//!    │ ╱    ╲ │           │ │   │ │         axes meet the plate, not all in the middle of it
//!    ● ╯    ╰ ●           ● ╯   ╰ ●
//! ```

use super::direction;
use super::pieces::Making;
use super::solve::FAINT;
use crate::mesh::Surface;

impl Making<'_> {
    /// Lets a branch, straight again, end at interface sections in nodes of its own, anywhere in
    /// their planes within a radius of the section. Leaves nodes that no piece ends at.
    pub(super) fn free_ends(&mut self, branch: usize) {
        let corner = |making: &Self| {
            let mut pieces = (0..making.pieces.len()).filter(|&i| making.is_corner(i));
            pieces.find(|&i| making.pieces[i].branch == branch)
        };
        while let Some(first) = corner(self) {
            self.join_at_corner(first);
        }
        let all = 0..self.pieces.len();
        let own: Vec<usize> = all.filter(|&i| self.pieces[i].branch == branch).collect();
        for piece in own {
            for end in 0..2 {
                let node = self.pieces[piece].ends[end];
                if self.is_interface(node) {
                    let mut anchor = self.anchors[node];
                    (anchor.slide, anchor.is_free, anchor.hold) = (anchor.radius, true, FAINT);
                    self.pieces[piece].ends[end] = self.push_node(self.nodes[node], anchor);
                }
            }
        }
    }

    /// Moves the planes of free ends to where their axes meet the cap of the interface section;
    /// whether there are any.
    pub(super) fn reach_caps(&mut self, surface: &Surface) -> bool {
        let mut moved = false;
        for piece in &self.pieces {
            for [node, other] in [piece.ends, [piece.ends[1], piece.ends[0]]] {
                let at = self.nodes[node].position;
                let outwards = direction(&self.nodes[other].position, &at);
                let anchor = &mut self.anchors[node];
                let interface = self.nodes[node].interface.filter(|_| anchor.is_free);
                let (Some(interface), Some(normal)) = (interface, anchor.normal) else { continue };
                let cap = &surface.interfaces[interface as usize];
                let depth = cap.way_to_cap(&surface.mesh, &at, &outwards);
                if let Some(depth) = depth.filter(|d| d.abs() <= anchor.slide) {
                    anchor.place += *normal * (normal.dot(&outwards) * depth);
                    moved = true;
                }
            }
        }
        moved
    }
}
