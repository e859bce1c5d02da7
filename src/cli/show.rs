//! Prints results on standard output and notes on standard error.

use std::io::{self, Write};
use std::path::Path;

use beamwright::output::summary::Summary;

use super::args::{GlobalArgs, ResultArgs};
use super::exit::{Exit, Failure};

/// The name of a file, safe to print.
pub(crate) fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// Prints a summary in the way that was asked for.
///
/// # Errors
/// With `--strict`, the first promise that does not hold.
pub(crate) fn summary(
    summary: &Summary,
    args: &ResultArgs,
    global: &GlobalArgs,
) -> Result<Exit, Failure> {
    if args.json {
        print(&(serde_json::to_string_pretty(summary).map_err(Failure::input)? + "\n"))?;
    } else if !global.quiet {
        print(&summary.to_string())?;
    }
    let mut breaches = summary.findings.iter().filter(|f| f.breach && args.strict);
    let Some(first) = breaches.next() else { return Ok(Exit::Done) };
    let more = match breaches.count() {
        0 => String::new(),
        count => format!(" (and {count} more)"),
    };
    Err(Failure {
        exit: Exit::Breach,
        message: format!("a promise is broken: {}{more}", first.text),
    })
}

/// Writes to standard output; a reader that has gone away is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    printed(io::stdout().lock().write_all(text.as_bytes()))
}

/// What became of something printed on standard output, once all of it has left the program.
pub(crate) fn printed(result: io::Result<()>) -> Result<(), Failure> {
    match result.and_then(|()| io::stdout().lock().flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::input(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Writes what went wrong to standard error; a reader that has gone away is none the wiser.
pub(crate) fn error(message: &str) {
    let _ = writeln!(io::stderr(), "error: {message}");
}
