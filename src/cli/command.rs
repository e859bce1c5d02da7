//! The commands, each with what can be typed for it.

use clap::{Parser, Subcommand};

use super::args::GlobalArgs;
use super::{evaluate, inspect, profiles, reconstruct, skeleton};

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
    #[command(after_help = reconstruct::EXAMPLES, args_override_self = true)]
    Reconstruct(Box<reconstruct::ReconstructArgs>),
    /// March the skeleton of a mesh and write it
    #[command(after_help = skeleton::EXAMPLES, args_override_self = true)]
    Skeleton(skeleton::SkeletonArgs),
    /// Measure skeletons: centeredness, topology, what lies outside
    #[command(after_help = evaluate::EXAMPLES, args_override_self = true)]
    Evaluate(evaluate::EvaluateArgs),
    /// Check a mesh: what was mended, labels per source, interface sections
    #[command(after_help = inspect::EXAMPLES, args_override_self = true)]
    Inspect(inspect::InspectArgs),
    /// List and search the profiles of the catalogues
    #[command(after_help = profiles::EXAMPLES, args_override_self = true)]
    Profiles(profiles::ProfilesArgs),
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

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  beamwright completions bash > ~/.local/share/bash-completion/completions/beamwright
  beamwright completions zsh > ~/.zfunc/_beamwright      (with ~/.zfunc in fpath)
  beamwright completions fish > ~/.config/fish/completions/beamwright.fish";

const MAN_EXAMPLES: &str = "\
Examples:
  beamwright man | man -l -
  beamwright man reconstruct | man -l -";

#[cfg(test)]
mod tests {
    use beamwright::frame::{FrameParams, ProfileParams};
    use beamwright::mesh::LabelParams;
    use beamwright::skeleton::SkeletonParams;
    use clap::CommandFactory;

    use super::*;

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
