//! `--report` and `--picture`: what people look at.

use std::path::{Path, PathBuf};

use beamwright::output::cut_list::CutList;
use beamwright::output::files::WriteError;
use beamwright::output::picture::{self, PictureFormat};
use beamwright::output::report::{self, Measures, Peer, Report};
use beamwright::output::summary::Summary;
use beamwright::output::{OutputFiles, step};
use beamwright::pipeline::Outcome;
use beamwright::skeleton_file;
use beamwright_formats::Unit;

use super::exit::Failure;
use super::export::view;
use super::outputs::OutputArgs;
use super::show;

/// The files to look at that were asked for.
pub(crate) struct Looks {
    report: Option<PathBuf>,
    pictures: Vec<(PathBuf, PictureFormat)>,
    peers: Vec<Peer>,
}

impl Looks {
    /// Checks what was asked for and reads the skeletons to compare with, before the work begins.
    ///
    /// * `unit`: of skeletons whose format has none.
    pub(crate) fn new(output: &OutputArgs, unit: Unit) -> Result<Self, Failure> {
        if let Some(path) = output.report.as_deref().filter(|p| !is_html(p)) {
            return Err(Failure::usage(format!("the report {} must end in .html", path.display())));
        }
        Ok(Self {
            report: output.report.clone(),
            pictures: output.picture.iter().map(|p| picture_of(p)).collect::<Result<_, _>>()?,
            peers: output.compare.iter().map(|p| peer(p, unit)).collect::<Result<_, _>>()?,
        })
    }

    /// Every file that is written.
    pub(crate) fn targets(&self) -> impl Iterator<Item = PathBuf> + '_ {
        self.report.iter().chain(self.pictures.iter().map(|(path, _)| path)).cloned()
    }

    /// Adds the files to those that are written together.
    ///
    /// * `name`: of the mesh.
    pub(crate) fn add(
        self,
        files: &mut OutputFiles,
        name: &str,
        outcome: &Outcome,
        summary: &Summary,
        document: &step::Document,
        cut_list: &CutList,
    ) -> Result<(), Failure> {
        let view = view(outcome, document);
        for (path, format) in &self.pictures {
            files
                .add(path, |out| picture::write(*format, &view, out))
                .map_err(|e: WriteError| Failure::input(e))?;
        }
        let Some(path) = &self.report else { return Ok(()) };
        let measures = Measures::new(&outcome.surface, &outcome.skeleton, self.peers)
            .map_err(Failure::input)?;
        let report = Report { name, summary, view: &view, measures: &measures, cut_list };
        files.add(path, |out| report::write(&report, out)).map_err(Failure::input)
    }
}

fn is_html(path: &Path) -> bool {
    path.extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("html") || e.eq_ignore_ascii_case("htm"))
}

fn picture_of(path: &Path) -> Result<(PathBuf, PictureFormat), Failure> {
    let format = PictureFormat::of(path).ok_or_else(|| {
        Failure::usage(format!("the picture {} must end in .png or .svg", path.display()))
    })?;
    Ok((path.to_owned(), format))
}

fn peer(path: &Path, unit: Unit) -> Result<Peer, Failure> {
    let skeleton = skeleton_file::read(path, unit).map_err(Failure::input)?;
    Ok(Peer { name: show::name_of(path), skeleton })
}
