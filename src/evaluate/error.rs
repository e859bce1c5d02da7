//! Why a skeleton could not be evaluated.

/// Why a skeleton could not be evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluateError {
    /// An option is outside its range.
    #[error("{name} must be a length above 0, but is {value}")]
    OutOfRange {
        /// The option, as on the command line.
        name: &'static str,
        /// What was given.
        value: f64,
    },

    /// The skeleton is so long that it cannot be measured in such small steps.
    #[error(
        "the skeleton is {length:.3e} mm long, more than {limit} steps of {step:.3e} mm; \
         is its unit that of the mesh?"
    )]
    TooLong {
        /// Length of the skeleton, mm.
        length: f64,
        /// The step, mm.
        step: f64,
        /// Most steps that are taken.
        limit: usize,
    },
}
