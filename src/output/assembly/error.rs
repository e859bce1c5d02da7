//! Why there is no assembly, or a beam is missing in it.

use std::f64::consts::PI;

use crate::frame::Beam;
use crate::output::step;

/// Why there is no assembly.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AssemblyError {
    /// No beam is a solid, not even as a round bar.
    #[error("no beam can be built as a solid; {beam}: {fault}")]
    NoBeam {
        /// Mark and name of the first.
        beam: String,
        /// What is wrong with it.
        fault: NoSolid,
    },

    /// The ball of a joint is no solid.
    #[error("a ball of a joint is no solid: {0}")]
    Ball(#[from] step::BodyError),
}

/// Why a beam is no solid, not even as a round bar with square ends.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoSolid {
    /// It is finer than what CAD programs can tell from nothing.
    #[error(
        "it is {length:.1e} mm long and {thick:.1e} mm thick, and CAD programs take lengths below \
         {least:e} mm for nothing; scale the part, or tell the unit of the file with --unit",
        least = step::SHORTEST
    )]
    TooFine {
        /// Its length, mm.
        length: f64,
        /// Diameter of the round bar of its area, mm.
        thick: f64,
    },

    /// Anything else.
    #[error(transparent)]
    Body(step::BodyError),
}

impl NoSolid {
    /// The fault of a beam in the words of its user.
    pub(super) fn of(beam: &Beam, fault: step::BodyError) -> Self {
        let length = beam.length;
        let thick = 2.0 * (beam.shape.properties.area / PI).sqrt();
        let is_fine = length.min(thick) < step::SHORTEST;
        if is_fine { Self::TooFine { length, thick } } else { Self::Body(fault) }
    }
}
