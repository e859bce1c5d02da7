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

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Done => 0,
            Exit::Input => 1,
            Exit::Usage => 2,
            Exit::Breach => 3,
            Exit::Interrupted => 130,
        })
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
