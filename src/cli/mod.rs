//! Parses what was typed, runs it, prints the result, and ends with the right exit code.

mod args;
mod batch;
mod config;
mod documents;
mod evaluate;
mod exit;
mod export;
mod inspect;
mod look;
mod outputs;
mod profiles;
mod progress;
mod reconstruct;
mod shop;
mod show;
mod skeleton;
mod targets;

use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind;

use self::args::{Cli, Command};
use self::exit::{Exit, Failure};
use self::progress::Progress;

/// Runs the command line.
pub(crate) fn main() -> ExitCode {
    let typed = match config::with_options(std::env::args_os()) {
        Ok(typed) => typed,
        Err(failure) => return ended(Err(failure)),
    };
    let cli = match Cli::try_parse_from(&typed) {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version go to standard output and are no failure.
            let asked_for =
                matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
            let _ = error.print();
            return if asked_for { Exit::Done } else { Exit::Usage }.into();
        }
    };
    if let Some(file) = &cli.global.write_config {
        return ended(config::write(file, &typed));
    }
    progress::watch_for_interrupt();
    let mut progress = Progress::new(&cli.global);
    let end = match &cli.command {
        Command::Completions { shell } => documents::completions(*shell),
        Command::Man { command } => documents::manual(command.as_deref()),
        Command::Reconstruct(args) => reconstruct::run(args, &cli.global, &mut progress),
        Command::Skeleton(args) => skeleton::run(args, &cli.global, &mut progress),
        Command::Evaluate(args) => evaluate::run(args, &cli.global, &mut progress),
        Command::Profiles(args) => profiles::run(args),
        Command::Inspect(args) => inspect::run(args, &cli.global, &mut progress),
    };
    progress.finish();
    ended(end)
}

fn ended(end: Result<Exit, Failure>) -> ExitCode {
    match end {
        Ok(exit) => exit.into(),
        Err(Failure { exit, message }) => {
            show::error(&message);
            exit.into()
        }
    }
}
