//! The values of a PLY file, one element after the other.

use std::path::Path;

use super::super::Source;
use super::super::error::{Place, SkeletonFileError};
use super::super::text::{Line, lines, missing, parse};
use super::header::{Element, Encoding, Header, Scalar};

/// Reads rows of values; what the header promises and the file does not hold is an error, and
/// costs no memory.
pub(super) struct Values<'a> {
    path: &'a Path,
    encoding: Encoding,
    bytes: &'a [u8],
    at: usize,
    lines: Box<dyn Iterator<Item = Line<'a>> + 'a>,
    lines_before: u64,
    line: u64,
    row: Vec<f64>,
}

impl<'a> Values<'a> {
    pub(super) fn new(source: &Source<'a>, header: &Header) -> Self {
        let body = source.bytes.get(header.size..).unwrap_or_default();
        Self {
            path: source.path,
            encoding: header.encoding,
            bytes: source.bytes,
            at: header.size,
            lines: Box::new(lines(source.path, body)),
            lines_before: header.lines,
            line: header.lines,
            row: Vec::new(),
        }
    }

    /// Where the last row stands.
    pub(super) fn place(&self) -> Place {
        match self.encoding {
            Encoding::Ascii => Place::Line(self.line),
            _ => Place::Byte(self.at as u64),
        }
    }

    /// The last row: one value a property, NaN for a list.
    pub(super) fn row(&self) -> &[f64] {
        &self.row
    }

    /// Goes to the next row.
    pub(super) fn advance(&mut self, element: &Element) -> Result<(), SkeletonFileError> {
        self.row.clear();
        match self.encoding {
            Encoding::Ascii => self.text_row(element),
            _ => self.binary_row(element),
        }
    }

    fn text_row(&mut self, element: &Element) -> Result<(), SkeletonFileError> {
        let Some(line) = self.lines.find(|line| !line.text.trim_ascii().is_empty()) else {
            return Err(self.cut_off(element));
        };
        let line = Line { number: self.lines_before + line.number, ..line };
        self.line = line.number;
        let mut words = line.words();
        let mut value = || {
            let word = words.next().unwrap_or_default();
            parse::<f64>(word).ok_or_else(|| line.malformed("a number for each property", word))
        };
        for property in &element.properties {
            let first = value()?;
            let is_list = property.length.is_some();
            self.row.push(if is_list { f64::NAN } else { first });
            if is_list {
                // As many values are asked for as the line holds, however long the list claims to be.
                (0..first as u64).try_for_each(|_| value().map(drop))?;
            }
        }
        match words.next() {
            Some(more) => Err(line.malformed("the end of the line", more)),
            None => Ok(()),
        }
    }

    fn binary_row(&mut self, element: &Element) -> Result<(), SkeletonFileError> {
        for property in &element.properties {
            let value = match property.length {
                None => self.scalar(property.scalar),
                Some(length) => self.scalar(length).and_then(|length| {
                    self.skip((length.max(0.0) as usize).checked_mul(property.scalar.size())?)
                }),
            };
            match value {
                Some(value) => self.row.push(value),
                None => return Err(self.cut_off(element)),
            }
        }
        Ok(())
    }

    fn cut_off(&self, element: &Element) -> SkeletonFileError {
        let expected = format!("{} elements {}", element.count, element.name);
        missing(self.path, self.place(), expected, "the end of the file")
    }

    fn skip(&mut self, count: usize) -> Option<f64> {
        self.at = self.at.checked_add(count).filter(|&at| at <= self.bytes.len())?;
        Some(f64::NAN)
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let bytes = self.bytes.get(self.at..)?.first_chunk::<N>()?;
        self.at += N;
        Some(*bytes)
    }

    fn scalar(&mut self, scalar: Scalar) -> Option<f64> {
        let little = self.encoding == Encoding::LittleEndian;
        macro_rules! number {
            ($type:ty) => {{
                let bytes = self.take()?;
                f64::from(if little {
                    <$type>::from_le_bytes(bytes)
                } else {
                    <$type>::from_be_bytes(bytes)
                })
            }};
        }
        Some(match scalar {
            Scalar::I8 => number!(i8),
            Scalar::U8 => number!(u8),
            Scalar::I16 => number!(i16),
            Scalar::U16 => number!(u16),
            Scalar::I32 => number!(i32),
            Scalar::U32 => number!(u32),
            Scalar::F32 => number!(f32),
            Scalar::F64 => number!(f64),
        })
    }
}

impl Scalar {
    /// Bytes of one value.
    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}
