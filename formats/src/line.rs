//! One line of a text file, and the words and numbers in it.

use std::path::Path;

use crate::error::{Place, ReadError, quote};

/// A line of a text file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'b> {
    /// The line without its end.
    pub(crate) text: &'b [u8],
    /// Its number, from 1.
    pub(crate) number: u64,
    /// The file, for messages.
    pub(crate) path: &'b Path,
}

impl<'b> Line<'b> {
    /// The words of the line.
    pub(crate) fn fields(&self) -> Fields<'b> {
        Fields { rest: self.text }
    }

    /// Where the line is.
    pub(crate) fn place(&self) -> Place {
        Place::Line(self.number)
    }

    /// The error that `found` stands where `expected` should.
    pub(crate) fn malformed(&self, expected: impl Into<String>, found: &[u8]) -> ReadError {
        ReadError::Malformed {
            path: self.path.to_owned(),
            place: self.place(),
            expected: expected.into(),
            found: if found.is_empty() { "the end of the line".to_owned() } else { quote(found) },
        }
    }

    /// The error that a field of the line is not what it should be.
    pub(crate) fn fault(&self, expected: impl Into<String>, fault: FieldFault<'_>) -> ReadError {
        let (path, place) = (self.path.to_owned(), self.place());
        match fault {
            FieldFault::Missing => self.malformed(expected, b""),
            FieldFault::Unreadable(word) if is_number_with_comma(word) => {
                ReadError::Comma { path, place, number: quote(word) }
            }
            FieldFault::Unreadable(word) => self.malformed(expected, word),
            FieldFault::NotFinite(word) => {
                ReadError::NotFinite { path, place, number: quote(word) }
            }
        }
    }

    /// The error that a coordinate of this line is too large in millimetres.
    pub(crate) fn overflow(&self) -> ReadError {
        let number = format!("{} in millimetres", quote(self.text));
        ReadError::NotFinite { path: self.path.to_owned(), place: self.place(), number }
    }

    /// The error that a face of this line names a point that does not exist.
    pub(crate) fn out_of_range(&self, index: impl ToString, range: impl Into<String>) -> ReadError {
        ReadError::IndexOutOfRange {
            path: self.path.to_owned(),
            place: self.place(),
            index: index.to_string(),
            range: range.into(),
        }
    }
}

/// Whether a word is a whole number, of any length and sign, that [`Fields::count`] may refuse.
pub(crate) fn is_whole_number(word: &[u8]) -> bool {
    let digits = word.strip_prefix(b"-").unwrap_or(word);
    !digits.is_empty() && digits.len() <= 30 && digits.iter().all(u8::is_ascii_digit)
}

fn is_number_with_comma(word: &[u8]) -> bool {
    word.contains(&b',')
        && word.iter().any(u8::is_ascii_digit)
        && word.iter().all(|byte| byte.is_ascii_digit() || b"+-.,eE".contains(byte))
}

/// Why a field could not be taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FieldFault<'b> {
    /// The line has ended.
    Missing,
    /// The word is not a number of the wanted kind.
    Unreadable(&'b [u8]),
    /// The word is a number, but NaN or infinite.
    NotFinite(&'b [u8]),
}

/// The words of a line, taken one by one.
#[derive(Clone, Debug)]
pub(crate) struct Fields<'b> {
    rest: &'b [u8],
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x0b | 0x0c)
}

impl<'b> Fields<'b> {
    /// The words of any text.
    pub(crate) fn of(text: &'b [u8]) -> Self {
        Self { rest: text }
    }

    fn skip_blanks(&mut self) {
        while let [first, rest @ ..] = self.rest
            && is_blank(*first)
        {
            self.rest = rest;
        }
    }

    /// Whether no word is left.
    pub(crate) fn is_empty(&mut self) -> bool {
        self.skip_blanks();
        self.rest.is_empty()
    }

    /// The rest of the line, without blanks around it.
    pub(crate) fn rest(&self) -> &'b [u8] {
        self.rest.trim_ascii()
    }

    /// The next word.
    #[inline]
    pub(crate) fn word(&mut self) -> Option<&'b [u8]> {
        self.skip_blanks();
        let length = self.rest.iter().position(|&byte| is_blank(byte)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(length);
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }

    /// The next word as a number, NaN and infinity included.
    #[inline]
    pub(crate) fn any_number(&mut self) -> Result<f64, FieldFault<'b>> {
        self.skip_blanks();
        if let Ok((number, length)) = fast_float2::parse_partial::<f64, _>(self.rest) {
            let rest = &self.rest[length..];
            if rest.first().is_none_or(|&byte| is_blank(byte)) {
                self.rest = rest;
                return Ok(number);
            }
        }
        Err(self.word().map_or(FieldFault::Missing, FieldFault::Unreadable))
    }

    /// The next word as a finite number.
    #[inline]
    pub(crate) fn number(&mut self) -> Result<f64, FieldFault<'b>> {
        let before = self.clone();
        let number = self.any_number()?;
        if number.is_finite() {
            return Ok(number);
        }
        let word = { before }.word().unwrap_or_default();
        Err(FieldFault::NotFinite(word))
    }

    /// The next word as a whole number that is not negative.
    #[inline]
    pub(crate) fn count(&mut self) -> Result<u64, FieldFault<'b>> {
        self.skip_blanks();
        let before = self.clone();
        let (number, length) = whole_number(self.rest);
        let rest = &self.rest[length..];
        match number {
            Some(number) if length > 0 && rest.first().is_none_or(|&byte| is_blank(byte)) => {
                self.rest = rest;
                Ok(number)
            }
            _ => Err({ before }.word().map_or(FieldFault::Missing, FieldFault::Unreadable)),
        }
    }

    /// The next word as a whole number; one written as `32.0` counts.
    #[inline]
    pub(crate) fn integer(&mut self) -> Result<i64, FieldFault<'b>> {
        self.skip_blanks();
        let mut digits = Self { rest: self.rest.strip_prefix(b"-").unwrap_or(self.rest) };
        if let Ok(number) = digits.count()
            && let Ok(number) = i64::try_from(number)
        {
            let is_negative = self.rest.starts_with(b"-");
            *self = digits;
            return Ok(if is_negative { -number } else { number });
        }
        let word = self.clone().word().unwrap_or_default();
        match self.number()? {
            number if number.fract() == 0.0 && number.abs() < MOST_EXACT => Ok(number as i64),
            _ => Err(FieldFault::Unreadable(word)),
        }
    }
}

/// All whole numbers up to this are exact in an `f64`.
const MOST_EXACT: f64 = 9_007_199_254_740_992.0;

/// The whole number at the start of `text` (`None` if it is beyond `u64`) and its length.
#[inline]
pub(crate) fn whole_number(text: &[u8]) -> (Option<u64>, usize) {
    let mut number: u64 = 0;
    let mut length = 0;
    // 19 digits always fit, so that the loop need not check.
    while let Some(digit) = text.get(length).map(|byte| byte.wrapping_sub(b'0'))
        && digit < 10
        && length < 19
    {
        number = number * 10 + u64::from(digit);
        length += 1;
    }
    let more = text[length..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    if more == 0 { (Some(number), length) } else { (None, length + more) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(text: &str) -> Vec<Result<f64, FieldFault<'_>>> {
        let mut fields = Fields::of(text.as_bytes());
        std::iter::from_fn(|| (!fields.is_empty()).then(|| fields.number())).collect()
    }

    #[test]
    fn numbers_come_in_all_the_ways_programs_write_them() {
        let read: Vec<f64> =
            numbers("1 -2.5 +3 .5 5. 1e3 1E-3 -0 007 1e-400").into_iter().flatten().collect();
        assert_eq!(read, [1.0, -2.5, 3.0, 0.5, 5.0, 1e3, 1e-3, 0.0, 7.0, 0.0]);
    }

    #[test]
    fn what_is_no_finite_number_is_refused() {
        for word in ["abc", "1,5", "0x10", "1_000", "1.5mm", "--1", "1e", "\u{661}"] {
            assert_eq!(numbers(word), [Err(FieldFault::Unreadable(word.as_bytes()))]);
        }
        for word in ["nan", "NaN", "inf", "-Infinity", "1e400", "-1e400"] {
            assert_eq!(numbers(word), [Err(FieldFault::NotFinite(word.as_bytes()))]);
        }
        assert_eq!(Fields::of(b" ").number(), Err(FieldFault::Missing));
    }

    #[test]
    fn counts_are_whole_and_not_negative() {
        let mut fields = Fields::of(b"0 18446744073709551615 7");
        assert_eq!(fields.count(), Ok(0));
        // 20 digits are beyond any count; the largest u64 has to go with them.
        assert!(fields.count().is_err());
        assert_eq!(Fields::of(b"9999999999999999999").count(), Ok(9_999_999_999_999_999_999));
        for word in ["-1", "1.0", "1,", "x", "+"] {
            let fault = Err(FieldFault::Unreadable(word.as_bytes()));
            assert_eq!(Fields::of(word.as_bytes()).count(), fault);
        }
        assert_eq!(Fields::of(b"").count(), Err(FieldFault::Missing));
    }

    #[test]
    fn integers_may_be_negative_or_have_a_point() {
        let mut fields = Fields::of(b"-1 32.0 4e9 007");
        assert_eq!([(); 4].map(|()| fields.integer()), [Ok(-1), Ok(32), Ok(4_000_000_000), Ok(7)]);
        for word in ["1.5", "--1", "1e300", "-"] {
            let fault = Err(FieldFault::Unreadable(word.as_bytes()));
            assert_eq!(Fields::of(word.as_bytes()).integer(), fault);
        }
    }

    #[test]
    fn a_comma_is_told_apart_from_other_faults() {
        let line = Line { text: b"", number: 3, path: Path::new("x.off") };
        let fault = |word: &'static str| {
            line.fault("a number", FieldFault::Unreadable(word.as_bytes())).to_string()
        };
        assert!(fault("1,5").contains("`1,5` has a comma"), "{}", fault("1,5"));
        assert!(fault("1,").contains("comma"));
        assert_eq!(fault("a,b"), "cannot read x.off: line 3: expected a number, found `a,b`");
    }
}
