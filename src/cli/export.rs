//! `--export`: further files, each in the format its extension names.

use std::path::{Path, PathBuf};

use beamwright::output::files::WriteError;
use beamwright::output::material::Material;
use beamwright::output::mlp::{self, Project};
use beamwright::output::view::View;
use beamwright::output::{OutputFiles, calculix, dxf, glb, ifc, step};
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
    Dxf,
    Ifc,
    CalculiX,
}

impl Format {
    const ALL: [Self; 5] =
        [Self::MeshLabProject, Self::BinaryGltf, Self::Dxf, Self::Ifc, Self::CalculiX];

    const fn extension(self) -> &'static str {
        match self {
            Self::MeshLabProject => "mlp",
            Self::BinaryGltf => "glb",
            Self::Dxf => "dxf",
            Self::Ifc => "ifc",
            Self::CalculiX => "inp",
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
            Format::BinaryGltf | Format::Dxf | Format::Ifc | Format::CalculiX => {
                vec![self.path.clone()]
            }
        }
    }

    /// Adds the files to those that are written together.
    pub(crate) fn add(
        &self,
        files: &mut OutputFiles,
        outcome: &Outcome,
        document: &step::Document,
        material: &Material,
    ) -> Result<(), WriteError> {
        let Outcome { frame, joints, surface, .. } = outcome;
        let name = &document.name;
        match self.format {
            Format::Dxf => files.add(&self.path, |out| dxf::write(frame, out)),
            Format::Ifc => {
                files.add(&self.path, |out| ifc::write(name, frame, joints, material, out))
            }
            Format::CalculiX => files.add(&self.path, |out| {
                calculix::write(name, frame, &surface.interfaces, material, out)
            }),
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
