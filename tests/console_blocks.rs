//! Every console block of the pages, typed into a shell in a folder with the samples: what the
//! program prints is what stands there.
//!
//! ````text
//! ```console
//! $ beamwright inspect samples/cantilever.obj      typed; a pipe or a pattern is the shell's
//! input       cantilever.obj                       printed; [..] stands for anything in a line
//! ```
//! ````
//!
//! With `BEAMWRIGHT_RENEW=1` the pages are written anew instead, and the difference is for `git
//! diff` to show.

#![cfg(unix)]

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

type Result<T = ()> = std::result::Result<T, Box<dyn Error>>;

#[test]
fn pages_show_what_the_program_prints() -> Result {
    let renew = std::env::var_os("BEAMWRIGHT_RENEW").is_some();
    let (mut commands, mut stale) = (0, Vec::new());
    for page in pages()? {
        let text = fs::read_to_string(&page)?;
        let folder = tempfile::tempdir()?;
        std::os::unix::fs::symlink(fs::canonicalize("samples")?, folder.path().join("samples"))?;
        let (renewed, count) = renewed(&text, |typed| printed(folder.path(), typed))?;
        commands += count;
        if renewed == text {
            continue;
        }
        if renew {
            fs::write(&page, renewed)?;
        } else {
            stale.push(format!("{}:\n{}", page.display(), first_difference(&text, &renewed)));
        }
    }
    assert!(commands > 0, "no page shows a command");
    let how = "BEAMWRIGHT_RENEW=1 cargo test --test console_blocks";
    assert!(stale.is_empty(), "{}\nto renew the pages: {how}", stale.join("\n"));
    Ok(())
}

/// The README and everything in the folder of pages.
fn pages() -> Result<Vec<PathBuf>> {
    let mut pages = vec![PathBuf::from("README.md")];
    for entry in fs::read_dir("docs")? {
        let path = entry?.path();
        if path.extension().is_some_and(|e| e == "md") {
            pages.push(path);
        }
    }
    pages.sort();
    Ok(pages)
}

/// A page with what its commands print now, and the number of its commands. Lines that agree with
/// what stands there keep their `[..]`.
fn renewed(page: &str, run: impl Fn(&str) -> Result<String>) -> Result<(String, usize)> {
    let (mut text, mut count) = (String::new(), 0);
    let mut lines = page.lines().peekable();
    let mut inside = false;
    while let Some(line) = lines.next() {
        text += &format!("{line}\n");
        inside = if inside { line != "```" } else { line == "```console" };
        let Some(typed) = line.strip_prefix("$ ").filter(|_| inside) else { continue };
        let mut shown = Vec::new();
        while let Some(line) = lines.next_if(|l| *l != "```" && !l.starts_with("$ ")) {
            shown.push(line);
        }
        count += 1;
        for (i, printed) in run(typed)?.lines().enumerate() {
            let kept = shown.get(i).filter(|shown| agrees(shown, printed));
            text += &format!("{}\n", kept.unwrap_or(&printed));
        }
    }
    Ok((text, count))
}

/// Both streams of a command that a shell runs, spaces at line ends aside; it must end well.
fn printed(folder: &Path, typed: &str) -> Result<String> {
    let program = Path::new(env!("CARGO_BIN_EXE_beamwright"));
    let folders = [program.parent().unwrap_or(program).to_owned()];
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(folders.into_iter().chain(std::env::split_paths(&path)))?;
    let output = Command::new("sh")
        .args(["-c", &format!("exec 2>&1; {typed}")])
        .current_dir(folder)
        .env("PATH", path)
        .output()?;
    let text = String::from_utf8(output.stdout)?;
    if !output.status.success() {
        return Err(format!("`{typed}` failed:\n{text}").into());
    }
    Ok(text.lines().map(|line| format!("{}\n", line.trim_end())).collect())
}

/// Whether a printed line is the one shown, where `[..]` stands for anything.
fn agrees(shown: &str, printed: &str) -> bool {
    let Some((begin, rest)) = shown.split_once("[..]") else { return shown == printed };
    let Some(mut left) = printed.strip_prefix(begin) else { return false };
    let mut parts: Vec<&str> = rest.split("[..]").collect();
    let end = parts.pop().unwrap_or_default();
    for part in parts {
        let Some(at) = left.find(part) else { return false };
        left = &left[at + part.len()..];
    }
    left.ends_with(end)
}

fn first_difference(page: &str, renewed: &str) -> String {
    let (mut old, mut new) = (page.lines(), renewed.lines());
    let mut number = 0;
    loop {
        number += 1;
        match (old.next(), new.next()) {
            (a, b) if a == b && a.is_some() => {}
            (a, b) => {
                let line = |l: Option<&str>| l.unwrap_or("(the end)").to_owned();
                return format!(
                    "  line {number} shows   {}\n  but printed is {}",
                    line(a),
                    line(b)
                );
            }
        }
    }
}

#[test]
fn a_line_agrees_but_for_what_is_left_open() {
    assert!(agrees("read [..] s of [..] s", "read 0.12 s of 3 s"));
    assert!(agrees("plain", "plain") && !agrees("plain", "plain "));
    assert!(!agrees("read [..] s", "read 0.12 ms or"));
}

#[test]
fn blocks_are_renewed_and_the_rest_is_left_alone() -> Result {
    let page = "# A\n```console\n$ one\nold\n$ two\nkept [..]\n```\n$ no command\n";
    let (text, count) = renewed(page, |typed| Ok(format!("kept by {typed}\n")))?;
    assert_eq!(text, "# A\n```console\n$ one\nkept by one\n$ two\nkept [..]\n```\n$ no command\n");
    assert_eq!(count, 2);
    Ok(())
}
