//! Why there is no assembly.

use std::f64::consts::PI;

use crate::frame::{Beam, Frame, mark};
use crate::output::step;

/// Why there is no assembly.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AssemblyError {
    /// CAD programs take every beam for nothing.
    #[error(
        "the longest beam, {beam}, is {length:.1e} mm long and {thick:.1e} mm thick, and CAD programs take \
         lengths below {least:e} mm for nothing; scale the part, or tell the unit of the file with --unit",
        least = step::SHORTEST
    )]
    TooFine {
        /// Mark of the longest.
        beam: String,
        /// Its length, mm.
        length: f64,
        /// Diameter of the round bar of its area, mm.
        thick: f64,
    },

    /// No beam is a solid, not even as a round bar.
    #[error("no beam can be built as a solid; {beam}: {fault}")]
    NoBeam {
        /// Mark and name of the first.
        beam: String,
        /// What is wrong with it.
        fault: step::BodyError,
    },

    /// The ball of a joint is no solid.
    #[error("a ball of a joint is no solid: {0}")]
    Ball(#[from] step::BodyError),
}

impl AssemblyError {
    /// The error for a frame whose beams are all finer than a solid can be.
    pub(super) fn too_fine(frame: &Frame) -> Option<Self> {
        let thick = |b: &Beam| 2.0 * (b.shape.properties.area / PI).sqrt();
        let is_fine = |b: &Beam| b.length.min(thick(b)) < step::SHORTEST;
        let longest = (0..frame.beams.len())
            .max_by(|&i, &j| frame.beams[i].length.total_cmp(&frame.beams[j].length))?;
        let beam = &frame.beams[longest];
        let (length, thick) = (beam.length, thick(beam));
        let error = Self::TooFine { beam: mark(longest), length, thick };
        frame.beams.iter().all(is_fine).then_some(error)
    }
}
