//! The data of a binary PLY file, element by element.

use std::io::{self, Read};

use ply_rs_bw::parser::{ParseError, Parser};
use ply_rs_bw::ply::{ElementDef, Encoding, PropertyAccess, PropertyType};

use super::Reader;
use super::columns::{ElementKind, size_of};
use super::header::{Element, Header};
use super::record::{Face, Point, Skipped};
use crate::error::{Place, ReadError};
use crate::input::Input;

/// Reads all elements.
///
/// Bytes behind the last one are passed over: some programs fill up the last block.
pub(super) fn read(
    input: &mut Input<'_>,
    header: &Header,
    reader: &mut Reader<'_>,
) -> Result<(), ReadError> {
    for element in &header.elements {
        element.check_count(input, header.encoding)?;
        match element.kind {
            ElementKind::Point => {
                reader.builder.mesh.positions.reserve_exact(element.definition.count);
                each(input, header.encoding, element, |place, point: Point| {
                    reader.point(&point, || place.clone())
                })?;
            }
            ElementKind::Face => {
                each(input, header.encoding, element, |place, face: Face| {
                    for corner in face.corners() {
                        reader.corner(corner, || place.clone())?;
                    }
                    reader.face(&face, || place.clone())
                })?;
            }
            ElementKind::Other => skip(input, header.encoding, element)?,
        }
    }
    Ok(())
}

/// Reads the elements of one kind; `take` also gets the place where the element begins.
fn each<R: PropertyAccess>(
    input: &mut Input<'_>,
    encoding: Encoding,
    element: &Element,
    mut take: impl FnMut(Place, R) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    for number in 0..element.count() {
        let place = Place::Byte(input.position());
        let record = read_one(input, encoding, &element.definition)
            .map_err(|error| fault(input, &error, element, number))?;
        take(place, record)?;
    }
    Ok(())
}

#[inline]
fn read_one<R: PropertyAccess>(
    input: &mut Input<'_>,
    encoding: Encoding,
    definition: &ElementDef,
) -> Result<R, ParseError> {
    let parser = Parser::new();
    match encoding {
        Encoding::BinaryBigEndian => parser.read_big_endian_element(input, definition),
        _ => parser.read_little_endian_element(input, definition),
    }
}

fn fault(input: &Input<'_>, error: &ParseError, element: &Element, number: u64) -> ReadError {
    let (path, place) = (input.path().to_owned(), Place::Byte(input.position()));
    let what = format!("{} {} of {}", element.title(), number + 1, element.count());
    match error.kind() {
        io::ErrorKind::UnexpectedEof => {
            ReadError::CutOff { path, place, missing: format!("the end of {what}") }
        }
        io::ErrorKind::InvalidInput | io::ErrorKind::InvalidData => ReadError::Malformed {
            path,
            place,
            expected: format!("{what} as the header declares it"),
            found: error.to_string().to_lowercase().trim_end_matches('.').to_owned(),
        },
        kind => input.io_error(kind.into()),
    }
}

/// Passes over all elements of a kind that is not used.
fn skip(input: &mut Input<'_>, encoding: Encoding, element: &Element) -> Result<(), ReadError> {
    let mut size = 0;
    for property in element.definition.properties.values() {
        match &property.data_type {
            PropertyType::Scalar(scalar) => size += size_of(scalar),
            PropertyType::List(..) => {
                return each(input, encoding, element, |_, _: Skipped| Ok(()));
            }
        }
    }
    // The count has been checked: the product is below the size of the file.
    let mut data = input.take(size * element.count());
    match io::copy(&mut data, &mut io::sink()) {
        Ok(_) => Ok(()),
        Err(error) => Err(input.io_error(error)),
    }
}
