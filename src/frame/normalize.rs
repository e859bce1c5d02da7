//! Normalization: bent branches become straight beams between shared nodes.

use nalgebra::{Point3, Unit, Vector3};

use super::beam_section::{BeamAxes, BeamSection};
use super::measured::measured;
use super::params::FrameParams;
use super::section_at::Section;
use super::shape::BeamShape;
use super::solve::{Pull, solve_nodes};
use super::straighten::{breaks, distance_to_segment};
use super::{Beam, Frame, Node, NodeId, NodeKind, direction};
use crate::finding::{Finding, FindingKind};
use crate::mesh::InterfaceSection;
use crate::skeleton::{Branch, PointKind, Skeleton};

/// A frame and what is odd about it.
#[derive(Clone, Debug, Default)]
pub struct Normalized {
    /// The frame.
    pub frame: Frame,
    /// What the user should know.
    pub findings: Vec<Finding>,
}

/// One straight piece before its node positions are final.
struct Piece {
    ends: [usize; 2],
    branch: usize,
    /// Skeletal points on the way, ends left out.
    points: Vec<u32>,
}

/// A branch is not broken into pieces shorter than this many of its radii: as long as it is wide a
/// piece is no beam.
const SHORTEST_PIECE: f64 = 3.0;

/// Pieces and nodes in the making.
#[derive(Default)]
struct Making {
    nodes: Vec<Node>,
    planes: Vec<Option<Unit<Vector3<f64>>>>,
    pieces: Vec<Piece>,
}

/// Makes straight beams of the branches of a skeleton.
///
/// * `sections`: one entry a skeletal point, as [`super::sections`] gives them.
/// * `interfaces`: the sections whose planes interface nodes stay in.
pub fn normalize(
    skeleton: &Skeleton,
    sections: &[Option<Section>],
    interfaces: &[InterfaceSection],
    params: &FrameParams,
) -> Normalized {
    let mut making = Making::new(skeleton, interfaces, params);
    let mut findings = Vec::new();
    making.solve(sections);
    making.merge_near_nodes(skeleton, sections, &mut findings);
    making.solve(sections);
    making.report_deviations(skeleton, params, &mut findings);
    let beams = making
        .pieces
        .iter()
        .map(|p| {
            beam(p, &making.nodes, sections, mean_radius(skeleton, &skeleton.branches[p.branch]))
        })
        .collect();
    Normalized { frame: Frame { nodes: making.nodes, beams }, findings }
}

impl Making {
    fn new(skeleton: &Skeleton, interfaces: &[InterfaceSection], params: &FrameParams) -> Self {
        let mut making = Self::default();
        let mut of_point = vec![None; skeleton.points.len()];
        for (b, branch) in skeleton.branches.iter().enumerate() {
            let chain = skeleton.polyline(branch);
            let radius = mean_radius(skeleton, branch);
            let kept = breaks(&chain, params.max_deviation * radius, SHORTEST_PIECE * radius);
            for w in kept.windows(2) {
                let ends = [w[0], w[1]].map(|i| {
                    let point = branch.points[i];
                    *of_point[point as usize]
                        .get_or_insert_with(|| making.add_node(skeleton, point, interfaces))
                });
                let points = branch.points[w[0] + 1..w[1]].to_vec();
                making.pieces.push(Piece { ends, branch: b, points });
            }
        }
        making
    }

    fn add_node(
        &mut self,
        skeleton: &Skeleton,
        point: u32,
        interfaces: &[InterfaceSection],
    ) -> usize {
        let position = skeleton.position(point);
        let kind = match skeleton.points[point as usize].kind {
            PointKind::Junction => NodeKind::Junction,
            PointKind::Interface => NodeKind::Interface,
            PointKind::End => NodeKind::End,
            PointKind::Branch => NodeKind::Bend,
        };
        let plane = (kind == NodeKind::Interface)
            .then(|| {
                interfaces
                    .iter()
                    .min_by(|a, b| {
                        let d = |i: &InterfaceSection| (i.centroid - position).norm_squared();
                        d(a).total_cmp(&d(b))
                    })
                    .map(|i| Unit::new_unchecked(i.normal))
            })
            .flatten();
        self.nodes.push(Node { position, kind });
        self.planes.push(plane);
        self.nodes.len() - 1
    }

    /// Moves all nodes so that the pieces run through the centroids of their sections.
    fn solve(&mut self, sections: &[Option<Section>]) {
        let pulls: Vec<Pull> =
            self.pieces.iter().flat_map(|p| pulls(p, &self.nodes, sections)).collect();
        let mut positions: Vec<Point3<f64>> = self.nodes.iter().map(|n| n.position).collect();
        solve_nodes(&mut positions, &self.planes, &pulls);
        for (node, position) in self.nodes.iter_mut().zip(positions) {
            node.position = position;
        }
    }

    /// Makes one node of two that a piece shorter than a section radius joins.
    fn merge_near_nodes(
        &mut self,
        skeleton: &Skeleton,
        sections: &[Option<Section>],
        findings: &mut Vec<Finding>,
    ) {
        while let Some(short) = self.pieces.iter().position(|piece| {
            let [a, b] = piece.ends.map(|n| self.nodes[n].position);
            piece.ends[0] != piece.ends[1]
                && (a - b).norm() < radius(piece, skeleton, sections)
                && !piece.ends.iter().all(|&n| self.nodes[n].kind == NodeKind::Interface)
        }) {
            let [a, b] = self.pieces.remove(short).ends;
            let (kept, gone) =
                if self.nodes[b].kind == NodeKind::Interface { (b, a) } else { (a, b) };
            for end in self.pieces.iter_mut().flat_map(|p| &mut p.ends) {
                if *end == gone {
                    *end = kept;
                }
            }
            findings.push(Finding::note(
                FindingKind::NodesMerged,
                Some(self.nodes[kept].position),
                "two nodes closer than a section radius were made one",
            ));
            // A piece whose two ends became one is nothing any more.
            self.pieces.retain(|p| p.ends[0] != p.ends[1] || p.points.len() > 2);
        }
        self.drop_unused_nodes();
    }

    fn drop_unused_nodes(&mut self) {
        let mut new_index = vec![usize::MAX; self.nodes.len()];
        let (mut nodes, mut planes) = (Vec::new(), Vec::new());
        for piece in &mut self.pieces {
            for end in &mut piece.ends {
                if new_index[*end] == usize::MAX {
                    new_index[*end] = nodes.len();
                    nodes.push(self.nodes[*end]);
                    planes.push(self.planes[*end]);
                }
                *end = new_index[*end];
            }
        }
        (self.nodes, self.planes) = (nodes, planes);
    }

    /// Names the beams whose branch bends away by more than was asked for.
    fn report_deviations(
        &self,
        skeleton: &Skeleton,
        params: &FrameParams,
        findings: &mut Vec<Finding>,
    ) {
        for (i, piece) in self.pieces.iter().enumerate() {
            let [a, b] = piece.ends.map(|n| self.nodes[n].position);
            let worst = piece
                .points
                .iter()
                .map(|&p| (distance_to_segment(&skeleton.position(p), &a, &b), p))
                .max_by(|x, y| x.0.total_cmp(&y.0));
            let Some((distance, point)) = worst else { continue };
            let radius = skeleton.points[point as usize].radius;
            // A third over the wanted value: joints shared with other beams take their part.
            if distance > 1.33 * params.max_deviation * radius {
                findings.push(Finding::note(
                    FindingKind::Deviation,
                    Some(skeleton.position(point)),
                    format!(
                        "beam {} leaves its branch by {distance:.2} mm ({:.2} section radii)",
                        i + 1,
                        distance / radius
                    ),
                ));
            }
        }
    }
}

/// The centroids along a piece that tell where its axis is: not those swollen by a junction.
fn pulls(piece: &Piece, nodes: &[Node], sections: &[Option<Section>]) -> Vec<Pull> {
    let [a, b] = piece.ends.map(|n| nodes[n].position);
    let length = (b - a).norm();
    let found: Vec<&Section> =
        piece.points.iter().filter_map(|&p| sections[p as usize].as_ref()).collect();
    if found.is_empty() || length == 0.0 {
        return Vec::new();
    }
    let section = BeamSection::new(&found, a, length, &BeamAxes::along(direction(&a, &b)));
    let share = length / found.len() as f64;
    found
        .iter()
        .zip(&section.stations)
        .map(|(s, station)| Pull {
            ends: piece.ends,
            centroid: s.centroid,
            // Squared: a section that is swollen by half has a tenth of the pull of a clean one.
            weight: station.weight * station.weight * station.moments.area * share,
        })
        .collect()
}

/// Mean radius of the sections of a piece, or of its points where it has none, mm.
fn radius(piece: &Piece, skeleton: &Skeleton, sections: &[Option<Section>]) -> f64 {
    let radii: Vec<f64> = piece
        .points
        .iter()
        .map(|&p| {
            let own = skeleton.points[p as usize].radius;
            sections[p as usize].as_ref().map_or(own, |s| s.radius().min(1.5 * own))
        })
        .collect();
    if radii.is_empty() { 0.0 } else { radii.iter().sum::<f64>() / radii.len() as f64 }
}

fn mean_radius(skeleton: &Skeleton, branch: &Branch) -> f64 {
    let sum: f64 = branch.points.iter().map(|&p| skeleton.points[p as usize].radius).sum();
    sum / branch.points.len() as f64
}

fn beam(piece: &Piece, nodes: &[Node], sections: &[Option<Section>], fallback: f64) -> Beam {
    let [a, b] = piece.ends.map(|n| nodes[n].position);
    let length = (b - a).norm();
    let found: Vec<&Section> =
        piece.points.iter().filter_map(|&p| sections[p as usize].as_ref()).collect();
    let free = BeamAxes::along(direction(&a, &b));
    let (.., angle) = BeamSection::new(&found, a, length, &free).mean.principal();
    let axes = free.rolled(angle);
    let assumed_area = std::f64::consts::PI * fallback * fallback;
    let section = BeamSection::new(&found, a, length, &axes);
    Beam {
        ends: piece.ends.map(NodeId::new),
        passes: Vec::new(),
        branch: piece.branch as u32,
        axes,
        length,
        cut_length: length,
        measured: measured(&section),
        section,
        assumed_area,
        shape: BeamShape::unmatched(assumed_area),
    }
}
