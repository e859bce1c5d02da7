//! glTF 2.0, as JSON with buffers beside it (`.gltf`) or as one binary file (`.glb`).
//!
//! ```text
//! scene ─► nodes, a tree ─► mesh ─► primitives ─► accessors ─► buffer views ─► buffers
//!          transform        name    material       count, type   offset, stride   in the file,
//!          name                                    sparse                         beside it, data:
//! ```
//!
//! Each node with a mesh brings a copy of it, moved by the transforms of the node and all above it;
//! a transform that mirrors also turns the triangles over, so that they look outward again. glTF is
//! in metres with Y up; points come out in millimetres with Z up: (x, y, z) → (x, −z, y).
//!
//! The `gltf` crate takes the JSON apart and reads accessors. It opens whatever a buffer names,
//! panics or runs on at some invalid accessors, and does not notice cycles of nodes: buffers are
//! found [here](buffer), accessors are [checked](accessor) before they are read, and the tree is
//! [walked](scene) without recursion.
//!
//! A face gets the names of its material, its mesh, its node and the nodes above that.
//!
//! # What is not read
//!
//! Compressed or quantized meshes (Draco, meshopt, `KHR_mesh_quantization`) are refused with a
//! message. Skins, morph targets and animations are passed over: the mesh is as it stands at rest.

mod accessor;
mod buffer;
mod container;
mod primitive;
mod scene;

use std::io::Read;
use std::path::Path;

use crate::builder::Builder;
use crate::error::ReadError;
use crate::input::Input;
use crate::raw_mesh::RawMesh;
use buffer::Buffers;
use primitive::Emitter;

/// Where the labels of this format live.
const LABEL_SOURCE: &str =
    "glTF names of nodes, meshes and materials, material colours, or colours of points";

/// Reads a glTF or GLB file; `folder` is where its buffers are looked for.
pub(crate) fn read(
    mut input: Input<'_>,
    builder: Builder<'_>,
    folder: Option<&Path>,
    max_bytes: u64,
) -> Result<RawMesh, ReadError> {
    let path = input.path();
    let mut bytes = Vec::new();
    // One more than the size, so that the end is noticed without growing.
    bytes.reserve_exact(usize::try_from(input.size()).unwrap_or(usize::MAX).saturating_add(1));
    input
        .read_to_end(&mut bytes)
        .map_err(|source| ReadError::Io { path: path.to_owned(), source })?;
    drop(input);

    let (json, blob) = container::split(&bytes, path)?;
    let document = container::parse(json, path)?;
    let mut buffers = Buffers::new(path, folder, blob, document.buffers().len(), max_bytes);
    let mut emitter = Emitter::new(builder, path);
    scene::walk(&document, path, |instance| emitter.instance(&instance, &mut buffers))?;
    emitter.finish(LABEL_SOURCE)
}

/// The error that a part of the JSON is not what it should be.
fn malformed(
    path: &Path,
    part: impl Into<String>,
    expected: impl Into<String>,
    found: impl Into<String>,
) -> ReadError {
    ReadError::Malformed {
        path: path.to_owned(),
        place: crate::error::Place::Part(part.into()),
        expected: expected.into(),
        found: found.into(),
    }
}

#[cfg(test)]
mod tests;
