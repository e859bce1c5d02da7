//! How the skeleton is marched; one flag for one parameter field.

use beamwright::skeleton::{Junctions, Orientation, SkeletonParams};
use clap::{Args, ValueEnum};

#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Marching")]
pub(crate) struct MarchArgs {
    /// Frame in which the identifier box is carried along
    #[arg(long, value_name = "FRAME", default_value = "local")]
    pub(crate) orientation: OrientationArg,

    /// Where the local march places junctions
    #[arg(long, value_name = "PLACE", default_value = "auto")]
    pub(crate) junctions: JunctionsArg,

    /// Distance between skeletal points, in mean strut radii; smaller follows bends more closely
    #[arg(long, value_name = "RADII", default_value_t = SkeletonParams::default().step)]
    pub(crate) step: f64,

    /// How much wider than the branch the box gets before a junction is seen
    #[arg(long, value_name = "RATIO", default_value_t = SkeletonParams::default().width_ratio)]
    pub(crate) width_ratio: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum OrientationArg {
    /// The box turns with the branch
    Local,
    /// The box stays aligned with the global axes
    Global,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum JunctionsArg {
    /// Where axes meet, in a frame of straight bars; in the middle elsewhere
    Auto,
    /// Where the straight axes of the branches meet
    Axes,
    /// In the middle of the material: the best-centred skeleton
    Centred,
}

impl From<&MarchArgs> for SkeletonParams {
    fn from(args: &MarchArgs) -> Self {
        let MarchArgs { orientation, junctions, step, width_ratio } = *args;
        let orientation = match orientation {
            OrientationArg::Local => Orientation::Local,
            OrientationArg::Global => Orientation::Global,
        };
        let junctions = match junctions {
            JunctionsArg::Auto => Junctions::Auto,
            JunctionsArg::Axes => Junctions::Axes,
            JunctionsArg::Centred => Junctions::Centred,
        };
        Self { orientation, junctions, step, width_ratio }
    }
}
