//! Progress out, cancellation in.

use std::ops::ControlFlow;

/// A stage of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Reading the file.
    Read,
    /// Welding, mending and labelling the mesh.
    Mesh,
    /// Marching the skeleton.
    Skeleton,
    /// Measuring sections.
    Sections,
    /// Normalizing branches to beams.
    Frame,
    /// Writing files.
    Write,
}

impl Stage {
    /// The stage in one word, as printed in progress lines.
    pub fn name(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Mesh => "mesh",
            Self::Skeleton => "skeleton",
            Self::Sections => "sections",
            Self::Frame => "frame",
            Self::Write => "write",
        }
    }
}

/// Watches the work and may stop it.
///
/// `()` watches nothing:
///
/// ```
/// use beamwright::observer::{Observer, Stage};
/// assert!(().progress(Stage::Mesh, 1, 2).is_continue());
/// ```
pub trait Observer {
    /// `done` of `total` steps of `stage` are done; `Break` asks the work to stop.
    fn progress(&mut self, _stage: Stage, _done: usize, _total: usize) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// Asked many times within a step, where nothing is worth showing; `Break` asks the work to stop.
    fn keep_on(&mut self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl Observer for () {}
