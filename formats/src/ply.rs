//! PLY, the Stanford polygon file, ASCII or binary, as written by MeshLab, Blender, CloudCompare.
//!
//! ```text
//! ply
//! format ascii 1.0                        or binary_little_endian, binary_big_endian
//! comment made by hand
//! element vertex 4
//! property float x                        any number type
//! property float y
//! property float z
//! property uchar red                      colours of points and of faces: red green blue
//! …
//! element face 2
//! property list uchar int vertex_indices  or vertex_index
//! property int flags                      MeshLab: bit 32 is set for selected faces
//! property float quality
//! property uchar non_design               not 0: non-design; see below for other names
//! end_header
//! ```
//!
//! `ply-rs-bw` reads the header and the binary data, element by element into records of fixed
//! fields. It is not given the lines of ASCII data: its grammar refuses numbers such as `5.` and
//! `.5`, and takes five times as long.
//!
//! # Which property is which label
//!
//! * A property of the face whose name has `nondesign` in it, whatever its case and with or without
//!   `_` and `-`, becomes `face_property`; integers as they are, of other numbers only whether they
//!   are 0.
//! * Of the remaining integer properties one is carried as names such as `region=3`: the first
//!   called `label`, `region`, `group`, `part`, `segment` or `material`, else the first of all. It
//!   is left out if it has more than 256 different values, as it then numbers the faces.

mod ascii;
mod binary;
mod columns;
mod header;
mod record;

use std::collections::BTreeMap;

use crate::builder::Builder;
use crate::colour::Colours;
use crate::error::{Place, ReadError};
use crate::input::Input;
use crate::names::NameTable;
use crate::raw_mesh::RawMesh;
use columns::{ElementKind, Slot};
use header::{Element, Header};
use record::{Face, Point};

/// Where the labels of this format live.
const LABEL_SOURCE: &str =
    "PLY face property non_design, flags, quality or colour, or colours of points";

/// Most different values of an integer property that is carried as names.
const MOST_NAMED_VALUES: usize = 256;

/// Reads a PLY file.
pub(crate) fn read(mut input: Input<'_>, builder: Builder<'_>) -> Result<RawMesh, ReadError> {
    input.skip_byte_order_mark()?;
    let header = header::read(&mut input)?;
    let mut reader = Reader::new(builder, &header, input.path());
    reader.check_header(&header)?;
    if header.is_ascii() {
        ascii::read(&mut input, &header, &mut reader)?;
    } else {
        binary::read(&mut input, &header, &mut reader)?;
    }
    reader.finish(&header)
}

/// Gathers the points and faces that come out of either encoding.
struct Reader<'a> {
    builder: Builder<'a>,
    path: &'a std::path::Path,
    /// Points by the header; faces may come before them.
    points: u64,
    has: FaceCarriers,
    point_colours: Colours,
    face_colours: Colours,
    labels: Vec<i64>,
}

/// Which carriers the faces have by the header.
#[derive(Clone, Copy, Debug, Default)]
struct FaceCarriers {
    flags: bool,
    quality: bool,
    colour: bool,
    non_design: bool,
    label: bool,
}

impl<'a> Reader<'a> {
    fn new(builder: Builder<'a>, header: &Header, path: &'a std::path::Path) -> Self {
        let points = header.element(ElementKind::Point).map_or(0, Element::count);
        let faces = header.element(ElementKind::Face);
        let has = |slot| faces.is_some_and(|faces| faces.has(slot));
        let has = FaceCarriers {
            flags: has(Slot::Flags),
            quality: has(Slot::Quality),
            colour: has(Slot::Red) && has(Slot::Green) && has(Slot::Blue),
            non_design: has(Slot::NonDesign),
            label: has(Slot::Label),
        };
        Self {
            builder,
            path,
            points,
            has,
            point_colours: Colours::default(),
            face_colours: Colours::default(),
            labels: Vec::new(),
        }
    }

    fn check_header(&mut self, header: &Header) -> Result<(), ReadError> {
        self.builder.check_point_count(self.points)?;
        let faces = header.element(ElementKind::Face);
        let wrong = |expected: &str| header.missing(self.path, expected);
        let Some(points) = header.element(ElementKind::Point) else {
            return Err(wrong("`element vertex` in the header"));
        };
        if ![Slot::X, Slot::Y, Slot::Z].into_iter().all(|slot| points.has(slot)) {
            return Err(wrong("properties x, y and z of `element vertex` in the header"));
        }
        match faces {
            Some(faces) if faces.count() > 0 && !faces.has(Slot::Corners) => {
                Err(wrong("`property list … vertex_indices` of `element face` in the header"))
            }
            None if header.has_triangle_strips() => Err(ReadError::Unsupported {
                path: self.path.to_owned(),
                feature: "triangle strips (element tristrips)".to_owned(),
                advice: "save it again with faces, for instance in MeshLab",
            }),
            _ => Ok(()),
        }
    }

    fn point(&mut self, point: &Point, place: impl Fn() -> Place) -> Result<(), ReadError> {
        if self.builder.point(point.position).is_err() {
            let [x, y, z] = point.position;
            let number = format!("the point ({x:?}, {y:?}, {z:?})");
            return Err(ReadError::NotFinite {
                path: self.path.to_owned(),
                place: place(),
                number,
            });
        }
        self.point_colours.push(point.colour());
        Ok(())
    }

    #[inline]
    fn corner(&mut self, index: i64, place: impl Fn() -> Place) -> Result<(), ReadError> {
        match u64::try_from(index) {
            Ok(point) if point < self.points => {
                self.builder.corner(point as u32);
                Ok(())
            }
            _ => Err(ReadError::IndexOutOfRange {
                path: self.path.to_owned(),
                place: place(),
                index: index.to_string(),
                range: match self.points {
                    0 => "the file has no points".to_owned(),
                    points => format!("points are numbered from 0 to {}", points - 1),
                },
            }),
        }
    }

    /// Ends a face whose corners have been given.
    fn face(&mut self, face: &Face, place: impl Fn() -> Place) -> Result<(), ReadError> {
        let corners = self.builder.open_corners();
        if corners < 3 {
            return Err(ReadError::Malformed {
                path: self.path.to_owned(),
                place: place(),
                expected: "a face of at least three corners".to_owned(),
                found: format!("one of {corners}"),
            });
        }
        self.builder.close_face()?;
        let carriers = &mut self.builder.mesh.carriers;
        if self.has.flags {
            carriers.face_selected.push(face.flags & MESHLAB_SELECTED != 0);
        }
        if self.has.quality {
            carriers.face_quality.push(face.quality);
        }
        if self.has.non_design {
            carriers.face_property.push(face.non_design);
        }
        if self.has.colour {
            self.face_colours.push(Some(face.colour));
        }
        if self.has.label {
            self.labels.push(face.label);
        }
        Ok(())
    }

    fn finish(self, header: &Header) -> Result<RawMesh, ReadError> {
        let mut mesh = self.builder.finish(LABEL_SOURCE)?;
        let scale = |kind| header.element(kind).map(Element::colour_scale).unwrap_or_default();
        mesh.carriers.face_colour = self.face_colours.of_faces(scale(ElementKind::Face));
        mesh.carriers.vertex_colour = self.point_colours.of_points(scale(ElementKind::Point));
        if let Some(name) = header.label_name() {
            label_names(name, &self.labels).move_to(&mut mesh.carriers);
        }
        Ok(mesh)
    }
}

/// MeshLab's bit for a selected face.
const MESHLAB_SELECTED: i64 = 0x20;

/// Names such as `region=3` for the values of an integer property.
fn label_names(property: &str, values: &[i64]) -> NameTable {
    let mut table = NameTable::default();
    let mut sets = BTreeMap::new();
    for &value in values {
        let set = match sets.get(&value) {
            Some(&set) => set,
            None if sets.len() == MOST_NAMED_VALUES => return NameTable::default(),
            None => {
                let name = format!("{property}={value}");
                let Ok(set) = table.set([name.as_bytes()]) else { return NameTable::default() };
                sets.insert(value, set);
                set
            }
        };
        table.give(set, 1);
    }
    table
}

#[cfg(test)]
mod tests;
