//! `beamwright skeleton`.

use std::path::PathBuf;

use beamwright::output::OutputFiles;
use beamwright::output::summary::Summary;
use beamwright::pipeline::march;
use beamwright::skeleton_file;
use clap::Args;

use super::args::{GlobalArgs, InputArgs, ResultArgs};
use super::exit::{Exit, Failure};
use super::march::MarchArgs;
use super::progress::Progress;
use super::{show, targets};

pub(crate) const EXAMPLES: &str = "\
Examples:
  beamwright skeleton part.obj -o skeleton.json
  beamwright skeleton part.obj -o skeleton.ply      (opens in MeshLab)";

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

pub(crate) fn run(
    args: &SkeletonArgs,
    global: &GlobalArgs,
    progress: &mut Progress,
) -> Result<Exit, Failure> {
    let format = targets::skeleton_format(&args.output)?;
    targets::check([args.output.as_path()], &args.input, &[])?;
    let mut settings = args.input.settings();
    settings.skeleton = (&args.march).into();
    let (surface, marched) = march(&args.input.input, &settings, progress)?;
    let name = show::name_of(&args.input.input);
    let summary =
        Summary::new(name, &surface, &marched.findings).with_skeleton(&surface, &marched.skeleton);
    if !(args.result.strict && summary.has_breach()) {
        let mut files = OutputFiles::default();
        files
            .add(&args.output, |mut out| skeleton_file::write(&marched.skeleton, format, &mut out))
            .map_err(Failure::input)?;
        targets::commit(files, progress)?;
    }
    progress.finish();
    show::summary(&summary, &args.result, global)
}
