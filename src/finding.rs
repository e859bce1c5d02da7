//! What is odd but workable: told to the user, with its place.

use nalgebra::Point3;

/// What a finding is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum FindingKind {
    /// A part of a size that tells of another unit of length.
    Unit,
    /// The mesh was mended.
    MeshMended,
    /// A hollow inside the material was left out.
    Cavity,
    /// A body that no non-design part holds was left out.
    FloatingIsland,
    /// Labels that mark nothing, or specks of label noise.
    Labels,
    /// An interface section that no branch leaves.
    IdleInterface,
    /// A part of the surface that is not beam-like.
    NotBeamLike,
    /// A branch so long that its points are farther apart than wanted.
    Slender,
    /// A skeletal point or segment outside the object.
    Outside,
    /// The skeleton has other cycles, components or ends than the object.
    Topology,
    /// Junctions that lie in the middle of the material instead of where axes meet.
    CentredJunctions,
    /// A branch that ends freely.
    FreeEnd,
    /// Nodes so close to each other that they were made one.
    NodesMerged,
    /// A beam whose axis leaves the branch by more than wanted.
    Deviation,
    /// A beam whose axis leaves the material.
    BeamOutside,
    /// A section that no profile matches well.
    PoorMatch,
    /// A non-design part that is no solid of the STEP file.
    NonDesign,
    /// A joint that could not be made.
    Joint,
    /// A shape that is no sound solid and was built as a simpler one.
    SimplerSolid,
    /// A piece that no stock bar is long enough for.
    Stock,
}

impl FindingKind {
    /// The kind in kebab case, for machines.
    pub fn name(self) -> &'static str {
        match self {
            Self::Unit => "unit",
            Self::MeshMended => "mesh-mended",
            Self::Cavity => "cavity",
            Self::FloatingIsland => "floating-island",
            Self::Labels => "labels",
            Self::IdleInterface => "idle-interface",
            Self::NotBeamLike => "not-beam-like",
            Self::Slender => "slender",
            Self::Outside => "outside",
            Self::Topology => "topology",
            Self::CentredJunctions => "centred-junctions",
            Self::FreeEnd => "free-end",
            Self::NodesMerged => "nodes-merged",
            Self::Deviation => "deviation",
            Self::BeamOutside => "beam-outside",
            Self::PoorMatch => "poor-match",
            Self::NonDesign => "non-design",
            Self::Joint => "joint",
            Self::SimplerSolid => "simpler-solid",
            Self::Stock => "stock",
        }
    }
}

/// Something the user should know.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is about.
    pub kind: FindingKind,
    /// One sentence for people.
    pub text: String,
    /// Where, mm.
    pub place: Option<Point3<f64>>,
    /// Whether a promise of the program is broken: an error with `--strict`.
    pub breach: bool,
}

impl Finding {
    /// Something worth knowing.
    pub fn note(kind: FindingKind, place: Option<Point3<f64>>, text: impl Into<String>) -> Self {
        Self { kind, text: text.into(), place, breach: false }
    }

    /// A promise that does not hold for this result.
    pub fn breach(kind: FindingKind, place: Option<Point3<f64>>, text: impl Into<String>) -> Self {
        Self { kind, text: text.into(), place, breach: true }
    }
}
