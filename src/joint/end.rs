//! A beam at a node, as the joint there sees it.

use nalgebra::{Unit, Vector3};

use super::cut::{PER_QUARTER, round};
use crate::frame::{Beam, BeamAxes, Frame};
use crate::section::contours::Contours;
use crate::section::outline::Outline;

/// A beam at a node.
pub(super) struct End {
    pub(super) beam: usize,
    /// Which of its ends is here; `None` where it passes.
    pub(super) side: Option<usize>,
    /// Its axes, turned as its section is.
    pub(super) axes: BeamAxes,
    /// Along the beam, away from the node.
    pub(super) away: Unit<Vector3<f64>>,
    /// Corners of its outline, from the axis, in model coordinates, mm.
    pub(super) corners: Vec<Vector3<f64>>,
    /// Its mean section area, mm².
    pub(super) area: f64,
    /// Whether its outline is a circle.
    pub(super) is_round: bool,
    /// Its radius, if it is a round bar or tube of constant section, mm.
    pub(super) bar: Option<f64>,
}

impl End {
    pub(super) fn ends(&self) -> bool {
        self.side.is_some()
    }

    /// How far the beam reaches from its axis in a direction, mm.
    pub(super) fn support(&self, direction: &Vector3<f64>) -> f64 {
        self.corners.iter().map(|c| c.dot(direction)).fold(0.0, f64::max)
    }

    /// Radius of the circle about the axis that holds the outline, mm.
    pub(super) fn reach(&self) -> f64 {
        self.corners.iter().map(Vector3::norm).fold(0.0, f64::max)
    }
}

/// The beams at every node.
pub(super) struct Members {
    pub(super) at_node: Vec<Vec<End>>,
}

impl Members {
    pub(super) fn new(frame: &Frame) -> Self {
        let mut at_node: Vec<Vec<End>> = frame.nodes.iter().map(|_| Vec::new()).collect();
        for (i, beam) in frame.beams.iter().enumerate() {
            for side in 0..2 {
                at_node[beam.ends[side].index()].push(end(i, beam, Some(side)));
            }
            for passage in &beam.passes {
                at_node[passage.node.index()].push(end(i, beam, None));
            }
        }
        Self { at_node }
    }
}

fn end(index: usize, beam: &Beam, side: Option<usize>) -> End {
    let stations = &beam.shape.stations;
    let region = if side == Some(1) { &stations[stations.len() - 1] } else { &stations[0] };
    let axes = beam.axes.rolled(beam.shape.roll);
    let outline = Contours::of_region(&region.region, PER_QUARTER).outer;
    let corners = outline.iter().map(|p| axes.y.into_inner() * p.x + axes.z.into_inner() * p.y);
    End {
        beam: index,
        side,
        away: if side == Some(1) { -beam.axes.x } else { beam.axes.x },
        corners: corners.collect(),
        area: beam.shape.properties.area,
        is_round: matches!(region.region.outer, Outline::Circle { .. }),
        bar: bar(beam),
        axes,
    }
}

/// The radius of a round bar or tube of constant section.
fn bar(beam: &Beam) -> Option<f64> {
    let [first, others @ ..] = beam.shape.stations.as_slice() else { return None };
    let is_round = first.region.holes.iter().all(|hole| round(hole).is_some());
    let is_constant = others.iter().all(|s| s.region == first.region);
    round(&first.region.outer).filter(|_| is_round && is_constant)
}
