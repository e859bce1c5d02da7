//! What can be typed; one flag for one parameter field.

use std::path::PathBuf;
use std::str::FromStr;

use beamwright::frame::{FrameParams, Loft, ProfileParams};
use beamwright::joint::JointKind;
use beamwright::mesh::LabelParams;
use beamwright::mesh::label::DEFAULT_NAMES;
use beamwright::pipeline::Settings;
use beamwright::section::{MatchMode, ProfileChoice};
use beamwright::skeleton::{Junctions, Orientation, SkeletonParams};
use beamwright_formats::{ReadOptions, Unit};
use clap::{Args, Parser, Subcommand, ValueEnum};

use super::evaluate::EvaluateArgs;
use super::outputs::OutputArgs;
use super::profiles::ProfilesArgs;
use super::shop::ShopArgs;

/// From a topology-optimized mesh to beams one can buy, cut and weld.
#[derive(Debug, Parser)]
#[command(
    name = "beamwright",
    version,
    max_term_width = 100,
    after_help = ENDS,
    propagate_version = true,
    args_override_self = true
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,

    #[command(flatten)]
    pub(crate) global: GlobalArgs,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Turn a mesh into beams: STEP assembly, cut list, skeleton
    #[command(after_help = RECONSTRUCT_EXAMPLES, args_override_self = true)]
    Reconstruct(Box<ReconstructArgs>),
    /// March the skeleton of a mesh and write it
    #[command(after_help = SKELETON_EXAMPLES, args_override_self = true)]
    Skeleton(SkeletonArgs),
    /// Measure skeletons: centeredness, topology, what lies outside
    #[command(after_help = super::evaluate::EXAMPLES, args_override_self = true)]
    Evaluate(EvaluateArgs),
    /// Check a mesh: what was mended, labels per source, interface sections
    #[command(after_help = INSPECT_EXAMPLES, args_override_self = true)]
    Inspect(InspectArgs),
    /// List and search the profiles of the catalogues
    #[command(after_help = super::profiles::EXAMPLES, args_override_self = true)]
    Profiles(ProfilesArgs),
    /// Print the completions for a shell
    #[command(after_help = COMPLETIONS_EXAMPLES)]
    Completions {
        /// The shell they are for
        shell: clap_complete::Shell,
    },
    /// Print the manual page, or that of a command
    #[command(after_help = MAN_EXAMPLES)]
    Man {
        /// The command
        command: Option<String>,
    },
}

const ENDS: &str = "\
Examples:
  beamwright reconstruct part.obj -o part.step        (and part.csv, part.skeleton.json)
  beamwright reconstruct --help                       (all options of a command)

Exit codes:
  0  done
  1  the input cannot be processed
  2  wrong usage
  3  --strict found a promise that does not hold
  130  interrupted";

const RECONSTRUCT_EXAMPLES: &str = "\
Examples:
  beamwright reconstruct part.obj -o part.step
  beamwright reconstruct part.stl --non-design pads.stl -o part.step --cut-list part.csv
  beamwright reconstruct part.ply -o part.step --skeleton part.json --json
  beamwright reconstruct part.ply -o part.step --export part.mlp      (opens in MeshLab)
  beamwright reconstruct part.obj -o part.step --report .html         (part.html, for a browser)
  beamwright reconstruct *.stl --out-dir beams --report .html --picture .png
  beamwright reconstruct part.obj -o part.step --config shop.toml";

const SKELETON_EXAMPLES: &str = "\
Examples:
  beamwright skeleton part.obj -o skeleton.json
  beamwright skeleton part.obj -o skeleton.ply      (opens in MeshLab)";

const INSPECT_EXAMPLES: &str = "\
Examples:
  beamwright inspect part.stl --non-design pads.stl
  beamwright inspect part.obj --json";

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  beamwright completions bash > ~/.local/share/bash-completion/completions/beamwright
  beamwright completions zsh > ~/.zfunc/_beamwright      (with ~/.zfunc in fpath)
  beamwright completions fish > ~/.config/fish/completions/beamwright.fish";

const MAN_EXAMPLES: &str = "\
Examples:
  beamwright man | man -l -
  beamwright man reconstruct | man -l -";

/// Flags of every subcommand.
#[derive(Args, Debug)]
#[command(next_help_heading = "Messages")]
pub(crate) struct GlobalArgs {
    /// No progress bar and no summary; only errors, and results asked for with --json
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,

    /// Tell the time of each stage and the files written, on standard error
    #[arg(short, long, global = true, conflicts_with = "quiet")]
    pub(crate) verbose: bool,

    /// Take options from a file, one `name = value` a line; what is typed counts more
    #[arg(long, global = true, value_name = "FILE.toml")]
    pub(crate) config: Option<PathBuf>,

    /// Write the options typed, and the defaults of all others, to a file for --config, and end
    #[arg(long, global = true, value_name = "FILE.toml")]
    pub(crate) write_config: Option<PathBuf>,

    /// How progress is shown on standard error
    #[arg(long, global = true, value_name = "HOW", default_value = "auto")]
    pub(crate) progress: ProgressStyle,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressStyle {
    /// A bar on a terminal, nothing elsewhere
    Auto,
    /// One JSON object a line
    Json,
    /// Nothing
    None,
}

#[derive(Args, Clone, Debug)]
#[command(mut_arg("junctions", |arg| arg.default_value("axes")))]
pub(crate) struct ReconstructArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) march: MarchArgs,
    #[command(flatten)]
    pub(crate) frame: FrameArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) shop: ShopArgs,
    #[command(flatten)]
    pub(crate) result: ResultArgs,

    /// Further meshes, where --out-dir is given
    #[arg(value_name = "IN", help_heading = "Input")]
    pub(crate) more: Vec<PathBuf>,
}

#[derive(Args, Debug)]
pub(crate) struct SkeletonArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) march: MarchArgs,

    /// Skeleton file: .json .obj .ply .cg .swc
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: PathBuf,

    #[command(flatten)]
    pub(crate) result: ResultArgs,
}

#[derive(Args, Debug)]
pub(crate) struct InspectArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) result: ResultArgs,
}

/// How the result is shown.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Output")]
pub(crate) struct ResultArgs {
    /// Print the result as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// End with exit code 3, and write no file, when a promise does not hold (points outside, wrong
    /// topology)
    #[arg(long)]
    pub(crate) strict: bool,
}

#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Input")]
pub(crate) struct InputArgs {
    /// Mesh file: .off .obj .ply .stl .gltf .glb
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,

    /// Unit of length in the file (default: mm; glTF: m)
    #[arg(long, value_name = "mm|cm|m|in")]
    pub(crate) unit: Option<Unit>,

    /// Closed mesh of a non-design part; may be repeated
    #[arg(long, value_name = "FILE")]
    pub(crate) non_design: Vec<PathBuf>,

    /// Box in which all faces are non-design, two opposite corners in mm; may be repeated
    #[arg(long, value_name = "X0,Y0,Z0,X1,Y1,Z1", allow_hyphen_values = true)]
    pub(crate) non_design_box: Vec<Corners>,

    /// Name of a group, material or solid that is non-design, with * for anything; may be repeated
    #[arg(long, value_name = "PATTERN", default_values_t = DEFAULT_NAMES.map(String::from))]
    pub(crate) non_design_name: Vec<String>,
}

/// Two opposite corners of a box, mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corners([f64; 6]);

impl FromStr for Corners {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Vec<f64> = text
            .split(',')
            .map(|part| part.trim().parse().ok().filter(|x: &f64| x.is_finite()))
            .collect::<Option<_>>()
            .ok_or("six numbers in mm are wanted, with commas between")?;
        let count = numbers.len();
        let numbers = numbers.try_into();
        numbers.map(Self).map_err(|_| format!("six numbers are wanted, but there are {count}"))
    }
}

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

impl InputArgs {
    fn labels(&self) -> LabelParams {
        LabelParams {
            second_meshes: Vec::new(),
            boxes: self.non_design_box.iter().map(|corners| corners.0).collect(),
            names: self.non_design_name.clone(),
        }
    }

    /// Settings for reading and labelling; the rest at its defaults.
    pub(crate) fn settings(&self) -> Settings {
        Settings {
            read: ReadOptions { unit: self.unit, ..ReadOptions::default() },
            non_design_files: self.non_design.clone(),
            labels: self.labels(),
            ..Settings::default()
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_well_formed() {
        Cli::command().debug_assert();
    }

    #[test]
    fn flag_defaults_are_the_library_defaults() {
        let cli = Cli::parse_from(["beamwright", "reconstruct", "in.obj", "-o", "out.step"]);
        let Command::Reconstruct(args) = cli.command else { panic!("another subcommand") };
        assert_eq!(SkeletonParams::from(&args.march), SkeletonParams::for_beams());
        assert_eq!(FrameParams::from(&args.frame), FrameParams::default());
        assert_eq!(ProfileParams::from(&args.frame), ProfileParams::default());
        assert_eq!(args.input.settings().labels.names, LabelParams::default().names);
    }

    #[test]
    fn a_skeleton_alone_is_as_well_centred_as_can_be() {
        let cli = Cli::parse_from(["beamwright", "skeleton", "in.obj", "-o", "out.json"]);
        let Command::Skeleton(args) = cli.command else { panic!("another subcommand") };
        assert_eq!(SkeletonParams::from(&args.march), SkeletonParams::default());
    }

    #[test]
    fn boxes_with_negative_corners_are_taken() {
        let cli = Cli::parse_from([
            "beamwright",
            "inspect",
            "in.obj",
            "--non-design-box",
            "-1,-2,-3,1,2,3",
            "--non-design-box",
            "5,5,5,6,6,6",
        ]);
        let Command::Inspect(args) = cli.command else { panic!("another subcommand") };
        let boxes = args.input.settings().labels.boxes;
        assert_eq!(boxes, [[-1., -2., -3., 1., 2., 3.], [5., 5., 5., 6., 6., 6.]]);
    }
}
