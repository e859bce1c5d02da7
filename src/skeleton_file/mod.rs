//! Skeleton files: those of other programs are read, ours are written.
//!
//! | file | what it is | read | write | radius |
//! |---|---|---|---|---|
//! | `.json` | `beamwright-skeleton`, our own: points with kind and radius, branches | yes | yes | yes |
//! | `.obj` | polylines: `v` and `l` | yes | yes | no |
//! | `.ply` | `element edge`, as MeshLab shows it | yes | yes | `quality` |
//! | `.cg` | curve graph of Starlab (thesis §4.3.1.3) | yes | yes | no |
//! | `.swc` | traced nerve cells; many skeleton programs write it | yes | yes | yes |
//! | `NAME_nodes.txt` and `NAME_connectivity.txt` | node and connectivity text (thesis §4.3.2.3) | yes | no | no |
//!
//! What is read is a graph of points and segments. Points at the same place become one, so that
//! polylines that each bring their own copy of a junction are joined; branches are the chains
//! between junctions, ends and interface sections. Only our own format is taken as it is.
//!
//! # What a reader promises
//!
//! * A skeleton of finite places and at least one segment, or one [`SkeletonFileError`] with the
//!   file and the line; never a panic, whatever the file holds.
//! * No more memory than a few times the size of the file, and no file larger than [`MAX_BYTES`].
//!
//! # What a writer promises
//!
//! * The same skeleton gives the same bytes; every number is written with the fewest digits from
//!   which it is read again unchanged. Lengths are in mm.
//!
//! # Examples
//! ```
//! use beamwright::skeleton_file::{Format, read_bytes, write};
//! use beamwright_formats::Unit;
//!
//! let obj = b"v 0 0 0\nv 1 0 0\nv 2 0 0\nl 1 2 3\n";
//! let skeleton = read_bytes(obj, Format::Obj, Unit::Cm).unwrap();
//! assert_eq!((skeleton.points.len(), skeleton.branches.len()), (3, 1));
//!
//! let mut cg = Vec::new();
//! write(&skeleton, Format::Cg, &mut cg).unwrap();
//! assert_eq!(cg, b"# D:3 NV:3 NE:2\nv 0.0 0.0 0.0\nv 10.0 0.0 0.0\nv 20.0 0.0 0.0\ne 1 2\ne 2 3\n");
//! ```

mod cg;
mod error;
mod json;
pub mod line_graph;
mod node_text;
mod number;
mod obj;
mod ply;
mod swc;
mod text;

use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use beamwright_formats::Unit;
use nalgebra::Point3;

pub use error::{Place, SkeletonFileError};
pub use line_graph::LineGraph;

use crate::skeleton::graph::{PointKind, SkeletalPoint, Skeleton};

/// Largest file that is read, bytes: some ten million points.
pub const MAX_BYTES: u64 = 1 << 30;

/// A kind of skeleton file that is both read and written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Our own.
    Json,
    /// Polylines.
    Obj,
    /// Edges.
    Ply,
    /// Curve graph of Starlab.
    Cg,
    /// Traced nerve cell.
    Swc,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 5] = [Self::Json, Self::Obj, Self::Ply, Self::Cg, Self::Swc];

    /// The extension, in small letters and without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Cg => "cg",
            Self::Swc => "swc",
        }
    }

    /// The format of a file by its extension, in small letters or capitals.
    ///
    /// # Errors
    /// If the extension is none of those known.
    pub fn of(path: &Path) -> Result<Self, SkeletonFileError> {
        let extension = path.extension().unwrap_or_default();
        Self::ALL
            .into_iter()
            .find(|f| extension.eq_ignore_ascii_case(f.extension()))
            .ok_or_else(|| SkeletonFileError::UnknownExtension { path: path.to_owned() })
    }
}

/// A file in memory.
struct Source<'a> {
    /// For messages.
    path: &'a Path,
    bytes: &'a [u8],
    /// Millimetres in one unit of the file.
    to_mm: f64,
}

/// What a reader finds: not yet joined to a graph.
#[derive(Default)]
struct Parts {
    points: Vec<SkeletalPoint>,
    segments: Vec<[u32; 2]>,
    /// Faces passed over: the file may be a mesh.
    faces: usize,
}

/// A point of which only the place is known.
fn point_at(position: Point3<f64>) -> SkeletalPoint {
    SkeletalPoint { position, radius: 0.0, kind: PointKind::Branch }
}

/// Reads a skeleton; the extension tells the format.
///
/// * `path`: the file; of a pair of text files that of the nodes, see the table above.
/// * `unit`: what the file is in. JSON says it itself.
///
/// # Errors
/// If there is no such file, its kind is unknown, it is malformed, or it has no segment.
pub fn read(path: &Path, unit: Unit) -> Result<Skeleton, SkeletonFileError> {
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("txt")) {
        return read_node_text(path, unit);
    }
    let format = Format::of(path)?;
    let bytes = bytes_of(path)?;
    read_source(&Source { path, bytes: &bytes, to_mm: unit.to_mm() }, format)
}

/// Reads a skeleton from memory; messages call the file `memory` with the extension of the format.
///
/// # Errors
/// If the content is malformed or has no segment.
pub fn read_bytes(bytes: &[u8], format: Format, unit: Unit) -> Result<Skeleton, SkeletonFileError> {
    let path = PathBuf::from("memory").with_extension(format.extension());
    read_source(&Source { path: &path, bytes, to_mm: unit.to_mm() }, format)
}

fn read_source(source: &Source<'_>, format: Format) -> Result<Skeleton, SkeletonFileError> {
    let parts = match format {
        Format::Json => {
            let skeleton = json::read(source)?;
            let none = skeleton.segments().next().is_none();
            return if none {
                Err(no_segments(source, skeleton.points.len(), 0))
            } else {
                Ok(skeleton)
            };
        }
        Format::Obj => obj::read(source)?,
        Format::Ply => ply::read(source)?,
        Format::Cg => cg::read(source)?,
        Format::Swc => swc::read(source)?,
    };
    join(source, parts)
}

fn read_node_text(path: &Path, unit: Unit) -> Result<Skeleton, SkeletonFileError> {
    let partner = node_text::partner_of(path);
    let Some(partner) = partner.filter(|p| p.is_file()) else {
        // A node file that is not there either is the first thing to tell.
        bytes_of(path)?;
        let partner = node_text::partner_of(path);
        return Err(SkeletonFileError::NoConnectivity { path: path.to_owned(), partner });
    };
    let (nodes, connectivity) = (bytes_of(path)?, bytes_of(&partner)?);
    let to_mm = unit.to_mm();
    let source = Source { path, bytes: &nodes, to_mm };
    let rows = Source { path: &partner, bytes: &connectivity, to_mm };
    let parts = node_text::read(&source, &rows)?;
    join(&source, parts)
}

fn join(source: &Source<'_>, parts: Parts) -> Result<Skeleton, SkeletonFileError> {
    let points = parts.points.len();
    let graph = LineGraph::new(parts.points, parts.segments);
    if graph.segments().is_empty() {
        return Err(no_segments(source, points, parts.faces));
    }
    Ok(graph.to_skeleton())
}

fn no_segments(source: &Source<'_>, points: usize, faces: usize) -> SkeletonFileError {
    SkeletonFileError::NoSegments { path: source.path.to_owned(), points, faces }
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, SkeletonFileError> {
    let io = |source| SkeletonFileError::Io { path: path.to_owned(), source };
    let too_large =
        |size| SkeletonFileError::TooLarge { path: path.to_owned(), size, limit: MAX_BYTES };
    // Asked before opening: opening a named pipe would wait for somebody to write into it.
    let about = path.metadata().map_err(io)?;
    if !about.is_file() {
        return Err(SkeletonFileError::NotAFile { path: path.to_owned() });
    }
    if about.len() > MAX_BYTES {
        return Err(too_large(about.len()));
    }
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(io)?;
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(io)?;
    if bytes.len() as u64 > MAX_BYTES { Err(too_large(bytes.len() as u64)) } else { Ok(bytes) }
}

/// Writes a skeleton.
///
/// # Errors
/// What `out` says.
pub fn write(skeleton: &Skeleton, format: Format, out: &mut impl Write) -> io::Result<()> {
    match format {
        Format::Json => json::write(skeleton, out),
        Format::Obj => obj::write(skeleton, out),
        Format::Ply => ply::write(skeleton, out),
        Format::Cg => cg::write(skeleton, out),
        Format::Swc => swc::write(skeleton, out),
    }
}
