//! Why a skeleton file could not be read, told so that one can mend the file.

use std::io;
use std::path::PathBuf;

use crate::wording::counted;

pub use beamwright_formats::Place;

/// Why a skeleton could not be read.
///
/// Every message begins with the file and, where there is one, the place in it. Text quoted from
/// the file is shortened, and its control characters are escaped.
///
/// # Examples
/// ```
/// use beamwright::skeleton_file::{Format, read_bytes};
/// use beamwright_formats::Unit;
///
/// let cg = b"# D:3 NV:2 NE:1\nv 0 0 0\nv 10 0 0\ne 1 3\n";
/// let error = read_bytes(cg, Format::Cg, Unit::Mm).unwrap_err();
/// assert_eq!(error.to_string(), "cannot read memory.cg: line 4: a segment names point 3, but the file has 2 points");
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SkeletonFileError {
    /// The file cannot be opened or read.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },

    /// The path leads to a directory or a device.
    #[error("cannot read {}: it is not a file", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
    },

    /// The extension is none of those that are known.
    #[error(
        "unknown kind of skeleton file {}; known are .json .obj .ply .cg .swc and, for reading, \
         NAME_nodes.txt beside NAME_connectivity.txt", path.display()
    )]
    UnknownExtension {
        /// The file.
        path: PathBuf,
    },

    /// A node file without the connectivity file that belongs to it.
    #[error(
        "cannot read {}: {}", path.display(),
        match partner {
            Some(partner) => format!("its segments are expected in {}", partner.display()),
            None => "give the file of the nodes; its name has the word `nodes` where that of the \
                     connectivity file beside it has the word `connectivity`".to_owned(),
        }
    )]
    NoConnectivity {
        /// The node file.
        path: PathBuf,
        /// The connectivity file that was looked for.
        partner: Option<PathBuf>,
    },

    /// The file is larger than a skeleton can be.
    #[error("cannot read {}: {size} bytes are more than the limit of {limit}; is it a skeleton?", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size in bytes.
        size: u64,
        /// The limit in bytes.
        limit: u64,
    },

    /// Something else stands where the format wants something particular.
    #[error("cannot read {}: {place}: expected {expected}, found {found}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Where.
        place: Place,
        /// What the format wants here.
        expected: String,
        /// What stands here.
        found: String,
    },

    /// A coordinate is NaN, infinite or absurdly large.
    #[error("cannot read {}: {place}: {number} is no number that can be a place; export the skeleton again", path.display())]
    NotUsable {
        /// The file.
        path: PathBuf,
        /// Where.
        place: Place,
        /// The number as written.
        number: String,
    },

    /// A segment names a point that is not there.
    #[error(
        "cannot read {}: {place}: a segment names point {index}, but the file has {}",
        path.display(),
        counted(*count, "point", "points")
    )]
    NoSuchPoint {
        /// The file.
        path: PathBuf,
        /// Where.
        place: Place,
        /// The point as named.
        index: String,
        /// How many points there are.
        count: usize,
    },

    /// The JSON is broken or not of the shape of a skeleton.
    #[error("cannot read {}: line {line}, column {column}: {message}", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong.
        message: String,
    },

    /// The file is well-formed but holds no curve.
    #[error(
        "cannot read {}: it has {} but no segment between two of them{}",
        path.display(),
        counted(*points, "point", "points"),
        if *faces > 0 { "; it has faces: is it a mesh?" } else { "" }
    )]
    NoSegments {
        /// The file.
        path: PathBuf,
        /// Points found.
        points: usize,
        /// Faces found.
        faces: usize,
    },
}
