//! One labelled mesh gives one skeleton, whatever file it comes from.

use std::path::Path;

use beamwright_formats::Format;
use tempfile::{TempDir, tempdir};

use crate::common::TestMesh;
use crate::common::curves::Curves;
use crate::common::program::run;
use crate::objects::{labelled, model, non_design_parts, size};
use crate::writers::{self, VARIANTS};

/// Largest distance between points of the same skeleton, in sizes of the object.
const SAME: f64 = 1e-4;

/// The skeleton of a file in a folder.
fn skeleton_of(folder: &Path, file: &str, more: &[&str]) -> Curves {
    let mut words = vec!["skeleton", file, "-o", "out.json", "--strict"];
    words.extend(more);
    run(folder, &words).succeeded();
    Curves::read(&folder.join("out.json"))
}

/// A folder with one file in it.
fn folder_with(name: &str, content: impl AsRef<[u8]>) -> TempDir {
    let folder = tempdir().expect("a folder");
    std::fs::write(folder.path().join(name), content).expect("a file");
    folder
}

fn assert_same(curves: &Curves, reference: &Curves, mesh: &TestMesh, what: &str) {
    let deviation = curves.deviation_from(reference).unwrap_or_else(|e| panic!("{what}: {e}"));
    assert!(deviation <= SAME * size(mesh), "{what}: {deviation} mm");
}

fn reference(mesh: &TestMesh) -> Curves {
    skeleton_of(folder_with("part.obj", writers::obj(&model(mesh))).path(), "part.obj", &[])
}

#[test]
fn every_format_with_labels_gives_the_same_skeleton() {
    for (name, mesh) in labelled() {
        let reference = reference(&mesh);
        for (format, variant, write) in VARIANTS {
            // glTF has Y up: the reader turns it back.
            let is_gltf = matches!(format, Format::Gltf | Format::Glb);
            let turned = mesh.mapped(|[x, y, z]| [x, z, -y]);
            let content = write(&model(if is_gltf { &turned } else { &mesh }));
            let file = format!("part.{}", format.extension());
            let folder = folder_with(&file, content);
            let unit: &[&str] = if is_gltf { &["--unit", "mm"] } else { &[] };
            let curves = skeleton_of(folder.path(), &file, unit);
            assert_same(&curves, &reference, &mesh, &format!("{name} as {variant}"));
        }
    }
}

#[test]
fn a_second_mesh_says_the_same_as_labels() {
    for (name, mesh) in labelled() {
        let reference = reference(&mesh);
        let parts = model(&non_design_parts(&mesh));
        let plain =
            model(&TestMesh { non_design: vec![false; mesh.triangles.len()], ..mesh.clone() });
        for (file, content, part, second) in [
            ("plain.off", plain_off(&plain), "kept.stl", writers::stl_binary(&parts)),
            ("plain.stl", writers::stl_binary(&plain), "kept.off", plain_off(&parts)),
        ] {
            let folder = folder_with(file, content);
            std::fs::write(folder.path().join(part), second).expect("a file");
            let curves = skeleton_of(folder.path(), file, &["--non-design", part]);
            assert_same(&curves, &reference, &mesh, &format!("{name} as {file} with {part}"));
        }
    }
}

/// OFF without colours.
fn plain_off(model: &writers::Model) -> Vec<u8> {
    let text = String::from_utf8(writers::off(model)).expect("text");
    let plain = text.replacen("COFF", "OFF", 1).replace(" 0 10 255\n", "\n");
    // The first channel of the colour goes as well.
    let is_face = |line: &str| line.starts_with("3 ") && line.split(' ').count() == 5;
    let lines = plain.lines().map(|l| if is_face(l) { l.rsplit_once(' ').unwrap().0 } else { l });
    lines.flat_map(|line| [line, "\n"]).collect::<String>().into_bytes()
}

#[test]
fn units_of_the_file_are_heard() {
    let (_, mesh) = labelled().swap_remove(2);
    let reference = reference(&mesh);
    for (unit, scale) in [("m", 1e-3), ("cm", 0.1), ("in", 1.0 / 25.4)] {
        let scaled = mesh.mapped(|p| p.map(|x| x * scale));
        let folder = folder_with("part.obj", scaled.obj());
        let curves = skeleton_of(folder.path(), "part.obj", &["--unit", unit]);
        assert_same(&curves, &reference, &mesh, unit);
    }
}

#[test]
fn capitals_in_the_extension_are_read() {
    let (_, mesh) = labelled().swap_remove(2);
    let folder = folder_with("PART.OBJ", mesh.obj());
    skeleton_of(folder.path(), "PART.OBJ", &[]);
}
