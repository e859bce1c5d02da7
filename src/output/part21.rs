//! The text of an exchange file (ISO 10303-21), STEP or IFC: entities, numbers, strings.

use std::fmt::{self, Display, Formatter, Write as _};
use std::io::Write;

/// Bytes collected before they go to the output.
const CHUNK: usize = 1 << 16;

/// The number of an entity, `#12`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(in crate::output) struct Id(u32);

impl Display for Id {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.0)
    }
}

/// Why an entity could not be written.
#[derive(Debug)]
pub(in crate::output) enum Fault {
    /// A number in it is NaN or infinite.
    NotFinite,
    Io(std::io::Error),
}

/// Writes entities one after the other and numbers them.
pub(in crate::output) struct Part21<'a> {
    out: &'a mut dyn Write,
    text: String,
    next: u32,
}

impl<'a> Part21<'a> {
    pub(in crate::output) fn new(out: &'a mut dyn Write) -> Self {
        Self { out, text: String::with_capacity(CHUNK + 4096), next: 1 }
    }

    /// Writes text that is not an entity.
    pub(in crate::output) fn raw(&mut self, text: &str) -> Result<(), Fault> {
        self.text.push_str(text);
        self.flush_from(CHUNK)
    }

    /// Sets a number aside for an entity that is written later.
    pub(in crate::output) fn reserve(&mut self) -> Id {
        let id = Id(self.next);
        self.next += 1;
        id
    }

    /// Writes an entity under the next number.
    pub(in crate::output) fn entity(&mut self, entity: fmt::Arguments<'_>) -> Result<Id, Fault> {
        let id = self.reserve();
        self.entity_as(id, entity)?;
        Ok(id)
    }

    /// Writes an entity under a number set aside before.
    pub(in crate::output) fn entity_as(
        &mut self,
        id: Id,
        entity: fmt::Arguments<'_>,
    ) -> Result<(), Fault> {
        // Only `Real` refuses to be formatted.
        writeln!(self.text, "{id}={entity};").map_err(|_| Fault::NotFinite)?;
        self.flush_from(CHUNK)
    }

    /// Hands everything to the output.
    pub(in crate::output) fn finish(mut self) -> Result<(), Fault> {
        self.flush_from(0)?;
        self.out.flush().map_err(Fault::Io)
    }

    fn flush_from(&mut self, size: usize) -> Result<(), Fault> {
        if self.text.len() > size {
            self.out.write_all(self.text.as_bytes()).map_err(Fault::Io)?;
            self.text.clear();
        }
        Ok(())
    }
}

/// A real number: the shortest text that reads back as the same `f64`.
///
/// Part 21 wants a decimal point, and a capital E.  Formatting fails if the
/// number is not finite.
#[derive(Clone, Copy)]
pub(in crate::output) struct Real(pub(in crate::output) f64);

impl Display for Real {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let x = self.0;
        let size = x.abs();
        if !x.is_finite() {
            Err(fmt::Error)
        } else if x == 0.0 {
            f.write_str("0.") // of either sign
        } else if !(1e-4..1e15).contains(&size) {
            let text = format!("{x:E}");
            let (digits, exponent) = text.split_once('E').unwrap_or((&text, "0"));
            let point = if digits.contains('.') { "" } else { "." };
            write!(f, "{digits}{point}E{exponent}")
        } else if x.fract() == 0.0 {
            write!(f, "{x:.0}.")
        } else {
            write!(f, "{x}")
        }
    }
}

/// A string in quotes, with everything but plain ASCII escaped.
///
/// `'` and `\` are doubled; other characters go by code point, four digits
/// between `\X2\` and `\X0\`, or eight between `\X4\` and `\X0\`.  So does a
/// `'` that no letter or digit follows: OCCT takes `'')` for the end of a string.
pub(in crate::output) struct Text<'a>(pub(in crate::output) &'a str);

impl Display for Text<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_char('\'')?;
        let mut open = 0; // digits of the escape that is open
        let mut rest = self.0.chars();
        while let Some(c) = rest.next() {
            let inside = rest.as_str().starts_with(|next: char| next.is_ascii_alphanumeric());
            let digits = match c {
                '\'' if !inside => 4,
                ' '..='~' => 0,
                _ if (c as u32) < 0x1_0000 => 4,
                _ => 8,
            };
            if digits != open {
                f.write_str(if open == 0 { "" } else { r"\X0\" })?;
                f.write_str(if digits == 4 {
                    r"\X2\"
                } else if digits == 8 {
                    r"\X4\"
                } else {
                    ""
                })?;
                open = digits;
            }
            match (digits, c) {
                (0, '\'' | '\\') => write!(f, "{c}{c}")?,
                (0, _) => f.write_char(c)?,
                _ => write!(f, "{:0digits$X}", c as u32)?,
            }
        }
        f.write_str(if open == 0 { "'" } else { r"\X0\'" })
    }
}

/// Items in parentheses with commas between them.
pub(in crate::output) struct List<I>(pub(in crate::output) I);

impl<I: Clone + IntoIterator<Item: Display>> Display for List<I> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_char('(')?;
        for (i, item) in self.0.clone().into_iter().enumerate() {
            if i > 0 {
                f.write_char(',')?;
            }
            write!(f, "{item}")?;
        }
        f.write_char(')')
    }
}

/// `.T.` or `.F.`
pub(in crate::output) struct Flag(pub(in crate::output) bool);

impl Display for Flag {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0 { ".T." } else { ".F." })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reals_have_a_point_and_read_back() {
        let cases = [
            (1.0, "1."),
            (-0.0, "0."),
            (0.5, "0.5"),
            (-12.25, "-12.25"),
            (1e-7, "1.E-7"),
            (1.5e-7, "1.5E-7"),
            (1e15, "1.E15"),
            (123_456_789.0, "123456789."),
            (0.1 + 0.2, "0.30000000000000004"),
        ];
        for (x, text) in cases {
            assert_eq!(Real(x).to_string(), text);
            assert_eq!(text.parse::<f64>().unwrap(), x);
        }
    }

    #[test]
    fn numbers_that_are_none_are_refused() {
        let mut out = Vec::new();
        let mut part = Part21::new(&mut out);
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let fault = part.entity(format_args!("X({})", Real(x)));
            assert!(matches!(fault, Err(Fault::NotFinite)));
        }
    }

    #[test]
    fn quotes_and_backslashes_are_doubled() {
        assert_eq!(Text(r"a'b\c").to_string(), r"'a''b\\c'");
        assert_eq!(Text("").to_string(), "''");
    }

    #[test]
    fn quote_that_might_end_the_string_goes_by_code_point() {
        assert_eq!(Text("f('x')").to_string(), r"'f(''x\X2\0027\X0\)'");
        assert_eq!(Text("a'").to_string(), r"'a\X2\0027\X0\'");
    }

    #[test]
    fn other_alphabets_are_escaped_by_code_point() {
        assert_eq!(Text("Träger").to_string(), r"'Tr\X2\00E4\X0\ger'");
        assert_eq!(Text("梁柱").to_string(), r"'\X2\688167F1\X0\'");
        assert_eq!(Text("a🙂é").to_string(), r"'a\X4\0001F642\X0\\X2\00E9\X0\'");
        assert_eq!(Text("a\nb").to_string(), r"'a\X2\000A\X0\b'");
    }

    #[test]
    fn lists_are_separated_by_commas() {
        assert_eq!(List([1, 2, 3]).to_string(), "(1,2,3)");
        assert_eq!(List(Vec::<i32>::new()).to_string(), "()");
    }
}
