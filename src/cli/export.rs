//! `--export`: further files, each in the format its extension names.

use std::path::{Path, PathBuf};

use beamwright::output::files::WriteError;
use beamwright::output::mlp::{self, Project};
use beamwright::output::{OutputFiles, step};
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
}

impl Format {
    const ALL: [Self; 1] = [Self::MeshLabProject];

    const fn extension(self) -> &'static str {
        match self {
            Self::MeshLabProject => "mlp",
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
        }
    }
}

fn project<'a>(outcome: &'a Outcome, document: &'a step::Document) -> Project<'a> {
    let Outcome { surface, skeleton, sections, .. } = outcome;
    Project { surface, skeleton, sections, document }
}
