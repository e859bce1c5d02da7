//! `--export`: further files, each in the format its extension names.

use std::path::{Path, PathBuf};

use beamwright::output::files::WriteError;
use beamwright::output::mlp::{self, Project};
use beamwright::output::view::View;
use beamwright::output::{OutputFiles, glb, step};
use beamwright::pipeline::Outcome;

use super::exit::Failure;

/// One further file, or a file with others beside it.
#[derive(Debug)]
pub(crate) struct Export {
    path: PathBuf,
    format: Format,
}

/// What can be exported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    MeshLabProject,
    BinaryGltf,
}

impl Format {
    const ALL: [Self; 2] = [Self::MeshLabProject, Self::BinaryGltf];

    const fn extension(self) -> &'static str {
        match self {
            Self::MeshLabProject => "mlp",
            Self::BinaryGltf => "glb",
        }
    }

    fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        Self::ALL.into_iter().find(|f| extension.eq_ignore_ascii_case(f.extension()))
    }
}

impl Export {
    /// What a file name asks for.
    pub(crate) fn new(path: &Path) -> Result<Self, Failure> {
        let format = Format::of(path).ok_or_else(|| {
            let known = Format::ALL.map(|f| format!(".{}", f.extension())).join(" ");
            Failure::usage(format!("the export {} must end in {known}", path.display()))
        })?;
        Ok(Self { path: path.to_owned(), format })
    }

    /// Every file that is written.
    pub(crate) fn targets(&self) -> Vec<PathBuf> {
        match self.format {
            Format::MeshLabProject => mlp::targets(&self.path).to_vec(),
            Format::BinaryGltf => vec![self.path.clone()],
        }
    }

    /// Adds the files to those that are written together.
    pub(crate) fn add(
        &self,
        files: &mut OutputFiles,
        outcome: &Outcome,
        document: &step::Document,
    ) -> Result<(), WriteError> {
        match self.format {
            Format::MeshLabProject => mlp::add(files, &self.path, &project(outcome, document)),
            Format::BinaryGltf => files
                .add(&self.path, |out| glb::write(&document.name, &view(outcome, document), out)),
        }
    }
}

fn project<'a>(outcome: &'a Outcome, document: &'a step::Document) -> Project<'a> {
    let Outcome { surface, skeleton, sections, .. } = outcome;
    Project { surface, skeleton, sections, document }
}

/// The result as pictures and 3D files show it.
pub(crate) fn view<'a>(outcome: &'a Outcome, document: &step::Document) -> View<'a> {
    let Outcome { surface, skeleton, sections, frame, .. } = outcome;
    View::new(surface, skeleton, sections, frame, document)
}
