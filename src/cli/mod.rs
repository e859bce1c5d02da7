//! Parses what was typed, runs it, prints the result, and ends with the right exit code.

mod args;
mod batch;
mod command;
mod config;
mod documents;
mod evaluate;
mod exit;
mod export;
mod frame;
mod inspect;
mod look;
mod march;
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

use self::command::{Cli, Command};
use self::config::Words;
use self::exit::{Exit, Failure};
use self::progress::Progress;

/// Runs the command line.
pub(crate) fn main() -> ExitCode {
    let words = match Words::new(std::env::args_os()) {
        Ok(words) => words,
        Err(failure) => return ended(Err(failure)),
    };
    let cli = match Cli::try_parse_from(&words.all) {
        Ok(cli) => cli,
        Err(error) => return ended(not_parsed(&error, &words)),
    };
    if let Some(file) = &cli.global.write_config {
        return ended(config::write(file, &words.all));
    }
    progress::watch_for_interrupt();
    let mut progress = Progress::new(&cli.global);
    let end = match &cli.command {
        Command::Completions { shell } => documents::completions(*shell),
        Command::Man { command } => documents::manual(command.as_deref()),
        Command::Reconstruct(args) => batch::run(args, &cli.global, &mut progress),
        Command::Skeleton(args) => skeleton::run(args, &cli.global, &mut progress),
        Command::Evaluate(args) => evaluate::run(args, &cli.global, &mut progress),
        Command::Profiles(args) => profiles::run(args),
        Command::Inspect(args) => inspect::run(args, &cli.global, &mut progress),
    };
    progress.finish();
    ended(end.map_err(|failure| match words.placed(&failure.message) {
        // Whatever did not come to its end then.
        _ if progress::interrupted() => Failure::interrupted(),
        Some(message) if failure.exit == Exit::Usage => Failure { message, ..failure },
        _ => failure,
    }))
}

/// What is printed in place of a run: what was asked for, or what cannot be understood.
fn not_parsed(error: &clap::Error, words: &Words) -> Result<Exit, Failure> {
    // Help and version go to standard output and are no failure.
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        show::printed(error.print())?;
        return Ok(Exit::Done);
    }
    let text = error.to_string();
    let fault = text.strip_prefix("error: ").and_then(|text| text.split("\n\n").next());
    match fault.and_then(|fault| words.placed(fault)) {
        Some(message) => Err(Failure::usage(message)),
        None => {
            let _ = error.print();
            Ok(Exit::Usage)
        }
    }
}

fn ended(end: Result<Exit, Failure>) -> ExitCode {
    match end {
        Ok(exit) => {
            progress::may_tell_the_end();
            exit.into()
        }
        Err(Failure { exit, message }) => {
            if progress::may_tell_the_end() {
                show::error(&message);
            }
            exit.into()
        }
    }
}
