//! Many meshes in one run, options from a file, and what the command line knows of itself.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name)
}

fn beamwright(folder: &Path, words: &[&str]) -> std::io::Result<Output> {
    Command::new(env!("CARGO_BIN_EXE_beamwright")).current_dir(folder).args(words).output()
}

#[test]
fn one_bad_file_does_not_stop_the_rest() -> Outcome {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("bad.obj"), "no mesh\n")?;
    let [bar, y] = [sample("single_bar.obj"), sample("y_form.obj")];
    let (bar, y) = (bar.to_string_lossy(), y.to_string_lossy());
    let words = ["reconstruct", &bar, "bad.obj", &y, "--out-dir", "out"];
    let done = beamwright(folder.path(), &words)?;
    assert_eq!(done.status.code(), Some(1));
    let error = String::from_utf8(done.stderr)?;
    let lines: Vec<&str> = error.lines().collect();
    let [first, last] = lines[..] else { panic!("{error}") };
    assert!(first.starts_with("error: cannot read bad.obj: "), "{error}");
    assert_eq!(first.matches("bad.obj").count(), 1, "{error}");
    assert_eq!(last, "error: 1 of 3 meshes failed: bad.obj");
    for name in ["single_bar.step", "single_bar.csv", "y_form.step", "y_form.skeleton.json"] {
        assert!(folder.path().join("out").join(name).is_file(), "{name}");
    }
    Ok(())
}

#[test]
fn two_meshes_of_one_name_are_refused_before_any_work() -> Outcome {
    let folder = tempfile::tempdir()?;
    let bar = sample("single_bar.obj");
    let bar = bar.to_string_lossy();
    std::fs::create_dir(folder.path().join("old"))?;
    std::fs::copy(&*bar, folder.path().join("old/single_bar.obj"))?;
    let words = ["reconstruct", &bar, "old/single_bar.obj", "--out-dir", "out"];
    let done = beamwright(folder.path(), &words)?;
    assert_eq!(done.status.code(), Some(2));
    let error = String::from_utf8(done.stderr)?;
    let both = format!("error: {bar} and old/single_bar.obj would both be written to ");
    assert!(error.starts_with(&both) && error.lines().count() == 1, "{error}");
    assert!(!folder.path().join("out").exists());
    Ok(())
}

/// All outputs of `reconstruct`, by their endings.
const ENDINGS: [&str; 14] = [
    "--cut-list",
    ".json",
    "--skeleton",
    ".skeleton.ply",
    "--sections",
    ".csv",
    "--export",
    ".glb",
    "--export",
    ".dxf",
    "--picture",
    ".svg",
    "--report",
    ".html",
];

#[test]
fn an_output_given_by_its_ending_goes_beside_the_step_file() -> Outcome {
    let folder = tempfile::tempdir()?;
    let [bar, y] = [sample("single_bar.obj"), sample("y_form.obj")];
    let (bar, y) = (bar.to_string_lossy(), y.to_string_lossy());
    let one = ["reconstruct", &bar, "-q", "-o", "v1.2.step"];
    let many = ["reconstruct", &bar, &y, "-q", "--out-dir", "out"];
    for words in [&one[..], &many] {
        let done = beamwright(folder.path(), &[words, &ENDINGS].concat())?;
        assert!(done.status.success(), "{done:?}");
    }
    let endings = ENDINGS.iter().filter_map(|word| word.strip_prefix('.')).chain(["step"]);
    for ending in endings {
        for stem in ["v1.2", "out/single_bar", "out/y_form"] {
            let name = format!("{stem}.{ending}");
            assert!(folder.path().join(&name).is_file(), "{name}");
        }
    }
    assert_eq!(std::fs::read_dir(folder.path().join("out"))?.count(), 16);
    Ok(())
}

#[test]
fn a_second_mesh_without_a_folder_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let bar = sample("single_bar.obj");
    let words = ["reconstruct", &bar.to_string_lossy(), "b.obj", "-o", "a.step"];
    let done = beamwright(folder.path(), &words)?;
    assert_eq!(done.status.code(), Some(2));
    assert!(String::from_utf8(done.stderr)?.contains("--out-dir"));
    assert_eq!(std::fs::read_dir(folder.path())?.count(), 0);
    Ok(())
}

#[test]
fn one_file_for_many_meshes_is_refused_before_any_work() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (option, file, ending) in [
        ("--report", "r.html", ".html"),
        ("--picture", "png", ".png"),
        ("--export", "./.glb", ".glb"),
        ("--cut-list", "lists/all.csv", ".csv"),
    ] {
        let words = ["reconstruct", "a.obj", "b.obj", "--out-dir", "out", option, file];
        let done = beamwright(folder.path(), &words)?;
        assert_eq!(done.status.code(), Some(2), "{file}");
        let error = String::from_utf8(done.stderr)?;
        let told = format!(
            "error: {option} {file} is one file for many meshes: with --out-dir give its ending \
             alone, {option} {ending}\n"
        );
        assert_eq!(error, told);
    }
    for (words, told) in [
        (["--picture", ".jpg"], "error: the picture out/a.jpg must end in .png or .svg\n"),
        (["--sections", ".csv"], "error: two outputs of a.obj would be written to out/a.csv\n"),
    ] {
        let batch = ["reconstruct", "a.obj", "b.obj", "--out-dir", "out"];
        let done = beamwright(folder.path(), &[&batch[..], &words].concat())?;
        assert_eq!(done.status.code(), Some(2), "{words:?}");
        assert_eq!(String::from_utf8(done.stderr)?, told);
    }
    assert!(!folder.path().join("out").exists());
    Ok(())
}

#[test]
fn options_written_to_a_file_give_the_same_result_when_read() -> Outcome {
    let folder = tempfile::tempdir()?;
    let bar = sample("single_bar.obj");
    let bar = bar.to_string_lossy();
    let typed = ["--profile", "rectangle", "--joints", "trim", "--material", "S355"];
    let mut words = vec!["reconstruct", &bar, "-o", "a.step"];
    words.extend(typed);
    assert!(beamwright(folder.path(), &words)?.status.success());
    words.extend(["--write-config", "shop.toml"]);
    assert!(beamwright(folder.path(), &words)?.status.success());
    let words = ["reconstruct", &bar, "-o", "b.step", "--config", "shop.toml"];
    assert!(beamwright(folder.path(), &words)?.status.success());
    let read = |name: &str| std::fs::read(folder.path().join(name));
    assert_eq!(read("a.csv")?, read("b.csv")?);
    assert!(String::from_utf8(read("b.csv")?)?.contains("S355"));
    // What is typed counts more than the file.
    let words = ["reconstruct", &bar, "-o", "c.step", "--config", "shop.toml", "--material", "X"];
    assert!(beamwright(folder.path(), &words)?.status.success());
    assert!(!String::from_utf8(read("c.csv")?)?.contains("S355"));
    Ok(())
}

/// Words that set options of a command to other values than their own.
const CHOSEN: [(&str, &str); 5] = [
    (
        "reconstruct in.obj -o out.step --unit cm --non-design-box -1,-2,-3,1,2,3 \
         --non-design-name pad* --orientation global --step 1.5 --width-ratio 1.4 \
         --max-deviation 0.7 --continuous --profile catalogue:CHS,IPE --match area --loft taper \
         --joints trim --max-profiles 3 --catalogue own.csv --material S355 \
         --elastic-modulus 70000 --poisson 0.33 --stock-length 6000 --kerf 3 --no-non-design \
         --density 2700 --json --strict --report .html --picture .png --picture .svg",
        "verbose",
    ),
    ("skeleton in.obj -o out.json --unit in --step 2.0 --orientation global --json", "quiet"),
    (
        "evaluate in.obj s.json --skeleton-unit m --post-process=cut --resample 2 --cube 3.5 \
         --sphere box --strict",
        "quiet",
    ),
    ("inspect in.obj --unit m --non-design-box 0,0,0,1,1,1 --json", "verbose"),
    ("profiles --family CHS,IPE --json --catalogue own.csv", "quiet"),
];

#[test]
fn every_option_stands_in_the_file_and_comes_back() -> Outcome {
    // What one run reads and writes is no part of a file for many.
    let of_one_run = "config write-config output out-dir compare non-design help version";
    let folder = tempfile::tempdir()?;
    for (words, global) in CHOSEN {
        let flag = format!("--{global}");
        let words: Vec<&str> = words.split_whitespace().collect();
        let write = |options: &[&str], file: &str| {
            let words = [options, &["--write-config", file]].concat();
            beamwright(folder.path(), &words).map(|done| assert!(done.status.success(), "{done:?}"))
        };
        write(&[&words[..], &[&flag, "--progress", "json"]].concat(), "a.toml")?;
        let first = std::fs::read_to_string(folder.path().join("a.toml"))?;
        let help = beamwright(folder.path(), &[words[0], "--help"])?;
        for option in long_options(&String::from_utf8(help.stdout)?) {
            let named =
                |line: &str| line.trim_start_matches("# ").starts_with(&format!("{option} ="));
            let is_listed = first.lines().any(named);
            let is_of_one_run = of_one_run.split_whitespace().any(|o| o == option);
            assert!(is_listed || is_of_one_run, "{}: {option}", words[0]);
        }
        let inputs = words.iter().take_while(|w| !w.starts_with("--")).copied();
        let again: Vec<&str> = inputs.chain(["--config", "a.toml"]).collect();
        write(&again, "b.toml")?;
        assert_eq!(std::fs::read_to_string(folder.path().join("b.toml"))?, first, "{}", words[0]);
    }
    Ok(())
}

/// Names of the long options in a help text.
fn long_options(help: &str) -> Vec<String> {
    let named = |line: &str| {
        let line = line.trim_start();
        let option = line.strip_prefix("--").or_else(|| line.get(4..)?.strip_prefix("--"))?;
        line.starts_with('-').then(|| option.split([' ', '=', '[']).next().unwrap_or("").to_owned())
    };
    help.lines().filter_map(named).collect()
}

#[test]
fn what_is_wrong_with_an_option_of_a_file_is_told_with_its_line() -> Outcome {
    let folder = tempfile::tempdir()?;
    let bar = sample("single_bar.obj");
    let bar = bar.to_string_lossy();
    let told = |text: &str, more: &[&str]| -> Result<String, Box<dyn std::error::Error>> {
        std::fs::write(folder.path().join("a.toml"), text)?;
        let words = ["reconstruct", &bar, "-o", "x.step", "--config", "a.toml"];
        let done = beamwright(folder.path(), &[&words[..], more].concat())?;
        assert_eq!(done.status.code(), Some(2), "{text}");
        Ok(String::from_utf8(done.stderr)?)
    };
    for (text, fault) in [
        ("profil = \"round\"\n", "line 1: there is no option profil"),
        ("# ours\n\nstrict = true\nstep = 5\n", "line 4: --step must lie in [0.1, 2], but is 5"),
        ("step = 1\n\nkerf = = 1\n", "line 3: "),
        ("\nkerf = -1\n", "line 2: --kerf must be"),
        ("json = true\nstep = \"x\"", "line 2: invalid value 'x' for '--step <RADII>'"),
        ("joints = \"weld\"\nstep = 1", "line 1: invalid value 'weld' for '--joints"),
        ("\nstrict = 1", "line 2: the option strict is true or false"),
    ] {
        let error = told(text, &[])?;
        let wanted = format!("error: cannot use the options of a.toml: {fault}");
        assert!(error.starts_with(&wanted), "{text}: {error}");
    }
    // What was typed is not the fault of the file.
    assert!(told("step = 1", &["--step", "5"])?.starts_with("error: --step must lie"));
    Ok(())
}

#[test]
fn completions_and_manual_pages_are_printed() -> Outcome {
    let folder = tempfile::tempdir()?;
    for shell in ["bash", "zsh", "fish"] {
        let done = beamwright(folder.path(), &["completions", shell])?;
        assert!(done.status.success() && done.stdout.len() > 1000, "{shell}");
    }
    let page = beamwright(folder.path(), &["man", "reconstruct"])?;
    let page = String::from_utf8(page.stdout)?;
    assert!(page.contains(".SH SYNOPSIS"));
    // An example is a line of its own, to be copied.
    let example = "\\&beamwright reconstruct part.obj \\-o part.step\n";
    assert!(page.contains(".SH \"EXAMPLES\"\n.nf\n") && page.contains(example), "{page}");
    assert_eq!(beamwright(folder.path(), &["man", "nothing"])?.status.code(), Some(2));
    Ok(())
}
