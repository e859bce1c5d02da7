//! How a run ends: the exit code says what happened.

use std::io::{BufRead, BufReader, Read};
use std::process::Stdio;

use crate::common::frame::{bar, cube};
use crate::common::program::{Ran, command, run};
use crate::{folder_with_bar, names, sample};

#[test]
fn a_good_run_ends_with_0() {
    let folder = folder_with_bar();
    for words in [
        &["reconstruct", "bar.obj", "-o", "out.step"][..],
        &["skeleton", "bar.obj", "-o", "out.json"],
        &["inspect", "bar.obj"],
        &["evaluate", "bar.obj", "out.json"],
        &["--version"],
        &["--help"],
        &["reconstruct", "--help"],
    ] {
        let printed = run(folder.path(), words).succeeded();
        assert!(!printed.is_empty(), "{words:?}");
    }
}

#[test]
fn input_that_cannot_be_used_ends_with_1() {
    let folder = folder_with_bar();
    for command in ["reconstruct", "skeleton"] {
        let words = [command, "nothing.obj", "-o", "out.step"];
        let words =
            words.map(|w| if command == "skeleton" { w.replace("step", "obj") } else { w.into() });
        let message = run(folder.path(), &words).failed(1);
        assert!(message.starts_with("cannot read nothing.obj: "), "{message}");
    }
    run(folder.path(), &["inspect", "nothing.obj"]).failed(1);
    assert_eq!(names(folder.path()), ["bar.obj"]);
}

#[test]
fn a_catalogue_that_cannot_be_read_is_named_with_the_line() {
    let folder = folder_with_bar();
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("a file");
    };
    write("own1.csv", "# shape: round\nname,d\nA,10\n");
    write("own2.csv", "# shape: round\nname,d\nB,20\nC,x\n");
    write("own3.json", "{\n\"profiles\": [}");
    write("empty.csv", "# shape: round\nname,d\n");
    for (bad, fault) in [
        ("own2.csv", "line 4: d must be a number, but is \"x\""),
        ("own3.json", "line 2: malformed JSON: "),
        (
            "empty.csv",
            "it has no profiles: a .csv lists them one a line below its header, a .json in `profiles`",
        ),
        ("none.csv", "No such file or directory"),
    ] {
        for command in [&["profiles"][..], &["reconstruct", "bar.obj", "-o", "a.step"]] {
            let catalogues = ["--catalogue", "own1.csv", "--catalogue", bad];
            let message = run(folder.path(), &[command, &catalogues].concat()).failed(1);
            let wanted = format!("cannot read {bad}: {fault}");
            assert!(message.starts_with(&wanted), "{command:?}: {message}");
        }
    }
}

#[test]
fn wrong_usage_ends_with_2_and_says_what_is_wanted() {
    let folder = folder_with_bar();
    for (words, wanted) in [
        (&["reconstruct", "bar.obj", "-o", "out.pdf"][..], "must end in .step or .stp"),
        (&["reconstruct", "bar.obj", "-o", "out.step", "--export", "out.3ds"], ".mlp"),
        (&["reconstruct", "bar.obj", "-o", "out.step", "--sections", "out.xls"], ".json or .csv"),
        (&["reconstruct", "bar.obj", "-o", "a.step", "--skeleton", "a.txt"], ".json"),
        (&["reconstruct", "bar.obj", "-o", "a.step", "--profile", "catalogue:XYZ"], "XYZ"),
        (&["skeleton", "bar.obj", "-o", "a.json", "--step", "0"], "step"),
        (&["skeleton", "bar.obj", "-o", "a.json", "--width-ratio", "0.5"], "width"),
    ] {
        let message = run(folder.path(), words).failed(2);
        assert!(message.contains(wanted), "{words:?}: {message}");
    }
    assert_eq!(names(folder.path()), ["bar.obj"]);
}

#[test]
fn words_that_mean_nothing_end_with_2() {
    let folder = folder_with_bar();
    for words in [
        &[][..],
        &["reconstruct"],
        &["frobnicate"],
        &["inspect", "bar.obj", "--no-such-flag"],
        &["inspect", "bar.obj", "--unit", "mile"],
        &["inspect", "bar.obj", "--non-design-box", "1,2,3"],
        &["inspect", "bar.obj", "--non-design-box", "1,2,3,4,5,x"],
        &["reconstruct", "bar.obj", "-o", "a.step", "--max-profiles", "0"],
        &["inspect", "bar.obj", "-q", "-v"],
    ] {
        let ran = run(folder.path(), words);
        assert_eq!(ran.code, Some(2), "{words:?}");
        assert!(ran.stdout.is_empty() && !ran.stderr.is_empty(), "{words:?}");
    }
}

#[test]
fn a_broken_promise_ends_with_3_under_strict_and_writes_nothing() {
    // The march as the thesis has it leaves one of these, which it says itself.
    let ran: Vec<Ran> = ["cantilever", "four_fixings", "y_form"]
        .iter()
        .map(|name| {
            let folder = folder_with_bar();
            let words = ["-o", "out.step", "--orientation", "global", "--strict"];
            let ran: Ran = command(folder.path())
                .arg("reconstruct")
                .arg(sample(name))
                .args(words)
                .output()
                .expect("the program starts")
                .into();
            let is_written = names(folder.path()) != ["bar.obj"];
            assert_eq!(is_written, ran.code == Some(0), "{ran:?}");
            ran
        })
        .collect();
    let broken: Vec<&Ran> = ran.iter().filter(|r| r.code == Some(3)).collect();
    assert!(!broken.is_empty(), "{ran:?}");
    for ran in broken {
        assert!(ran.stderr.starts_with("error: a promise is broken: "), "{}", ran.stderr);
        assert!(ran.stdout.contains("BREACH"), "{}", ran.stdout);
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_ends_with_130_and_writes_nothing() {
    let folder = folder_with_bar();
    std::fs::write(folder.path().join("cube.obj"), cube().mesh(0.8).obj()).expect("a file");
    std::fs::write(folder.path().join("out.step"), "kept").expect("a file");
    let mut child = command(folder.path())
        .args(["reconstruct", "cube.obj", "-o", "out.step", "--progress", "json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    let first = lines.next().expect("progress").expect("text");
    assert!(first.contains("read"), "{first}");
    let id = child.id().to_string();
    let sent = std::process::Command::new("kill").args(["-INT", &id]).status().expect("kill");
    assert!(sent.success());
    let rest: Vec<String> = lines.map_while(Result::ok).collect();
    let ran = Ran::from(child.wait_with_output().expect("an end"));
    assert_eq!(ran.code, Some(130), "{rest:?}");
    assert_eq!(rest.last().map(String::as_str), Some("error: interrupted"));
    assert_eq!(ran.stdout, "");
    assert_eq!(names(folder.path()), ["bar.obj", "cube.obj", "out.step"]);
    let kept = std::fs::read_to_string(folder.path().join("out.step")).expect("a file");
    assert_eq!(kept, "kept");
}

#[cfg(unix)]
#[test]
fn a_run_that_waits_where_nothing_asks_whether_to_stop_is_interrupted_too() {
    let folder = folder_with_bar();
    // More than a pipe holds: the program waits for a reader that has had enough.
    let mut child = command(folder.path())
        .args(["profiles", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut out = child.stdout.take().expect("a pipe");
    out.read_exact(&mut [0]).expect("a first byte");
    let id = child.id().to_string();
    let sent = std::process::Command::new("kill").args(["-INT", &id]).status().expect("kill");
    assert!(sent.success());
    let ran = Ran::from(child.wait_with_output().expect("an end"));
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(130), "error: interrupted\n"));
    drop(out);
}

#[test]
fn numbers_that_cannot_be_end_with_2_before_anything_is_read() {
    let folder = folder_with_bar();
    let refused = |option: &str, value: &str, says: &str| {
        let words = ["reconstruct", "missing.obj", "-o", "a.step", "--stock-length", "6000"];
        let ran = run(folder.path(), &[&words[..], &[option, value]].concat());
        assert_eq!(ran.code, Some(2), "{option} {value}: {ran:?}");
        assert!(ran.stderr.contains(option) && ran.stderr.contains(says), "{ran:?}");
        assert!(ran.stdout.is_empty());
    };
    for value in ["0", "-7850", "nan", "inf", "1e9"] {
        refused("--density", value, "must lie in (0, 30000] kg/m³");
        refused("--elastic-modulus", value, "must lie in (0, 2e6] MPa");
    }
    for value in ["-0.1", "0.5", "0.7", "nan"] {
        refused("--poisson", value, "must lie in [0, 0.5)");
    }
    for value in ["0", "-6000", "nan", "inf"] {
        refused("--stock-length", value, "must be a length above 0");
    }
    for value in ["-1", "nan", "6000", "1e9"] {
        refused("--kerf", value, "must be at least 0 and shorter than the bar");
    }
    for value in ["0", "-1", "2.5", "nan"] {
        refused("--max-profiles", value, "invalid value");
    }
    refused("--density", "steel", "invalid value");
}

#[test]
fn a_piece_longer_than_a_stock_bar_is_told_and_not_nested() {
    let folder = folder_with_bar();
    let words = ["reconstruct", "bar.obj", "-o", "a.step", "--stock-length", "20", "--json"];
    let printed = run(folder.path(), &words).succeeded();
    let summary: serde_json::Value = serde_json::from_str(&printed).expect("JSON");
    let findings = summary["findings"].as_array().expect("findings");
    let stock = findings.iter().find(|f| f["kind"] == "stock").expect("a finding");
    let text = stock["text"].as_str().expect("a text");
    assert!(text.starts_with("P01 (1 of Round ") && text.contains("it is in no bar"), "{text}");
    let list = std::fs::read_to_string(folder.path().join("a.csv")).expect("a cut list");
    assert!(list.contains("P01,\"longer than a bar, not nested"), "{list}");
}

#[test]
fn the_mesh_file_beside_is_claimed_only_where_it_is_written() {
    let folder = folder_with_bar();
    let words = ["reconstruct", "bar.obj", "-o", "a.step", "--skeleton", "a.non-design.ply"];
    run(folder.path(), &words).succeeded();
    assert!(names(folder.path()).contains(&"a.non-design.ply".to_owned()));
}

#[test]
fn a_march_whose_branches_are_no_beams_says_what_to_do() {
    let folder = folder_with_bar();
    // Stretched across, the bar is a tall sheet for a march that does not turn with it.
    let text = std::fs::read_to_string(sample("single_bar.obj")).expect("a mesh");
    let stretched = |line: &str| match line.split_whitespace().collect::<Vec<_>>()[..] {
        ["v", x, y, z] => format!("v {x} {y} {z}e4\n"),
        ["f", ..] => format!("{line}\n"),
        _ => String::new(),
    };
    let text: String = text.lines().map(stretched).collect();
    std::fs::write(folder.path().join("sheet.obj"), text).expect("a file");
    let words = ["reconstruct", "sheet.obj", "-o", "a.step", "--orientation", "global"];
    let message = run(folder.path(), &words).failed(1);
    let start =
        "no beam of sheet.obj: the march found 1 branch, but none is as long as it is thick; ";
    assert_eq!(message, format!("{start}try --orientation local, which turns with the part"));
    assert_eq!(names(folder.path()), ["bar.obj", "sheet.obj"]);
}

#[test]
fn a_part_whose_design_encloses_nothing_says_what_to_do() {
    let folder = folder_with_bar();
    let mut mesh = bar().mesh(2.0);
    mesh.positions.iter_mut().for_each(|p| p[0] *= 1e-3);
    std::fs::write(folder.path().join("flat.obj"), mesh.obj()).expect("a file");
    let message = run(folder.path(), &["skeleton", "flat.obj", "-o", "a.json"]).failed(1);
    assert!(message.starts_with("no skeleton of flat.obj: the design part, "), "{message}");
    assert_eq!(names(folder.path()), ["bar.obj", "flat.obj"]);
}
