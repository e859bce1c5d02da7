//! What the command line knows of itself: completions and manual pages.

use clap::CommandFactory;
use clap_complete::Shell;

use super::args::Cli;
use super::exit::{Exit, Failure};
use super::show;

/// Prints the completions of a shell.
pub(crate) fn completions(shell: Shell) -> Result<Exit, Failure> {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "beamwright", &mut text);
    print(text)
}

/// Prints the manual page of the program or of a subcommand.
pub(crate) fn manual(command: Option<&str>) -> Result<Exit, Failure> {
    let mut all = Cli::command();
    all.build();
    let page = match command {
        None => all,
        Some(name) => all.find_subcommand(name).cloned().ok_or_else(|| {
            let known: Vec<&str> = all.get_subcommands().map(|c| c.get_name()).collect();
            Failure::usage(format!("no subcommand {name}; there are {}", known.join(", ")))
        })?,
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(page).render(&mut text).map_err(Failure::input)?;
    print(text)
}

fn print(text: Vec<u8>) -> Result<Exit, Failure> {
    show::print(&String::from_utf8_lossy(&text))?;
    Ok(Exit::Done)
}
