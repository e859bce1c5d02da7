//! The formats that can be read, told by extension and by content.

use std::ffi::OsStr;
use std::path::Path;

use crate::error::ReadError;
use crate::input::Input;
use crate::line::Fields;
use crate::{off, stl};

/// A file format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Object File Format of Geomview, with its variants COFF, NOFF, NCOFF, STOFF and so on.
    Off,
    /// Wavefront OBJ.
    Obj,
    /// Stanford polygon file, ASCII or binary.
    Ply,
    /// Stereolithography, ASCII or binary.
    Stl,
    /// glTF 2.0 as JSON.
    Gltf,
    /// glTF 2.0 as one binary file.
    Glb,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 6] = [Self::Off, Self::Obj, Self::Ply, Self::Stl, Self::Gltf, Self::Glb];

    /// The format of a file by its extension, in capitals or not.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension().and_then(OsStr::to_str)?;
        Self::ALL.into_iter().find(|format| format.extension().eq_ignore_ascii_case(extension))
    }

    /// The extension without the point.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Gltf => "gltf",
            Self::Glb => "glb",
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Off => "OFF",
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Stl => "STL",
            Self::Gltf => "glTF",
            Self::Glb => "GLB",
        }
    }
}

/// What a content looks like.
struct Look {
    name: &'static str,
    /// `None`: a format that cannot be read.
    format: Option<Format>,
}

/// Bytes that are looked at.
const HEAD: usize = 4096;

/// Makes sure that the content is not clearly of another format than `expected`.
///
/// Content that looks like nothing known passes: the reader of the format then says what is wrong.
pub(crate) fn check_content(expected: Format, input: &mut Input<'_>) -> Result<(), ReadError> {
    let (path, size) = (input.path(), input.size());
    let head = input.peek(HEAD)?;
    if expected == Format::Stl && stl::has_size_of_binary(head, size) {
        return Ok(());
    }
    let Some(look) = look(head, size) else { return Ok(()) };
    if look.format == Some(expected) {
        return Ok(());
    }
    let advice = match look.format {
        Some(format) => format!("rename it to .{}", format.extension()),
        None if look.name == "UTF-16 text" => "save it as UTF-8 or plain ASCII".to_owned(),
        None => "export the mesh as OFF, OBJ, PLY, STL or glTF".to_owned(),
    };
    Err(ReadError::OtherFormat {
        path: path.to_owned(),
        expected: expected.name(),
        looks_like: look.name,
        advice,
    })
}

/// Beginnings of files that cannot be read, but are met under a wrong name.
const FOREIGN: [(&[u8], &str); 13] = [
    (b"\xff\xfe", "UTF-16 text"),
    (b"\xfe\xff", "UTF-16 text"),
    (b"PK\x03\x04", "a ZIP archive (3MF, FCStd or compressed)"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"7z\xbc\xaf", "a 7z archive"),
    (b"%PDF", "PDF"),
    (b"ISO-10303-21", "STEP"),
    (b"<?xml", "XML (AMF, COLLADA or VTK)"),
    (b"<!doctype", "a web page (a failed download?)"),
    (b"<html", "a web page (a failed download?)"),
    (b"# vtk DataFile", "legacy VTK"),
    (b"$MeshFormat", "Gmsh"),
    (b"version https://git-lfs", "a Git LFS pointer (the file itself was not fetched)"),
];

fn look(head: &[u8], size: u64) -> Option<Look> {
    let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    let known = |format: Format| Some(Look { name: format.name(), format: Some(format) });
    if head.starts_with(b"glTF") {
        return known(Format::Glb);
    }
    let text = head.trim_ascii_start();
    let starts_with = |start: &[u8]| {
        text.get(..start.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(start))
    };
    if let Some((_, name)) = FOREIGN.iter().find(|(start, _)| starts_with(start)) {
        return Some(Look { name, format: None });
    }
    if stl::has_size_of_binary(head, size) {
        return Some(Look { name: "binary STL", format: Some(Format::Stl) });
    }
    if head.contains(&0) {
        return if starts_with(b"ply\n") || starts_with(b"ply\r") {
            known(Format::Ply)
        } else {
            None
        };
    }
    look_of_text(text)
}

fn look_of_text(text: &[u8]) -> Option<Look> {
    let known = |format: Format| Some(Look { name: format.name(), format: Some(format) });
    if text.starts_with(b"{") {
        let is_gltf = memchr::memmem::find(text, b"\"asset\"").is_some();
        return if is_gltf { known(Format::Gltf) } else { None };
    }
    let mut lines = text
        .split(|&byte| byte == b'\n' || byte == b'\r')
        .map(<[u8]>::trim_ascii)
        .filter(|line| !line.is_empty() && !line.starts_with(b"#"));
    let line = lines.next()?;
    let word = Fields::of(line).word()?;
    match word {
        b"ply" => known(Format::Ply),
        _ if word.eq_ignore_ascii_case(b"solid") && stl::looks_like_ascii(text) => {
            Some(Look { name: "ASCII STL", format: Some(Format::Stl) })
        }
        _ if off::is_first_word(word) => known(Format::Off),
        _ if std::iter::once(line).chain(lines).find_map(tells_obj) == Some(true) => {
            known(Format::Obj)
        }
        _ => None,
    }
}

/// Whether a line is one that OBJ files have; `None` if it could be, and the next has to tell.
fn tells_obj(line: &[u8]) -> Option<bool> {
    let mut fields = Fields::of(line);
    match fields.word()? {
        b"v" => Some((0..3).all(|_| fields.number().is_ok())),
        b"mtllib" => Some(true),
        b"o" | b"g" | b"s" | b"usemtl" | b"vn" | b"vt" => None,
        _ => Some(false),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn look_name(head: &[u8]) -> Option<&'static str> {
        look(head, head.len() as u64).map(|look| look.name)
    }

    #[test]
    fn an_extension_counts_in_capitals_too() {
        assert_eq!(Format::of(Path::new("a/Part.STL")), Some(Format::Stl));
        assert_eq!(Format::of(Path::new("part.Gltf")), Some(Format::Gltf));
        assert_eq!(Format::of(Path::new("part.step")), None);
        assert_eq!(Format::of(Path::new(".off")), None);
    }

    #[test]
    fn formats_are_known_by_their_beginning() {
        assert_eq!(look_name(b"\n# made by hand\nNCOFF 3 1 0\n"), Some("OFF"));
        assert_eq!(look_name(b"# Blender\nmtllib a.mtl\n"), Some("OBJ"));
        assert_eq!(look_name(b"v 0 0 0\n"), Some("OBJ"));
        assert_eq!(look_name(b"o part\ng a b\nv 0 0 0\n"), Some("OBJ"));
        assert_eq!(look_name(b"ply\r\nformat ascii 1.0\r\n"), Some("PLY"));
        assert_eq!(look_name(b"solid a\n facet normal 0 0 1\n"), Some("ASCII STL"));
        assert_eq!(look_name(b"{ \"asset\": {} }"), Some("glTF"));
        assert_eq!(look_name(b"glTF\x02\0\0\0"), Some("GLB"));
        assert_eq!(look_name(b"ISO-10303-21;\n"), Some("STEP"));
        assert_eq!(look_name(b"<!DOCTYPE html>"), Some("a web page (a failed download?)"));
    }

    #[test]
    fn what_could_be_anything_is_left_to_the_reader() {
        for head in [&b"# only a comment\n"[..], b"1 2 3\n", b"\0\0\0", b"o part\n", b"{}"] {
            assert_eq!(look_name(head), None);
        }
    }
}
