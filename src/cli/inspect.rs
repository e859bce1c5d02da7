//! `beamwright inspect`.

use beamwright::mesh;
use beamwright::output::summary::Summary;
use beamwright::pipeline::surface;
use clap::Args;

use super::args::{GlobalArgs, InputArgs, ResultArgs};
use super::exit::{Exit, Failure};
use super::progress::Progress;
use super::show;

pub(crate) const EXAMPLES: &str = "\
Examples:
  beamwright inspect part.stl --non-design pads.stl
  beamwright inspect part.obj --json";

#[derive(Args, Debug)]
pub(crate) struct InspectArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) result: ResultArgs,
}

pub(crate) fn run(
    args: &InspectArgs,
    global: &GlobalArgs,
    progress: &mut Progress,
) -> Result<Exit, Failure> {
    let surface = surface(&args.input.input, &args.input.settings(), progress)?;
    progress.finish();
    let name = show::name_of(&args.input.input);
    let summary = Summary::new(name, &surface, &mesh::findings(&surface));
    show::summary(&summary, &args.result, global)
}
