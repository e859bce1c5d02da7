//! The command line of beamwright.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
