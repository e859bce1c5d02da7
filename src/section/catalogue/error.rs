//! Why a catalogue cannot be used.

use std::fmt;
use std::path::PathBuf;

use crate::section::error::SectionError;

/// Why a catalogue cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueError {
    /// A file is no catalogue, or cannot be read.
    #[error("cannot read {}: {fault}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        fault: Box<Self>,
    },

    /// The file cannot be opened or read.
    #[error("{fault}")]
    Unreadable {
        /// What the system says.
        fault: String,
    },

    /// The file is larger than any catalogue.
    #[error("it has {bytes} bytes; a catalogue has at most 16 MiB: is it one?")]
    TooLarge {
        /// Its size.
        bytes: u64,
    },

    /// The file is not UTF-8 text.
    #[error("line {line}: not UTF-8 text; save the file as UTF-8")]
    NotText {
        /// Line of the first byte that is not.
        line: u64,
    },

    /// The JSON is malformed.
    #[error("line {line}: malformed JSON: {fault}")]
    Json {
        /// Line of the fault.
        line: u64,
        /// What is wrong.
        fault: String,
    },

    /// A row is wrong.
    #[error("{place}: {fault}")]
    Row {
        /// Where it is.
        place: Place,
        /// What is wrong with it.
        fault: RowFault,
    },

    /// There are no profiles in the file.
    #[error(
        "it has no profiles: a .csv lists them one a line below its header, a .json in `profiles`"
    )]
    Empty,

    /// A family that was asked for is not there.
    #[error("no family {name} in the catalogue; it has {known}")]
    UnknownFamily {
        /// What was asked for.
        name: String,
        /// What is there.
        known: String,
    },
}

/// Where in a file a profile is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Line of a CSV file, counted from 1.
    Line(u64),
    /// Profile of a JSON file, counted from 1.
    Profile(u64),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Profile(number) => write!(f, "profile {number}"),
        }
    }
}

/// What is wrong with a row of a catalogue.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RowFault {
    /// The row has more or fewer fields than the header.
    #[error(
        "{found} fields where the header has {expected}; give each column of the header its field"
    )]
    Fields {
        /// Fields of the row.
        found: u64,
        /// Fields of the header.
        expected: u64,
    },

    /// A value that the shape needs is missing.
    #[error("no {column}, which {needed_by} needs")]
    Missing {
        /// Column of the value.
        column: &'static str,
        /// What needs it.
        needed_by: String,
    },

    /// A value is not a number.
    #[error("{column} must be a number, but is {text:?}")]
    NotANumber {
        /// Column of the value.
        column: String,
        /// What stands there.
        text: String,
    },

    /// A size is not one a beam can have.
    #[error("{column} is {millimetres} mm; sizes must lie between 0.001 and 100000 mm")]
    Size {
        /// Column of the value.
        column: String,
        /// Its value, mm.
        millimetres: f64,
    },

    /// A name is missing, too long or has control characters.
    #[error("the name {text:?} must have 1 to 80 printable characters")]
    Name {
        /// What stands there, cut to length.
        text: String,
    },

    /// A word is none of the known ones.
    #[error("unknown {what} {text:?}; use one of {known}")]
    Unknown {
        /// What the word stands for.
        what: &'static str,
        /// The word.
        text: String,
        /// The known ones.
        known: &'static str,
    },

    /// The sizes do not make a shape.
    #[error(transparent)]
    Shape(#[from] SectionError),

    /// A published value does not agree with the shape.
    #[error(
        "{column} is stated as {stated}, but the sizes give {computed}; one of them is mistyped"
    )]
    Disagrees {
        /// Column of the value.
        column: &'static str,
        /// The stated value, mm units.
        stated: f64,
        /// The value of the shape, mm units.
        computed: f64,
    },

    /// A name stands twice in the file.
    #[error("{name:?} was already given at {first}; rename or remove one of them")]
    Twice {
        /// The name.
        name: String,
        /// Where it stood first.
        first: Place,
    },
}
