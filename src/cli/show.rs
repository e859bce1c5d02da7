//! Prints results on standard output and notes on standard error.

use std::io::{self, Write};
use std::path::Path;

use beamwright::output::summary::Summary;

use super::args::ResultArgs;
use super::exit::{Exit, Failure};

/// The name of a file, safe to print.
pub(crate) fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// Prints a summary in the way that was asked for; the exit code it means.
pub(crate) fn summary(summary: &Summary, args: &ResultArgs) -> Result<Exit, Failure> {
    let text = if args.json {
        serde_json::to_string_pretty(summary).map_err(Failure::input)? + "\n"
    } else {
        summary.to_string()
    };
    print(&text)?;
    Ok(if args.strict && summary.has_breach() { Exit::Breach } else { Exit::Done })
}

/// Writes to standard output; a reader that has gone away is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    match io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::input(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}
