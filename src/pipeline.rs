//! The stages in order: file → surface → skeleton → sections → frame.
//!
//! Each stage hands its result to the next; nothing is shared behind their backs. What is odd but
//! workable is gathered as [`Finding`]s on the way.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use beamwright_formats::{ReadError, ReadOptions, read};

use crate::finding::Finding;
use crate::frame::{self, Frame, FrameParams, Normalized, ProfileParams, Section};
use crate::joint::{JointKind, Joints, joints};
use crate::mesh::indexed::{IndexedMesh, weld};
use crate::mesh::label::LabelParams;
use crate::mesh::{self, MeshError, Surface, prepare_watched};
use crate::observer::{Observer, Stage};
use crate::section::Catalogue;
use crate::section::catalogue::CatalogueError;
use crate::section::matching::{MatchError, ProfileChoice};
use crate::skeleton::params::OutOfRange;
use crate::skeleton::{self, Marched, Orientation, Skeleton, SkeletonError, SkeletonParams};
use crate::wording::counted;

/// Everything that steers a run.
#[derive(Clone, Debug)]
pub struct Settings {
    /// How the file is read.
    pub read: ReadOptions,
    /// Files with the non-design part, as closed meshes.
    pub non_design_files: Vec<PathBuf>,
    /// What else says which faces are non-design; its second meshes are read from the files.
    pub labels: LabelParams,
    /// The march.
    pub skeleton: SkeletonParams,
    /// Normalization.
    pub frame: FrameParams,
    /// Profiles.
    pub profiles: ProfileParams,
    /// How beams are joined.
    pub joints: JointKind,
    /// Files with the user's own profiles, searched besides the built-in ones.
    pub catalogue_files: Vec<PathBuf>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            read: ReadOptions::default(),
            non_design_files: Vec::new(),
            labels: LabelParams::default(),
            skeleton: SkeletonParams::for_beams(),
            frame: FrameParams::default(),
            profiles: ProfileParams::default(),
            joints: JointKind::default(),
            catalogue_files: Vec::new(),
        }
    }
}

/// What a run produced.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The surface that was marched.
    pub surface: Surface,
    /// Its skeleton.
    pub skeleton: Skeleton,
    /// The section at each skeletal point.
    pub sections: Vec<Option<Section>>,
    /// Straight beams.
    pub frame: Frame,
    /// How they are cut where they meet.
    pub joints: Joints,
    /// What the user should know, breaches first.
    pub findings: Vec<Finding>,
}

/// Why a run ended without a result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PipelineError {
    /// A file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The mesh cannot be used.
    #[error("cannot use {}: {source}", path.display())]
    Mesh {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: MeshError,
    },
    /// No skeleton was found.
    #[error("no skeleton of {}: {source}", path.display())]
    Skeleton {
        /// The file.
        path: PathBuf,
        /// Why.
        source: SkeletonError,
    },
    /// No branch of the skeleton became a beam.
    #[error(
        "no beam of {}: the march found {}, but none is as long as it is thick; {}",
        path.display(),
        counted(*branches, "branch", "branches"),
        match orientation {
            Orientation::Global => "try --orientation local, which turns with the part",
            Orientation::Local => "beamwright needs a beam-like result",
        }
    )]
    NoBeam {
        /// The file.
        path: PathBuf,
        /// Which march.
        orientation: Orientation,
        /// Branches it found.
        branches: usize,
    },
    /// A parameter is out of its range.
    #[error(transparent)]
    Params(#[from] OutOfRange),
    /// The user's profiles cannot be read.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// A beam finds no profile.
    #[error("no profile for the beams of {}: {source}", path.display())]
    Match {
        /// The file.
        path: PathBuf,
        /// Why.
        source: MatchError,
    },
    /// The observer asked to stop.
    #[error("interrupted")]
    Cancelled,
}

/// Reads a file and makes a surface of it.
///
/// # Errors
/// The file cannot be read or its mesh cannot be used.
pub fn surface(
    path: &Path,
    settings: &Settings,
    observer: &mut impl Observer,
) -> Result<Surface, PipelineError> {
    step(observer, Stage::Read, 0)?;
    let raw = read(path, &settings.read)?;
    let mut labels = settings.labels.clone();
    for file in &settings.non_design_files {
        labels.second_meshes.push(read_part(file, &settings.read)?);
    }
    step(observer, Stage::Mesh, 0)?;
    let surface = prepare_watched(&raw, &labels, observer).map_err(|source| match source {
        MeshError::Cancelled => PipelineError::Cancelled,
        source => PipelineError::Mesh { path: path.to_owned(), source },
    })?;
    step(observer, Stage::Mesh, 1)?;
    Ok(surface)
}

fn read_part(path: &Path, options: &ReadOptions) -> Result<IndexedMesh, PipelineError> {
    Ok(weld(&read(path, options)?).0)
}

/// Reads a file and marches its skeleton.
///
/// # Errors
/// As [`surface`]; or no part of it is beam-like.
pub fn march(
    path: &Path,
    settings: &Settings,
    observer: &mut impl Observer,
) -> Result<(Surface, Marched), PipelineError> {
    settings.skeleton.check()?;
    let surface = surface(path, settings, observer)?;
    let mut marched =
        skeleton::march(&surface, &settings.skeleton, observer).map_err(|source| match source {
            SkeletonError::Cancelled => PipelineError::Cancelled,
            source => PipelineError::Skeleton { path: path.to_owned(), source },
        })?;
    marched.findings.extend(mesh::findings(&surface));
    breaches_first(&mut marched.findings);
    Ok((surface, marched))
}

/// Runs all stages on a file.
///
/// # Errors
/// As [`march`].
pub fn run(
    path: &Path,
    settings: &Settings,
    observer: &mut impl Observer,
) -> Result<Outcome, PipelineError> {
    settings.frame.check()?;
    let catalogue = catalogue(settings)?;
    let (surface, Marched { skeleton, mut findings }) = march(path, settings, observer)?;
    step(observer, Stage::Sections, 0)?;
    let watched = frame::sections_watched(&surface, &skeleton, observer);
    let sections = unless_stopped(watched)?;
    step(observer, Stage::Frame, 0)?;
    let watched =
        frame::normalize_watched(&skeleton, &sections, &surface, &settings.frame, observer);
    let Normalized { mut frame, findings: odd } = unless_stopped(watched)?;
    findings.extend(odd);
    if frame.beams.is_empty() {
        let orientation = settings.skeleton.orientation;
        let branches = skeleton.branches.len();
        return Err(PipelineError::NoBeam { path: path.to_owned(), orientation, branches });
    }
    step(observer, Stage::Frame, 0)?;
    let matched =
        frame::match_profiles_watched(&mut frame, &settings.profiles, &catalogue, observer);
    findings.extend(matched.map_err(|source| match source {
        MatchError::Cancelled => PipelineError::Cancelled,
        source => PipelineError::Match { path: path.to_owned(), source },
    })?);
    step(observer, Stage::Frame, 0)?;
    let (joints, odd) = joints(&frame, &surface.interfaces, settings.joints);
    findings.extend(odd);
    step(observer, Stage::Frame, 1)?;
    breaches_first(&mut findings);
    Ok(Outcome { surface, skeleton, sections, frame, joints, findings })
}

/// The built-in profiles, where they are asked for: their properties take longer than many a frame.
/// And those of the user, whose faults are told in any case.
fn catalogue(settings: &Settings) -> Result<Catalogue, PipelineError> {
    let mut all = match settings.profiles.choice {
        ProfileChoice::Catalogue(_) => Catalogue::builtin().clone(),
        _ => Catalogue::default(),
    };
    for file in &settings.catalogue_files {
        all.extend(Catalogue::read(file)?);
    }
    Ok(all)
}

fn step(observer: &mut impl Observer, stage: Stage, done: usize) -> Result<(), PipelineError> {
    unless_stopped(observer.progress(stage, done, 1))
}

fn unless_stopped<T>(watched: ControlFlow<(), T>) -> Result<T, PipelineError> {
    watched.continue_value().ok_or(PipelineError::Cancelled)
}

fn breaches_first(findings: &mut [Finding]) {
    findings.sort_by_key(|f| (!f.breach, f.kind));
}
