//! What the beams are like; one flag for one parameter field.

use std::path::PathBuf;

use beamwright::frame::{FrameParams, Loft, ProfileParams};
use beamwright::joint::JointKind;
use beamwright::section::{MatchMode, ProfileChoice};
use clap::{Args, ValueEnum};

#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Beams")]
pub(crate) struct FrameArgs {
    /// Farthest a branch may bend away from one straight beam, in section radii
    #[arg(long, value_name = "RADII", default_value_t = FrameParams::default().max_deviation)]
    pub(crate) max_deviation: f64,

    /// Keep members that run straight on across a junction in one piece
    #[arg(long)]
    pub(crate) continuous: bool,

    /// Profiles: auto, round, tube, rectangle, box, ellipse, i, c, l, freeform,
    /// catalogue[:FAMILY,...]
    #[arg(long, value_name = "CHOICE", default_value = "auto")]
    pub(crate) profile: ProfileChoice,

    /// In what a profile equals the measured section: stiffness, area, or not-weaker (in nothing
    /// less)
    #[arg(long = "match", value_name = "MODE", default_value = "stiffness")]
    pub(crate) match_mode: MatchMode,

    /// How the shape runs along a beam
    #[arg(long, value_name = "HOW", default_value = "constant")]
    pub(crate) loft: LoftArg,

    /// How beams end where they meet
    #[arg(long, value_name = "KIND", default_value = "none")]
    pub(crate) joints: JointArg,

    /// At most so many different profiles in the whole frame, of all that --profile allows
    #[arg(long, value_name = "N", allow_negative_numbers = true,
        value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_profiles: Option<u32>,

    /// Your own profiles (.csv, .json), searched besides the built-in ones; may be repeated
    #[arg(long, value_name = "FILE")]
    pub(crate) catalogue: Vec<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum JointArg {
    /// Square ends at the nodes; beams overlap there
    None,
    /// A ball at every node, beams welded to it
    Sphere,
    /// Mitred where two beams meet
    Mitre,
    /// Mitred, or cut against the side of the thickest beam
    Trim,
}

impl From<JointArg> for JointKind {
    fn from(arg: JointArg) -> Self {
        match arg {
            JointArg::None => Self::None,
            JointArg::Sphere => Self::Sphere,
            JointArg::Mitre => Self::Mitre,
            JointArg::Trim => Self::Trim,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LoftArg {
    /// The mean section all along
    Constant,
    /// Straight from end section to end section
    Taper,
    /// Through several sections
    Multi,
}

impl From<&FrameArgs> for FrameParams {
    fn from(args: &FrameArgs) -> Self {
        Self { max_deviation: args.max_deviation, continuous: args.continuous }
    }
}

impl From<&FrameArgs> for ProfileParams {
    fn from(args: &FrameArgs) -> Self {
        Self {
            choice: args.profile.clone(),
            mode: args.match_mode,
            loft: match args.loft {
                LoftArg::Constant => Loft::Constant,
                LoftArg::Taper => Loft::Taper,
                LoftArg::Multi => Loft::Multi,
            },
            max_profiles: args.max_profiles.map(|n| n as usize),
        }
    }
}
