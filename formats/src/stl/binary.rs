//! Binary STL: triangles by `stl_io`, attributes read in passing.
//!
//! That crate takes a file for text if it begins with `solid`, believes any count of triangles, and
//! drops the attributes. It is given a blank header instead of the file's, a count that has been
//! checked against the size, and a stream that keeps the attributes as they go by.
//!
//! # Colours
//!
//! An attribute is a colour of 5 bits a channel, red in the lowest bits:
//!
//! * If the header has `COLOR=` in it (Materialise Magics), a triangle has a colour of its own where
//!   bit 15 is not set; where it is, the triangle has that of the whole part, which says nothing.
//! * In other files a triangle has a colour where bit 15 is set, as in VisCAM and MeshLab. By the
//!   documents of VisCAM blue is in the lowest bits; MeshLab puts red there, and is what meshes are
//!   coloured with here. In a file of VisCAM red and blue are swapped.

use std::io::{self, Read, Seek, SeekFrom};

use super::{FACET, HEADER, facet_count};
use crate::builder::Builder;
use crate::error::{Place, ReadError};
use crate::input::Input;
use crate::raw_mesh::RawMesh;

/// Where the labels of this variant live.
const LABEL_SOURCE: &str = "attribute colours of the binary STL";

/// Set in an attribute that is a colour; in Magics, that is none.
const COLOUR_BIT: u16 = 0x8000;

/// Reads a binary STL file.
pub(super) fn read(mut input: Input<'_>, mut builder: Builder<'_>) -> Result<RawMesh, ReadError> {
    let count = check_count(&mut input)?;
    let is_magics = memchr::memmem::find(input.peek(HEADER)?, b"COLOR=").is_some();
    input.skip(HEADER);

    builder.check_point_count(3 * u64::from(count))?;
    builder.mesh.positions.reserve_exact(3 * count as usize);
    builder.mesh.faces.corners.reserve_exact(3 * count as usize);
    builder.mesh.faces.starts.reserve_exact(count as usize);
    let mut stream =
        FacetStream { input, header: header_of(count), position: 0, attributes: Vec::new() };
    read_facets(&mut stream, &mut builder)?;

    let mut mesh = builder.finish(LABEL_SOURCE)?;
    let mut attributes = stream.attributes;
    // Padding behind the last triangle may have passed for one more.
    attributes.truncate(mesh.faces.len());
    let has_colour = |attribute: u16| attribute != 0 && (attribute & COLOUR_BIT == 0) == is_magics;
    if attributes.iter().any(|&attribute| has_colour(attribute)) {
        let colour = |attribute| has_colour(attribute).then(|| colour_of(attribute));
        mesh.carriers.face_colour = attributes.into_iter().map(colour).collect();
    }
    Ok(mesh)
}

/// Number of triangles by the header, which must be what the size allows.
fn check_count(input: &mut Input<'_>) -> Result<u32, ReadError> {
    let (path, size) = (input.path(), input.size());
    let Some(count) = facet_count(input.peek(HEADER)?) else {
        return Err(ReadError::CutOff {
            path: path.to_owned(),
            place: Place::Byte(size),
            missing: "the end of the header of a binary STL file, 84 bytes".to_owned(),
        });
    };
    let room = size - HEADER as u64;
    let (held, rest) = (room / FACET as u64, room % FACET as u64);
    // A few bytes too many are padding; whole triangles too many are a wrong count.
    if u64::from(count) > held || (u64::from(count) < held && rest == 0) {
        return Err(ReadError::WrongCount {
            path: path.to_owned(),
            place: Place::Byte(HEADER as u64 - 4),
            what: "triangles".to_owned(),
            count: count.into(),
            room,
            holds: held.to_string(),
        });
    }
    Ok(count)
}

fn read_facets(stream: &mut FacetStream<'_>, builder: &mut Builder<'_>) -> Result<(), ReadError> {
    let path = stream.input.path();
    let byte_of = |facet: usize| (HEADER + FACET * facet) as u64;
    let fault = |source| ReadError::Io { path: path.to_owned(), source };
    for (number, facet) in stl_io::create_stl_reader(stream).map_err(fault)?.enumerate() {
        let facet = facet.map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => ReadError::CutOff {
                path: path.to_owned(),
                place: Place::Byte(byte_of(number)),
                missing: format!("the end of triangle {}", number + 1),
            },
            _ => fault(error),
        })?;
        for point in facet.vertices {
            let [x, y, z] = point.0;
            builder.corner(builder.mesh.positions.len() as u32);
            builder.point(point.0.map(f64::from)).map_err(|_| ReadError::NotFinite {
                path: path.to_owned(),
                place: Place::Byte(byte_of(number)),
                number: format!("the point ({x:?}, {y:?}, {z:?}) of triangle {}", number + 1),
            })?;
        }
        builder.close_face()?;
    }
    Ok(())
}

fn colour_of(attribute: u16) -> [u8; 3] {
    [0, 5, 10].map(|shift| ((attribute >> shift & 0x1f) << 3) as u8)
}

/// A header that no one takes for text: a line end, zeros, and the count.
fn header_of(count: u32) -> [u8; HEADER] {
    let mut header = [0; HEADER];
    header[0] = b'\n';
    header[HEADER - 4..].copy_from_slice(&count.to_le_bytes());
    header
}

/// The file as `stl_io` sees it: [`header_of`], and the triangles, whose attributes are kept.
struct FacetStream<'a> {
    /// Stands at the first triangle.
    input: Input<'a>,
    header: [u8; HEADER],
    position: usize,
    attributes: Vec<u16>,
}

impl Read for FacetStream<'_> {
    fn read(&mut self, target: &mut [u8]) -> io::Result<usize> {
        if self.position < HEADER {
            // Never beyond the header in one go: the probe for text reads ahead and then seeks back.
            let count = (&self.header[self.position..]).read(target)?;
            self.position += count;
            return Ok(count);
        }
        let count = self.input.read(target)?;
        self.keep_attributes(&target[..count]);
        self.position += count;
        Ok(count)
    }
}

impl FacetStream<'_> {
    fn keep_attributes(&mut self, bytes: &[u8]) {
        let into_facet = (self.position - HEADER) % FACET;
        // The high byte of an attribute may come with the next block.
        if into_facet == FACET - 1
            && let (Some(attribute), Some(&high)) = (self.attributes.last_mut(), bytes.first())
        {
            *attribute |= u16::from(high) << 8;
        }
        let first = (2 * FACET - 2 - into_facet) % FACET;
        for attribute in bytes.get(first..).unwrap_or_default().chunks(FACET) {
            let high = attribute.get(1).copied().unwrap_or(0);
            self.attributes.push(u16::from_le_bytes([attribute[0], high]));
        }
    }
}

impl Seek for FacetStream<'_> {
    /// Goes back to the beginning, which is all that the probe for text asks for.
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        if to == SeekFrom::Start(0) && self.position <= HEADER {
            self.position = 0;
            return Ok(0);
        }
        Err(io::ErrorKind::Unsupported.into())
    }
}
