//! `beamwright evaluate` through the real program: its own skeletons and those of others.
//!
//! The part is a bar of radius 4 along x, between a pad about x = 0 and one about x = 50 whose
//! faces towards it lie at x = 6 and x = 44. Skeletons are drawn by hand where a figure must be
//! known beforehand.

mod common;

use std::fmt::Write;
use std::path::Path;

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use common::frame::bar;
use common::program::run;

/// Lengths of a straight line on the axis that ends in the interface centres, mm.
const AXIS: [f64; 5] = [6.0, 15.0, 25.0, 35.0, 44.0];

/// A folder with the labelled bar, `bar.obj`.
fn folder_with_bar() -> TempDir {
    let folder = tempdir().expect("a folder");
    write(folder.path(), "bar.obj", &bar().mesh(1.0).obj());
    folder
}

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("a file");
}

/// A polyline along x at a height above the axis, as OBJ.
fn line_at(height: f64, xs: &[f64]) -> String {
    let mut text = String::new();
    for x in xs {
        let _ = writeln!(text, "v {x} {height} 0");
    }
    for i in 1..xs.len() {
        let _ = writeln!(text, "l {i} {}", i + 1);
    }
    text
}

/// What `evaluate bar.obj … --json` prints.
fn report(folder: &Path, arguments: &[&str]) -> Value {
    let words = [&["evaluate", "bar.obj", "--json"][..], arguments].concat();
    serde_json::from_str(&run(folder, &words).succeeded()).expect("JSON")
}

fn number(value: &Value, pointer: &str) -> f64 {
    value.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer}: {value}"))
}

/// The figures of the first skeleton that a format must not change.
fn figures(report: &Value) -> [f64; 5] {
    [
        "/skeletons/0/raw/e_center",
        "/skeletons/0/resampled/e_true",
        "/skeletons/0/raw/hu_degree",
        "/skeletons/0/outside/length",
        "/skeletons/0/topology/interface_ends",
    ]
    .map(|pointer| number(report, pointer))
}

#[test]
fn own_skeleton_of_a_bar_is_centred_inside_and_homotopic() {
    let folder = folder_with_bar();
    run(folder.path(), &["skeleton", "bar.obj", "-o", "own.json"]).succeeded();
    let report = report(folder.path(), &["own.json", "--strict"]);
    assert!(number(&report, "/skeletons/0/raw/offset/shaft_mean") < 0.01, "{report}");
    assert!(number(&report, "/skeletons/0/raw/hu_degree") > 0.9, "{report}");
    assert!(number(&report, "/skeletons/0/outside/fraction").abs() < f64::EPSILON);
    assert_eq!(report.pointer("/skeletons/0/topology/is_homotopic"), Some(&Value::Bool(true)));
}

#[test]
fn every_format_of_a_skeleton_has_the_same_figures() {
    let folder = folder_with_bar();
    let written = ["own.json", "own.obj", "own.ply", "own.cg", "own.swc"].map(|name| {
        run(folder.path(), &["skeleton", "bar.obj", "-o", name]).succeeded();
        figures(&report(folder.path(), &[name]))
    });
    for (i, other) in written.iter().enumerate().skip(1) {
        // An SWC is a tree from its root, so it may list a branch from its other end. The first ray
        // of eq. (2.2) depends on that; rays to the true section do not.
        let from_its_end = usize::from(i == 4);
        for (a, b) in written[0].iter().zip(other).skip(from_its_end) {
            assert!((a - b).abs() <= 1e-6 * a.abs().max(1e-3), "{written:?}");
        }
    }
}

#[test]
fn node_and_connectivity_files_are_read_as_one_skeleton() {
    let folder = folder_with_bar();
    write(folder.path(), "axis.obj", &line_at(0.0, &AXIS));
    let nodes: String = AXIS.iter().map(|x| format!("{x} 0 0\n")).collect();
    write(folder.path(), "axis_nodes.txt", &nodes);
    write(folder.path(), "axis_connectivity.txt", "2 0\n1 3\n2 4\n3 5\n4 0\n");
    let read = figures(&report(folder.path(), &["axis_nodes.txt"]));
    assert_eq!(read, figures(&report(folder.path(), &["axis.obj"])));
}

#[test]
fn nodes_without_their_connectivity_are_refused_by_name() {
    let folder = folder_with_bar();
    write(folder.path(), "axis_nodes.txt", "6 0 0\n44 0 0\n");
    let message = run(folder.path(), &["evaluate", "bar.obj", "axis_nodes.txt"]).failed(1);
    assert!(message.contains("axis_connectivity.txt"), "{message}");
}

#[test]
fn table_puts_skeletons_side_by_side_within_80_columns() {
    let folder = folder_with_bar();
    let names = ["a.obj", "b.obj", "c.obj", "d.obj", "a_rather_long_name_of_a_skeleton.obj"];
    for name in names {
        write(folder.path(), name, &line_at(0.0, &AXIS));
    }
    let words = [&["evaluate", "bar.obj"][..], &names].concat();
    let table = run(folder.path(), &words).succeeded();
    for line in table.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    for row in ["E_center", "true rays", "Hu's degree", "points outside", "free ends"] {
        assert!(table.lines().any(|l| l.contains(row)), "no row {row} in\n{table}");
    }
}

#[test]
fn skeletons_are_reported_in_the_order_given() {
    let folder = folder_with_bar();
    write(folder.path(), "z.obj", &line_at(0.0, &AXIS));
    write(folder.path(), "a.obj", &line_at(1.0, &AXIS));
    let report = report(folder.path(), &["z.obj", "a.obj"]);
    assert_eq!(report["skeletons"][0]["name"], "z.obj");
    assert_eq!(report["skeletons"][1]["name"], "a.obj");
}

#[test]
fn distance_of_two_parallel_skeletons_is_their_gap() {
    let folder = folder_with_bar();
    write(folder.path(), "axis.obj", &line_at(0.0, &AXIS));
    write(folder.path(), "above.obj", &line_at(1.5, &AXIS));
    let report = report(folder.path(), &["axis.obj", "above.obj"]);
    for figure in ["d12_mean", "d21_max", "hausdorff"] {
        let gap = number(&report, &format!("/comparisons/0/{figure}"));
        assert!((gap - 1.5).abs() < 1e-9, "{figure} {gap}");
    }
}

#[test]
fn offset_is_counted_in_section_radii() {
    let folder = folder_with_bar();
    write(folder.path(), "above.obj", &line_at(1.0, &AXIS));
    let report = report(folder.path(), &["above.obj"]);
    let offset = number(&report, "/skeletons/0/raw/offset/shaft_mean");
    assert!((offset - 0.25).abs() < 0.01, "1 mm of a radius of 4 mm: {offset}");
}

#[test]
fn strict_refuses_a_skeleton_that_leaves_the_part() {
    let folder = folder_with_bar();
    write(folder.path(), "outside.obj", &line_at(5.0, &AXIS));
    let figures = report(folder.path(), &["outside.obj"]);
    assert!(number(&figures, "/skeletons/0/raw/points_outside") > 0.0, "{figures}");
    assert!(number(&figures, "/skeletons/0/outside/fraction") > 0.9, "{figures}");
    let strict = run(folder.path(), &["evaluate", "bar.obj", "outside.obj", "--strict"]);
    assert_eq!(strict.code, Some(3), "{strict:?}");
    assert!(strict.stdout.contains("points outside"), "the table is printed all the same");
    assert_eq!(
        strict.stderr,
        "error: a promise is broken by outside.obj: 5 of its points outside; mend it, or leave out \
         --strict to have it measured as it is\n"
    );
}

#[test]
fn strict_refuses_a_loop_in_a_bar_and_a_bar_in_two_pieces() {
    let folder = folder_with_bar();
    let ring = "v 6 0 0\nv 20 0 0\nv 30 1 0\nv 30 -1 0\nv 44 0 0\nl 1 2 3 5\nl 2 4 5\n";
    write(folder.path(), "ring.obj", ring);
    let pieces = "v 6 0 0\nv 20 0 0\nv 30 0 0\nv 44 0 0\nl 1 2\nl 3 4\n";
    write(folder.path(), "pieces.obj", pieces);
    for name in ["ring.obj", "pieces.obj"] {
        let strict = run(folder.path(), &["evaluate", "bar.obj", name, "--strict"]);
        assert_eq!(strict.code, Some(3), "{name}: {strict:?}");
    }
    let both = run(folder.path(), &["evaluate", "bar.obj", "ring.obj", "pieces.obj", "--strict"]);
    assert_eq!(both.stderr.lines().count(), 1, "{both:?}");
    let said = "ring.obj: cycles 1 instead of 0 (and 1 more of 2 skeletons);";
    assert!(both.stderr.contains(said), "{both:?}");
    assert_eq!(run(folder.path(), &["evaluate", "bar.obj", "ring.obj"]).code, Some(0));
}

#[test]
fn post_processing_drops_joins_and_prunes() {
    let folder = folder_with_bar();
    // Begins inside the left pad, stops short of the right one, and has a whisker upwards.
    let mut text = line_at(0.0, &[0.0, 12.0, 20.0, 28.0, 38.0]);
    text.push_str("v 20 2 0\nl 3 6\n");
    write(folder.path(), "theirs.obj", &text);
    let before = report(folder.path(), &["theirs.obj"]);
    let after = report(folder.path(), &["theirs.obj", "--post-process"]);
    assert_eq!(number(&before, "/skeletons/0/topology/interface_ends"), 0.0);
    assert_eq!(number(&after, "/skeletons/0/topology/interface_ends"), 2.0);
    assert_eq!(number(&after, "/skeletons/0/topology/free_ends"), 0.0);
    assert_eq!(number(&after, "/skeletons/0/post_processing/removed"), 1.0);
    assert_eq!(number(&after, "/skeletons/0/post_processing/joined"), 2.0);
    assert_eq!(number(&after, "/skeletons/0/post_processing/pruned"), 1.0);
}

#[test]
fn skeleton_in_centimetres_is_converted() {
    let folder = folder_with_bar();
    write(folder.path(), "mm.obj", &line_at(0.0, &AXIS));
    write(folder.path(), "cm.obj", &line_at(0.0, &AXIS.map(|x| x / 10.0)));
    let mm = number(&report(folder.path(), &["mm.obj"]), "/skeletons/0/outside/length");
    let cm = report(folder.path(), &["cm.obj", "--skeleton-unit", "cm"]);
    assert!((number(&cm, "/skeletons/0/outside/length") - mm).abs() < 1e-9);
}

#[test]
fn resampling_sets_the_distance_of_the_points() {
    let folder = folder_with_bar();
    write(folder.path(), "axis.obj", &line_at(0.0, &AXIS));
    let points = |step: &str| {
        let report = report(folder.path(), &["axis.obj", "--resample", step]);
        number(&report, "/skeletons/0/resampled/points")
    };
    assert_eq!(points("2"), 20.0, "38 mm in steps of 2");
    assert_eq!(points("3.8"), 11.0);
}

#[test]
fn lengths_that_are_none_are_wrong_usage() {
    let folder = folder_with_bar();
    write(folder.path(), "axis.obj", &line_at(0.0, &AXIS));
    for option in ["--resample=0", "--resample=nan", "--resample=-1", "--cube=inf"] {
        let message = run(folder.path(), &["evaluate", "bar.obj", "axis.obj", option]).failed(2);
        let name = option.split('=').next().unwrap_or_default();
        assert!(message.contains(name), "{message}");
    }
}

#[test]
fn files_that_are_no_skeleton_are_refused_by_name() {
    let folder = folder_with_bar();
    write(folder.path(), "broken.json", "{ \"format\": \"beamwright-skeleton\"");
    write(folder.path(), "empty.cg", "");
    write(folder.path(), "sheet.xls", "");
    for name in ["nothing.json", "broken.json", "empty.cg", "sheet.xls", "bar.obj"] {
        let message = run(folder.path(), &["evaluate", "bar.obj", name]).failed(1);
        assert!(message.contains(name), "{message}");
    }
}

#[test]
fn two_runs_print_the_same_bytes() {
    let folder = folder_with_bar();
    run(folder.path(), &["skeleton", "bar.obj", "-o", "own.json"]).succeeded();
    let words = ["evaluate", "bar.obj", "own.json", "--json"];
    assert_eq!(run(folder.path(), &words).succeeded(), run(folder.path(), &words).succeeded());
}

/// The same definitions, written a second time in another language by other hands, give these.
#[test]
fn figures_agree_with_those_of_an_independent_evaluator() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let words = ["evaluate", "samples/quadpod.obj", "tests/data/quadpod_axes.obj", "--json"];
    let report: Value = serde_json::from_str(&run(root, &words).succeeded()).expect("JSON");
    for (pointer, expected) in [
        ("/skeletons/0/raw/e_center", 0.037_603_378_483_955_7),
        ("/skeletons/0/raw/e_true", 0.017_486_456_951_932_0),
        ("/skeletons/0/raw/hu_degree", 0.922_210_808_309_130_8),
        ("/skeletons/0/raw/offset/mean", 0.129_482_059_147_461_1),
        ("/skeletons/0/resampled/e_center", 0.041_395_125_095_669_3),
    ] {
        let found = number(&report, pointer);
        assert!((found / expected - 1.0).abs() < 1e-9, "{pointer}: {found} for {expected}");
    }
}
