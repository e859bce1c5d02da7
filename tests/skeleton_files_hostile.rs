//! Whatever a skeleton file holds: one clear error with file and line, never a panic.

use std::path::Path;

use beamwright::skeleton_file::{Format, SkeletonFileError, read, read_bytes};
use beamwright_formats::Unit;
use proptest::prelude::*;

fn message(bytes: &[u8], format: Format) -> String {
    read_bytes(bytes, format, Unit::Mm).unwrap_err().to_string()
}

#[test]
fn the_line_of_a_fault_is_named() {
    use Format::{Cg, Obj, Ply, Swc};
    for (text, format, expected) in [
        ("v 0 0 0\nv 1 0 x\n", Cg, "memory.cg: line 2: expected three coordinates, found `x`"),
        ("v 0 0\n", Cg, "memory.cg: line 1: expected three coordinates, found the end of the line"),
        ("v 0 0 0\nw\n", Cg, "memory.cg: line 2: expected `v` or `e`, found `w`"),
        (
            "v 0 0 nan\n",
            Obj,
            "memory.obj: line 1: `nan` is no number that can be a place; export the skeleton again",
        ),
        (
            "v 0 0 1e300\n",
            Obj,
            "memory.obj: line 1: `1e300` is no number that can be a place; export the skeleton again",
        ),
        (
            "v 0 0 0\nl 1 9\n",
            Obj,
            "memory.obj: line 2: a segment names point 9, but the file has 1 point",
        ),
        (
            "v 0 0 0\nl 1 -2\n",
            Obj,
            "memory.obj: line 2: a segment names point -2, but the file has 1 point",
        ),
        (
            "v 0 0 0\nl 1\n",
            Obj,
            "line 2: expected the numbers of two or more points, found the end",
        ),
        (
            "v 0 0 0\nl 1 0\n",
            Obj,
            "memory.obj: line 2: a segment names point 0, but the file has 1 point",
        ),
        (
            "1 0 0 0 0 1 -1\n2 0 0 0 0 1 7\n",
            Swc,
            "memory.swc: line 2: a segment names point 7, but the file has 2 points",
        ),
        ("1 0 0 0 0 1 -1\n1 0 0 0 0 1 1\n", Swc, "line 2: expected a new number for each point"),
        (
            "ply\nformat ascii 1.0\nelement edge 1\nproperty int start\nend_header\n0\n",
            Ply,
            "memory.ply: line 3: expected a property vertex1 of element edge, found none",
        ),
        (
            "ply\nformat ascii 1.0\nelement edge 9\nproperty int vertex1\nproperty int vertex2\n\
          end_header\n0 1\n",
            Ply,
            "line 7: expected 9 elements edge, found the end of the file",
        ),
        ("ply\nformat ascii 1.0\n", Ply, "memory.ply: line 2: expected `end_header`"),
        ("solid x\n", Ply, "memory.ply: line 1: expected `ply`, found `solid`"),
    ] {
        let message = message(text.as_bytes(), format);
        assert!(message.contains(expected), "{message}\n  is not\n{expected}");
    }
}

#[test]
fn faults_of_json_have_line_or_part() {
    for (text, expected) in [
        ("{", "line 1, column 1: EOF while parsing an object"),
        ("{\"nodes\": []}", "missing field `format`"),
        (
            r#"{"format":"x","version":1,"unit":"mm","points":[],"branches":[]}"#,
            "format: expected `beamwright-skeleton`, found `x`",
        ),
        (
            r#"{"format":"beamwright-skeleton","version":2,"unit":"mm","points":[],"branches":[]}"#,
            "version: expected version 1 of the format, found `2`",
        ),
        (
            r#"{"format":"beamwright-skeleton","version":1,"unit":"ft","points":[],"branches":[]}"#,
            "unit: expected mm, cm, m or in, found `ft`",
        ),
        (
            r#"{"format":"beamwright-skeleton","version":1,"unit":"mm",
          "points":[{"id":0,"position":[0,0,1e999]}],"branches":[]}"#,
            "line 2, column",
        ),
        (
            r#"{"format":"beamwright-skeleton","version":1,"unit":"mm",
          "points":[{"id":0,"position":[0,0,0]}],"branches":[{"points":[0,5]}]}"#,
            "branches[0].points[1]: a segment names point 5, but the file has 1 point",
        ),
        (
            r#"{"format":"beamwright-skeleton","version":1,"unit":"mm",
          "points":[{"id":0,"position":[0,0,0]},{"id":0,"position":[1,0,0]}],"branches":[]}"#,
            "points[1].id: expected an id of its own, found `0`",
        ),
        (
            r#"{"format":"beamwright-skeleton","version":1,"unit":"mm",
          "points":[{"id":0,"position":[0,0,0]}],"branches":[]}"#,
            "it has 1 point but no segment between two of them",
        ),
    ] {
        let message = message(text.as_bytes(), Format::Json);
        assert!(message.contains(expected), "{message}\n  is not\n{expected}");
    }
}

#[test]
fn a_mesh_is_told_from_a_skeleton() {
    let message = message(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", Format::Obj);
    assert!(message.contains("it has faces: is it a mesh?"), "{message}");
}

#[test]
fn counts_that_the_file_does_not_hold_cost_no_memory() {
    for header in [
        "element vertex 4000000000000000000\nproperty float x\nproperty float y\nproperty float z\n",
        "element vertex 1\nproperty list uint double x\nproperty float y\nproperty float z\n",
        "element thing 4000000000000000000\nelement vertex 0\n",
        "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n",
    ] {
        for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
            let ply = format!("ply\nformat {encoding} 1.0\n{header}end_header\n");
            let bytes = [ply.as_bytes(), &[255; 64]].concat();
            assert!(read_bytes(&bytes, Format::Ply, Unit::Mm).is_err());
        }
    }
}

#[test]
fn a_deeply_nested_json_is_an_error() {
    let deep = [vec![b'['; 100_000], vec![b']'; 100_000]].concat();
    assert!(message(&deep, Format::Json).contains("line 1"));
}

#[test]
fn places_that_are_no_file_are_named() {
    let message = |path: &str| read(Path::new(path), Unit::Mm).unwrap_err().to_string();
    assert!(message("no/such.cg").starts_with("cannot read no/such.cg: "));
    assert!(message("tests").starts_with("unknown kind of skeleton file tests; known are .json"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.obj");
    std::fs::create_dir(&path).unwrap();
    assert!(matches!(read(&path, Unit::Mm), Err(SkeletonFileError::NotAFile { .. })));
}

#[test]
fn a_node_file_needs_its_connectivity_file() {
    let folder = tempfile::tempdir().unwrap();
    let nodes = folder.path().join("part_nodes.txt");
    let connectivity = folder.path().join("part_connectivity.txt");
    let read_pair = |n: &str, c: &str| {
        std::fs::write(&nodes, n).unwrap();
        std::fs::write(&connectivity, c).unwrap();
        read(&nodes, Unit::Mm).map_err(|e| e.to_string())
    };
    std::fs::write(&nodes, "0 0 0\n1 0 0\n").unwrap();
    let alone = read(&nodes, Unit::Mm).unwrap_err().to_string();
    assert!(
        alone.contains("its segments are expected in") && alone.contains("part_connectivity.txt")
    );
    assert_eq!(read_pair("0,0,0\n1,0,0\n", "2 0 NaN\n1\n\n").unwrap().points.len(), 2);
    for (n, c, expected) in [
        ("0 0 0\n1 0\n", "2\n1\n", "part_nodes.txt: line 2: expected three coordinates"),
        (
            "0 0 0\n1 0 0\n",
            "2\n3\n",
            "part_connectivity.txt: line 2: a segment names point 3, but the file has 2 points",
        ),
        ("0 0 0\n1 0 0\n", "2\n1\n1\n", "line 3: expected no more rows than the 2 nodes"),
        ("0 0 0\nNaN NaN NaN\n", "2\n1\n", "line 1: expected no segment to node 2, which is NaN"),
        ("0 0 0\n1 0 0\n", "x\n", "line 1: expected numbers of nodes, found `x`"),
    ] {
        let message = read_pair(n, c).unwrap_err();
        assert!(message.contains(expected), "{message}\n  is not\n{expected}");
    }
    let other = folder.path().join("skeleton.txt");
    std::fs::write(&other, "0 0 0\n").unwrap();
    let message = read(&other, Unit::Mm).unwrap_err().to_string();
    assert!(message.contains("give the file of the nodes"), "{message}");
}

/// Valid files of each format, to be damaged.
fn valid() -> Vec<(Format, Vec<u8>)> {
    [
        (Format::Cg, "starlab.cg"),
        (Format::Obj, "polylines.obj"),
        (Format::Ply, "meshlab.ply"),
        (Format::Swc, "traced.swc"),
        (Format::Json, "ours.json"),
    ]
    .map(|(format, name)| (format, std::fs::read(Path::new("tests/data").join(name)).unwrap()))
    .to_vec()
}

proptest! {
    #[test]
    fn no_bytes_make_a_reader_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        for format in Format::ALL {
            let _ = read_bytes(&bytes, format, Unit::Mm);
        }
    }

    #[test]
    fn no_damage_makes_a_reader_panic(
        at in any::<prop::sample::Index>(),
        cut in any::<prop::sample::Index>(),
        with in "[-0-9eE.,nanif \n]{0,6}",
    ) {
        for (format, mut bytes) in valid() {
            let at = at.index(bytes.len());
            let end = (at + cut.index(8)).min(bytes.len());
            bytes.splice(at..end, with.bytes());
            if let Ok(skeleton) = read_bytes(&bytes, format, Unit::Inch) {
                prop_assert!(skeleton.points.iter().all(|p| p.position.coords.amax() <= 1e30));
                prop_assert!(skeleton.segments().flatten().all(|p| (p as usize) < skeleton.points.len()));
            }
        }
    }
}
