//! Readers of surface meshes: file in, [`RawMesh`] out.
//!
//! A topology-optimised part comes as a mesh in one of five formats, and each keeps the labels of
//! its non-design faces somewhere else. The readers carry all of it and decide nothing: what the
//! labels mean is settled later, and by others.
//!
//! ```text
//!  part.off .obj .ply .stl .gltf .glb
//!        │  read: extension and content agree? size within the limit?
//!        ▼
//!   one reader per format ──► RawMesh { positions in mm, polygons, label carriers }
//!                                │  triangulate
//!                                ▼
//!                             Triangles { corners, the polygon each came from }
//! ```
//!
//! | format | crate beneath | labels carried |
//! |---|---|---|
//! | OFF  | none | colours of faces; colours of points (COFF) |
//! | OBJ  | `tobj` for the material library | `g`, `o` and `usemtl` names together; material colours; colours of points |
//! | PLY  | `ply-rs-bw` for header and binary data | `non_design` property, `flags`, `quality`, colours of faces and points, one further integer property |
//! | STL  | `stl_io` for binary | names of solids (ASCII); attribute colours (binary) |
//! | glTF | `gltf` | names of nodes, meshes and materials; material colours; colours of points |
//!
//! # What a reader promises
//!
//! * A mesh that keeps the invariants of [`RawMesh`], or one [`ReadError`] with the file, the line
//!   or byte, what was expected and what to do. Never a panic, whatever the file holds.
//! * Nothing outside of the file's folder is read, and no more memory is taken than a few times
//!   what the file and its buffers hold.
//! * Points stay as they are in the file: they are neither welded nor sorted, so an STL file gives
//!   three points a triangle.
//!
//! # Examples
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("pad.OBJ");
//! # std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng non_design\nf 1 2 3 4\n")?;
//! use beamwright_formats::{ReadOptions, Unit, read};
//!
//! let options = ReadOptions { unit: Some(Unit::Cm), ..ReadOptions::default() };
//! let mesh = read(&path, &options)?;
//! assert_eq!(mesh.positions[2], [10.0, 10.0, 0.0]);
//! assert_eq!(mesh.carriers.names, ["non_design"]);
//! assert_eq!(mesh.triangulate().corners.len(), 2);
//! # Ok(())
//! # }
//! ```
//!
//! # Fuzzing
//!
//! `formats/fuzz` has a target for each reader and one for the triangulation; with a nightly
//! compiler and `cargo install cargo-fuzz`, `cd formats && cargo +nightly fuzz run obj` runs one.

use std::path::Path;

mod builder;
mod colour;
mod error;
mod format;
mod gltf;
mod input;
mod line;
mod names;
mod nearby;
mod obj;
mod off;
mod ply;
pub mod raw_mesh;
mod stl;
mod triangulate;
mod unit;

pub use error::{Place, ReadError};
pub use format::Format;
pub use raw_mesh::{LabelCarriers, Polygons, RawMesh};
pub use triangulate::Triangles;
pub use unit::{Unit, UnknownUnit};

use builder::Builder;
use input::Input;

/// What a reader has to be told besides the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadOptions {
    /// Unit of length of the file.
    ///
    /// `None`: metres for glTF, millimetres for the others.  Default: `None`.
    pub unit: Option<Unit>,
    /// Largest file that is read, bytes; for glTF also the largest sum of its buffers.
    ///
    /// The mesh takes up to four times as much memory.  Default: 8 GiB.
    pub max_bytes: u64,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { unit: None, max_bytes: 8 << 30 }
    }
}

/// Reads a mesh from a file; the extension, in capitals or not, tells the format.
///
/// # Errors
/// If there is no such file, its extension is unknown, its content is of another format or
/// malformed, or it has no faces: see [`ReadError`].
pub fn read(path: &Path, options: &ReadOptions) -> Result<RawMesh, ReadError> {
    let Some(format) = Format::of(path) else {
        return Err(missing_or_unknown(path));
    };
    let input = Input::open(path, options.max_bytes)?;
    // An empty parent means the working directory.
    let folder = path
        .parent()
        .map(|folder| if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
    read_input(input, format, folder, options)
}

/// Reads a mesh from memory; messages call the file `memory` with the extension of the format.
///
/// A glTF file must hold its buffers itself, and the material library of an OBJ file is not found.
///
/// # Errors
/// As [`read`], without those of the file system.
pub fn read_bytes(
    bytes: &[u8],
    format: Format,
    options: &ReadOptions,
) -> Result<RawMesh, ReadError> {
    let path = Path::new("memory").with_extension(format.extension());
    let input = Input::from_bytes(&path, bytes, options.max_bytes)?;
    read_input(input, format, None, options)
}

fn read_input(
    mut input: Input<'_>,
    format: Format,
    folder: Option<&Path>,
    options: &ReadOptions,
) -> Result<RawMesh, ReadError> {
    format::check_content(format, &mut input)?;
    let default_unit = match format {
        Format::Gltf | Format::Glb => Unit::M,
        Format::Off | Format::Obj | Format::Ply | Format::Stl => Unit::Mm,
    };
    let unit = options.unit.unwrap_or(default_unit);
    let builder = Builder::new(input.path(), unit.to_mm());
    match format {
        Format::Off => off::read(&mut input, builder),
        Format::Obj => obj::read(&mut input, builder, folder),
        Format::Ply => ply::read(input, builder),
        Format::Stl => stl::read(input, builder),
        Format::Gltf | Format::Glb => gltf::read(input, builder, folder, options.max_bytes),
    }
}

/// A directory or a missing file is the nearer fault than its extension.
fn missing_or_unknown(path: &Path) -> ReadError {
    match Input::open(path, u64::MAX) {
        Err(error @ (ReadError::Io { .. } | ReadError::NotAFile { .. })) => error,
        _ => ReadError::UnknownExtension { path: path.to_owned() },
    }
}

/// What the tests of the readers share.
#[cfg(test)]
mod testing {
    use super::*;

    /// The mesh in `bytes`, its invariants checked.
    pub(crate) fn mesh(bytes: impl AsRef<[u8]>, format: Format) -> RawMesh {
        let mesh = read_bytes(bytes.as_ref(), format, &ReadOptions::default());
        let mesh = mesh.unwrap_or_else(|error| panic!("{error}"));
        mesh.check();
        mesh
    }

    /// The message of the error that `bytes` lead to, without the file name.
    pub(crate) fn message(bytes: impl AsRef<[u8]>, format: Format) -> String {
        match read_bytes(bytes.as_ref(), format, &ReadOptions::default()) {
            Ok(mesh) => panic!("no error, but {mesh:?}"),
            Err(error) => {
                let start = format!("cannot read memory.{}: ", format.extension());
                error.to_string().replacen(&start, "", 1)
            }
        }
    }

    /// The names of each face.
    pub(crate) fn names_of_faces(mesh: &RawMesh) -> Vec<Vec<&str>> {
        let carriers = &mesh.carriers;
        let name = |&name: &u32| carriers.names[name as usize].as_str();
        let names = |&set: &u32| carriers.name_sets[set as usize].iter().map(name).collect();
        carriers.face_names.iter().map(names).collect()
    }
}
