//! Every way to say which part is non-design.

use std::path::Path;

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use crate::common::TestMesh;
use crate::common::families::cube;
use crate::common::frame::{TrueFrame, bar, corner};
use crate::common::program::run;
use crate::common::zero_surface::surface_of;

fn folder_with(mesh: &TestMesh) -> TempDir {
    let folder = tempdir().expect("a folder");
    std::fs::write(folder.path().join("part.obj"), mesh.obj()).expect("a file");
    folder
}

/// What `inspect` says of the labels.
fn labels(folder: &Path, more: &[&str]) -> Value {
    let words = [&["inspect", "part.obj", "--json"], more].concat();
    let summary: Value = serde_json::from_str(&run(folder, &words).succeeded()).expect("JSON");
    summary["labels"].clone()
}

/// Counts of a skeleton: branches, junctions, ends in interface sections, free ends.
fn skeleton(folder: &Path, more: &[&str]) -> [u64; 4] {
    let words = ["skeleton", "part.obj", "-o", "out.json", "--json", "--strict"];
    let printed = run(folder, &[&words, more].concat()).succeeded();
    let summary: Value = serde_json::from_str(&printed).expect("JSON");
    ["branches", "junctions", "interface_ends", "free_ends"]
        .map(|key| summary["skeleton"][key].as_u64().expect("a count"))
}

/// The same mesh without labels.
fn unlabelled(frame: &TrueFrame) -> TestMesh {
    let mesh = frame.mesh(2.0);
    TestMesh { non_design: vec![false; mesh.triangles.len()], ..mesh }
}

/// A cube of half a side about a place.
fn cube_at(place: [f64; 3], half: f64) -> TestMesh {
    cube().mapped(|p| [0, 1, 2].map(|k| place[k] + half * p[k]))
}

#[test]
fn the_source_is_named_and_counted() {
    let folder = folder_with(&bar().mesh(2.0));
    let found = labels(folder.path(), &[]);
    assert_eq!(found["source"], "name");
    assert_eq!(found["sets"], 2);
    assert_eq!(found["interfaces"].as_array().map(Vec::len), Some(2));
    assert!(found["non_design_faces"].as_u64() > Some(100));
}

#[test]
fn second_meshes_and_boxes_say_the_same_as_names() {
    let frame = bar();
    let folder = folder_with(&unlabelled(&frame));
    let mut options = [Vec::new(), Vec::new()];
    for (i, node) in frame.nodes.iter().enumerate() {
        // A little larger, as corners are rounded off by the grid.
        let half = frame.pad + 0.3;
        let name = format!("pad{i}.obj");
        let pad = cube_at(*node, half);
        std::fs::write(folder.path().join(&name), pad.obj()).expect("a file");
        options[0].extend(["--non-design".to_owned(), name]);
        let corners: Vec<String> =
            [-half, half].iter().flat_map(|h| node.map(|x| (x + h).to_string())).collect();
        options[1].extend(["--non-design-box".to_owned(), corners.join(",")]);
    }
    let named = skeleton(folder_with(&frame.mesh(2.0)).path(), &[]);
    assert_eq!(named, [1, 0, 2, 0]);
    for (more, source) in options.iter().zip(["second mesh", "box"]) {
        let more: Vec<&str> = more.iter().map(String::as_str).collect();
        assert_eq!(labels(folder.path(), &more)["source"], source);
        assert_eq!(skeleton(folder.path(), &more), named, "{source}");
    }
}

#[test]
fn a_pattern_of_ones_own_replaces_the_known_names() {
    let folder = folder_with(&bar().mesh(2.0));
    let path = folder.path().join("part.obj");
    let text = std::fs::read_to_string(&path).expect("a file");
    std::fs::write(&path, text.replace("g non_design", "g Pad-A")).expect("a file");
    assert_eq!(labels(folder.path(), &[])["source"], Value::Null);
    assert_eq!(labels(folder.path(), &["--non-design-name", "pad*"])["sets"], 2);
}

#[test]
fn an_option_that_marks_nothing_is_told() {
    let folder = folder_with(&bar().mesh(2.0));
    let printed =
        run(folder.path(), &["inspect", "part.obj", "--non-design-box", "900,900,900,901,901,901"]);
    assert!(printed.succeeded().contains("the box marks no face as non-design"));
}

#[test]
fn without_labels_flat_ends_begin_the_march() {
    // A cylinder: its flat ends are where it was cut from its surroundings.
    let folder = folder_with(&crate::common::families::cylinder(3.0, 40.0, 24, 20));
    assert_eq!(labels(folder.path(), &[])["source"], Value::Null);
    let [branches, junctions, interfaces, free] = skeleton(folder.path(), &[]);
    assert_eq!((branches, junctions, interfaces + free), (1, 0, 2));
}

#[test]
fn one_part_with_several_interface_sections_anchors_every_branch() {
    // Two bars between the same two blocks.
    let frame = TrueFrame {
        nodes: vec![[0.0, -12.0, 0.0], [50.0, -12.0, 0.0], [0.0, 12.0, 0.0], [50.0, 12.0, 0.0]],
        struts: vec![([0, 1], [4.0; 2]), ([2, 3], [4.0; 2])],
        pads: vec![0, 1, 2, 3],
        pad: 13.0,
    };
    let folder = folder_with(&frame.mesh(2.0));
    let found = labels(folder.path(), &[]);
    assert_eq!(found["sets"], 2);
    assert_eq!(found["interfaces"].as_array().map(Vec::len), Some(4));
    assert_eq!(skeleton(folder.path(), &[]), [2, 0, 4, 0]);
}

/// A boss with a bolt hole, upright at the origin, and two bars from its side to blocks at ±`reach`.
fn bolted(hole: f64, reach: f64) -> TestMesh {
    let ring = move |[x, y, z]: [f64; 3]| {
        let r = x.hypot(y);
        (r - 12.0).max(hole - r).max(z.abs() - 7.0)
    };
    let block = move |[x, y, z]: [f64; 3]| {
        ((x.abs() - reach).abs() - 6.0).max(y.abs() - 6.0).max(z.abs() - 6.0)
    };
    let kept = move |p: [f64; 3]| ring(p).min(block(p));
    let bars =
        move |[x, y, z]: [f64; 3]| (y.hypot(z) - 4.0).max(x.abs() - reach).max(10.0 - x.abs());
    let limit = [reach + 9.0, 15.0, 15.0];
    let low = limit.map(|x| -x - 0.37);
    let mut mesh = surface_of(|p| kept(p).min(bars(p)), low, limit, 1.5);
    let middle = |t: &[u32; 3]| {
        [0, 1, 2].map(|k| t.iter().map(|&v| mesh.positions[v as usize][k]).sum::<f64>() / 3.0)
    };
    mesh.non_design = mesh.triangles.iter().map(|t| kept(middle(t)) < 0.5).collect();
    mesh
}

#[test]
fn ring_shaped_parts_anchor_their_branches_and_their_hole_is_no_cycle() {
    let folder = folder_with(&bolted(6.0, 45.0));
    let found = labels(folder.path(), &[]);
    assert_eq!(found["sets"], 3);
    assert_eq!(found["interfaces"].as_array().map(Vec::len), Some(4));
    assert_eq!(skeleton(folder.path(), &[]), [2, 0, 4, 0]);
}

#[test]
fn a_face_of_a_pad_that_was_not_labelled_is_a_part_of_it() {
    let mesh = bar().mesh(2.0);
    let labels = mesh.non_design.clone();
    let clean = skeleton(folder_with(&mesh).path(), &[]);
    // The outer face of the first pad, as far as the strut is thick.
    let least = mesh.positions.iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
    let mut mesh = mesh.labelled(|[x, y, z]| x < least + 0.1 && y.hypot(z) < 4.0);
    let count = mesh.non_design.iter().filter(|&&is_chosen| is_chosen).count();
    assert!(count > 20, "{count}");
    mesh.non_design.iter_mut().zip(labels).for_each(|(f, pad)| *f = pad && !*f);
    assert_eq!(skeleton(folder_with(&mesh).path(), &[]), clean);
}

#[test]
fn specks_of_label_noise_do_not_become_branches() {
    let mut mesh = corner().mesh(1.6);
    let clean = skeleton(folder_with(&mesh).path(), &[]);
    let pads = mesh.non_design.clone();
    for (i, label) in mesh.non_design.iter_mut().enumerate() {
        // Single faces, on struts and pads alike.
        if i % 97 == 0 {
            *label = !pads[i];
        }
    }
    let folder = folder_with(&mesh);
    assert_eq!(skeleton(folder.path(), &[]), clean);
    let printed = run(folder.path(), &["inspect", "part.obj"]).succeeded();
    assert!(printed.contains("speck"), "{printed}");
}
