//! `beamwright evaluate`: any skeleton, held against the mesh it was made of.

use std::path::{Path, PathBuf};

use beamwright::evaluate::{
    BoundingSphere, Compared, EvaluateError, EvaluateOptions, Evaluated, Evaluation, Evaluator,
    Link, Report, compare,
};
use beamwright::pipeline::surface;
use beamwright::skeleton::Skeleton;
use beamwright::skeleton_file;
use beamwright_formats::Unit;
use clap::{Args, ValueEnum};

use super::args::{GlobalArgs, InputArgs, ResultArgs};
use super::exit::{Exit, Failure};
use super::progress::Progress;
use super::show;

pub(crate) const EXAMPLES: &str = "\
Examples:
  beamwright evaluate part.obj part.skeleton.json
  beamwright evaluate part.obj ours.json theirs.cg --post-process
  beamwright evaluate part.stl axes_nodes.txt --non-design pads.stl --json";

/// What the evaluation is told.
#[derive(Args, Debug)]
pub(crate) struct EvaluateArgs {
    #[command(flatten)]
    input: InputArgs,
    #[command(flatten)]
    measure: MeasureArgs,
    #[command(flatten)]
    result: ResultArgs,

    /// Skeletons: .json .obj .ply .cg .swc, or NAME_nodes.txt beside NAME_connectivity.txt
    #[arg(value_name = "SKELETON", required = true)]
    skeletons: Vec<PathBuf>,
}

#[derive(Args, Debug)]
#[command(next_help_heading = "Evaluation")]
struct MeasureArgs {
    /// Unit of length in the skeleton files; JSON says its own (default: that of --unit, or mm)
    #[arg(long, value_name = "mm|cm|m|in")]
    skeleton_unit: Option<Unit>,

    /// Drop what lies in non-design parts, join the interface centres, prune dangling ends
    #[arg(long, value_name = "RULE", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "closest")]
    post_process: Option<LinkArg>,

    /// Distance of the points at equal spacing, mm (default: mean strut radius)
    #[arg(long, value_name = "MM")]
    resample: Option<f64>,

    /// Half the side of the neighbourhood cube, mm (default: reach of the interface sections)
    #[arg(long, value_name = "MM")]
    cube: Option<f64>,

    /// Sphere whose radius the criterion is divided by
    #[arg(long, value_name = "SPHERE", default_value = "smallest")]
    sphere: SphereArg,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum LinkArg {
    /// Each interface centre to its closest point, as in the thesis
    Closest,
    /// Every cut branch to its interface section
    Cut,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum SphereArg {
    /// The smallest one that holds the mesh
    Smallest,
    /// The one about the centre of the bounding box
    Box,
}

pub(crate) fn run(
    args: &EvaluateArgs,
    global: &GlobalArgs,
    progress: &mut Progress,
) -> Result<Exit, Failure> {
    let options = args.measure.options();
    options.check().map_err(Failure::usage)?;
    let surface = surface(&args.input.input, &args.input.settings(), progress)?;
    let unit = args.measure.skeleton_unit.or(args.input.unit).unwrap_or(Unit::Mm);
    let evaluator = Evaluator::new(&surface, &options).map_err(Failure::usage)?;
    let (mut evaluated, mut skeletons) = (Vec::new(), Vec::new());
    for path in &args.skeletons {
        let read = skeleton_file::read(path, unit).map_err(Failure::input)?;
        let (one, skeleton) = evaluate(&evaluator, path, read, args.measure.post_process)?;
        evaluated.push(one);
        skeletons.push(skeleton);
    }
    let comparisons = comparisons(&evaluated, &skeletons, args.measure.resample)?;
    progress.finish();
    let report = Report::new(evaluated, comparisons);
    print(&report, &args.result, global)?;
    match breach(&report.skeletons).filter(|_| args.result.strict) {
        Some(message) => Err(Failure { exit: Exit::Breach, message }),
        None => Ok(Exit::Done),
    }
}

/// Measures one skeleton, made comparable before if asked for.
fn evaluate(
    evaluator: &Evaluator<'_>,
    path: &Path,
    skeleton: Skeleton,
    link: Option<LinkArg>,
) -> Result<(Evaluated, Skeleton), Failure> {
    let (skeleton, post_processing) = match link {
        Some(link) => {
            let (skeleton, done) = evaluator.post_process(&skeleton, link.into());
            (skeleton, Some(done))
        }
        None => (skeleton, None),
    };
    let evaluation = evaluator.evaluate(&skeleton).map_err(|e| of_file(path, &e))?;
    let name = path.to_string_lossy().into_owned();
    Ok((Evaluated { name, post_processing, evaluation }, skeleton))
}

fn of_file(path: &Path, error: &EvaluateError) -> Failure {
    Failure::input(format!("cannot evaluate {}: {error}", path.display()))
}

/// The first skeleton against each of the others.
fn comparisons(
    evaluated: &[Evaluated],
    skeletons: &[Skeleton],
    step: Option<f64>,
) -> Result<Vec<Compared>, Failure> {
    let ([first, others @ ..], [base, rest @ ..]) = (evaluated, skeletons) else {
        return Ok(Vec::new());
    };
    others
        .iter()
        .zip(rest)
        .map(|(other, skeleton)| {
            let comparison =
                compare(base, skeleton, step).map_err(|e| of_file(Path::new(&other.name), &e))?;
            Ok(Compared { first: first.name.clone(), second: other.name.clone(), comparison })
        })
        .collect()
}

/// What breaks a promise, if anything: how many skeletons, and the first with what is wrong in it.
fn breach(evaluated: &[Evaluated]) -> Option<String> {
    let mut broken = evaluated
        .iter()
        .map(|e| (&e.name, faults(&e.evaluation).join(", ")))
        .filter(|(_, faults)| !faults.is_empty());
    let (name, faults) = broken.next()?;
    let more = match broken.count() {
        0 => String::new(),
        count => format!(" (and {count} more of {} skeletons)", evaluated.len()),
    };
    Some(format!(
        "a promise is broken by {name}: {faults}{more}; mend it, or leave out --strict to have it \
         measured as it is"
    ))
}

/// What keeps a skeleton from lying inside everywhere with the components and cycles of the part.
fn faults(e: &Evaluation) -> Vec<String> {
    let (outside, through) = (e.raw.points_outside, e.outside.segments_through_surface);
    let t = &e.topology;
    [
        (outside > 0, format!("{outside} of its points outside")),
        (through > 0, format!("{through} of its segments through the surface")),
        (
            t.components != t.expected_components,
            format!("components {} instead of {}", t.components, t.expected_components),
        ),
        (
            t.cycle_rank != t.expected_cycle_rank,
            format!("cycles {} instead of {}", t.cycle_rank, t.expected_cycle_rank),
        ),
    ]
    .into_iter()
    .filter_map(|(wrong, text)| wrong.then_some(text))
    .collect()
}

fn print(report: &Report, args: &ResultArgs, global: &GlobalArgs) -> Result<(), Failure> {
    if args.json {
        show::print(&report.to_json().map_err(Failure::input)?)?;
    } else if !global.quiet {
        show::print(&report.to_table())?;
    }
    Ok(())
}

impl MeasureArgs {
    fn options(&self) -> EvaluateOptions {
        let sphere = match self.sphere {
            SphereArg::Smallest => BoundingSphere::Smallest,
            SphereArg::Box => BoundingSphere::BoxCentred,
        };
        EvaluateOptions { step: self.resample, cube_half: self.cube, sphere }
    }
}

impl From<LinkArg> for Link {
    fn from(arg: LinkArg) -> Self {
        match arg {
            LinkArg::Closest => Self::Closest,
            LinkArg::Cut => Self::Cut,
        }
    }
}
