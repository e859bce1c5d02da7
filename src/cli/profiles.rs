//! `beamwright profiles`: what the catalogues hold.

use std::path::PathBuf;

use beamwright::section::Catalogue;
use beamwright::section::catalogue::{families_table, json_listing, table};
use clap::Args;

use super::exit::{Exit, Failure};
use super::show;

pub(crate) const EXAMPLES: &str = "\
Examples:
  beamwright profiles                          the families and their standards
  beamwright profiles --family CHS,IPE
  beamwright profiles 60.3 --json
  beamwright profiles hea 200
  beamwright profiles --catalogue own.csv --family own";

/// Which profiles are listed.
#[derive(Args, Debug)]
pub(crate) struct ProfilesArgs {
    /// Only profiles with these words in name, family or standard
    #[arg(value_name = "TEXT")]
    search: Vec<String>,

    /// Only these families
    #[arg(long, value_name = "FAMILY", value_delimiter = ',')]
    family: Vec<String>,

    /// Your own profiles (.csv, .json), listed besides the built-in ones; may be repeated
    #[arg(long, value_name = "FILE")]
    catalogue: Vec<PathBuf>,

    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &ProfilesArgs) -> Result<Exit, Failure> {
    let mut all = Catalogue::builtin().clone();
    for file in &args.catalogue {
        all.extend(Catalogue::read(file).map_err(Failure::input)?);
    }
    if args.search.is_empty() && args.family.is_empty() && !args.json {
        show::print(&families_table(&all))?;
        return Ok(Exit::Done);
    }
    if !args.family.is_empty() {
        all = all.of_families(&args.family).map_err(Failure::usage)?;
    }
    let text = args.search.join(" ");
    let found = all.search(&text);
    if found.is_empty() {
        return Err(Failure::input(format!(
            "no profile has \"{text}\" in its name, family or standard"
        )));
    }
    show::print(&if args.json { json_listing(&found) } else { table(&found) })?;
    Ok(Exit::Done)
}
