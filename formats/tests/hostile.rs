//! Files that are broken, foreign or made to do harm: one clear message each, and nothing else.
//!
//! One test per kind of file. What a fault within a format says is tested beside its reader.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use beamwright_formats::{Format, RawMesh, ReadError, ReadOptions, read, read_bytes};
use common::{VARIANTS, cube};
use tempfile::TempDir;

/// A folder with one file in it.
fn file(name: &str, content: impl AsRef<[u8]>) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, content).unwrap();
    (folder, path)
}

fn error_of(path: &Path) -> ReadError {
    match read(path, &ReadOptions::default()) {
        Ok(mesh) => panic!("{}: no error, but {mesh:?}", path.display()),
        Err(error) => error,
    }
}

/// The message for a file, without its folder.
fn message_of(path: &Path) -> String {
    let folder = path.parent().unwrap().to_str().unwrap();
    error_of(path).to_string().replace(&format!("{folder}/"), "")
}

fn message(name: &str, content: impl AsRef<[u8]>) -> String {
    let (_folder, path) = file(name, content);
    message_of(&path)
}

fn mesh(name: &str, content: impl AsRef<[u8]>) -> RawMesh {
    let (_folder, path) = file(name, content);
    let mesh = read(&path, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}"));
    mesh.check();
    mesh
}

const TRIANGLE_OFF: &str = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const TRIANGLE_OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[test]
fn a_missing_file_is_told_as_the_system_tells_it() {
    let error = read(Path::new("no/such/cross.off"), &ReadOptions::default()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "cannot read no/such/cross.off: No such file or directory (os error 2)"
    );
}

#[test]
fn a_missing_file_of_unknown_extension_is_told_as_missing() {
    let error = read(Path::new("no/such/cross.stp"), &ReadOptions::default()).unwrap_err();
    assert!(matches!(error, ReadError::Io { .. }), "{error}");
}

#[test]
fn a_directory_is_told_as_one() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["parts.obj", "parts"] {
        let path = folder.path().join(name);
        fs::create_dir(&path).unwrap();
        assert_eq!(message_of(&path), format!("cannot read {name}: it is a directory, not a file"));
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_is_not_waited_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipe.off");
    let made = std::process::Command::new("mkfifo").arg(&path).status();
    if made.is_ok_and(|status| status.success()) {
        assert_eq!(message_of(&path), "cannot read pipe.off: it is a device or pipe, not a file");
    }
}

#[cfg(unix)]
#[test]
fn a_file_that_may_not_be_read_is_told() {
    use std::os::unix::fs::PermissionsExt;
    let (_folder, path) = file("secret.off", TRIANGLE_OFF);
    fs::set_permissions(&path, fs::Permissions::from_mode(0o000)).unwrap();
    // The superuser may read it all the same.
    if fs::File::open(&path).is_err() {
        assert!(message_of(&path).starts_with("cannot read secret.off: Permission denied"));
    }
}

#[test]
fn an_unknown_extension_is_answered_with_the_known_ones() {
    assert_eq!(
        message("part.step", "ISO-10303-21;"),
        "cannot read part.step: unknown extension .step; known are .off .obj .ply .stl .gltf .glb"
    );
    assert!(message("part", TRIANGLE_OFF).contains("the name has no extension; known are .off"));
}

#[test]
fn an_extension_may_be_in_capitals() {
    assert_eq!(mesh("PART.OFF", TRIANGLE_OFF), mesh("part.Off", TRIANGLE_OFF));
}

#[test]
fn an_empty_file_is_told() {
    for format in Format::ALL {
        let name = format!("part.{}", format.extension());
        let expected = format!("cannot read {name}: the file is empty; export it again");
        assert_eq!(message(&name, ""), expected);
    }
}

#[test]
fn a_file_of_blanks_only_is_told() {
    for format in Format::ALL {
        let error = message(&format!("part.{}", format.extension()), " \n\t\r\n \n");
        assert!(error.starts_with("cannot read part."), "{error}");
    }
}

#[test]
fn content_of_another_format_is_named() {
    for (format, name, write) in VARIANTS {
        for other in Format::ALL.into_iter().filter(|&other| other != format) {
            let error = message(&format!("part.{}", other.extension()), write(&cube()));
            let advice = format!("rename it to .{}", format.extension());
            assert!(error.contains("its content looks like"), "{name} as {other:?}: {error}");
            assert!(error.ends_with(&advice), "{name} as {other:?}: {error}");
        }
    }
}

#[test]
fn content_that_no_reader_takes_is_named() {
    for (content, name) in [
        (&b"PK\x03\x04rest"[..], "a ZIP archive"),
        (b"\x1f\x8b\x08\0", "a gzip archive"),
        (b"<!DOCTYPE html><html>404</html>", "a web page"),
        (b"<?xml version=\"1.0\"?>", "XML"),
        (b"# vtk DataFile Version 3.0\n", "legacy VTK"),
        (b"\xff\xfeO\0F\0F\0", "UTF-16 text"),
        (b"version https://git-lfs.github.com/spec/v1\n", "a Git LFS pointer"),
    ] {
        for format in Format::ALL {
            let error = message(&format!("part.{}", format.extension()), content);
            assert!(error.contains(&format!("its content looks like {name}")), "{error}");
        }
    }
}

#[test]
fn a_file_beyond_the_limit_is_refused() {
    let (_folder, path) = file("part.off", TRIANGLE_OFF);
    let options = ReadOptions { max_bytes: 10, ..ReadOptions::default() };
    let error = read(&path, &options).unwrap_err();
    assert!(
        error
            .to_string()
            .ends_with("36 bytes are more than the limit of 10; reduce or split the mesh"),
        "{error}"
    );
}

#[test]
fn a_surface_is_needed() {
    for (name, content) in [
        ("a.off", "OFF\n1 0 0\n0 0 0\n"),
        ("a.obj", "v 0 0 0\n"),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\nend_header\n0 0 0\n",
        ),
    ] {
        let expected = "it has 1 point but no faces; export the surface as a mesh of triangles";
        assert_eq!(message(name, content), format!("cannot read {name}: {expected}"));
    }
}

#[test]
fn line_ends_of_every_system_are_read() {
    for (name, text) in [("a.off", TRIANGLE_OFF), ("a.obj", TRIANGLE_OBJ)] {
        let plain = mesh(name, text);
        for (line_end, kind) in [("\r\n", "CR LF"), ("\r", "CR"), ("\n\r", "LF CR")] {
            assert_eq!(mesh(name, text.replace('\n', line_end)), plain, "{kind}");
        }
        assert_eq!(mesh(name, format!("\u{feff}{text}")), plain, "byte order mark");
        assert_eq!(mesh(name, text.trim_end()), plain, "no last line end");
    }
}

#[test]
fn a_fault_behind_cr_lines_has_the_right_line() {
    assert!(message("a.obj", "v 0 0 0\rv 1 0 0\rv 0 x 0\r").contains("line 3: expected v x y z"));
}

#[test]
fn decimal_commas_are_explained() {
    for (name, text) in [
        ("a.off", TRIANGLE_OFF.replace("1 0 0", "1,5 0 0")),
        ("a.obj", TRIANGLE_OBJ.replace("1 0 0", "1,5 0 0")),
        ("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 1,5 0 0\n".to_owned()),
        ("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1,5 0 0\n".to_owned()),
    ] {
        let error = message(name, text);
        assert!(error.contains("`1,5` has a comma"), "{error}");
        assert!(error.contains("decimal point"), "{error}");
    }
}

#[test]
fn numbers_that_are_none_are_refused() {
    for number in
        ["nan", "NaN", "-nan(ind)", "inf", "-Infinity", "1e400", "1e308e", "0x1p3", "1.2.3"]
    {
        for (name, text) in [("a.off", TRIANGLE_OFF), ("a.obj", TRIANGLE_OBJ)] {
            let error = message(name, text.replace("1 0 0", &format!("{number} 0 0")));
            assert!(error.contains(&format!("`{number}`")), "{error}");
            assert!(error.contains("line "), "{error}");
        }
    }
}

#[test]
fn a_number_that_overflows_in_millimetres_is_refused() {
    let options = ReadOptions { unit: Some("m".parse().unwrap()), ..ReadOptions::default() };
    let text = TRIANGLE_OBJ.replace("v 1 0 0", "v 1e306 0 0");
    let error = read_bytes(text.as_bytes(), Format::Obj, &options).unwrap_err().to_string();
    assert!(
        error.contains("line 2: `v 1e306 0 0` in millimetres is not a finite number"),
        "{error}"
    );
}

#[test]
fn huge_coordinates_do_no_harm() {
    let mesh = mesh(
        "a.off",
        "OFF\n5 1 0\n1e308 0 0\n-1e308 0 0\n0 1e308 0\n0 -1e308 1e-320\n1 1 1\n5 0 1 2 3 4\n",
    );
    assert_eq!(mesh.triangulate().corners.len(), 3);
}

#[test]
fn counts_beyond_the_file_take_no_memory() {
    let header = |element: &str| {
        format!(
            "ply\nformat binary_little_endian 1.0\nelement {element}\nproperty float x\nproperty float y\nproperty float z\nend_header\n1234"
        )
    };
    let mut stl = vec![0; 134];
    stl[80..84].copy_from_slice(&4_000_000_000_u32.to_le_bytes());
    for (name, content) in [
        ("a.off", b"OFF\n4000000000 1 0\n0 0 0\n".to_vec()),
        ("b.off", b"OFF\n1 4000000000 0\n0 0 0\n".to_vec()),
        ("c.off", b"OFF\n18446744073709551615 18446744073709551615 0\n".to_vec()),
        ("a.ply", header("vertex 4000000000").into_bytes()),
        ("b.ply", header("vertex 18446744073709551615").into_bytes()),
        ("c.ply", header("other 4000000000\nproperty char x\nelement vertex 1").into_bytes()),
        ("a.stl", stl),
    ] {
        let start = Instant::now();
        let error = error_of(&file(name, content).1);
        let is_expected = matches!(
            error,
            ReadError::WrongCount { .. } | ReadError::TooMany { .. } | ReadError::Malformed { .. }
        );
        assert!(is_expected || matches!(error, ReadError::Io { .. }), "{name}: {error}");
        assert!(start.elapsed() < Duration::from_secs(1));
    }
}

#[test]
fn a_header_count_of_elements_without_data_takes_no_time() {
    for encoding in ["ascii", "binary_little_endian"] {
        let text = format!(
            "ply\nformat {encoding} 1.0\nelement none 18446744073709551615\nelement vertex 0\n\
             property float x\nproperty float y\nproperty float z\nend_header\n"
        );
        assert!(message("a.ply", text).contains("0 points but no faces"));
    }
}

#[test]
fn a_list_length_beyond_the_file_takes_no_memory() {
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty char x\nproperty char y\n\
                  property char z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n";
    let bytes = [header.as_bytes(), &[0; 3], &[0xff; 4], &[0; 64]].concat();
    let error = message("a.ply", bytes);
    assert!(error.contains("the file ends before the end of face 1 of 1"), "{error}");
    let signed = header.replace("uint", "int");
    let bytes = [signed.as_bytes(), &[0; 3], &[0xff; 4], &[0; 64]].concat();
    let error = message("a.ply", bytes);
    assert!(error.contains("list length cannot be negative"), "{error}");
}

#[test]
fn corners_out_of_range_are_told_with_their_place() {
    for (name, text, expected) in [
        (
            "a.off",
            TRIANGLE_OFF.replace("3 0 1 2", "3 0 1 3"),
            "line 6: a face names point 3, but points are numbered from 0 to 2",
        ),
        (
            "b.off",
            TRIANGLE_OFF.replace("3 0 1 2", "3 0 1 -1"),
            "line 6: a face names point -1, but",
        ),
        (
            "c.off",
            TRIANGLE_OFF.replace("3 0 1 2", "3 0 1 99999999999999999999"),
            "line 6: a face names point 9999",
        ),
        (
            "a.obj",
            TRIANGLE_OBJ.replace("f 1 2 3", "f 1 2 4"),
            "line 4: a face names point 4, but points are numbered from 1 to 3",
        ),
        (
            "b.obj",
            TRIANGLE_OBJ.replace("f 1 2 3", "f 0 1 2"),
            "line 4: a face names point 0, but points are numbered from 1",
        ),
        (
            "c.obj",
            TRIANGLE_OBJ.replace("f 1 2 3", "f -1 -2 -4"),
            "line 4: a face names point -4, but only 3 points come before it",
        ),
        (
            "d.obj",
            TRIANGLE_OBJ.replace("f 1 2 3", "f -9223372036854775808 1 2"),
            "line 4: a face names point -922337203685",
        ),
    ] {
        let error = message(name, text);
        assert_eq!(error.find(expected), Some(format!("cannot read {name}: ").len()), "{error}");
    }
}

#[test]
fn latin_1_bytes_do_no_harm() {
    let obj = [b"# f\xfcr M\xfcller\ng Tr\xe4ger\n", TRIANGLE_OBJ.as_bytes()].concat();
    assert_eq!(mesh("a.obj", obj).carriers.names, ["Tr\u{fffd}ger"]);
    let off = [b"OFF # M\xfcller\n", &TRIANGLE_OFF.as_bytes()[4..]].concat();
    assert_eq!(mesh("a.off", off).faces.len(), 1);
    let ply = b"ply\nformat ascii 1.0\ncomment M\xfcller\nelement vertex 3\nproperty int x\nproperty int y\nproperty int z\n\
                element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    assert_eq!(mesh("a.ply", ply).faces.len(), 1);
    let stl = b"solid Tr\xe4ger\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    assert_eq!(mesh("a.stl", stl).carriers.names, ["Tr\u{fffd}ger"]);
    let error = message("b.obj", b"v 0 0 \xe4\n");
    assert!(error.contains("line 1: expected v x y z, found `\u{fffd}`"), "{error}");
}

#[test]
fn a_name_is_carried_and_not_interpreted() {
    let name = "<img src=x onerror=alert(1)> ../../etc/passwd %s {} \u{202e} \\n";
    for (file, text) in [
        ("a.obj", format!("g {name}\n{TRIANGLE_OBJ}")),
        (
            "a.stl",
            format!(
                "solid {name}\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"
            ),
        ),
    ] {
        assert_eq!(mesh(file, text).carriers.names[0], name);
    }
}

#[test]
fn control_characters_do_not_get_into_messages() {
    for content in ["v \x1b[31m 0 0\n", "v \x07\x08 0 0\n"] {
        let error = message("a.obj", content);
        assert!(!error.contains(char::is_control), "{error:?}");
    }
}

#[test]
fn a_line_of_many_megabytes_is_quoted_in_short() {
    let long = "x".repeat(20_000_000);
    for (name, text) in [
        ("a.off", long.clone()),
        ("a.obj", format!("v {long}")),
        ("a.stl", long.clone()),
        ("a.ply", format!("ply\n{long}")),
    ] {
        let error = message(name, text);
        assert!(error.len() < 400, "{}", error.len());
        assert!(error.contains("xxx…`"), "{error}");
    }
    let name = mesh("b.obj", format!("g {long}\n{TRIANGLE_OBJ}")).carriers.names.remove(0);
    assert_eq!(name.len(), long.len());
}

#[test]
fn a_missing_material_library_is_no_fault() {
    let mesh = mesh("a.obj", format!("mtllib none.mtl\nusemtl red\n{TRIANGLE_OBJ}"));
    assert_eq!(mesh.carriers.names, ["red"]);
    assert!(mesh.carriers.face_colour.is_empty());
}

#[test]
fn a_face_of_too_many_corners_is_refused() {
    let corners = " 1".repeat(70_000);
    let error = message("a.obj", format!("v 0 0 0\nf{corners}\n"));
    assert!(
        error.ends_with("more than 60000 corners of one face; reduce or split the mesh"),
        "{error}"
    );
    let error = message("a.off", format!("OFF\n1 1 0\n0 0 0\n4000000000{corners}\n"));
    assert!(error.contains("more than 60000 corners of one face"), "{error}");
}

#[test]
fn many_large_faces_are_refused() {
    let face = format!("f{}\n", " 1 2 3".repeat(10_000));
    let error = message("a.obj", format!("{TRIANGLE_OBJ}{}", face.repeat(5)));
    assert!(
        error.ends_with(
            "its faces have too many corners; cut them into triangles before exporting the mesh"
        ),
        "{error}"
    );
}

#[test]
fn names_without_end_are_refused() {
    let mut text = String::from(TRIANGLE_OBJ);
    for name in 0..250_001 {
        text.push_str(&format!("g {name}\nf 1 2 3\n"));
    }
    let error = message("a.obj", text);
    assert!(error.contains("more than 250000 names of groups, objects and materials"), "{error}");
}

#[test]
fn statements_that_ask_for_much_work_take_no_time() {
    let words: String = (0..300_000).map(|word| format!(" {word}")).collect();
    for (statement, count) in [("mtllib a\n", 300_000), (words.as_str(), 1)] {
        let statement = if count == 1 {
            format!("g{statement}\nmtllib{statement}\n")
        } else {
            statement.repeat(count)
        };
        let start = Instant::now();
        assert_eq!(mesh("a.obj", format!("{statement}usemtl a\n{TRIANGLE_OBJ}")).faces.len(), 1);
        assert!(start.elapsed() < Duration::from_secs(10));
    }
}

#[test]
fn a_glb_file_is_not_a_gltf_file() {
    let bytes = common::glb(&cube());
    assert!(message("a.gltf", &bytes).contains("its content looks like GLB; rename it to .glb"));
    assert!(
        message("a.glb", common::gltf(&cube(), false))
            .contains("looks like glTF; rename it to .gltf")
    );
}

#[test]
fn a_repeated_key_of_json_is_told() {
    let text = r#"{"asset":{"version":"2.0"},"nodes":[],"nodes":[]}"#;
    assert!(message("a.gltf", text).contains("duplicate field `nodes`"));
}

#[test]
fn json_that_grows_in_memory_is_refused() {
    for (start, piece, count) in [
        (r#"{"asset":{"version":"2.0"},"nodes":["#, "{},", 300_000),
        (r#"{"asset":{"version":"2.0"},"materials":["#, "{},", 300_000),
        (r#"{"asset":{"version":"2.0"},"accessors":[{"min":["#, "0,", 5_000_000),
    ] {
        let error = message("a.gltf", format!("{start}{}", piece.repeat(count)));
        assert!(error.contains("in its JSON; reduce or split the mesh"), "{error}");
    }
}
