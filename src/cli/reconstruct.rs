//! `beamwright reconstruct`: the main job.

use std::path::{Path, PathBuf};

use beamwright::mesh::Surface;
use beamwright::output::assembly::{Assembly, AssemblyError, assembly};
use beamwright::output::cut_list::CutList;
use beamwright::output::mesh_export::{PartMesh, write_parts};
use beamwright::output::sections::SectionFormat;
use beamwright::output::summary::Summary;
use beamwright::output::{OutputFiles, sections, step};
use beamwright::pipeline::{self, Outcome};
use beamwright::skeleton_file;

use super::args::{GlobalArgs, ReconstructArgs};
use super::exit::{Exit, Failure};
use super::export::Export;
use super::look::Looks;
use super::progress::Progress;
use super::skeleton::skeleton_format;
use super::{show, targets};

/// One mesh, or many into one folder.
pub(crate) fn run(
    args: &ReconstructArgs,
    global: &GlobalArgs,
    progress: &mut Progress,
) -> Result<Exit, Failure> {
    args.shop.check()?;
    match (&args.output.out_dir, &args.output.output) {
        (Some(folder), _) => super::batch::run(args, folder, global, progress),
        (None, _) if !args.more.is_empty() => Err(Failure::usage(
            "for more than one mesh give a folder, --out-dir, instead of --output",
        )),
        (None, step) => {
            let step = step.clone().unwrap_or_default();
            Job::new(args.of_one(&args.input.input, step))?.run(global, progress)
        }
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
        Ok(Self { targets: Targets::new(&args)?, args })
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
        targets.check(&args)?;
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
            targets.claim_beside(args)?;
        }
        let files = written(targets, args, &outcome, &summary, &list, &document, &beside)?;
        targets::commit(files, progress)?;
    }
    progress.finish();
    show::summary(&summary, &args.result, global)
}

/// Why the beams of a mesh are no solids, and what to do where its size tells.
fn not_built(mesh: &Path, surface: &Surface, fault: &AssemblyError) -> Failure {
    let advice = pipeline::unit_in_doubt(surface.report.extent);
    let advice = advice.map_or_else(String::new, |advice| format!("; {advice}"));
    Failure::input(format!("cannot build {}: {fault}{advice}", mesh.display()))
}

/// Where the results go.
struct Targets {
    step: PathBuf,
    cut_list: PathBuf,
    cut_list_format: CutListFormat,
    skeleton: PathBuf,
    skeleton_format: skeleton_file::Format,
    /// Non-design parts that are too much for the STEP file; claimed only where there are any.
    beside: PathBuf,
    /// All others.
    claimed: Vec<PathBuf>,
    sections: Option<(PathBuf, SectionFormat)>,
    exports: Vec<Export>,
    looks: Looks,
}

impl Targets {
    /// What the endings of the outputs ask for.
    fn new(args: &ReconstructArgs) -> Result<Self, Failure> {
        let step = args.output.output.clone().unwrap_or_default();
        let is_step = step
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("step") || e.eq_ignore_ascii_case("stp"));
        if !is_step {
            return Err(Failure::usage(format!(
                "the output {} must end in .step or .stp",
                step.display()
            )));
        }
        let beside = |ending: &str| step.with_extension(ending);
        let cut_list = args.output.cut_list.clone().unwrap_or_else(|| beside("csv"));
        let skeleton = args.output.skeleton.clone().unwrap_or_else(|| beside("skeleton.json"));
        let sections = args.output.sections.as_deref().map(section_target).transpose()?;
        let exports: Vec<Export> =
            args.output.export.iter().map(|path| Export::new(path)).collect::<Result<_, _>>()?;
        let looks = Looks::new(args)?;
        let non_design = beside("non-design.ply");
        let mut all = vec![step.clone(), cut_list.clone(), skeleton.clone()];
        all.extend(sections.iter().map(|(path, _)| path.clone()));
        all.extend(exports.iter().flat_map(Export::targets));
        all.extend(looks.targets());
        Ok(Self {
            skeleton_format: skeleton_format(&skeleton)?,
            step,
            cut_list_format: cut_list_format(&cut_list)?,
            cut_list,
            skeleton,
            beside: non_design,
            claimed: all,
            sections,
            exports,
            looks,
        })
    }

    /// Checks every target before the work begins.
    fn check(&self, args: &ReconstructArgs) -> Result<(), Failure> {
        let all = self.claimed.iter().map(PathBuf::as_path);
        targets::check(all, &args.input, &args.frame.catalogue)
    }

    /// Checks the mesh file of non-design parts against what else is read and written.
    fn claim_beside(&self, args: &ReconstructArgs) -> Result<(), Failure> {
        let all = self.claimed.iter().chain([&self.beside]);
        targets::check(all.map(PathBuf::as_path), &args.input, &args.frame.catalogue)
    }
}

/// How the cut list is written.
#[derive(Clone, Copy)]
enum CutListFormat {
    Csv,
    Json,
}

fn cut_list_format(path: &Path) -> Result<CutListFormat, Failure> {
    let is = |e: &str| path.extension().is_some_and(|x| x.eq_ignore_ascii_case(e));
    match (is("csv"), is("json")) {
        (true, _) => Ok(CutListFormat::Csv),
        (_, true) => Ok(CutListFormat::Json),
        _ => Err(Failure::usage(format!(
            "the cut list {} must end in .csv or .json",
            path.display()
        ))),
    }
}

fn section_target(path: &Path) -> Result<(PathBuf, SectionFormat), Failure> {
    let format = SectionFormat::of(path).ok_or_else(|| {
        Failure::usage(format!("the sections {} must end in .json or .csv", path.display()))
    })?;
    Ok((path.to_owned(), format))
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
    targets.looks.add(&mut files, args, outcome, summary, document, list)?;
    Ok(files)
}
