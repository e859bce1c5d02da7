//! `beamwright reconstruct`: the main job.

use std::path::{Path, PathBuf};

use beamwright::mesh::{Surface, unit_in_doubt};
use beamwright::output::assembly::{Assembly, AssemblyError, NoSolid, assembly};
use beamwright::output::cut_list::CutList;
use beamwright::output::mesh_export::{PartMesh, write_parts};
use beamwright::output::summary::Summary;
use beamwright::output::{OutputFiles, sections, step};
use beamwright::pipeline::{self, Outcome};
use beamwright::skeleton_file;
use beamwright_formats::Unit;
use clap::Args;

use super::args::{GlobalArgs, InputArgs, ResultArgs};
use super::exit::{Exit, Failure};
use super::frame::FrameArgs;
use super::march::MarchArgs;
use super::outputs::OutputArgs;
use super::progress::Progress;
use super::shop::ShopArgs;
use super::targets::{CutListFormat, Targets};
use super::{show, targets};

pub(crate) const EXAMPLES: &str = "\
Examples:
  beamwright reconstruct part.obj -o part.step
  beamwright reconstruct part.stl --non-design pads.stl -o part.step --cut-list part.csv
  beamwright reconstruct part.ply -o part.step --skeleton part.json --json
  beamwright reconstruct part.ply -o part.step --export part.mlp      (opens in MeshLab)
  beamwright reconstruct part.obj -o part.step --report .html         (part.html, for a browser)
  beamwright reconstruct *.stl --out-dir beams --report .html --picture .png
  beamwright reconstruct part.obj -o part.step --config shop.toml";

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

impl ReconstructArgs {
    /// The same for one mesh, into a STEP file.
    pub(crate) fn of_one(&self, input: &Path, step: PathBuf) -> Self {
        let mut one = Self { output: self.output.of_one(step), ..self.clone() };
        one.input.input = input.to_owned();
        one
    }
}

/// One mesh and what is made of it.
pub(crate) struct Job {
    args: ReconstructArgs,
    targets: Targets,
}

impl Job {
    /// Checks what is asked for, before any work.
    ///
    /// # Errors
    /// An output whose ending is none of its formats.
    pub(crate) fn new(args: ReconstructArgs) -> Result<Self, Failure> {
        let unit = args.input.unit.unwrap_or(Unit::Mm);
        Ok(Self { targets: Targets::new(&args.output, unit)?, args })
    }

    /// The mesh.
    pub(crate) fn input(&self) -> &Path {
        &self.args.input.input
    }

    /// Every file that is written.
    pub(crate) fn outputs(&self) -> &[PathBuf] {
        &self.targets.claimed
    }

    /// From the mesh to its beams.
    pub(crate) fn run(self, global: &GlobalArgs, progress: &mut Progress) -> Result<Exit, Failure> {
        let Self { args, targets } = self;
        targets.check(&args.input, &args.frame.catalogue)?;
        reconstruct(&args, targets, global, progress)
    }
}

fn reconstruct(
    args: &ReconstructArgs,
    targets: Targets,
    global: &GlobalArgs,
    progress: &mut Progress,
) -> Result<Exit, Failure> {
    let mut settings = args.input.settings();
    settings.skeleton = (&args.march).into();
    settings.frame = (&args.frame).into();
    settings.profiles = (&args.frame).into();
    settings.joints = args.frame.joints.into();
    settings.catalogue_files = args.frame.catalogue.clone();
    let mut outcome = pipeline::run(&args.input.input, &settings, progress)?;
    let name = show::name_of(&args.input.input);
    let stem = args.input.input.file_stem().unwrap_or_default().to_string_lossy();
    let density = args.shop.density;
    let mut built = assembly(&stem, &outcome.frame, &outcome.joints, density)
        .map_err(|fault| not_built(&args.input.input, &outcome.surface, &fault))?;
    if !args.output.no_non_design {
        built = built.with_non_design(&outcome.surface, density);
    }
    let Assembly { document, sizes, beside, findings } = built;
    outcome.findings.extend(findings);
    let params = args.shop.cut_list_params();
    let list = CutList::new(&outcome.frame, &outcome.joints, &sizes, &params);
    outcome.findings.extend(list.findings());
    let summary = Summary::new(name, &outcome.surface, &outcome.findings)
        .with_skeleton(&outcome.surface, &outcome.skeleton)
        .with_frame(&outcome.surface, &outcome.frame);
    if !(args.result.strict && summary.has_breach()) {
        if !beside.is_empty() {
            targets.claim_beside(&args.input, &args.frame.catalogue)?;
        }
        let files = written(targets, args, &outcome, &summary, &list, &document, &beside)?;
        targets::commit(files, progress)?;
    }
    progress.finish();
    show::summary(&summary, &args.result, global)
}

/// Why the beams of a mesh are no solids, and what to do where its size tells.
fn not_built(mesh: &Path, surface: &Surface, fault: &AssemblyError) -> Failure {
    // A part whose beams are too fine is told so.
    let is_told = matches!(fault, AssemblyError::NoBeam { fault: NoSolid::TooFine { .. }, .. });
    let advice = unit_in_doubt(surface.report.extent).filter(|_| !is_told);
    let advice = advice.map_or_else(String::new, |advice| format!("; {advice}"));
    Failure::input(format!("cannot build {}: {fault}{advice}", mesh.display()))
}

/// The outputs, complete under temporary names.
fn written(
    targets: Targets,
    args: &ReconstructArgs,
    outcome: &Outcome,
    summary: &Summary,
    list: &CutList,
    document: &step::Document,
    beside: &[PartMesh],
) -> Result<OutputFiles, Failure> {
    let mut files = OutputFiles::default();
    files
        .add(&targets.step, |mut out| {
            step::write(document, &mut out).map_err(|e| std::io::Error::other(e.to_string()))
        })
        .and_then(|()| {
            files.add(&targets.cut_list, |out| match targets.cut_list_format {
                CutListFormat::Csv => list.write_csv(out),
                CutListFormat::Json => list.write_json(out),
            })
        })
        .and_then(|()| {
            files.add(&targets.skeleton, |mut out| {
                skeleton_file::write(&outcome.skeleton, targets.skeleton_format, &mut out)
            })
        })
        .map_err(Failure::input)?;
    if !beside.is_empty() {
        files.add(&targets.beside, |out| write_parts(beside, out)).map_err(Failure::input)?;
    }
    if let Some((path, format)) = &targets.sections {
        let Outcome { skeleton, sections, frame, .. } = outcome;
        files
            .add(path, |out| sections::write(*format, skeleton, sections, frame, out))
            .map_err(Failure::input)?;
    }
    for export in &targets.exports {
        export.add(&mut files, outcome, document, &args.shop.material()).map_err(Failure::input)?;
    }
    targets.looks.add(&mut files, &summary.input, outcome, summary, document, list)?;
    Ok(files)
}
