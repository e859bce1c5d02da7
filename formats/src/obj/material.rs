//! Colours of materials, from the libraries that an OBJ file names.
//!
//! MeshLab writes the colours of faces as materials. A library that is missing, lies outside of the
//! folder or is malformed is no error: the names of the materials are in the OBJ file itself.

use std::collections::HashMap;
use std::path::Path;

use indexmap::IndexSet;

use crate::colour::to_byte;
use crate::error::ReadError;
use crate::input::Input;
use crate::nearby;

/// Largest material library that is read, bytes.
const LARGEST_LIBRARY: u64 = 16 << 20;
/// Most files of a line.
const MOST_FILES: usize = 16;
/// Most materials of a library that are read: `tobj` takes over half a kilobyte for each.
const MOST_MATERIALS: usize = 10_000;

/// Colour of a material by its index among the materials that faces use.
type MaterialColours = HashMap<usize, [u8; 3]>;

/// Reads the diffuse colours of the materials that faces use; the first library with a material wins.
pub(super) fn read_colours(
    folder: &Path,
    libraries: &IndexSet<String>,
    used: &IndexSet<Vec<u8>>,
) -> MaterialColours {
    let mut colours = HashMap::new();
    if used.iter().all(Vec::is_empty) {
        return colours;
    }
    let mut seen = IndexSet::new();
    for library in libraries {
        // A line may name one file with blanks in its name, or several files.
        for name in
            std::iter::once(library.as_str()).chain(library.split_whitespace().take(MOST_FILES))
        {
            if let Ok(path) = nearby::find(folder, name)
                && seen.insert(path.clone())
                && let Ok(text) = used_part(&path, used)
            {
                add_colours(&text, used, &mut colours);
            }
        }
    }
    colours
}

/// The lines of a library that begin a material in use or give its diffuse colour.
///
/// `tobj` panics at a colour of fewer than three numbers and stops at the first byte that is not
/// UTF-8, so it gets these lines only, and only if they are sound.
fn used_part(path: &Path, used: &IndexSet<Vec<u8>>) -> Result<Vec<u8>, ReadError> {
    let mut input = Input::open(path, LARGEST_LIBRARY)?;
    input.skip_byte_order_mark()?;
    let mut part = Vec::new();
    let mut materials = 0;
    let mut is_used = false;
    while let Some(line) = input.next_line()? {
        let mut fields = line.fields();
        match fields.word() {
            Some(b"newmtl") => {
                let index = used.get_index_of(fields.rest());
                is_used = index.is_some() && !fields.is_empty() && materials < MOST_MATERIALS;
                if let Some(index) = index.filter(|_| is_used) {
                    materials += 1;
                    // The index stands for the name, which may hold anything.
                    part.extend_from_slice(format!("newmtl {index}\n").as_bytes());
                }
            }
            Some(b"Kd") if is_used => {
                if let (Ok(r), Ok(g), Ok(b)) = (fields.number(), fields.number(), fields.number()) {
                    part.extend_from_slice(format!("Kd {r} {g} {b}\n").as_bytes());
                }
            }
            _ => {}
        }
    }
    Ok(part)
}

fn add_colours(library: &[u8], used: &IndexSet<Vec<u8>>, colours: &mut MaterialColours) {
    let Ok((materials, _)) = tobj::load_mtl_buf(&mut &library[..]) else { return };
    for material in materials {
        if let Some(diffuse) = material.diffuse
            && let Ok(index) = material.name.parse::<usize>()
            && index < used.len()
        {
            let colour = diffuse.map(|channel| to_byte((channel * 255.0) as f32));
            colours.entry(index).or_insert(colour);
        }
    }
}

/// The colour of each face, by its run of faces of one material; empty if no face has a colour.
pub(super) fn spread(
    colours: &MaterialColours,
    runs: &[(usize, usize)],
    faces: usize,
) -> Vec<Option<[u8; 3]>> {
    if !runs.iter().any(|(_, material)| colours.contains_key(material)) {
        return Vec::new();
    }
    let mut spread = vec![None; faces];
    let ends = runs.iter().skip(1).map(|run| run.0).chain([faces]);
    for (&(start, material), end) in runs.iter().zip(ends) {
        spread[start..end].fill(colours.get(&material).copied());
    }
    spread
}

#[cfg(test)]
mod tests {
    use crate::{RawMesh, ReadOptions, read};

    const PART: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\nf 1 3 2\n\
                        usemtl plain\nf 1 2 3\nusemtl red\nf 1 2 3\n";

    fn read_with_library(statement: &str, library: &[u8]) -> RawMesh {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("my part.mtl"), library).unwrap();
        let path = folder.path().join("part.obj");
        std::fs::write(&path, format!("{statement}\n{PART}")).unwrap();
        let mesh = read(&path, &ReadOptions::default()).unwrap();
        mesh.check();
        mesh
    }

    #[test]
    fn faces_get_the_diffuse_colour_of_their_material() {
        let library =
            b"# MeshLab\nnewmtl red\nKa 0 0 0\nKd 1.0 0.0 0.2\nmap_Kd a.png\n\nnewmtl plain\n";
        let red = Some([255, 0, 51]);
        for statement in
            ["mtllib my part.mtl", "mtllib .\\my part.mtl", "mtllib none.mtl\nmtllib my part.mtl"]
        {
            let mesh = read_with_library(statement, library);
            assert_eq!(mesh.carriers.face_colour, [None, red, red, None, red], "{statement}");
            assert_eq!(mesh.carriers.names, ["red", "plain"]);
        }
    }

    #[test]
    fn a_library_that_is_malformed_is_no_error() {
        for library in [
            &b"newmtl red\nKd 1\n"[..],
            b"newmtl red\nKd 1 nan 0\n",
            b"Kd 1 0 0\n",
            b"newmtl\nKd 1 0 0\nnewmtl \xff\nKd 1 0 0\nnewmtl 1\nKd 1 0 0\n",
            b"newmtl red\nKd spectral a.rfl\n",
            b"\0\0\0",
            b"",
        ] {
            let mesh = read_with_library("mtllib my part.mtl", library);
            assert!(mesh.carriers.face_colour.is_empty(), "{library:?}");
            assert_eq!(mesh.carriers.names, ["red", "plain"]);
        }
    }

    #[test]
    fn a_library_outside_of_the_folder_is_not_read() {
        let outside = tempfile::tempdir().unwrap();
        let library = outside.path().join("out.mtl");
        std::fs::write(&library, "newmtl red\nKd 1 0 0\n").unwrap();
        let statement = format!("mtllib {}", library.display());
        assert!(read_with_library(&statement, b"").carriers.face_colour.is_empty());
    }
}
