//! OFF, the Object File Format of Geomview, as written by CGAL, MeshLab, Open3D and many others.
//!
//! ```text
//! NCOFF                  which of normal (N), colour (C), texture coordinate (ST) points have
//! 4 2 0                  points, faces, edges (not used); may stand on the first line
//! 0 0 0  0 0 1  255 0 0  x y z, normal, colour of 3 or 4 numbers, texture coordinate
//! …
//! 3 0 1 2  255 0 0       corners, their points from 0, colour of the face or nothing
//! 3 0 2 3                # a comment
//! ```
//!
//! The first word may be missing (Geomview allows it). Normals, texture coordinates, alpha and
//! indices into a colour map are passed over. Faces of one or two corners are points and lines in
//! this format, not surface, and fall out.

use crate::builder::Builder;
use crate::colour::{Colours, Scale};
use crate::error::{Place, ReadError};
use crate::input::Input;
use crate::line::{FieldFault, Fields, Line, is_whole_number};
use crate::raw_mesh::RawMesh;

/// Where the labels of this format live.
const LABEL_SOURCE: &str = "OFF colours of faces, or of points (COFF)";

/// Fewest bytes of a point: "0 0 0\n".
const POINT_BYTES: u64 = 6;
/// Fewest bytes of a face: "0\n".
const FACE_BYTES: u64 = 2;

/// Numbers of a point line, by the letters of the first word.
#[derive(Clone, Copy, Debug, Default)]
struct PointLayout {
    normal: bool,
    colour: bool,
    texture: bool,
}

impl PointLayout {
    /// The layout told by a first word such as `STCNOFF`; `None` for any other word.
    fn of(word: &[u8]) -> Option<Self> {
        let word = word.to_ascii_uppercase();
        let rest = word.strip_suffix(b"OFF")?;
        let (texture, rest) = strip(rest, b"ST");
        let (colour, rest) = strip(rest, b"C");
        let (normal, rest) = strip(rest, b"N");
        // MeshLab writes NCOFF, Geomview CNOFF.
        let (late_colour, rest) = strip(rest, b"C");
        let colour = colour || late_colour;
        rest.is_empty().then_some(Self { normal, colour, texture })
    }
}

fn strip<'w>(word: &'w [u8], prefix: &[u8]) -> (bool, &'w [u8]) {
    word.strip_prefix(prefix).map_or((false, word), |rest| (true, rest))
}

/// Whether a word is one that an OFF file begins with.
pub(crate) fn is_first_word(word: &[u8]) -> bool {
    PointLayout::of(word).is_some()
}

/// Reads an OFF file.
pub(crate) fn read(input: &mut Input<'_>, mut builder: Builder<'_>) -> Result<RawMesh, ReadError> {
    input.skip_byte_order_mark()?;
    let (layout, points, faces) = read_header(input)?;
    check_counts(input, &builder, points, faces)?;
    let point_colours = read_points(input, &mut builder, layout, points)?;
    let face_colours = read_faces(input, &mut builder, faces)?;
    if let Some(line) = input.next_content()? {
        return Err(line.malformed(
            format!("the end of the file after {points} points and {faces} faces"),
            line.text,
        ));
    }
    let mut mesh = builder.finish(LABEL_SOURCE)?;
    mesh.carriers.face_colour = face_colours.of_faces(Scale::Guessed);
    mesh.carriers.vertex_colour = point_colours.of_points(Scale::Guessed);
    Ok(mesh)
}

fn read_header(input: &mut Input<'_>) -> Result<(PointLayout, u64, u64), ReadError> {
    let Some(line) = input.next_content()? else {
        return Err(input.cut_off("its first word, OFF"));
    };
    let mut fields = line.fields();
    let layout = match first_word(&line, fields.clone())? {
        Some(layout) => {
            fields.word();
            layout
        }
        None => PointLayout::default(),
    };
    if fields.clone().word().is_some_and(|word| word.eq_ignore_ascii_case(b"BINARY")) {
        return Err(unsupported(&line, "binary OFF", "save it as ASCII OFF, or as PLY"));
    }
    if !fields.is_empty() {
        let (points, faces) = read_counts(&line, fields)?;
        return Ok((layout, points, faces));
    }
    let Some(line) = input.next_content()? else {
        return Err(input.cut_off("the counts of points and faces"));
    };
    let (points, faces) = read_counts(&line, line.fields())?;
    Ok((layout, points, faces))
}

/// The layout by the first word; `None` if the file begins with its counts.
fn first_word(line: &Line<'_>, mut fields: Fields<'_>) -> Result<Option<PointLayout>, ReadError> {
    if fields.clone().count().is_ok() {
        return Ok(None);
    }
    let word = fields.word().unwrap_or_default();
    let other_dimension = |word: &[u8]| {
        let word = word.to_ascii_uppercase();
        word.ends_with(b"4OFF") || word.ends_with(b"NOFF") && word.contains(&b'4')
    };
    if other_dimension(word) || word.ends_with(b"nOFF") {
        let advice = "save it with points of three coordinates";
        return Err(unsupported(line, "points of other than three coordinates", advice));
    }
    let layout = PointLayout::of(word);
    layout.map(Some).ok_or_else(|| line.malformed("OFF, COFF, NOFF or the like", word))
}

fn unsupported(line: &Line<'_>, feature: &str, advice: &'static str) -> ReadError {
    let path = line.path.to_owned();
    ReadError::Unsupported { path, feature: feature.to_owned(), advice }
}

fn read_counts(line: &Line<'_>, mut fields: Fields<'_>) -> Result<(u64, u64), ReadError> {
    let mut count =
        || fields.count().map_err(|fault| line.fault("the counts of points and faces", fault));
    Ok((count()?, count()?))
}

/// Makes sure that the file can hold what its header announces, before memory is taken for it.
fn check_counts(
    input: &Input<'_>,
    builder: &Builder<'_>,
    points: u64,
    faces: u64,
) -> Result<(), ReadError> {
    builder.check_point_count(points)?;
    // The last line may lack its end.
    let room = input.remaining() + 1;
    let wrong = |what: &str, count, holds| ReadError::WrongCount {
        path: input.path().to_owned(),
        place: Place::Line(input.line_number()),
        what: what.to_owned(),
        count,
        room: input.remaining(),
        holds: format!("at most {holds}"),
    };
    if points > room / POINT_BYTES {
        return Err(wrong("points", points, room / POINT_BYTES));
    }
    let room = room - points * POINT_BYTES;
    if faces > room / FACE_BYTES {
        return Err(wrong("faces", faces, room / FACE_BYTES));
    }
    Ok(())
}

fn read_points(
    input: &mut Input<'_>,
    builder: &mut Builder<'_>,
    layout: PointLayout,
    points: u64,
) -> Result<Colours, ReadError> {
    let mut colours = Colours::default();
    builder.mesh.positions.reserve_exact(points as usize);
    for point in 0..points {
        let Some(line) = input.next_content()? else {
            return Err(input.cut_off(format!("point {} of {points}", point + 1)));
        };
        let mut fields = line.fields();
        let mut number = || fields.number().map_err(|fault| line.fault("x y z", fault));
        let position = [number()?, number()?, number()?];
        builder.point(position).map_err(|_| line.overflow())?;
        if !fields.is_empty() {
            colours.push(read_point_rest(&line, fields, layout)?);
        } else {
            colours.push(None);
        }
    }
    Ok(colours)
}

/// What follows the coordinates of a point: normal, colour, texture coordinate.
fn read_point_rest(
    line: &Line<'_>,
    mut fields: Fields<'_>,
    layout: PointLayout,
) -> Result<Option<[f32; 3]>, ReadError> {
    if layout.normal {
        for _ in 0..3 {
            fields.any_number().map_err(|fault| line.fault("a normal of three numbers", fault))?;
        }
    }
    let mut numbers = [0.0; 6];
    let mut count = 0;
    while !fields.is_empty() {
        let number = fields.number().map_err(|fault| line.fault("a number", fault))?;
        let Some(slot) = numbers.get_mut(count) else {
            return Err(line.malformed("fewer numbers for one point", line.text));
        };
        *slot = number as f32;
        count += 1;
    }
    let colour = count.checked_sub(if layout.texture { 2 } else { 0 });
    match colour {
        Some(3 | 4) if layout.colour => Ok(Some([numbers[0], numbers[1], numbers[2]])),
        // Some programs write colours or normals without saying so in the first word.
        Some(0 | 3 | 4) => Ok(None),
        _ => {
            Err(line
                .malformed("numbers of one point as the first word of the file says", line.text))
        }
    }
}

fn read_faces(
    input: &mut Input<'_>,
    builder: &mut Builder<'_>,
    faces: u64,
) -> Result<Colours, ReadError> {
    let mut colours = Colours::default();
    let points = builder.mesh.positions.len() as u64;
    for face in 0..faces {
        let Some(line) = input.next_content()? else {
            return Err(input.cut_off(format!("face {} of {faces}", face + 1)));
        };
        let mut fields = line.fields();
        let expected = "the number of corners of a face";
        let corners = fields.count().map_err(|fault| line.fault(expected, fault))?;
        builder.check_corner_count(corners)?;
        for _ in 0..corners {
            builder.corner(read_corner(&line, &mut fields, points)?);
        }
        let colour = read_face_colour(&line, fields)?;
        if corners < 3 {
            builder.drop_face();
        } else {
            builder.close_face()?;
            colours.push(colour);
        }
    }
    Ok(colours)
}

#[inline]
fn read_corner(line: &Line<'_>, fields: &mut Fields<'_>, points: u64) -> Result<u32, ReadError> {
    match fields.count() {
        Ok(index) if index < points => Ok(index as u32),
        Ok(index) => Err(line.out_of_range(index, known_points(points))),
        Err(FieldFault::Unreadable(word)) if is_whole_number(word) => {
            Err(line.out_of_range(String::from_utf8_lossy(word), known_points(points)))
        }
        Err(fault) => Err(line.fault("the index of a corner", fault)),
    }
}

fn known_points(points: u64) -> String {
    match points.checked_sub(1) {
        Some(last) => format!("points are numbered from 0 to {last}"),
        None => "the file has no points".to_owned(),
    }
}

/// The colour at the end of a face line: nothing, an index into a colour map, or 3 or 4 numbers.
fn read_face_colour(
    line: &Line<'_>,
    mut fields: Fields<'_>,
) -> Result<Option<[f32; 3]>, ReadError> {
    let expected = "nothing, or a colour `r g b` or `r g b a`, after the corners";
    let mut colour = [0.0; 4];
    let mut count = 0;
    while !fields.is_empty() {
        let rest = fields.rest();
        let number = fields.number().map_err(|fault| line.fault(expected, fault))?;
        let Some(slot) = colour.get_mut(count) else {
            return Err(line.malformed(expected, rest));
        };
        *slot = number as f32;
        count += 1;
    }
    match count {
        0 | 1 => Ok(None),
        2 => Err(line.malformed(expected, line.text)),
        _ => Ok(Some([colour[0], colour[1], colour[2]])),
    }
}

#[cfg(test)]
mod tests {
    use crate::Format;
    use crate::testing::{mesh, message};

    const SQUARE: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

    #[test]
    fn counts_may_stand_on_the_first_line_and_comments_anywhere() {
        let plain = mesh(format!("OFF\n4 1 0\n{SQUARE}4 0 1 2 3\n"), Format::Off);
        assert_eq!(plain.positions.len(), 4);
        assert_eq!(plain.faces.corners_of(0), [0, 1, 2, 3]);
        for text in [
            format!("OFF 4 1 0\n{SQUARE}4 0 1 2 3"),
            format!(
                "# by hand\n\nOFF # here\n4 1 # no edges\n\n{SQUARE}\n# face\n 4  0 1\t2 3 # end\n"
            ),
            format!("4 1 0\n{SQUARE}4 0 1 2 3\n"),
            format!("off\r\n4 1 0\r\n{}4 0 1 2 3\r\n", SQUARE.replace('\n', "\r\n")),
            format!("OFF\r4 1 0\r{}4 0 1 2 3\r", SQUARE.replace('\n', "\r")),
            format!("\u{feff}OFF\n4 1 0\n{SQUARE}4 0 1 2 3\n"),
        ] {
            assert_eq!(mesh(&text, Format::Off), plain, "{text:?}");
        }
    }

    #[test]
    fn faces_have_colours_of_whole_numbers_or_of_fractions() {
        let text = format!(
            "OFF\n4 5 0\n{SQUARE}3 0 1 2 255 0 0\n3 0 1 2\n3 0 1 2 7\n3 0 1 2 1 2 3 255\n3 0 1 2 0.0 1e2 0\n"
        );
        let colours = [Some([255, 0, 0]), None, None, Some([1, 2, 3]), Some([0, 100, 0])];
        assert_eq!(mesh(text, Format::Off).carriers.face_colour, colours);
        let text = format!("COFF\n4 2 0\n{SQUARE}3 0 1 2 1 0 0\n3 0 1 2 0.2 0.4 0.6 1.0\n");
        let colours = [Some([255, 0, 0]), Some([51, 102, 153])];
        assert_eq!(mesh(text, Format::Off).carriers.face_colour, colours);
    }

    #[test]
    fn points_have_colours_and_normals_by_the_first_word() {
        let face = "3 0 1 2\n";
        let read = |text: String| mesh(text + face, Format::Off).carriers.vertex_colour;
        let expected = [[255, 0, 0], [0, 128, 0], [255, 255, 255]];
        let coff = "COFF 3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 128 0 255\n0 1 0\n";
        let ncoff = "NCOFF 3 1 0\n0 0 0 0 0 1 255 0 0\n1 0 0 0 0 1 0 128 0\n0 1 0 0 0 nan\n";
        let stcnoff =
            "STCNOFF 3 1 0\n0 0 0 0 0 1 255 0 0 .5 .5\n1 0 0 0 0 1 0 128 0 1 1\n0 1 0 0 0 1 0 0\n";
        for text in [coff, ncoff, stcnoff] {
            assert_eq!(read(text.to_owned()), expected, "{text}");
        }
        assert!(read("NOFF 3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n".to_owned()).is_empty());
    }

    #[test]
    fn points_and_lines_among_the_faces_fall_out() {
        let text = format!("OFF\n4 4 0\n{SQUARE}2 0 1 255 0 0\n3 0 1 2 0 255 0\n1 3\n0\n");
        let mesh = mesh(text, Format::Off);
        assert_eq!(mesh.faces.len(), 1);
        assert_eq!(mesh.carriers.face_colour, [Some([0, 255, 0])]);
    }

    #[test]
    fn other_kinds_of_off_are_refused_by_name() {
        assert!(message("OFF BINARY\n\0\0", Format::Off).contains("binary OFF"));
        for word in ["4OFF", "nOFF", "C4OFF", "CnOFF"] {
            let message = message(format!("{word}\n4\n1 1 1\n"), Format::Off);
            assert!(message.contains("other than three coordinates"), "{word}: {message}");
        }
        assert_eq!(
            message("POFF\n", Format::Off),
            "line 1: expected OFF, COFF, NOFF or the like, found `POFF`"
        );
    }

    #[test]
    fn more_than_the_header_announces_is_an_error() {
        let text = format!("OFF\n4 1 0\n{SQUARE}3 0 1 2\n3 0 2 3\n");
        assert_eq!(
            message(text, Format::Off),
            "line 8: expected the end of the file after 4 points and 1 faces, found `3 0 2 3`"
        );
    }
}
