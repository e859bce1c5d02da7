//! STL, the triangle soup of additive manufacturing, ASCII or binary.
//!
//! ```text
//! solid non_design              80 bytes of anything
//!   facet normal 0 0 1          u32: number of triangles
//!     outer loop                for each triangle, little endian:
//!       vertex 0 0 0              f32 × 3: normal
//!       vertex 1 0 0              f32 × 3 × 3: points
//!       vertex 0 1 0              u16: attribute, nothing or a colour
//!     endloop
//!   endfacet
//! endsolid non_design
//! solid strut
//! …
//! ```
//!
//! Each triangle brings three points of its own. Normals are passed over: they are often zero, and
//! the order of the points tells the same.
//!
//! Which of the two a file is, `solid` at its beginning does not tell: many binary files begin with
//! it. A file whose size is what its count of triangles asks for is binary; otherwise one without a
//! zero byte at its beginning is ASCII.

mod ascii;
mod binary;

use crate::builder::Builder;
use crate::error::ReadError;
use crate::input::Input;
use crate::raw_mesh::RawMesh;

/// Bytes before the first triangle of a binary file.
const HEADER: usize = 84;
/// Bytes of a triangle in a binary file.
const FACET: usize = 50;

/// Bytes that are looked at to tell text from binary.
const HEAD: usize = 1024;

/// Reads an STL file.
pub(crate) fn read(mut input: Input<'_>, builder: Builder<'_>) -> Result<RawMesh, ReadError> {
    let size = input.size();
    let head = input.peek(HEAD)?;
    if has_size_of_binary(head, size) || head.contains(&0) {
        binary::read(input, builder)
    } else {
        ascii::read(&mut input, builder)
    }
}

/// Number of triangles by the header of a binary file.
fn facet_count(head: &[u8]) -> Option<u32> {
    let count = head.get(HEADER - 4..HEADER)?;
    Some(u32::from_le_bytes(count.try_into().ok()?))
}

/// Whether a file with this beginning has just the size that a binary STL file would have.
pub(crate) fn has_size_of_binary(head: &[u8], size: u64) -> bool {
    facet_count(head).is_some_and(|count| size == (HEADER + FACET * count as usize) as u64)
}

/// Whether a text that begins with `solid` goes on as ASCII STL.
pub(crate) fn looks_like_ascii(text: &[u8]) -> bool {
    let text = text[..text.len().min(HEAD)].to_ascii_lowercase();
    ["facet", "endsolid"].iter().any(|word| memchr::memmem::find(&text, word.as_bytes()).is_some())
}

#[cfg(test)]
mod tests;
