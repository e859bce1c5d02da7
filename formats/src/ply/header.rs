//! The header of a PLY file: which elements follow, and what their properties mean.
//!
//! The lines are taken apart here only as far as is needed to put [slots](Slot) in place of names
//! and to tell lines; what they mean is left to `ply-rs-bw`. On its own that crate does not notice
//! an element or a property that is declared twice, which would shift all data behind it.

use std::collections::HashSet;
use std::io::Cursor;
use std::path::Path;

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, PropertyType};

use super::columns::{ElementKind, Slot, is_integer, property_type, scale_of, size_of};
use super::record::Skipped;
use crate::colour::Scale;
use crate::error::{Place, ReadError, excerpt, quote};
use crate::input::Input;

/// Longest header that is read, bytes, comments not counted. Real ones have about 500.
const LONGEST_HEADER: usize = 64 * 1024;

/// What a header line may be.
const HEADER_LINES: &str = "`format`, `element NAME COUNT`, `property TYPE NAME`, \
     `property list TYPE TYPE NAME`, `comment`, `obj_info` or `end_header`";

/// Names of integer properties that are rather labels than others.
const LABEL_NAMES: [&str; 6] = ["label", "region", "group", "part", "segment", "material"];

/// A header.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    label_name: Option<String>,
    lines: u64,
}

/// An element: its kind, and its definition with the names of slots.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) kind: ElementKind,
    /// Name in the file.
    name: String,
    pub(super) definition: ElementDef,
    pub(super) place: Place,
}

impl Header {
    pub(super) fn is_ascii(&self) -> bool {
        self.encoding == Encoding::Ascii
    }

    /// The first element of a kind.
    pub(super) fn element(&self, kind: ElementKind) -> Option<&Element> {
        self.elements.iter().find(|element| element.kind == kind)
    }

    /// Name in the file of the property that goes to [`Slot::Label`].
    pub(super) fn label_name(&self) -> Option<&str> {
        self.label_name.as_deref()
    }

    pub(super) fn has_triangle_strips(&self) -> bool {
        self.elements.iter().any(|element| element.name == "tristrips")
    }

    /// The error that the header lacks something.
    pub(super) fn missing(&self, path: &Path, expected: &str) -> ReadError {
        ReadError::Malformed {
            path: path.to_owned(),
            place: Place::Line(self.lines),
            expected: expected.to_owned(),
            found: "the end of the header without it".to_owned(),
        }
    }
}

impl Element {
    /// The name as shown in messages.
    pub(super) fn title(&self) -> String {
        excerpt(&self.name, 40)
    }

    pub(super) fn count(&self) -> u64 {
        self.definition.count as u64
    }

    pub(super) fn has(&self, slot: Slot) -> bool {
        self.definition.properties.contains_key(&slot.name(0))
    }

    pub(super) fn colour_scale(&self) -> Scale {
        let red = self.definition.properties.get(&Slot::Red.name(0));
        red.map(|red| scale_of(&red.data_type)).unwrap_or_default()
    }

    /// Fewest bytes that one element takes in the file.
    pub(super) fn least_bytes(&self, encoding: Encoding) -> u64 {
        let properties = self.definition.properties.values();
        // In ASCII a value takes a digit and a blank or a line end.
        let least = |property: &PropertyType| match property {
            _ if encoding == Encoding::Ascii => 2,
            PropertyType::Scalar(scalar) => size_of(scalar),
            PropertyType::List(count, _) => size_of(count),
        };
        properties.map(|property| least(&property.data_type)).sum()
    }

    /// Makes sure that the file can hold as many as the header announces.
    pub(super) fn check_count(
        &self,
        input: &Input<'_>,
        encoding: Encoding,
    ) -> Result<(), ReadError> {
        // The last line of a text may lack its end.
        let room = input.remaining() + u64::from(encoding == Encoding::Ascii);
        match room.checked_div(self.least_bytes(encoding)) {
            Some(most) if self.count() > most => Err(ReadError::WrongCount {
                path: input.path().to_owned(),
                place: self.place.clone(),
                what: format!("of element {}", self.title()),
                count: self.count(),
                room: input.remaining(),
                holds: format!("at most {most}"),
            }),
            _ => Ok(()),
        }
    }
}

/// One line of the header that is more than a comment.
struct HeaderLine {
    number: u64,
    words: Vec<String>,
}

/// Reads the header, up to the first byte of the data.
pub(super) fn read(input: &mut Input<'_>) -> Result<Header, ReadError> {
    let path = input.path();
    let ends_in_cr = begins_with_cr_line(input)?;
    let lines = read_lines(input, ends_in_cr)?;
    check_declared_once(&lines, path)?;
    let (text, names) = put_slots(&lines);

    let parser = Parser::<Skipped>::new();
    let mut reader = Reader::new(Cursor::new(text.as_bytes()));
    let header = parser.read_header(&mut reader).map_err(|error| {
        // The text has one line for each of `lines`, and `end_header`.
        let line = error.line().and_then(|line| lines.get(line.saturating_sub(1)));
        ReadError::Malformed {
            path: path.to_owned(),
            place: Place::Line(line.map_or(input.line_number(), |line| line.number)),
            expected: HEADER_LINES.to_owned(),
            found: match line {
                Some(line) => quote(line.words.join(" ")),
                None => "a header without a sound `format` line".to_owned(),
            },
        }
    })?;
    let definitions = header.elements.into_values();
    let elements = names.elements.into_iter().zip(definitions);
    let elements = elements.map(|((name, line), definition)| Element {
        kind: ElementKind::of(&name),
        name,
        definition,
        place: Place::Line(line),
    });
    Ok(Header {
        encoding: header.encoding,
        elements: elements.collect(),
        label_name: names.label,
        lines: input.line_number(),
    })
}

/// Whether the lines of the header end in CR alone.
///
/// The data of a binary file may then begin with the byte of LF, which is not part of a line end.
fn begins_with_cr_line(input: &mut Input<'_>) -> Result<bool, ReadError> {
    let head = input.peek(64)?;
    let end = memchr::memchr2(b'\n', b'\r', head);
    Ok(end.is_some_and(|end| head[end] == b'\r' && head.get(end + 1) != Some(&b'\n')))
}

fn read_lines(input: &mut Input<'_>, ends_in_cr: bool) -> Result<Vec<HeaderLine>, ReadError> {
    let mut lines = Vec::new();
    let mut length = 0;
    loop {
        let line = if ends_in_cr { input.next_cr_line()? } else { input.next_line()? };
        let Some(line) = line else {
            return Err(input.cut_off("`end_header`"));
        };
        if lines.is_empty() && line.text.trim_ascii() != b"ply" {
            return Err(line.malformed("`ply`", line.text));
        }
        match line.fields().word() {
            None | Some(b"comment" | b"obj_info") => continue,
            Some(b"end_header") => return Ok(lines),
            Some(b"ply" | b"format" | b"element" | b"property") => {}
            _ => return Err(line.malformed(HEADER_LINES, line.text)),
        }
        length += line.text.len();
        if length > LONGEST_HEADER {
            return Err(line.malformed("`end_header` after 64 KiB of header", line.text));
        }
        let words = String::from_utf8_lossy(line.text);
        let words = words.split_ascii_whitespace().map(str::to_owned).collect();
        lines.push(HeaderLine { number: line.number, words });
    }
}

/// Names of the file that are not in the text for `ply-rs-bw`.
struct Names {
    /// Name and line of each element.
    elements: Vec<(String, u64)>,
    label: Option<String>,
}

/// Makes sure that no element, and no property of an element, is declared twice.
fn check_declared_once(lines: &[HeaderLine], path: &Path) -> Result<(), ReadError> {
    let mut elements = HashSet::new();
    let mut properties = HashSet::new();
    for line in lines {
        let is_new = match &line.words[..] {
            [element, name, ..] if element == "element" => {
                properties.clear();
                elements.insert(name)
            }
            [property, .., name] if property == "property" => properties.insert(name),
            _ => true,
        };
        if !is_new {
            return Err(ReadError::Malformed {
                path: path.to_owned(),
                place: Place::Line(line.number),
                expected: "each element and each of its properties to be declared once".to_owned(),
                found: format!("{} again", quote(line.words.join(" "))),
            });
        }
    }
    Ok(())
}

/// The header as text for `ply-rs-bw`, with slots in place of names.
fn put_slots(lines: &[HeaderLine]) -> (String, Names) {
    let label_line = find_label(lines);
    let mut names = Names { elements: Vec::new(), label: None };
    let mut text = String::new();
    let mut kind = ElementKind::Other;
    let mut taken = HashSet::new();
    for (number, line) in lines.iter().enumerate() {
        let mut words: Vec<&str> = line.words.iter().map(String::as_str).collect();
        let new_name;
        match &mut words[..] {
            ["element", name, _] => {
                names.elements.push(((*name).to_owned(), line.number));
                kind = ElementKind::of(name);
                taken.clear();
                new_name = format!("e{number}");
                *name = &new_name;
            }
            ["property", middle @ .., name] => {
                let slot = match property_type(middle) {
                    Some(_) if label_line == Some(number) => {
                        names.label = Some((*name).to_owned());
                        Slot::Label
                    }
                    Some(property) => Slot::of(kind, name, &property),
                    None => Slot::Unused,
                };
                // `red` and `diffuse_red` may both be there: the first counts.
                let is_first = taken.insert(slot.name(number));
                new_name = if is_first { slot } else { Slot::Unused }.name(number);
                *name = &new_name;
            }
            _ => {}
        }
        text.push_str(&words.join(" "));
        text.push('\n');
    }
    text.push_str("end_header\n");
    (text, names)
}

/// The line of the integer property of the faces that is carried as names.
fn find_label(lines: &[HeaderLine]) -> Option<usize> {
    let mut kind = ElementKind::Other;
    let mut candidates = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        match &line.words[..] {
            [element, name, _] if element == "element" => kind = ElementKind::of(name),
            [property, scalar, name] if property == "property" && kind == ElementKind::Face => {
                if let Some(property) = property_type(&[scalar.as_str()])
                    && is_integer(&property)
                    && Slot::of(kind, name, &property) == Slot::Unused
                    && !matches!(name.as_str(), "alpha" | "a" | "diffuse_alpha")
                {
                    candidates.push((number, name.to_ascii_lowercase()));
                }
            }
            _ => {}
        }
    }
    let named = |label: &&str| candidates.iter().find(|(_, name)| name == label);
    let preferred = LABEL_NAMES.iter().find_map(named);
    preferred.or(candidates.first()).map(|(number, _)| *number)
}
