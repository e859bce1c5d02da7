//! What can be typed for every command, and for every command that takes a mesh.

use std::path::PathBuf;
use std::str::FromStr;

use beamwright::mesh::LabelParams;
use beamwright::mesh::label::DEFAULT_NAMES;
use beamwright::pipeline::Settings;
use beamwright_formats::{ReadOptions, Unit};
use clap::{Args, ValueEnum};

/// Flags of every subcommand.
#[derive(Args, Debug)]
#[command(next_help_heading = "Messages")]
pub(crate) struct GlobalArgs {
    /// No progress bar and no summary; only errors, and results asked for with --json
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,

    /// Tell the time of each stage and the files written, on standard error
    #[arg(short, long, global = true, conflicts_with = "quiet")]
    pub(crate) verbose: bool,

    /// Take options from a file, one `name = value` a line; what is typed counts more
    #[arg(long, global = true, value_name = "FILE.toml")]
    pub(crate) config: Option<PathBuf>,

    /// Write the options typed, and the defaults of all others, to a file for --config, and end
    #[arg(long, global = true, value_name = "FILE.toml")]
    pub(crate) write_config: Option<PathBuf>,

    /// How progress is shown on standard error
    #[arg(long, global = true, value_name = "HOW", default_value = "auto")]
    pub(crate) progress: ProgressStyle,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressStyle {
    /// A bar on a terminal, nothing elsewhere
    Auto,
    /// One JSON object a line
    Json,
    /// Nothing
    None,
}

/// How the result is shown.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Output")]
pub(crate) struct ResultArgs {
    /// Print the result as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// End with exit code 3, and write no file, when a promise does not hold (points outside, wrong
    /// topology)
    #[arg(long)]
    pub(crate) strict: bool,
}

#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Input")]
pub(crate) struct InputArgs {
    /// Mesh file: .off .obj .ply .stl .gltf .glb
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,

    /// Unit of length in the file (default: mm; glTF: m)
    #[arg(long, value_name = "mm|cm|m|in")]
    pub(crate) unit: Option<Unit>,

    /// Closed mesh of a non-design part; may be repeated
    #[arg(long, value_name = "FILE")]
    pub(crate) non_design: Vec<PathBuf>,

    /// Box in which all faces are non-design, two opposite corners in mm; may be repeated
    #[arg(long, value_name = "X0,Y0,Z0,X1,Y1,Z1", allow_hyphen_values = true)]
    pub(crate) non_design_box: Vec<Corners>,

    /// Name of a group, material or solid that is non-design, with * for anything; may be repeated
    #[arg(long, value_name = "PATTERN", default_values_t = DEFAULT_NAMES.map(String::from))]
    pub(crate) non_design_name: Vec<String>,
}

/// Two opposite corners of a box, mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corners([f64; 6]);

impl FromStr for Corners {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Vec<f64> = text
            .split(',')
            .map(|part| part.trim().parse().ok().filter(|x: &f64| x.is_finite()))
            .collect::<Option<_>>()
            .ok_or("six numbers in mm are wanted, with commas between")?;
        let count = numbers.len();
        let numbers = numbers.try_into();
        numbers.map(Self).map_err(|_| format!("six numbers are wanted, but there are {count}"))
    }
}

impl InputArgs {
    fn labels(&self) -> LabelParams {
        LabelParams {
            second_meshes: Vec::new(),
            boxes: self.non_design_box.iter().map(|corners| corners.0).collect(),
            names: self.non_design_name.clone(),
        }
    }

    /// Settings for reading and labelling; the rest at its defaults.
    pub(crate) fn settings(&self) -> Settings {
        Settings {
            read: ReadOptions { unit: self.unit, ..ReadOptions::default() },
            non_design_files: self.non_design.clone(),
            labels: self.labels(),
            ..Settings::default()
        }
    }
}
