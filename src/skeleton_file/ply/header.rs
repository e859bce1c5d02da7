//! The header of a PLY file: which elements follow, and what each of them holds.

use super::super::Source;
use super::super::error::{Place, SkeletonFileError};
use super::super::text::{Line, lines, missing, parse};

/// Most properties an element may have; more are a fault, and would cost memory for each row.
const MOST_PROPERTIES: usize = 1000;

/// How the values are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// Type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) scalar: Scalar,
    /// Type of the length, for a list.
    pub(super) length: Option<Scalar>,
}

#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    /// Line of the header.
    pub(super) line: u64,
}

#[derive(Clone, Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Bytes and lines of the header.
    pub(super) size: usize,
    pub(super) lines: u64,
}

impl Header {
    pub(super) fn read(source: &Source<'_>) -> Result<Self, SkeletonFileError> {
        let mut header =
            Self { encoding: Encoding::Ascii, elements: Vec::new(), size: 0, lines: 0 };
        let mut encoding = None;
        for line in lines(source.path, source.bytes) {
            header.lines = line.number;
            let mut words = line.words();
            match (line.number, words.next()) {
                (1, Some(b"ply")) => {}
                (1, word) => return Err(line.malformed("`ply`", word.unwrap_or_default())),
                (_, Some(b"comment" | b"obj_info") | None) => {}
                (_, Some(b"format")) => encoding = Some(encoding_of(&line)?),
                (_, Some(b"element")) => header.elements.push(element(&line)?),
                (_, Some(b"property")) => header.add_property(&line)?,
                (_, Some(b"end_header")) => {
                    header.size = end_of(&line, source.bytes);
                    header.encoding = encoding
                        .ok_or_else(|| line.malformed("a line `format` before", line.text))?;
                    return Ok(header);
                }
                (_, Some(word)) => return Err(line.malformed("a line of a PLY header", word)),
            }
        }
        let place = Place::Line(header.lines);
        Err(missing(source.path, place, "`end_header`".into(), "the end of the file"))
    }

    fn add_property(&mut self, line: &Line<'_>) -> Result<(), SkeletonFileError> {
        let Some(element) = self.elements.last_mut() else {
            return Err(line.malformed("an element before its properties", line.text));
        };
        if element.properties.len() >= MOST_PROPERTIES {
            return Err(line.malformed("fewer properties", line.text));
        }
        let words: Vec<&[u8]> = line.words().take(6).collect();
        let scalar = |word: &[u8]| {
            scalar_of(word).ok_or_else(|| line.malformed("a type such as float or int", word))
        };
        let name = |word: &[u8]| String::from_utf8_lossy(word).into_owned();
        element.properties.push(match words[..] {
            [_, b"list", length, item, of] => {
                Property { name: name(of), scalar: scalar(item)?, length: Some(scalar(length)?) }
            }
            [_, item, of] => Property { name: name(of), scalar: scalar(item)?, length: None },
            _ => return Err(line.malformed("`property TYPE NAME`", line.text)),
        });
        Ok(())
    }
}

/// Bytes up to and with the end of a line of the file.
fn end_of(line: &Line<'_>, bytes: &[u8]) -> usize {
    let end = line.text.as_ptr_range().end as usize - bytes.as_ptr() as usize;
    match bytes[end..] {
        [b'\r', b'\n', ..] => end + 2,
        [_, ..] => end + 1,
        [] => end,
    }
}

fn encoding_of(line: &Line<'_>) -> Result<Encoding, SkeletonFileError> {
    match line.words().nth(1) {
        Some(b"ascii") => Ok(Encoding::Ascii),
        Some(b"binary_little_endian") => Ok(Encoding::LittleEndian),
        Some(b"binary_big_endian") => Ok(Encoding::BigEndian),
        word => Err(line.malformed("ascii or a binary encoding", word.unwrap_or_default())),
    }
}

fn element(line: &Line<'_>) -> Result<Element, SkeletonFileError> {
    let mut words = line.words().skip(1);
    let name = words.next().unwrap_or_default();
    let count = words.next().unwrap_or_default();
    let count = parse(count).ok_or_else(|| line.malformed("the number of elements", count))?;
    let name = String::from_utf8_lossy(name).into_owned();
    Ok(Element { name, count, properties: Vec::new(), line: line.number })
}

fn scalar_of(word: &[u8]) -> Option<Scalar> {
    Some(match word {
        b"char" | b"int8" => Scalar::I8,
        b"uchar" | b"uint8" => Scalar::U8,
        b"short" | b"int16" => Scalar::I16,
        b"ushort" | b"uint16" => Scalar::U16,
        b"int" | b"int32" => Scalar::I32,
        b"uint" | b"uint32" => Scalar::U32,
        b"float" | b"float32" => Scalar::F32,
        b"double" | b"float64" => Scalar::F64,
        _ => return None,
    })
}
