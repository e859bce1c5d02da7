//! Output files appear whole or not at all.

use std::path::Path;

use crate::common::program::{Ran, run};
use crate::{folder_with_bar, names};

/// All outputs of one run, all named.
const ALL: [&str; 12] = [
    "reconstruct",
    "bar.obj",
    "-o",
    "out.step",
    "--skeleton",
    "out.ply",
    "--cut-list",
    "out.csv",
    "--sections",
    "out.json",
    "--export",
    "out.mlp",
];

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).expect("a file")
}

#[test]
fn a_good_run_leaves_its_files_and_no_others() {
    let folder = folder_with_bar();
    run(folder.path(), &ALL).succeeded();
    let layers = ["input", "skeleton", "off_centre", "beams"].map(|l| format!("out.{l}.ply"));
    let mut expected: Vec<String> =
        ["bar.obj", "out.step", "out.ply", "out.csv", "out.json", "out.mlp"]
            .map(String::from)
            .into();
    expected.extend(layers);
    expected.sort();
    assert_eq!(names(folder.path()), expected);
}

#[test]
fn a_good_run_replaces_what_was_there() {
    let folder = folder_with_bar();
    let step = folder.path().join("out.step");
    std::fs::write(&step, "old").expect("a file");
    run(folder.path(), &ALL).succeeded();
    assert!(text(&step).ends_with("END-ISO-10303-21;\n"));
}

#[test]
fn a_failure_keeps_what_was_there() {
    let folder = folder_with_bar();
    let step = folder.path().join("out.step");
    std::fs::write(&step, "old").expect("a file");
    std::fs::write(folder.path().join("flat.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        .expect("a file");
    run(folder.path(), &["reconstruct", "flat.obj", "-o", "out.step"]).failed(1);
    assert_eq!(text(&step), "old");
    assert_eq!(names(folder.path()), ["bar.obj", "flat.obj", "out.step"]);
}

/// Runs the program with files limited to some blocks of 512 bytes: a disk that gets full.
#[cfg(unix)]
fn on_a_small_disk(folder: &Path, blocks: u32, words: &[&str]) -> Ran {
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    std::process::Command::new("sh")
        .args(["-c", &script, env!("CARGO_BIN_EXE_beamwright")])
        .args(words)
        .current_dir(folder)
        .output()
        .expect("a shell")
        .into()
}

#[cfg(unix)]
#[test]
fn a_full_disk_leaves_nothing_half_written() {
    let folder = folder_with_bar();
    let step = folder.path().join("out.step");
    std::fs::write(&step, "old").expect("a file");
    for blocks in [1, 8, 12] {
        let message = on_a_small_disk(folder.path(), blocks, &ALL).failed(1);
        assert!(message.starts_with("cannot write out."), "{message}");
        assert!(!message.contains(".part"), "the name of a temporary file: {message}");
        assert_eq!(text(&step), "old", "{blocks} blocks");
        assert_eq!(names(folder.path()), ["bar.obj", "out.step"], "{blocks} blocks");
    }
}

#[test]
fn a_target_that_cannot_be_written_is_told_before_the_work() {
    let folder = folder_with_bar();
    std::fs::create_dir(folder.path().join("taken.step")).expect("a folder");
    for (target, why) in [
        ("nowhere/out.step", "its folder does not exist"),
        ("taken.step", "it is a folder"),
        ("bar.obj/out.step", "its folder does not exist"),
    ] {
        let message = run(folder.path(), &["reconstruct", "bar.obj", "-o", target]).failed(1);
        assert_eq!(message, format!("cannot write {target}: {why}"));
    }
    assert_eq!(names(folder.path()), ["bar.obj", "taken.step"]);
}

#[cfg(unix)]
#[test]
fn a_name_too_long_for_one_output_leaves_none() {
    let folder = folder_with_bar();
    let long = "a".repeat(250);
    std::fs::rename(folder.path().join("bar.obj"), folder.path().join(format!("{long}.obj")))
        .expect("another name");
    let (mesh, step) = (format!("{long}.obj"), format!("{long}.step"));
    for outputs in [&["-o", &step][..], &["--out-dir", "out", "--report", ".html"]] {
        let ran = run(folder.path(), &[&["reconstruct", &mesh], outputs].concat());
        assert_eq!(ran.code, Some(1), "{ran:?}");
        assert!(ran.stderr.contains(".skeleton.json: File name too long"), "{ran:?}");
        assert!(ran.stdout.is_empty(), "told before the work: {ran:?}");
    }
    assert_eq!(names(folder.path()), [&mesh, "out"]);
    assert!(names(&folder.path().join("out")).is_empty());
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_may_not_be_written_is_told_by_the_wanted_name() {
    let folder = folder_with_bar();
    // Not even root may create a file there.
    let message = run(folder.path(), &["skeleton", "bar.obj", "-o", "/sys/out.json"]).failed(1);
    let cause = message.strip_prefix("cannot write /sys/out.json: ");
    let cause = cause.unwrap_or_else(|| panic!("{message}"));
    assert!(!cause.contains("/sys") && !cause.contains("beamwright"), "{message}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_takes_no_files_is_told() {
    // Nobody may create files there, not even root.
    let folder = folder_with_bar();
    let words = ["reconstruct", "bar.obj", "-o", "/proc/self/out.step"];
    let message = run(folder.path(), &words).failed(1);
    assert!(message.starts_with("cannot write /proc/self/out.step: "), "{message}");
}

#[test]
fn an_input_is_never_an_output() {
    let folder = folder_with_bar();
    std::fs::copy(folder.path().join("bar.obj"), folder.path().join("kept.obj")).expect("a copy");
    std::fs::write(folder.path().join("own.csv"), "name,family,shape\n").expect("a file");
    let before = text(&folder.path().join("bar.obj"));
    for words in [
        &["skeleton", "bar.obj", "-o", "bar.obj"][..],
        &["skeleton", "bar.obj", "-o", "./bar.obj"],
        &["skeleton", "bar.obj", "-o", "kept.obj", "--non-design", "kept.obj"],
        &["reconstruct", "bar.obj", "-o", "a.step", "--skeleton", "bar.obj"],
        &["reconstruct", "bar.obj", "-o", "own.step", "--catalogue", "own.csv"],
    ] {
        let message = run(folder.path(), words).failed(2);
        assert!(message.contains("is an input file"), "{words:?}: {message}");
    }
    assert_eq!(text(&folder.path().join("bar.obj")), before);
}

#[cfg(unix)]
#[test]
fn an_input_is_never_an_output_by_a_second_name() {
    let folder = folder_with_bar();
    let path = |name: &str| folder.path().join(name);
    std::fs::hard_link(path("bar.obj"), path("hard.obj")).expect("a second name");
    std::os::unix::fs::symlink("bar.obj", path("soft.obj")).expect("a link");
    for output in ["hard.obj", "soft.obj"] {
        let message = run(folder.path(), &["skeleton", "bar.obj", "-o", output]).failed(2);
        assert_eq!(message, format!("the output {output} is an input file"));
    }
}

#[test]
fn two_outputs_never_share_a_file() {
    let folder = folder_with_bar();
    for words in [
        &[
            "reconstruct",
            "bar.obj",
            "-o",
            "a.step",
            "--skeleton",
            "a.json",
            "--sections",
            "./a.json",
        ][..],
        &["reconstruct", "bar.obj", "-o", "a.step", "--export", "a.mlp", "--export", "a.mlp"],
        &[
            "reconstruct",
            "bar.obj",
            "-o",
            "a.step",
            "--export",
            "a.mlp",
            "--skeleton",
            "a.skeleton.ply",
        ],
    ] {
        let message = run(folder.path(), words).failed(2);
        assert!(message.starts_with("two outputs would be written to "), "{words:?}: {message}");
    }
}

#[cfg(unix)]
#[test]
fn a_link_stays_and_the_file_behind_it_is_replaced() {
    let folder = folder_with_bar();
    let (link, file) = (folder.path().join("out.json"), folder.path().join("real.json"));
    std::fs::write(&file, "old").expect("a file");
    std::os::unix::fs::symlink("real.json", &link).expect("a link");
    run(folder.path(), &["skeleton", "bar.obj", "-o", "out.json"]).succeeded();
    assert!(link.is_symlink());
    assert!(text(&file).contains("beamwright-skeleton"));
}

#[cfg(unix)]
#[test]
fn a_device_behind_a_link_is_left_alone() {
    let folder = folder_with_bar();
    std::os::unix::fs::symlink("/dev/null", folder.path().join("out.json")).expect("a link");
    let message = run(folder.path(), &["skeleton", "bar.obj", "-o", "out.json"]).failed(1);
    assert!(message.ends_with("it is a device or pipe, not a file"), "{message}");
}
