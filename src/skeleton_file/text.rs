//! Lines, words and numbers of a text file, each with its place for messages.

use std::path::Path;

use nalgebra::Point3;

use super::error::{Place, SkeletonFileError};

/// Longest piece of a file shown in a message, characters.
const QUOTE_LENGTH: usize = 40;

/// Largest coordinate, mm: its fourth power, which area moments need, is still a number.
pub(super) const LARGEST: f64 = 1e30;

/// A line of a text file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    pub(super) path: &'a Path,
    /// Its number, from 1.
    pub(super) number: u64,
    pub(super) text: &'a [u8],
}

/// The lines of a file, whether they end in LF, CR LF or CR.
pub(super) fn lines<'a>(path: &'a Path, bytes: &'a [u8]) -> impl Iterator<Item = Line<'a>> {
    let mut rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut number = 0;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let length = rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
        let text = &rest[..length];
        let end = if rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
        rest = rest.get(length + end..).unwrap_or_default();
        number += 1;
        Some(Line { path, number, text })
    })
}

/// The lines that have more than blanks and a comment, without these; a comment goes from `#` to
/// the end of the line.
pub(super) fn content<'a>(path: &'a Path, bytes: &'a [u8]) -> impl Iterator<Item = Line<'a>> {
    lines(path, bytes).filter_map(|line| {
        let text = line.text.split(|&b| b == b'#').next().unwrap_or_default().trim_ascii();
        (!text.is_empty()).then_some(Line { text, ..line })
    })
}

impl<'a> Line<'a> {
    /// The words of the line; blanks, commas and semicolons stand between them.
    pub(super) fn words(&self) -> Words<'a> {
        Words { line: *self, rest: self.text }
    }

    pub(super) fn place(&self) -> Place {
        Place::Line(self.number)
    }

    /// The error that `found` stands where `expected` should.
    pub(super) fn malformed(&self, expected: &str, found: &[u8]) -> SkeletonFileError {
        malformed(self.path, self.place(), expected, found)
    }

    /// The error that a segment of this line names a point that is not there.
    pub(super) fn no_such_point(&self, index: impl ToString, count: usize) -> SkeletonFileError {
        let (path, place) = (self.path.to_owned(), self.place());
        SkeletonFileError::NoSuchPoint { path, place, index: index.to_string(), count }
    }
}

/// The error that `found` stands where `expected` should.
pub(super) fn malformed(
    path: &Path,
    place: Place,
    expected: &str,
    found: &[u8],
) -> SkeletonFileError {
    let found = if found.is_empty() { "the end of the line".to_owned() } else { quote(found) };
    SkeletonFileError::Malformed { path: path.to_owned(), place, expected: expected.into(), found }
}

/// The error that something is missing altogether; `found` says in words what is there.
pub(super) fn missing(
    path: &Path,
    place: Place,
    expected: String,
    found: &str,
) -> SkeletonFileError {
    SkeletonFileError::Malformed { path: path.to_owned(), place, expected, found: found.into() }
}

/// A piece of a file as shown in a message: in backquotes, shortened, control characters escaped.
pub(super) fn quote(text: &[u8]) -> String {
    let head = String::from_utf8_lossy(&text[..text.len().min(4 * QUOTE_LENGTH)]);
    let mut quoted: String = head.chars().take(QUOTE_LENGTH).flat_map(char::escape_debug).collect();
    if head.chars().nth(QUOTE_LENGTH).is_some() || text.len() > 4 * QUOTE_LENGTH {
        quoted.push('…');
    }
    format!("`{quoted}`")
}

/// The words of a line, taken one by one.
#[derive(Clone, Debug)]
pub(super) struct Words<'a> {
    line: Line<'a>,
    rest: &'a [u8],
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let between = |b: &u8| b.is_ascii_whitespace() || matches!(b, b',' | b';');
        let start = self.rest.iter().position(|b| !between(b))?;
        let word = &self.rest[start..];
        let length = word.iter().position(between).unwrap_or(word.len());
        self.rest = &word[length..];
        Some(&word[..length])
    }
}

impl Words<'_> {
    /// The next word as a number, NaN and infinity included.
    pub(super) fn any_number(&mut self, expected: &str) -> Result<f64, SkeletonFileError> {
        let word = self.next().unwrap_or_default();
        parse(word).ok_or_else(|| self.line.malformed(expected, word))
    }

    /// The next three words as a place in the file's unit, turned into mm.
    pub(super) fn position(&mut self, to_mm: f64) -> Result<Point3<f64>, SkeletonFileError> {
        let mut position = Point3::origin();
        for c in 0..3 {
            let word = self.clone().next().unwrap_or_default();
            position[c] = to_mm * self.any_number("three coordinates")?;
            if !is_usable(position[c]) {
                let (path, place) = (self.line.path.to_owned(), self.line.place());
                return Err(SkeletonFileError::NotUsable { path, place, number: quote(word) });
            }
        }
        Ok(position)
    }

    /// The next word as a whole number; one written as `3.0` counts.
    pub(super) fn integer(&mut self, expected: &str) -> Result<i64, SkeletonFileError> {
        let word = self.next().unwrap_or_default();
        as_integer(word).ok_or_else(|| self.line.malformed(expected, word))
    }
}

/// A word as a number.
pub(super) fn parse<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A word as a whole number; one written as `3.0` or `3e0` counts.
pub(super) fn as_integer(word: &[u8]) -> Option<i64> {
    parse::<i64>(word).or_else(|| {
        let number = parse::<f64>(word)?;
        (number.fract() == 0.0 && number.abs() < 1e15).then_some(number as i64)
    })
}

/// Whether a coordinate in mm can be computed with.
pub(super) fn is_usable(coordinate: f64) -> bool {
    coordinate.abs() <= LARGEST
}

/// The radius a file tells, mm; 0 where it tells none that is one.
pub(super) fn radius_or_unknown(radius: f64) -> f64 {
    if radius > 0.0 && is_usable(radius) { radius } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_lf_crlf_or_cr() {
        for text in
            [&b"a\nb\n\nc"[..], b"a\r\nb\r\n\r\nc\r\n", b"a\rb\r\rc\r", b"\xef\xbb\xbfa\nb\n\nc"]
        {
            let found: Vec<_> = lines(Path::new("x"), text).map(|l| (l.number, l.text)).collect();
            assert_eq!(found, [(1, &b"a"[..]), (2, b"b"), (3, b""), (4, b"c")]);
        }
    }

    #[test]
    fn a_whole_number_may_be_written_as_a_real_one() {
        assert_eq!(as_integer(b"3"), Some(3));
        assert_eq!(as_integer(b"1.2000000e+01"), Some(12));
        assert_eq!(as_integer(b"1.5"), None);
        assert_eq!(as_integer(b"1e300"), None);
    }

    #[test]
    fn a_quote_is_short_and_has_no_control_characters() {
        assert_eq!(quote(b"\x1b[31m"), "`\\u{1b}[31m`");
        assert!(quote(&[b'x'; 1000]).chars().count() < 50);
    }
}
