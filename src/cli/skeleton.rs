//! `beamwright skeleton`.

use beamwright::output::OutputFiles;
use beamwright::output::summary::Summary;
use beamwright::pipeline::march;
use beamwright::skeleton_file;

use super::args::{GlobalArgs, SkeletonArgs};
use super::exit::{Exit, Failure};
use super::progress::Progress;
use super::{show, targets};

pub(crate) fn run(
    args: &SkeletonArgs,
    global: &GlobalArgs,
    progress: &mut Progress,
) -> Result<Exit, Failure> {
    let format = skeleton_format(&args.output)?;
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

/// The skeleton format a file name asks for.
pub(crate) fn skeleton_format(path: &std::path::Path) -> Result<skeleton_file::Format, Failure> {
    skeleton_file::Format::of(path).map_err(Failure::usage)
}
