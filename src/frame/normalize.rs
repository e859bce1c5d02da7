//! Normalization: bent branches become straight beams between shared nodes.

use std::ops::ControlFlow;

use super::beam_axes::BeamAxes;
use super::beam_section::BeamSection;
use super::lay_anew::{frame_cost, lay_anew};
use super::measured::measured;
use super::params::FrameParams;
use super::pieces::{Making, Piece};
use super::section_at::Section;
use super::shape::BeamShape;
use super::{Beam, Frame, NodeId, Passage, bend, continuous, deviation, direction, hold};
use crate::finding::Finding;
use crate::mesh::{Shadow, Surface};
use crate::observer::Observer;
use crate::skeleton::Skeleton;

/// A frame and what is odd about it.
#[derive(Clone, Debug, Default)]
pub struct Normalized {
    /// The frame.
    pub frame: Frame,
    /// What the user should know.
    pub findings: Vec<Finding>,
}

/// Times nodes are held, pieces broken and nodes merged at most. A node is at its firmest after
/// thirteen, and a branch is halved no more often than it has points.
const MOST_ROUNDS: usize = 60;

/// Makes straight beams of the branches of a skeleton.
///
/// * `sections`: one entry a skeletal point, as [`super::sections`] gives them.
/// * `surface`: the material, which nodes and axes stay in, and the planes of interface nodes.
///
/// # Panics
/// If there are fewer sections than skeletal points.
pub fn normalize(
    skeleton: &Skeleton,
    sections: &[Option<Section>],
    surface: &Surface,
    params: &FrameParams,
) -> Normalized {
    let watched = normalize_watched(skeleton, sections, surface, params, &mut ());
    watched.continue_value().unwrap_or_default()
}

/// The same, unless the observer asks to stop.
pub(crate) fn normalize_watched(
    skeleton: &Skeleton,
    sections: &[Option<Section>],
    surface: &Surface,
    params: &FrameParams,
    observer: &mut impl Observer,
) -> ControlFlow<(), Normalized> {
    let mut held = Making::new(skeleton, sections, &surface.interfaces, params);
    let mut making = held.clone();
    let shadow = Shadow::new(&surface.tree);
    let mut findings = lay(&mut making, surface, &shadow, observer)?;
    let (filled, cost) = frame_cost(&making, &shadow);
    if filled.sticks_out() {
        held.hold_junctions();
        let held_findings = lay(&mut held, surface, &shadow, observer)?;
        if frame_cost(&held, &shadow).1 < cost {
            (making, findings) = (held, held_findings);
        }
    }
    making.drop_closed_pieces(&mut findings);
    if params.continuous && continuous::join(&mut making, params) {
        settle_nodes(&mut making, surface, observer)?;
    }
    deviation::report(&making, params, &mut findings);
    deviation::report_outside(&making, &surface.tree, &mut findings);
    let mut beams = Vec::with_capacity(making.pieces.len());
    for piece in &making.pieces {
        observer.keep_on()?;
        beams.push(beam(&making, piece, surface));
    }
    ControlFlow::Continue(Normalized { frame: Frame { nodes: making.nodes, beams }, findings })
}

/// Lays the pieces along their branches; what is odd about that.
fn lay(
    making: &mut Making<'_>,
    surface: &Surface,
    shadow: &Shadow<'_>,
    observer: &mut impl Observer,
) -> ControlFlow<(), Vec<Finding>> {
    let mut findings = Vec::new();
    settle(making, surface, &mut findings, observer)?;
    lay_anew(making, surface, shadow, |making| settle(making, surface, &mut Vec::new(), observer))?;
    ControlFlow::Continue(findings)
}

/// Solves until every node stays in the material, no piece bends and no two nodes are one; then
/// takes out the corners that are not needed any more.
fn settle(
    making: &mut Making<'_>,
    surface: &Surface,
    findings: &mut Vec<Finding>,
    observer: &mut impl Observer,
) -> ControlFlow<()> {
    for _ in 0..MOST_ROUNDS {
        observer.keep_on()?;
        making.solve();
        let again = making.merge_near_nodes(findings)
            || hold::hold_nodes_inside(making, &surface.tree)
            || bend::split_bent(making);
        if !again {
            break;
        }
    }
    if bend::rejoin_straight(making) {
        making.drop_unused_nodes();
        settle_nodes(making, surface, observer)?;
    }
    ControlFlow::Continue(())
}

/// Solves until every node stays in the material.
fn settle_nodes(
    making: &mut Making<'_>,
    surface: &Surface,
    observer: &mut impl Observer,
) -> ControlFlow<()> {
    for _ in 0..MOST_ROUNDS {
        observer.keep_on()?;
        making.solve();
        if !hold::hold_nodes_inside(making, &surface.tree) {
            break;
        }
    }
    ControlFlow::Continue(())
}

fn beam(making: &Making<'_>, piece: &Piece, surface: &Surface) -> Beam {
    let [a, b] = making.axis(piece);
    let length = (b - a).norm();
    let found = making.own_sections_of(piece);
    let free = BeamAxes::along(direction(&a, &b));
    let (.., angle) = BeamSection::new(&found, a, length, &free).mean.principal();
    let axes = free.rolled(angle);
    let section = BeamSection::new(&found, a, length, &axes);
    let assumed_area = std::f64::consts::PI * assumed_radius(making, piece, surface).powi(2);
    Beam {
        ends: piece.ends.map(NodeId::new),
        passes: piece.passes.iter().map(passage).collect(),
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

/// Radius of a beam where no section says it, mm: that of its branch, or the mean one of the part
/// for a branch that has none (its surface is torn along the whole of it).
fn assumed_radius(making: &Making<'_>, piece: &Piece, surface: &Surface) -> f64 {
    let own = making.branch_radius(piece);
    if own > 0.0 { own } else { surface.mean_radius().max(0.0) }
}

fn passage(&(node, branch): &(usize, usize)) -> Passage {
    Passage { node: NodeId::new(node), branch: branch as u32 }
}
