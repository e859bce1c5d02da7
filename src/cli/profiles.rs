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
  beamwright profiles --catalogue own.csv --family own";

/// Which profiles are listed.
#[derive(Args, Debug)]
pub(crate) struct ProfilesArgs {
    /// Only profiles whose name holds this text
    #[arg(value_name = "TEXT")]
    search: Option<String>,

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
    if args.search.is_none() && args.family.is_empty() && !args.json {
        show::print(&families_table(&all))?;
        return Ok(Exit::Done);
    }
    if !args.family.is_empty() {
        all = all.of_families(&args.family).map_err(Failure::usage)?;
    }
    let found = all.search(args.search.as_deref().unwrap_or_default());
    if found.is_empty() {
        let text = args.search.as_deref().unwrap_or_default();
        return Err(Failure::input(format!("no profile has \"{text}\" in its name")));
    }
    show::print(&if args.json { json_listing(&found) } else { table(&found) })?;
    Ok(Exit::Done)
}
