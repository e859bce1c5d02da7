//! Input that is broken, cut off, mislabelled or made to do harm: one clear message, exit code 1,
//! little memory.

use std::path::Path;
use std::process::Command;

use tempfile::{TempDir, tempdir};

use crate::common::frame::bar;
use crate::common::program::Ran;
use crate::{names, sample};

/// Address space the program gets, KiB: that of the program itself and a little more.
const MEMORY: u32 = 400_000;

/// Seconds the program gets.
const TIME: u32 = 20;

/// Runs `reconstruct` on a file with little memory and time.
fn reconstruct(folder: &Path, file: &std::ffi::OsStr) -> Ran {
    let script = format!("ulimit -v {MEMORY}; ulimit -t {TIME}; exec \"$0\" \"$@\"");
    Command::new("sh")
        .args(["-c", &script, env!("CARGO_BIN_EXE_beamwright"), "reconstruct"])
        .arg(file)
        .args(["-o", "out.step"])
        .current_dir(folder)
        .output()
        .expect("a shell")
        .into()
}

fn folder_with(name: &str, content: impl AsRef<[u8]>) -> TempDir {
    let folder = tempdir().expect("a folder");
    std::fs::write(folder.path().join(name), content).expect("a file");
    folder
}

/// The file is refused with a message that names it and has all `parts`; nothing is written.
fn assert_refused(name: &str, content: impl AsRef<[u8]>, parts: &[&str]) {
    let folder = folder_with(name, content);
    let message = reconstruct(folder.path(), name.as_ref()).failed(1);
    for part in [name].iter().chain(parts) {
        assert!(message.contains(part), "{message}\nhas no `{part}`");
    }
    assert!(message.len() < 400, "a message to read: {message}");
    assert_eq!(names(folder.path()), [name]);
}

/// The file runs through.
fn assert_taken(name: &str, content: impl AsRef<[u8]>) {
    let folder = folder_with(name, content);
    reconstruct(folder.path(), name.as_ref()).succeeded();
}

/// A bar as OBJ: ASCII only.
fn good() -> String {
    bar().mesh(2.0).obj()
}

/// Binary STL with a count and some bytes.
fn stl(count: u32, body: &[u8]) -> Vec<u8> {
    [&[0; 80][..], &count.to_le_bytes(), body].concat()
}

/// A glTF file of one triangle whose buffer lies at a place.
fn gltf(uri: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":36,"uri":"{uri}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "nodes":[{{"mesh":0}}],"scenes":[{{"nodes":[0]}}]}}"#
    )
}

#[test]
fn files_that_are_cut_off_are_told_with_the_place() {
    let good = good();
    let cut = &good[..good.rfind("f ").expect("a face") + 4];
    assert_refused("cut.obj", cut, &["line "]);
    assert_refused("cut.off", "OFF\n8 6 0\n0 0 0\n1 0 0\n", &["line 2"]);
    assert_refused("cut.stl", stl(12, &[0; 120]), &["byte 80", "12 triangles"]);
    assert_refused("cut.glb", b"glTF\x02\0\0\0\xff\0\0\0", &["byte"]);
    assert_refused("cut.gltf", "{\"asset\":{\"version\":\"2.0\"},", &["line 1"]);
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                  property float z\nelement face 1\nproperty list uchar int vertex_indices\n";
    assert_refused("cut.ply", header, &["end_header"]);
    assert_refused("cut.ply", format!("{header}end_header\n0 0 0\n1 0 0\n"), &["line 3"]);
}

#[test]
fn counts_beyond_the_file_take_no_memory() {
    assert_refused("many.off", "OFF\n4000000000 4000000000 0\n0 0 0\n", &["4000000000 points"]);
    assert_refused("many.stl", stl(4_000_000_000, &[0; 100]), &["4000000000 triangles"]);
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n\
               property float y\nproperty float z\nend_header\n";
    assert_refused("many.ply", ply, &["4000000000"]);
    let accessor = gltf("data:application/octet-stream;base64,AAAA")
        .replace("\"count\":3", "\"count\":4000000000");
    assert_refused("many.gltf", accessor, &[]);
}

#[test]
fn numbers_that_are_not_finite_are_told_with_their_place() {
    assert_refused("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", &["line 1", "nan"]);
    assert_refused("inf.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 -inf 0\n3 0 1 2\n", &["line 5", "inf"]);
    let mut corners = [0_f32; 12];
    corners[7] = f32::NAN;
    let body: Vec<u8> = corners.iter().flat_map(|c| c.to_le_bytes()).chain([0, 0]).collect();
    assert_refused("nan.stl", stl(1, &body), &["byte ", "triangle 1"]);
    assert_refused("huge.obj", "v 1e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", &["line 1"]);
}

#[test]
fn corners_out_of_range_are_told_with_their_place() {
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    assert_refused("range.obj", format!("{points}f 1 2 9\n"), &["line 4", "9", "1 to 3"]);
    assert_refused("range.obj", format!("{points}f 1 2 0\n"), &["line 4"]);
    assert_refused("range.obj", format!("{points}f 1 2 -4\n"), &["line 4"]);
    let off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n";
    assert_refused("range.off", off, &["line 6", "3", "0 to 2"]);
}

#[test]
fn empty_files_are_told() {
    for name in ["empty.off", "empty.obj", "empty.ply", "empty.stl", "empty.gltf", "empty.glb"] {
        assert_refused(name, "", &["is empty"]);
    }
    assert_refused("points.obj", "v 0 0 0\nv 1 0 0\n", &["no faces"]);
}

#[test]
fn content_of_another_format_is_named() {
    for name in ["wrong.off", "wrong.ply", "wrong.stl", "wrong.gltf", "wrong.glb"] {
        assert_refused(name, good(), &["looks like OBJ", "rename it to .obj"]);
    }
    assert_refused("wrong.obj", stl(1, &[0; 50]), &["looks like binary STL"]);
    assert_refused("mesh.xyz", good(), &[".xyz", ".off .obj .ply .stl .gltf .glb"]);
    assert_refused("mesh", good(), &["no extension"]);
}

#[test]
fn what_is_no_file_is_told() {
    let folder = tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("dir.obj")).expect("a folder");
    let message = reconstruct(folder.path(), "dir.obj".as_ref()).failed(1);
    assert_eq!(message, "cannot read dir.obj: it is a directory, not a file");
    let message = reconstruct(folder.path(), "/dev/zero".as_ref()).failed(1);
    assert!(message.contains("/dev/zero"), "{message}");
}

#[test]
fn decimal_commas_are_explained() {
    let content = "v 0,5 0,0 1,0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    assert_refused("comma.obj", content, &["line 1", "0,5", "decimal point"]);
}

#[test]
fn the_ways_of_other_systems_are_taken() {
    let good = good();
    assert_taken("crlf.obj", good.replace('\n', "\r\n"));
    assert_taken("bom.obj", format!("\u{feff}{good}"));
    assert_taken("material.obj", format!("mtllib missing.mtl\n{good}"));
    assert_taken("latin.obj", [b"# caf\xe9\n", good.as_bytes()].concat());
}

#[cfg(unix)]
#[test]
fn names_that_are_no_utf_8_are_taken_and_told() {
    use std::os::unix::ffi::OsStrExt;
    let folder = tempdir().expect("a folder");
    let name = std::ffi::OsStr::from_bytes(b"caf\xe9.obj");
    std::fs::write(folder.path().join(name), good()).expect("a file");
    reconstruct(folder.path(), name).succeeded();
    let message = reconstruct(folder.path(), std::ffi::OsStr::from_bytes(b"th\xe9.obj")).failed(1);
    assert!(message.contains("th\u{fffd}.obj"), "{message}");
}

#[test]
fn gltf_reads_nothing_outside_of_its_folder() {
    for uri in ["../secret.bin", "/etc/passwd", "http://example.com/a.bin", "file:///etc/passwd"] {
        assert_refused("outside.gltf", gltf(uri), &["outside"]);
    }
    assert_refused("missing.gltf", gltf("nothing.bin"), &["nothing.bin"]);
}

#[cfg(unix)]
#[test]
fn gltf_follows_no_link_out_of_its_folder() {
    let elsewhere = folder_with("secret.bin", [0; 36]);
    let folder = folder_with("link.gltf", gltf("inside.bin"));
    let inside = folder.path().join("inside.bin");
    std::os::unix::fs::symlink(elsewhere.path().join("secret.bin"), inside).expect("a link");
    let message = reconstruct(folder.path(), "link.gltf".as_ref()).failed(1);
    assert!(message.contains("outside"), "{message}");
}

#[test]
fn gltf_that_turns_in_circles_or_is_compressed_is_told() {
    let cycle = r#"{"asset":{"version":"2.0"},"nodes":[{"children":[1]},{"children":[0]}],
                    "scenes":[{"nodes":[0]}],"scene":0}"#;
    assert_refused("cycle.gltf", cycle, &["nodes["]);
    let draco = r#"{"asset":{"version":"2.0"},"extensionsUsed":["KHR_draco_mesh_compression"],
                    "extensionsRequired":["KHR_draco_mesh_compression"],"scenes":[{"nodes":[]}]}"#;
    assert_refused("draco.gltf", draco, &["KHR_draco_mesh_compression", "without compression"]);
}

#[test]
fn surfaces_that_are_no_body_are_told_with_what_is_missing() {
    assert_refused("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", &["no volume"]);
    let moebius = crate::common::families::moebius_strip().obj();
    assert_refused("moebius.obj", moebius, &[]);
    let point = "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n";
    assert_refused("point.obj", point, &[]);
}

/// The bar with one corner of its shaft pulled out to a place: a needle, and a hole beside it.
fn with_spike(x: f64) -> String {
    let mut mesh = bar().mesh(2.0);
    let shaft = mesh.positions.iter().position(|p| (p[0] - 25.0).abs() < 2.0 && p[2] > 3.0);
    mesh.positions[shaft.expect("a corner on the shaft")] = [25.0, 0.3 * x, x];
    mesh.obj()
}

#[test]
fn a_corner_far_out_in_space_takes_no_memory() {
    for reach in [300.0, 1e21, 1e150] {
        let folder = folder_with("spike.obj", with_spike(reach));
        let ran = reconstruct(folder.path(), "spike.obj".as_ref());
        assert!(matches!(ran.code, Some(0 | 1)), "{reach}: {ran:?}");
        if ran.code == Some(1) {
            ran.failed(1);
        }
    }
}

#[test]
fn a_mesh_whose_points_are_mixed_up_still_gives_beams_and_says_what_is_wrong() {
    let text = std::fs::read_to_string(sample("y_form")).expect("a sample");
    let mut lines: Vec<&str> = text.lines().collect();
    let last = lines.iter().rposition(|line| line.starts_with("v ")).expect("points");
    // One point stands last: all after it are taken for their neighbours, and no section is found.
    lines[340..=last].rotate_left(1);
    let folder = folder_with("mixed.obj", lines.join("\n"));
    let ran = reconstruct(folder.path(), "mixed.obj".as_ref());
    assert!(ran.stdout.contains("BREACH"), "{ran:?}");
    ran.succeeded();
    let list = std::fs::read_to_string(folder.path().join("out.csv")).expect("a cut list");
    assert!(list.contains("P01,B001,1,Round "), "{list}");
}
