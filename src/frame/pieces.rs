//! Nodes and straight pieces in the making: what normalization moves, breaks and joins.

use std::collections::BTreeMap;
use std::rc::Rc;

use nalgebra::{Point3, Unit, Vector3};

use super::depth::Depths;
use super::narrow_loop::is_narrow_loop;
use super::params::FrameParams;
use super::section_at::Section;
use super::solve::{Anchor, FAINT, Pull, Tie, solve_nodes};
use super::straighten::breaks;
use super::{Node, NodeKind};
use crate::mesh::InterfaceSection;
use crate::mesh::interface_section::nearest_section;
use crate::skeleton::{Branch, PointKind, Skeleton};

/// One straight piece before its node positions are final.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) ends: [usize; 2],
    pub(super) branch: usize,
    /// Nodes on the way and the branches that follow them.
    pub(super) passes: Vec<(usize, usize)>,
    /// Skeletal points on the way, ends left out.
    pub(super) points: Vec<u32>,
}

/// A branch is not broken beforehand into pieces shorter than this many of its radii: next to a
/// junction a branch turns into it, which is no bend of the beam.
pub(super) const SHORTEST_PIECE: f64 = 3.0;

/// How far a node slides in the plane of its interface section at first, in radii of that section.
/// Struts that leave their pad bent want to slide to its rim; oblique ones with fillets by a tenth.
const FARTHEST_SLIDE: f64 = 0.35;

/// Pieces and nodes in the making.
#[derive(Clone)]
pub(super) struct Making<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) sections: &'a [Option<Section>],
    /// Mean radius of each branch, mm.
    radii: Rc<[f64]>,
    /// How deep each section is.
    pub(super) depths: Rc<[Option<Depths>]>,
    pub(super) nodes: Vec<Node>,
    /// Where each node is held.
    pub(super) anchors: Vec<Anchor>,
    pub(super) pieces: Vec<Piece>,
    /// Skeletal points of the nodes that are corners of a branch.
    pub(super) corner_points: BTreeMap<usize, u32>,
    /// Farthest each branch may bend away from its pieces, in half-depths of its sections.
    pub(super) tolerances: Vec<f64>,
}

impl<'a> Making<'a> {
    pub(super) fn new(
        skeleton: &'a Skeleton,
        sections: &'a [Option<Section>],
        interfaces: &[InterfaceSection],
        params: &FrameParams,
    ) -> Self {
        let mut making = Self {
            skeleton,
            sections,
            radii: skeleton.branches.iter().map(|b| mean_radius(skeleton, b)).collect(),
            depths: sections.iter().map(|s| s.as_ref().map(Section::depths)).collect(),
            nodes: vec![],
            anchors: vec![],
            pieces: vec![],
            corner_points: BTreeMap::new(),
            tolerances: vec![params.max_deviation; skeleton.branches.len()],
        };
        let mut of_point = vec![None; skeleton.points.len()];
        for (b, branch) in skeleton.branches.iter().enumerate() {
            if is_narrow_loop(skeleton, branch) {
                continue;
            }
            let chain = skeleton.polyline(branch);
            let radius = making.radii[b];
            let kept = breaks(&chain, params.max_deviation * radius, SHORTEST_PIECE * radius);
            for w in kept.windows(2) {
                let ends = [w[0], w[1]].map(|i| {
                    let point = branch.points[i];
                    *of_point[point as usize]
                        .get_or_insert_with(|| making.add_node(point, interfaces))
                });
                let points = branch.points[w[0] + 1..w[1]].to_vec();
                making.pieces.push(Piece { ends, branch: b, passes: Vec::new(), points });
            }
        }
        making
    }

    fn add_node(&mut self, point: u32, interfaces: &[InterfaceSection]) -> usize {
        let position = self.skeleton.position(point);
        let radius = self.skeleton.points[point as usize].radius;
        let kind = match self.skeleton.points[point as usize].kind {
            PointKind::Junction => NodeKind::Junction,
            PointKind::Interface => NodeKind::Interface,
            PointKind::End => NodeKind::End,
            PointKind::Branch => NodeKind::Bend,
        };
        let mut anchor = Anchor::at(position, radius);
        let is_interface = kind == NodeKind::Interface;
        let interface = is_interface.then(|| nearest_section(interfaces, &position)).flatten();
        if let Some(i) = interface.map(|i| &interfaces[i]) {
            anchor.normal = Unit::try_new(i.normal, 0.0);
            anchor.radius = i.radius();
            anchor.slide = FARTHEST_SLIDE * anchor.radius;
        }
        let interface = interface.map(|i| i as u32);
        let node = self.push_node(Node { position, kind, interface }, anchor);
        if kind == NodeKind::Bend {
            self.corner_points.insert(node, point);
        }
        node
    }

    pub(super) fn push_node(&mut self, node: Node, anchor: Anchor) -> usize {
        self.nodes.push(node);
        self.anchors.push(anchor);
        self.nodes.len() - 1
    }

    /// Axis of a piece.
    pub(super) fn axis(&self, piece: &Piece) -> [Point3<f64>; 2] {
        piece.ends.map(|n| self.nodes[n].position)
    }

    /// Mean radius of the sections of a piece, or of its points where it has none, mm.
    pub(super) fn radius(&self, piece: &Piece) -> f64 {
        let of_point = |&p: &u32| {
            let own = self.skeleton.points[p as usize].radius;
            self.sections[p as usize].as_ref().map_or(own, |s| s.radius().min(1.5 * own))
        };
        let sum: f64 = piece.points.iter().map(of_point).sum();
        if piece.points.is_empty() {
            self.branch_radius(piece)
        } else {
            sum / piece.points.len() as f64
        }
    }

    /// Mean radius of the branch of a piece, mm.
    pub(super) fn branch_radius(&self, piece: &Piece) -> f64 {
        self.radii[piece.branch]
    }

    /// Moves all nodes so that the pieces run through the centroids of their sections.
    pub(super) fn solve(&mut self) {
        let pulls: Vec<Pull> = self.pieces.iter().flat_map(|p| self.pulls(p)).collect();
        let ties: Vec<Tie> = self
            .pieces
            .iter()
            .flat_map(|p| p.passes.iter().map(|&(node, _)| Tie { ends: p.ends, node }))
            .collect();
        let mut positions: Vec<Point3<f64>> = self.nodes.iter().map(|n| n.position).collect();
        solve_nodes(&mut positions, &self.anchors, &pulls, &ties);
        for (node, position) in self.nodes.iter_mut().zip(positions) {
            node.position = position;
        }
    }

    /// The centroids along a piece that tell where its axis is: not those swollen by a junction.
    fn pulls(&self, piece: &Piece) -> Vec<Pull> {
        let [a, b] = self.axis(piece);
        let found = self.sections_of(piece);
        if found.is_empty() || a == b {
            return Vec::new();
        }
        let share = (b - a).norm() / found.len() as f64;
        let radius = self.radius(piece);
        let section = self.beam_section(piece);
        section
            .stations
            .iter()
            .filter_map(|station| {
                let found = self.sections[station.point as usize].as_ref()?;
                // Squared: a section swollen by half has a tenth of the pull of a clean one.
                let weight =
                    self.own(piece, radius, station).powi(2) * station.moments.area * share;
                let metric = self.depths[station.point as usize]?.metric();
                Some(Pull { ends: piece.ends, centroid: found.centroid, weight, metric })
            })
            .collect()
    }

    /// Whether a node lies beyond the plane of an interface section that a piece of it ends in.
    pub(super) fn is_beyond_an_interface(&self, node: usize, piece: &Piece) -> bool {
        let at = self.nodes[node].position;
        piece.ends.iter().filter(|n| **n != node).any(|&other| {
            let anchor = &self.anchors[other];
            anchor.normal.is_some_and(|n| (at - anchor.place).dot(&n) < 0.0)
        })
    }

    pub(super) fn is_interface(&self, node: usize) -> bool {
        self.nodes[node].kind == NodeKind::Interface
    }

    /// Makes one piece of one and the next, which meet at a corner of their branch.
    pub(super) fn join_at_corner(&mut self, first: usize) {
        let gone = self.pieces.remove(first + 1);
        let piece = &mut self.pieces[first];
        let skipped = self.corner_points[&piece.ends[1]];
        piece.points.push(skipped);
        piece.points.extend(gone.points);
        piece.ends[1] = gone.ends[1];
    }

    /// Whether a piece and the next one are parts of one branch that meet at a corner of it.
    pub(super) fn is_corner(&self, first: usize) -> bool {
        let [Some(a), Some(b)] = [first, first + 1].map(|i| self.pieces.get(i)) else {
            return false;
        };
        a.ends[1] == b.ends[0]
            && self.corner_points.contains_key(&a.ends[1])
            && a.ends[0] != b.ends[1]
    }

    /// Breaks a piece at one of its points, which becomes a node.
    pub(super) fn split(&mut self, index: usize, at: usize) {
        let point = self.pieces[index].points[at];
        let position = self.sections[point as usize]
            .as_ref()
            .map_or_else(|| self.skeleton.position(point), |s| s.centroid);
        let radius = self.skeleton.points[point as usize].radius;
        let node = Node { position, kind: NodeKind::Bend, interface: None };
        let bend = self.push_node(node, Anchor::at(position, radius));
        self.corner_points.insert(bend, point);
        let mut second = self.pieces[index].clone();
        let first = &mut self.pieces[index];
        first.points.truncate(at);
        first.ends[1] = bend;
        second.points.drain(..=at);
        second.ends[0] = bend;
        self.pieces.insert(index + 1, second);
    }
}

fn mean_radius(skeleton: &Skeleton, branch: &Branch) -> f64 {
    let sum: f64 = branch.points.iter().map(|&p| skeleton.points[p as usize].radius).sum();
    sum / branch.points.len() as f64
}

impl Anchor {
    /// A node free to move in all directions.
    fn at(place: Point3<f64>, radius: f64) -> Self {
        let normal = None::<Unit<Vector3<f64>>>;
        Self { place, normal, radius, slide: radius, is_free: false, hold: FAINT }
    }
}
