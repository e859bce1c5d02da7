//! Wavefront OBJ, as written by Blender, MeshLab, FreeCAD and nearly everything else.
//!
//! ```text
//! mtllib part.mtl        colours of materials, optional
//! v 0 0 0                a point; may go on with a colour `r g b`, or with a weight
//! o bracket              object, group and material of the faces that follow:
//! g non_design           each holds until it is set again, and all hold together
//! usemtl red
//! f 1 2 3                corners from 1, or from the last point with -1; `1/2/3` has texture
//! f -3//1 -2//1 -1//1    coordinate and normal behind the slashes
//! ```
//!
//! Points and faces are read here and not by `tobj`: that crate keeps about a hundred bytes for
//! each face, so that a file of tiny faces takes more than ten times its size, forgets the object
//! at the next group and the material if its library is missing, knows no lines, and is four times
//! slower. It does read the material library.
//!
//! Normals, texture coordinates, lines, points and free-form surfaces are passed over. A group line
//! of several words may mean several groups or one name with blanks, so faces get the whole line
//! and each word as names.

mod material;

use std::path::Path;

use indexmap::IndexSet;

use crate::builder::Builder;
use crate::colour::{Colours, Scale};
use crate::error::{Place, ReadError};
use crate::input::Input;
use crate::line::{FieldFault, Fields, Line, is_whole_number, whole_number};
use crate::names::{MOST_NAMES, NameTable};
use crate::raw_mesh::RawMesh;

/// Where the labels of this format live.
const LABEL_SOURCE: &str =
    "OBJ group, object and material names, material colours, or colours of points";

/// Reads an OBJ file; `folder` is where its material libraries are looked for.
pub(crate) fn read(
    input: &mut Input<'_>,
    builder: Builder<'_>,
    folder: Option<&Path>,
) -> Result<RawMesh, ReadError> {
    input.skip_byte_order_mark()?;
    let mut reader = Reader::new(builder);
    let mut joined = Vec::new();
    let mut first_line = 0;
    while let Some(line) = input.next_line()? {
        let continues = line.text.last() == Some(&b'\\') && !line.text.starts_with(b"#");
        if !continues && joined.is_empty() {
            reader.statement(&line)?;
            continue;
        }
        if joined.is_empty() {
            first_line = line.number;
        }
        joined.extend_from_slice(&line.text[..line.text.len() - usize::from(continues)]);
        joined.push(b' ');
        if !continues {
            reader.statement(&Line { text: &joined, number: first_line, path: line.path })?;
            joined.clear();
        }
    }
    let path = input.path();
    reader.statement(&Line { text: &joined, number: first_line, path })?;
    reader.finish(path, folder)
}

/// The state of an OBJ file: what holds for the next face, and what has been gathered.
struct Reader<'a> {
    builder: Builder<'a>,
    point_colours: Colours,
    object: Vec<u8>,
    group: Vec<u8>,
    material: Vec<u8>,
    names: NameTable,
    /// Set of names of the next face; `None` after one of them has changed.
    name_set: Option<u32>,
    libraries: Vec<String>,
    materials: IndexSet<Vec<u8>>,
    /// First face, and index into `materials`, of each run of faces with one material.
    material_runs: Vec<(usize, usize)>,
    /// Largest index of a corner, from 1, and its line: points may come after faces.
    largest_index: (u64, u64),
}

impl<'a> Reader<'a> {
    fn new(builder: Builder<'a>) -> Self {
        Self {
            builder,
            point_colours: Colours::default(),
            object: Vec::new(),
            group: Vec::new(),
            material: Vec::new(),
            names: NameTable::default(),
            name_set: None,
            libraries: Vec::new(),
            materials: IndexSet::new(),
            material_runs: Vec::new(),
            largest_index: (0, 0),
        }
    }

    #[inline]
    fn statement(&mut self, line: &Line<'_>) -> Result<(), ReadError> {
        let mut fields = line.fields();
        match fields.word() {
            Some(b"v") => self.point(line, fields),
            Some(b"f") => self.face(line, fields),
            Some(word) => {
                self.other_statement(word, fields.rest());
                Ok(())
            }
            None => Ok(()),
        }
    }

    fn other_statement(&mut self, word: &[u8], rest: &[u8]) {
        let name = match word {
            b"o" => &mut self.object,
            b"g" => &mut self.group,
            b"usemtl" => &mut self.material,
            b"mtllib" => return self.libraries.push(String::from_utf8_lossy(rest).into_owned()),
            _ => return,
        };
        name.clear();
        name.extend_from_slice(rest);
        self.name_set = None;
    }

    fn point(&mut self, line: &Line<'_>, mut fields: Fields<'_>) -> Result<(), ReadError> {
        let mut number = || fields.number().map_err(|fault| line.fault("v x y z", fault));
        let mut position = [number()?, number()?, number()?];
        let mut colour = None;
        if !fields.is_empty() {
            match read_point_rest(line, fields)? {
                PointRest::Nothing => {}
                PointRest::Weight(weight) => position = position.map(|x| x / weight),
                PointRest::Colour(rgb) => colour = Some(rgb),
            }
        }
        self.point_colours.push(colour);
        self.builder.point(position).map_err(|_| line.overflow())
    }

    fn face(&mut self, line: &Line<'_>, mut fields: Fields<'_>) -> Result<(), ReadError> {
        while let Some(word) = fields.word()
            && !word.starts_with(b"#")
        {
            let point = self.corner(line, word)?;
            self.builder.corner(point);
        }
        let corners = self.builder.open_corners();
        if corners < 3 {
            return Err(line.malformed("a face of at least three corners", line.text));
        }
        self.builder.check_corner_count(corners as u64)?;
        let set = match self.name_set {
            Some(set) => set,
            None => self.make_name_set()?,
        };
        self.names.give(set, 1);
        self.builder.close_face()
    }

    /// The point a corner names, from 0.
    #[inline]
    fn corner(&mut self, line: &Line<'_>, word: &[u8]) -> Result<u32, ReadError> {
        let (number, length) = whole_number(word);
        match number {
            Some(index @ 1..=0xffff_ffff) if matches!(word.get(length), None | Some(b'/')) => {
                if index > self.largest_index.0 {
                    self.largest_index = (index, line.number);
                }
                Ok((index - 1) as u32)
            }
            _ => self.unusual_corner(line, word),
        }
    }

    /// A corner counted back from the last point, or none at all.
    #[cold]
    fn unusual_corner(&self, line: &Line<'_>, word: &[u8]) -> Result<u32, ReadError> {
        let index = &word[..memchr::memchr(b'/', word).unwrap_or(word.len())];
        if !is_whole_number(index) {
            let expected = "a corner: v, v/vt, v//vn or v/vt/vn";
            return Err(line.fault(expected, FieldFault::Unreadable(word)));
        }
        let points = self.builder.mesh.positions.len() as u64;
        let back = match index.strip_prefix(b"-") {
            Some(digits) => whole_number(digits).0,
            None => None,
        };
        if let Some(back @ 1..) = back
            && let Some(point) = points.checked_sub(back)
        {
            // Points beyond 32 bits are refused when the mesh is finished.
            return Ok(point as u32);
        }
        let range = match back {
            Some(1..) => format!("only {points} points come before it"),
            _ => "points are numbered from 1, or back from -1, and at most 4294967295".to_owned(),
        };
        Err(line.out_of_range(String::from_utf8_lossy(index), range))
    }

    /// Makes the set of names for the next faces, and begins a run of faces of one material.
    #[cold]
    fn make_name_set(&mut self) -> Result<u32, ReadError> {
        let words = || {
            let mut fields = Fields::of(&self.group);
            std::iter::from_fn(move || fields.word())
        };
        let single = [&self.object[..], &self.group];
        let names = single.into_iter().chain(words()).chain([&self.material[..]]);
        let set = self.names.set(names).map_err(|_| self.too_many_names())?;
        self.name_set = Some(set);

        let (material, _) = self.materials.insert_full(self.material.clone());
        if self.material_runs.last().map(|run| run.1) != Some(material) {
            self.material_runs.push((self.builder.mesh.faces.len(), material));
        }
        Ok(set)
    }

    fn too_many_names(&self) -> ReadError {
        self.builder.too_many("names of groups, objects and materials", MOST_NAMES as u64)
    }

    fn finish(self, path: &Path, folder: Option<&Path>) -> Result<RawMesh, ReadError> {
        let points = self.builder.mesh.positions.len() as u64;
        let (index, line) = self.largest_index;
        if index > points {
            return Err(ReadError::IndexOutOfRange {
                path: path.to_owned(),
                place: Place::Line(line),
                index: index.to_string(),
                range: match points {
                    0 => "the file has no points".to_owned(),
                    _ => format!("points are numbered from 1 to {points}"),
                },
            });
        }
        let mut mesh = self.builder.finish(LABEL_SOURCE)?;
        mesh.carriers.vertex_colour = self.point_colours.of_points(Scale::Guessed);
        self.names.move_to(&mut mesh.carriers);
        if let Some(folder) = folder {
            let colours = material::read_colours(folder, &self.libraries, &self.materials);
            mesh.carriers.face_colour =
                material::spread(&colours, &self.material_runs, mesh.faces.len());
        }
        Ok(mesh)
    }
}

/// What follows the coordinates of a point.
enum PointRest {
    Nothing,
    Weight(f64),
    Colour([f32; 3]),
}

fn read_point_rest(line: &Line<'_>, mut fields: Fields<'_>) -> Result<PointRest, ReadError> {
    let expected = "nothing, a weight, or a colour `r g b` after the coordinates";
    let mut numbers = [0.0; 4];
    let mut count = 0;
    while !fields.is_empty() && !fields.rest().starts_with(b"#") {
        let rest = fields.rest();
        let number = fields.number().map_err(|fault| line.fault(expected, fault))?;
        let Some(slot) = numbers.get_mut(count) else {
            return Err(line.malformed(expected, rest));
        };
        *slot = number;
        count += 1;
    }
    let [a, b, c, _] = numbers;
    match count {
        0 => Ok(PointRest::Nothing),
        1 if a == 0.0 => Err(line.malformed("a weight other than 0", line.text)),
        1 => Ok(PointRest::Weight(a)),
        2 => Err(line.malformed(expected, line.text)),
        _ => Ok(PointRest::Colour([a as f32, b as f32, c as f32])),
    }
}
