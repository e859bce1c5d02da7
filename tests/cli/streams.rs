//! Results go to standard output, everything else to standard error.

use std::path::Path;
use std::process::Stdio;

use serde_json::Value;

use crate::common::program::{Ran, command, run};
use crate::folder_with_bar;

const RECONSTRUCT: [&str; 4] = ["reconstruct", "bar.obj", "-o", "out.step"];

fn reconstruct(more: &[&str]) -> Ran {
    let folder = folder_with_bar();
    run(folder.path(), &[&RECONSTRUCT, more].concat())
}

#[test]
fn a_run_into_a_pipe_says_nothing_on_standard_error() {
    let ran = reconstruct(&[]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    assert!(ran.stdout.starts_with("input       bar.obj\n"), "{}", ran.stdout);
    assert!(!ran.stdout.contains('\u{1b}'), "no colours in a pipe");
}

#[cfg(unix)]
#[test]
fn a_reader_of_errors_that_has_gone_away_changes_no_exit_code() {
    let folder = folder_with_bar();
    for (words, code) in [
        (&["reconstruct", "nothing.obj", "-o", "a.step"][..], 1),
        (&["reconstruct", "nothing.obj", "none.obj", "--out-dir", "out"], 1),
        (&["reconstruct", "bar.obj", "-o", "a.pdf"], 2),
        (&["reconstruct", "bar.obj", "-o", "a.step", "-v", "--progress", "json"], 0),
    ] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let ran: Ran =
            command(folder.path()).args(words).stderr(writer).output().expect("a run").into();
        assert_eq!(ran.code, Some(code), "{words:?}");
    }
}

#[test]
fn tables_fit_80_columns() {
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    let folder = tempfile::tempdir().expect("a folder");
    for sample in ["cantilever.obj", "quadpod.obj"] {
        let mesh = samples.join(sample).to_string_lossy().into_owned();
        for words in [
            &["inspect", &mesh][..],
            &["reconstruct", &mesh, "-o", "out.step", "--max-profiles", "1"],
        ] {
            for line in run(folder.path(), words).succeeded().lines() {
                assert!(line.chars().count() <= 80, "{line}");
            }
        }
    }
}

#[test]
fn json_is_all_there_is_on_standard_output() {
    let folder = folder_with_bar();
    run(folder.path(), &["skeleton", "bar.obj", "-o", "out.json"]).succeeded();
    for words in [
        &["reconstruct", "bar.obj", "-o", "out.step", "--json", "-v"][..],
        &["skeleton", "bar.obj", "-o", "out.obj", "--json", "--progress", "json"],
        &["inspect", "bar.obj", "--json", "-q"],
        &["evaluate", "bar.obj", "out.json", "--json"],
    ] {
        let printed = run(folder.path(), words).succeeded();
        let value: Value =
            serde_json::from_str(&printed).unwrap_or_else(|e| panic!("{words:?}: {e}"));
        assert!(value.is_object(), "{words:?}");
        assert!(printed.ends_with("}\n"), "{words:?}");
    }
}

#[test]
fn progress_as_json_is_one_object_a_line_from_read_to_write() {
    let ran = reconstruct(&["--progress", "json"]);
    let lines: Vec<Value> = ran
        .stderr
        .lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{line}: {e}")))
        .collect();
    let mut stages: Vec<&str> = lines.iter().filter_map(|l| l["stage"].as_str()).collect();
    assert_eq!(stages.len(), lines.len());
    stages.dedup();
    assert_eq!(stages, ["read", "mesh", "skeleton", "sections", "frame", "write"]);
    for line in &lines {
        let (done, total) = (line["done"].as_u64().unwrap(), line["total"].as_u64().unwrap());
        assert!(done <= total, "{line}");
    }
    let last = lines.last().expect("a line");
    assert_eq!(last["done"], last["total"]);
}

#[test]
fn quiet_leaves_errors_only() {
    let ran = reconstruct(&["-q"]);
    assert_eq!((ran.code, ran.stdout.as_str(), ran.stderr.as_str()), (Some(0), "", ""));
    let folder = folder_with_bar();
    run(folder.path(), &["skeleton", "bar.obj", "-o", "a.json", "-q"]).succeeded();
    for words in [&["inspect", "bar.obj", "-q"][..], &["evaluate", "bar.obj", "a.json", "-q"]] {
        assert_eq!(run(folder.path(), words).succeeded(), "", "{words:?}");
    }
    run(folder.path(), &["inspect", "nothing.obj", "-q"]).failed(1);
}

#[test]
fn verbose_tells_the_time_of_each_stage_and_the_files() {
    let ran = reconstruct(&["-v"]);
    let first_words: Vec<&str> =
        ran.stderr.lines().filter_map(|l| l.split_whitespace().next()).collect();
    let stages = ["read", "mesh", "skeleton", "sections", "frame"];
    assert_eq!(first_words[..5], stages);
    for ending in ["step", "csv", "skeleton.json"] {
        let wrote = |l: &str| l.starts_with("wrote ") && l.ends_with(&format!("out.{ending}"));
        assert!(ran.stderr.lines().any(wrote), "{}", ran.stderr);
    }
    assert_eq!(ran.stdout, reconstruct(&[]).stdout);
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let folder = folder_with_bar();
    let mut child = command(folder.path())
        .args(["inspect", "bar.obj"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let ran = Ran::from(child.wait_with_output().expect("an end"));
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_printed_are_a_failure() {
    let folder = folder_with_bar();
    for words in [&["inspect", "bar.obj"][..], &["--help"], &["--version"], &["man"]] {
        let full = std::fs::File::options().write(true).open("/dev/full").expect("/dev/full");
        let output = command(folder.path()).args(words).stdout(full).output();
        let message = Ran::from(output.expect("the program starts")).failed(1);
        assert!(message.starts_with("cannot write to standard output: "), "{words:?}: {message}");
    }
}
