//! Nodes that are made one, and those no piece ends at any more.

use std::collections::BTreeMap;

use nalgebra::Point3;

use super::narrow_loop::is_narrow_loop;
use super::pieces::{Making, Piece, SHORTEST_PIECE};
use crate::finding::{Finding, FindingKind};

impl Making<'_> {
    /// Makes one node of two that a piece shorter than a section radius joins; whether any was.
    pub(super) fn merge_near_nodes(&mut self, findings: &mut Vec<Finding>) -> bool {
        let before = findings.len();
        let met = self.merge_nodes_of_interfaces();
        while let Some(short) = self.pieces.iter().position(|piece| {
            piece.ends[0] != piece.ends[1]
                && !piece.ends.iter().all(|&n| self.is_interface(n))
                && (self.is_shorter_than_its_radius(piece) || self.is_stub_beyond(piece))
        }) {
            let [a, b] = self.pieces.remove(short).ends;
            let (kept, gone) = if self.is_interface(b) { (b, a) } else { (a, b) };
            self.make_one(kept, gone);
            findings.push(Finding::note(
                FindingKind::NodesMerged,
                Some(self.nodes[kept].position),
                "two nodes closer than a section radius were made one",
            ));
            // A piece whose two ends became one is nothing any more.
            self.pieces.retain(|p| p.ends[0] != p.ends[1] || p.points.len() > 2);
        }
        self.drop_unused_nodes();
        met || findings.len() > before
    }

    /// Makes one node of those in one interface section that have come closer than a radius of
    /// their pieces; whether any have.
    fn merge_nodes_of_interfaces(&mut self) -> bool {
        let nodes: Vec<usize> =
            (0..self.nodes.len()).filter(|&n| self.nodes[n].interface.is_some()).collect();
        let mut used: BTreeMap<usize, f64> = BTreeMap::new();
        for piece in &self.pieces {
            let radius = self.radius(piece);
            for end in piece.ends {
                let least = used.entry(end).or_insert(radius);
                *least = least.min(radius);
            }
        }
        let mut met = false;
        for (i, a) in nodes.iter().enumerate() {
            for b in &nodes[i + 1..] {
                let (Some(of_a), Some(of_b)) = (used.get(a).copied(), used.get(b).copied()) else {
                    continue;
                };
                let distance = (self.nodes[*a].position - self.nodes[*b].position).norm();
                if self.nodes[*a].interface == self.nodes[*b].interface && distance < of_a.min(of_b)
                {
                    self.make_one(*a, *b);
                    used.remove(b);
                    met = true;
                }
            }
        }
        met
    }

    /// Lets all pieces end at one node that end at either of two.
    fn make_one(&mut self, kept: usize, gone: usize) {
        for piece in &mut self.pieces {
            for node in piece.ends.iter_mut().chain(piece.passes.iter_mut().map(|p| &mut p.0)) {
                if *node == gone {
                    *node = kept;
                }
            }
        }
    }

    /// Leaves out pieces that end where they begin: loops too narrow to be broken into beams.
    pub(super) fn drop_closed_pieces(&mut self, findings: &mut Vec<Finding>) {
        let narrow = self.skeleton.branches.iter().filter(|b| is_narrow_loop(self.skeleton, b));
        findings.extend(narrow.map(|b| no_beam(self.skeleton.position(b.points[0]))));
        for piece in self.pieces.extract_if(.., |p| p.ends[0] == p.ends[1]) {
            findings.push(no_beam(self.nodes[piece.ends[0]].position));
        }
        self.drop_unused_nodes();
    }

    fn is_shorter_than_its_radius(&self, piece: &Piece) -> bool {
        let [a, b] = self.axis(piece);
        (a - b).norm() < self.radius(piece)
    }

    /// Whether a piece is a short stub at an interface section, and the axes that meet at its
    /// other end meet beyond that section: they leave the section each by itself.
    fn is_stub_beyond(&self, piece: &Piece) -> bool {
        let [a, b] = piece.ends.map(|n| self.anchors[n].place);
        (a - b).norm() < SHORTEST_PIECE * self.radius(piece)
            && piece.ends.iter().any(|&n| self.is_beyond_an_interface(n, piece))
    }

    pub(super) fn drop_unused_nodes(&mut self) {
        let mut new_index = vec![usize::MAX; self.nodes.len()];
        let (mut nodes, mut anchors) = (Vec::new(), Vec::new());
        for piece in &mut self.pieces {
            for end in piece.ends.iter_mut().chain(piece.passes.iter_mut().map(|p| &mut p.0)) {
                if new_index[*end] == usize::MAX {
                    new_index[*end] = nodes.len();
                    nodes.push(self.nodes[*end]);
                    anchors.push(self.anchors[*end]);
                }
                *end = new_index[*end];
            }
        }
        (self.nodes, self.anchors) = (nodes, anchors);
        self.corner_points = std::mem::take(&mut self.corner_points)
            .into_iter()
            .map(|(node, point)| (new_index[node], point))
            .filter(|(node, _)| *node != usize::MAX)
            .collect();
    }
}

fn no_beam(place: Point3<f64>) -> Finding {
    Finding::note(
        FindingKind::NodesMerged,
        Some(place),
        "a loop at a node, narrower than a section radius, is no beam; it was left out",
    )
}
