//! What the command line knows of itself: completions and manual pages.

use std::io;

use clap::{Command, CommandFactory};
use clap_complete::Shell;

use super::command::Cli;
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
    print(page_of(page).map_err(Failure::input)?)
}

/// A manual page whose examples stand line by line.
fn page_of(command: Command) -> io::Result<Vec<u8>> {
    let more = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let page = clap_mangen::Man::new(command);
    let mut text = Vec::new();
    page.render_title(&mut text)?;
    page.render_name_section(&mut text)?;
    page.render_synopsis_section(&mut text)?;
    page.render_description_section(&mut text)?;
    page.render_options_section(&mut text)?;
    page.render_subcommands_section(&mut text)?;
    text.extend(sections(&more).into_bytes());
    page.render_version_section(&mut text)?;
    Ok(text)
}

/// `Examples:` and what is indented below it as a section whose lines are not filled.
fn sections(text: &str) -> String {
    let mut roff = String::new();
    for line in text.lines().filter(|line| !line.is_empty()) {
        match (line.strip_prefix("  "), line.strip_suffix(':')) {
            (None, Some(heading)) => {
                roff += &format!(".fi\n.SH \"{}\"\n.nf\n", heading.to_uppercase());
            }
            (indented, _) => {
                let plain = indented.unwrap_or(line).replace('\\', "\\e").replace('-', "\\-");
                roff += &format!("\\&{plain}\n");
            }
        }
    }
    roff + ".fi\n"
}

fn print(text: Vec<u8>) -> Result<Exit, Failure> {
    show::print(&String::from_utf8_lossy(&text))?;
    Ok(Exit::Done)
}
