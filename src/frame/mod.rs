//! From the skeleton to straight beams between nodes (thesis §5.2.3).
//!
//! ```text
//!   skeleton  ●━━●━━●━━╮          frame   ○──────────○   ○ node, from a junction or an
//!                      ◆━●━●━●                        ╲      interface section
//!                                                      ○  ── beam, one straight piece
//! ```
//!
//! | step | what | module |
//! |---|---|---|
//! | 1 | the section at every skeletal point | [`section_at`] |
//! | 2 | bent branches broken into straight pieces | `straighten`, `pieces` |
//! | 3 | all nodes moved so that the axes run in the middle of the material | `solve` |
//! | 4 | nodes that left the material held to the skeleton | `hold` |
//! | 5 | nodes closer than a section radius made one, pieces that still bend broken | `merge`, `bend` |
//! | 6 | branches that stick out of the material laid anew | `lay_anew`, `free_ends`, `filled` |
//! | 7 | members that run through a junction kept in one piece, if wanted | `continuous` |
//! | 8 | mean and end values of the sections along each beam that are its own | [`beam_section`], `own`, `measured` |
//! | 9 | a profile for every beam | [`profiles`] |

pub mod beam_axes;
pub mod beam_section;
pub mod beam_station;
mod bend;
mod continuous;
mod depth;
mod deviation;
mod filled;
mod free_ends;
mod hold;
mod lay_anew;
mod lofts;
mod measured;
mod merge;
pub mod moments;
mod narrow_loop;
pub mod normalize;
mod own;
pub mod params;
mod pieces;
pub mod profiles;
mod robust;
pub mod section_at;
pub mod shape;
mod solve;
mod straighten;
pub mod volume;

pub use beam_axes::BeamAxes;
pub use beam_section::BeamSection;
pub use beam_station::BeamStation;
pub use moments::Moments;
pub(crate) use normalize::normalize_watched;
pub use normalize::{Normalized, normalize};
pub use params::{FrameParams, ProfileParams};
pub use profiles::match_profiles;
pub(crate) use profiles::match_profiles_watched;
pub(crate) use section_at::sections_watched;
pub use section_at::{Section, sections};
pub use shape::{BeamShape, Loft};
pub use volume::{BeamVolumes, volumes};

use nalgebra::{Point3, Unit, Vector3};

use crate::mesh::id::id_type;
use crate::section::MatchTarget;

id_type!(
    /// An end of beams.
    NodeId
);
id_type!(
    /// A straight piece between two nodes.
    BeamId
);

/// What a node came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// A junction of the skeleton.
    Junction,
    /// An interface section.
    Interface,
    /// A free end.
    End,
    /// A bend of one branch.
    Bend,
}

/// An end of beams.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Place, mm.
    pub position: Point3<f64>,
    /// What it came from.
    pub kind: NodeKind,
    /// The interface section it ends in: its place among those of the mesh.
    pub interface: Option<u32>,
}

/// A node that a beam passes without being cut there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Passage {
    /// The node; it lies on the axis of the beam.
    pub node: NodeId,
    /// The branch the beam runs along from there on.
    pub branch: u32,
}

/// A straight piece between two nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// Its nodes.
    pub ends: [NodeId; 2],
    /// Nodes on its way, from the first end to the second; only with through-going members.
    pub passes: Vec<Passage>,
    /// The branch of the skeleton it is a part of; of a through-going member, the first.
    pub branch: u32,
    /// Its axes; y and z are the principal axes of its mean section.
    pub axes: BeamAxes,
    /// Length between the nodes, mm.
    pub length: f64,
    /// Length it is cut to: that of the beams equal to it, mm.
    pub cut_length: f64,
    /// What the sections along it say.
    pub section: BeamSection,
    /// Means of the sections that are its own, what the profile is matched to; angles are those
    /// from its axis y.  `None` where nothing was measured.
    pub measured: Option<MatchTarget>,
    /// Section area to assume where nothing was measured, mm².
    pub assumed_area: f64,
    /// The solid it is built as.
    pub shape: BeamShape,
}

impl Beam {
    /// Its parts from node to node, with the branch each runs along: one, and one more for
    /// each node it passes.
    pub fn spans(&self) -> impl Iterator<Item = ([NodeId; 2], u32)> + '_ {
        let nodes: Vec<NodeId> = std::iter::once(self.ends[0])
            .chain(self.passes.iter().map(|p| p.node))
            .chain([self.ends[1]])
            .collect();
        let branches = std::iter::once(self.branch).chain(self.passes.iter().map(|p| p.branch));
        branches.enumerate().map(move |(i, branch)| ([nodes[i], nodes[i + 1]], branch))
    }
}

/// All nodes and beams.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// All nodes.
    pub nodes: Vec<Node>,
    /// All beams, in the order of their branches.
    pub beams: Vec<Beam>,
}

impl Frame {
    /// A node.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// Positions of the two nodes of a beam, mm.
    pub fn axis(&self, beam: &Beam) -> [Point3<f64>; 2] {
        beam.ends.map(|n| self.node(n).position)
    }
}

/// Mark of beam number `index`, counted from 0: `B001`.
pub fn mark(index: usize) -> String {
    format!("B{:03}", index + 1)
}

/// Unit vector from one point to another; x where they coincide.
pub(crate) fn direction(a: &Point3<f64>, b: &Point3<f64>) -> Unit<Vector3<f64>> {
    Unit::try_new(b - a, 0.0).unwrap_or_else(Vector3::x_axis)
}
