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

/// Most words of a group line that are names by themselves.
const MOST_GROUPS: usize = 16;

/// Most different lines that name material libraries.
const MOST_LIBRARIES: usize = 64;

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
    libraries: IndexSet<String>,
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
            libraries: IndexSet::new(),
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
            b"mtllib" => {
                if self.libraries.len() < MOST_LIBRARIES {
                    self.libraries.insert(String::from_utf8_lossy(rest).into_owned());
                }
                return;
            }
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
            std::iter::from_fn(move || fields.word()).take(MOST_GROUPS)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Format;
    use crate::testing::{mesh, message, names_of_faces};

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    #[test]
    fn corners_count_from_one_or_back_from_the_last_point() {
        let plain = mesh(format!("{SQUARE}f 1 2 3 4\n"), Format::Obj);
        assert_eq!(plain.faces.corners, [0, 1, 2, 3]);
        for face in ["f 1/1 2/2 3/3 4/4", "f 1//1 2//2 3//3 4//1", "f -4/1/1 -3/1/1 3 -1 # square"]
        {
            assert_eq!(mesh(format!("{SQUARE}vt 0 0\nvn 0 0 1\n{face}"), Format::Obj), plain);
        }
    }

    #[test]
    fn points_may_come_after_the_faces_that_use_them() {
        assert_eq!(mesh(format!("f 1 2 3\n{SQUARE}"), Format::Obj).faces.corners, [0, 1, 2]);
        let message = message(format!("f 1 2 3\nf 1 9 3\nf 7 1 2\n{SQUARE}"), Format::Obj);
        assert_eq!(message, "line 2: a face names point 9, but points are numbered from 1 to 4");
    }

    #[test]
    fn object_group_and_material_hold_together() {
        let text = format!(
            "mtllib none.mtl\n{SQUARE}f 1 2 3\no bracket\nf 1 2 3\ng non_design\nusemtl red\nf 1 2 3\n\
             f 2 3 4\no arm\nf 1 2 3\ng\nusemtl grey steel\nf 1 2 3\ng left pad\nf 1 2 3\n"
        );
        let mesh = mesh(text, Format::Obj);
        let expected: [&[&str]; 7] = [
            &[],
            &["bracket"],
            &["bracket", "non_design", "red"],
            &["bracket", "non_design", "red"],
            &["arm", "non_design", "red"],
            &["arm", "grey steel"],
            &["arm", "left pad", "left", "pad", "grey steel"],
        ];
        assert_eq!(names_of_faces(&mesh), expected);
    }

    #[test]
    fn names_are_carried_as_they_are() {
        let name = "<img src=x onerror=alert(1)>";
        let bytes =
            [b"v 0 0 0\nv 1 0 0\nv 0 1 0\no Tr\xe4ger\ng ", name.as_bytes(), b"\nf 1 2 3\n"];
        let mesh = mesh(bytes.concat(), Format::Obj);
        assert_eq!(mesh.carriers.names[..2], ["Tr\u{fffd}ger", name]);
    }

    #[test]
    fn points_have_colours_of_0_to_1_or_of_0_to_255() {
        let faces = "f 1 2 3\n";
        let text = "v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0 1\nv 0 1 0\n";
        let colours = mesh(format!("{text}{faces}"), Format::Obj).carriers.vertex_colour;
        assert_eq!(colours, [[255, 0, 0], [0, 128, 0], [255, 255, 255]]);
        let text = "v 0 0 0 255 0 0\nv 1 0 0 0 128 0\nv 0 1 0 0 0 1\n";
        let colours = mesh(format!("{text}{faces}"), Format::Obj).carriers.vertex_colour;
        assert_eq!(colours, [[255, 0, 0], [0, 128, 0], [0, 0, 1]]);
    }

    #[test]
    fn a_weight_divides_the_coordinates() {
        let mesh = mesh("v 2 4 6 2\nv 1 0 0 1.0\nv 0 1 0\nf 1 2 3\n", Format::Obj);
        assert_eq!(mesh.positions[0], [1.0, 2.0, 3.0]);
        assert!(message("v 2 4 6 0\n", Format::Obj).contains("a weight other than 0"));
        assert!(message("v 2 4 6 1 2\n", Format::Obj).contains("a colour `r g b`"));
    }

    #[test]
    fn a_line_may_go_on_after_a_backslash() {
        let text = "v 0 \\\n0 0\\\r\n\nv 1 0 0\nv 0 1 0\n# \\\nf 1 \\\n2 \\\n3\ng a\\";
        assert_eq!(mesh(text, Format::Obj).faces.corners, [0, 1, 2]);
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2 \\\n4\n";
        assert!(message(text, Format::Obj).starts_with("line 4: a face names point 4"));
    }

    #[test]
    fn other_statements_are_passed_over() {
        let text =
            format!("{SQUARE}vp 1 2\ns off\np 1\nl 1 2\ncurv 0 1 1 2\nf 1 2 3\ncall other.obj\n");
        assert_eq!(mesh(text, Format::Obj).faces.len(), 1);
    }

    #[test]
    fn the_same_mesh_comes_out_of_tobj() {
        let text = format!(
            "{SQUARE}v 0.5 0.5 1e-1\ng a\nf 1 2 5\nf 2 3 5\nf -3 4 -1\nf 4 1 5\nf 4 3 2 1\n"
        );
        let options = tobj::LoadOptions::default();
        let missing = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
        let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, missing).unwrap();
        let theirs = &models[0].mesh;
        let point = |index: &u32| &theirs.positions[3 * *index as usize..][..3];
        let theirs: Vec<_> = theirs.indices.iter().flat_map(point).copied().collect();
        let ours = mesh(&text, Format::Obj);
        let point = |index: &u32| ours.positions[*index as usize];
        assert_eq!(ours.faces.corners.iter().flat_map(point).collect::<Vec<_>>(), theirs);
    }

    #[test]
    fn faults_are_told_with_their_line() {
        for (text, expected) in [
            ("v 0 0\n", "line 1: expected v x y z, found the end of the line"),
            ("v 0 0 nan\n", "line 1: `nan` is not a finite number"),
            ("v 1,5 0 0\n", "line 1: `1,5` has a comma"),
            (
                "v 0 0 0\nf 1 1\n",
                "line 2: expected a face of at least three corners, found `f 1 1`",
            ),
            ("v 0 0 0\nf 1 1 0\n", "line 2: a face names point 0, but points are numbered from 1"),
            ("v 0 0 0\nf 1 1 -2\n", "line 2: a face names point -2, but only 1 points come before"),
            ("v 0 0 0\nf 1 1 4294967296\n", "line 2: a face names point 4294967296, but"),
            ("v 0 0 0\nf 1 1 99999999999999999999999\n", "line 2: a face names point 9999999"),
            (
                "v 0 0 0\nf 1 1 1.5\n",
                "line 2: expected a corner: v, v/vt, v//vn or v/vt/vn, found `1.5`",
            ),
            ("v 0 0 0\nf 1 1 /1\n", "line 2: expected a corner"),
            ("f 1 2 3\n", "line 1: a face names point 3, but the file has no points"),
            ("hello\n", "it has 0 points but no faces"),
        ] {
            let message = message(text, Format::Obj);
            assert!(message.starts_with(expected), "{text:?}: {message}");
        }
    }
}
