//! How a run ends.

use std::process::ExitCode;

/// Exit codes, the same for every subcommand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Done.
    Done,
    /// The input cannot be processed.
    Input,
    /// Wrong usage.
    Usage,
    /// `--strict` found a breach.
    Breach,
    /// Interrupted.
    Interrupted,
}

impl Exit {
    /// The code the program ends with.
    pub(crate) const fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Input => 1,
            Self::Usage => 2,
            Self::Breach => 3,
            Self::Interrupted => 130,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        exit.code().into()
    }
}

/// A message for the user with the exit code it ends in.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) exit: Exit,
    pub(crate) message: String,
}

impl Failure {
    pub(crate) fn input(message: impl ToString) -> Self {
        Self { exit: Exit::Input, message: message.to_string() }
    }

    pub(crate) fn interrupted() -> Self {
        Self { exit: Exit::Interrupted, message: "interrupted".into() }
    }

    pub(crate) fn usage(message: impl ToString) -> Self {
        Self { exit: Exit::Usage, message: message.to_string() }
    }
}

impl From<beamwright::pipeline::PipelineError> for Failure {
    fn from(error: beamwright::pipeline::PipelineError) -> Self {
        use beamwright::pipeline::PipelineError as E;
        let exit = match error {
            E::Cancelled => Exit::Interrupted,
            E::Params(_) | E::Match { .. } => Exit::Usage,
            _ => Exit::Input,
        };
        Self { exit, message: error.to_string() }
    }
}
