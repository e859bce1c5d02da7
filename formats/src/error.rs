//! Why a file could not be read: faults in the file or its place, told so that one can mend them.

use std::fmt;
use std::io;
use std::path::PathBuf;

/// Where in a file something is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// Line of a text file, counted from 1.
    Line(u64),
    /// Byte of a binary file, counted from 0.
    Byte(u64),
    /// Path inside the JSON of a glTF file, such as `meshes[0].primitives[2]`.
    Part(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
            Self::Part(part) => f.write_str(part),
        }
    }
}

/// Why a mesh could not be read.
///
/// Every message begins with the file and, where there is one, the place in it; it ends with what
/// was expected or what to do. Text quoted from the file is shortened, and its control characters
/// are escaped.
///
/// # Examples
/// ```
/// use beamwright_formats::{Format, ReadOptions, read_bytes};
///
/// let off = b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1,5 0\n3 0 1 2\n";
/// let error = read_bytes(off, Format::Off, &ReadOptions::default()).unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "cannot read memory.off: line 5: `1,5` has a comma; \
///      numbers are written with a decimal point (1.5) and separated by spaces"
/// );
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be opened or read: it is missing, or not allowed.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },

    /// The path leads to a directory or a device.
    #[error("cannot read {}: it is a {what}, not a file", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
        /// What it is instead.
        what: &'static str,
    },

    /// The extension is none of those that can be read.
    #[error(
        "cannot read {}: {}; known are .off .obj .ply .stl .gltf .glb",
        path.display(),
        match path.extension() {
            Some(extension) => format!("unknown extension .{}", extension.to_string_lossy()),
            None => "the name has no extension".to_owned(),
        }
    )]
    UnknownExtension {
        /// The file.
        path: PathBuf,
    },

    /// The content is clearly of another format than the extension says.
    #[error("cannot read {} as {expected}: its content looks like {looks_like}; {advice}", path.display())]
    OtherFormat {
        /// The file.
        path: PathBuf,
        /// Format by the extension.
        expected: &'static str,
        /// Format by the content.
        looks_like: &'static str,
        /// What to do.
        advice: String,
    },

    /// The file is larger than [`ReadOptions::max_bytes`](crate::ReadOptions::max_bytes).
    #[error("cannot read {}: {size} bytes are more than the limit of {limit}; reduce or split the mesh", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size in bytes.
        size: u64,
        /// The limit in bytes.
        limit: u64,
    },

    /// The file has no content.
    #[error("cannot read {}: the file is empty; export it again", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },

    /// The file is well-formed but has no surface.
    #[error(
        "cannot read {}: it has {points} point{} but no faces; export the surface as a mesh of triangles",
        path.display(),
        if *points == 1 { "" } else { "s" }
    )]
    NoFaces {
        /// The file.
        path: PathBuf,
        /// Points found.
        points: usize,
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

    /// A number is written with a comma.
    #[error(
        "cannot read {}: {place}: {number} has a comma; \
         numbers are written with a decimal point (1.5) and separated by spaces",
        path.display()
    )]
    Comma {
        /// The file.
        path: PathBuf,
        /// Where.
        place: Place,
        /// The number as written.
        number: String,
    },

    /// A number is NaN, infinite or too large.
    #[error(
        "cannot read {}: {place}: {number} is not a finite number; repair the mesh before exporting it",
        path.display()
    )]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// Where.
        place: Place,
        /// The number as written.
        number: String,
    },

    /// The file ends too early.
    #[error("cannot read {}: {place}: the file ends before {missing}; it seems cut off, export or copy it again", path.display())]
    CutOff {
        /// The file.
        path: PathBuf,
        /// Where it ends.
        place: Place,
        /// What should still have come.
        missing: String,
    },

    /// A header announces more than the file can hold.
    #[error(
        "cannot read {}: {place}: the header announces {count} {what}, but the {room} bytes that follow hold {holds}; \
         the file is cut off or its header wrong",
        path.display()
    )]
    WrongCount {
        /// The file.
        path: PathBuf,
        /// Where the count stands.
        place: Place,
        /// What is counted.
        what: String,
        /// The count.
        count: u64,
        /// Bytes that follow.
        room: u64,
        /// What these bytes can hold: "at most 12", "1500".
        holds: String,
    },

    /// A face names a point that does not exist.
    #[error("cannot read {}: {place}: a face names point {index}, but {range}", path.display())]
    IndexOutOfRange {
        /// The file.
        path: PathBuf,
        /// Where.
        place: Place,
        /// The index as written.
        index: String,
        /// Which points exist.
        range: String,
    },

    /// The faces have so many corners that cutting them into triangles could take very long.
    #[error(
        "cannot read {}: its faces have too many corners; \
         cut them into triangles before exporting the mesh",
        path.display()
    )]
    LargeFaces {
        /// The file.
        path: PathBuf,
    },

    /// The file uses something this reader does not read.
    #[error("cannot read {}: it uses {feature}, which is not read; {advice}", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// What is used.
        feature: String,
        /// What to do.
        advice: &'static str,
    },

    /// A glTF file names a buffer outside of its own folder.
    #[error(
        "cannot read {}: its buffer {uri} lies outside of its folder; \
         put the buffer beside the file, or export as .glb",
        path.display()
    )]
    OutsideFolder {
        /// The file.
        path: PathBuf,
        /// The buffer as named in the file.
        uri: String,
    },

    /// There is more of something than can be held.
    #[error("cannot read {}: more than {limit} {what}; reduce or split the mesh", path.display())]
    TooMany {
        /// The file.
        path: PathBuf,
        /// What there is too much of.
        what: &'static str,
        /// How many are allowed.
        limit: u64,
    },
}

/// Longest piece of a file shown in a message, characters.
const QUOTE_LENGTH: usize = 40;

/// A piece of a file as shown in a message: in backquotes, shortened, control characters escaped.
pub(crate) fn quote(text: impl AsRef<[u8]>) -> String {
    format!("`{}`", excerpt(text, QUOTE_LENGTH))
}

/// The first `length` characters of a text, control characters escaped.
pub(crate) fn excerpt(text: impl AsRef<[u8]>, length: usize) -> String {
    let text = text.as_ref();
    let head = String::from_utf8_lossy(&text[..text.len().min(4 * length)]);
    let mut excerpt: String = head.chars().take(length).flat_map(char::escape_debug).collect();
    if head.chars().nth(length).is_some() || text.len() > 4 * length {
        excerpt.push('…');
    }
    excerpt
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quote_is_short_and_has_no_control_characters() {
        assert_eq!(quote("1,5"), "`1,5`");
        assert_eq!(quote(b"\x1b[31m\xff"), "`\\u{1b}[31m\u{fffd}`");
        assert_eq!(quote("x".repeat(1000)).chars().count(), QUOTE_LENGTH + 3);
    }

    #[test]
    fn an_error_stays_small_enough_to_be_returned_by_value() {
        assert!(size_of::<ReadError>() <= 128, "{}", size_of::<ReadError>());
    }
}
