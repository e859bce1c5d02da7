//! Where results go: what the names ask for, checked before the work begins, and their common end.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use beamwright::observer::{Observer, Stage};
use beamwright::output::sections::SectionFormat;
use beamwright::output::{OutputFiles, check_target};
use beamwright::skeleton_file;
use beamwright_formats::Unit;

use super::args::InputArgs;
use super::exit::Failure;
use super::export::Export;
use super::look::Looks;
use super::outputs::OutputArgs;
use super::progress::Progress;

/// Where the results of one mesh go.
pub(crate) struct Targets {
    pub(crate) step: PathBuf,
    pub(crate) cut_list: PathBuf,
    pub(crate) cut_list_format: CutListFormat,
    pub(crate) skeleton: PathBuf,
    pub(crate) skeleton_format: skeleton_file::Format,
    /// Non-design parts that are too much for the STEP file; claimed only where there are any.
    pub(crate) beside: PathBuf,
    /// All others.
    pub(crate) claimed: Vec<PathBuf>,
    pub(crate) sections: Option<(PathBuf, SectionFormat)>,
    pub(crate) exports: Vec<Export>,
    pub(crate) looks: Looks,
}

impl Targets {
    /// What the endings of the outputs ask for.
    ///
    /// # Errors
    /// An output whose ending is none of its formats.
    pub(crate) fn new(output: &OutputArgs, unit: Unit) -> Result<Self, Failure> {
        let step = output.output.clone().unwrap_or_default();
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
        let cut_list = output.cut_list.clone().unwrap_or_else(|| beside("csv"));
        let skeleton = output.skeleton.clone().unwrap_or_else(|| beside("skeleton.json"));
        let sections = output.sections.as_deref().map(section_target).transpose()?;
        let exports: Vec<Export> =
            output.export.iter().map(|path| Export::new(path)).collect::<Result<_, _>>()?;
        let looks = Looks::new(output, unit)?;
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
    ///
    /// * `catalogues`: files that are read besides the meshes.
    pub(crate) fn check(&self, input: &InputArgs, catalogues: &[PathBuf]) -> Result<(), Failure> {
        check(self.claimed.iter().map(PathBuf::as_path), input, catalogues)
    }

    /// Checks the mesh file of non-design parts against what else is read and written.
    pub(crate) fn claim_beside(
        &self,
        input: &InputArgs,
        catalogues: &[PathBuf],
    ) -> Result<(), Failure> {
        let all = self.claimed.iter().chain([&self.beside]);
        check(all.map(PathBuf::as_path), input, catalogues)
    }
}

/// How the cut list is written.
#[derive(Clone, Copy)]
pub(crate) enum CutListFormat {
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

/// The skeleton format a file name asks for.
pub(crate) fn skeleton_format(path: &Path) -> Result<skeleton_file::Format, Failure> {
    skeleton_file::Format::of(path).map_err(Failure::usage)
}

/// Whether every target can be written, none is named twice, and none is read.
pub(crate) fn check<'a>(
    targets: impl IntoIterator<Item = &'a Path>,
    input: &InputArgs,
    read: &[PathBuf],
) -> Result<(), Failure> {
    let inputs = || std::iter::once(&input.input).chain(&input.non_design).chain(read);
    let mut places = Vec::new();
    for target in targets {
        check_target(target).map_err(Failure::input)?;
        let place = place(target);
        let shown = target.display();
        if inputs().any(|i| i.canonicalize().is_ok_and(|i| i == place || is_one_file(&i, &place))) {
            return Err(Failure::usage(format!("the output {shown} is an input file")));
        }
        if places.contains(&place) {
            return Err(Failure::usage(format!("two outputs would be written to {shown}")));
        }
        places.push(place);
    }
    Ok(())
}

/// Where a path leads: two ways to name a file have one place.
fn place(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| {
        let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize().unwrap_or_default();
        folder.join(path.file_name().unwrap_or(OsStr::new("")))
    })
}

/// Whether two names are those of one file (hard links).
#[cfg(unix)]
fn is_one_file(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |path: &Path| path.metadata().ok().map(|m| (m.dev(), m.ino()));
    id(a).is_some_and(|a| id(b) == Some(a))
}

/// Whether two names are those of one file: the standard library cannot tell here.
#[cfg(not(unix))]
fn is_one_file(_: &Path, _: &Path) -> bool {
    false
}

/// Puts files in their places, unless the user asked to stop.
pub(crate) fn commit(files: OutputFiles, progress: &mut Progress) -> Result<(), Failure> {
    if progress.progress(Stage::Write, 0, 1).is_break() {
        return Err(Failure::interrupted());
    }
    let names: Vec<String> = files.paths().map(|p| p.display().to_string()).collect();
    files.commit().map_err(Failure::input)?;
    names.iter().for_each(|name| progress.note(&format!("wrote {name}")));
    let _ = progress.progress(Stage::Write, 1, 1);
    Ok(())
}
