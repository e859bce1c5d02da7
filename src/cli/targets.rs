//! Checks of output files before the work begins, and the common end of all that write.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use beamwright::observer::{Observer, Stage};
use beamwright::output::{OutputFiles, check_target};

use super::args::InputArgs;
use super::exit::{Exit, Failure};
use super::progress::Progress;

/// Whether every target can be written, none is named twice, and none is read.
pub(crate) fn check<'a>(
    targets: impl IntoIterator<Item = &'a Path>,
    input: &InputArgs,
    read: &[PathBuf],
) -> Result<(), Failure> {
    let inputs = || std::iter::once(&input.input).chain(&input.non_design).chain(read);
    let mut places = Vec::new();
    for target in targets {
        check_target(target).map_err(Failure::input)?;
        let place = place(target);
        let shown = target.display();
        if inputs().any(|i| i.canonicalize().is_ok_and(|i| i == place || is_one_file(&i, &place))) {
            return Err(Failure::usage(format!("the output {shown} is an input file")));
        }
        if places.contains(&place) {
            return Err(Failure::usage(format!("two outputs would be written to {shown}")));
        }
        places.push(place);
    }
    Ok(())
}

/// Where a path leads: two ways to name a file have one place.
fn place(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| {
        let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize().unwrap_or_default();
        folder.join(path.file_name().unwrap_or(OsStr::new("")))
    })
}

/// Whether two names are those of one file (hard links).
#[cfg(unix)]
fn is_one_file(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |path: &Path| path.metadata().ok().map(|m| (m.dev(), m.ino()));
    id(a).is_some_and(|a| id(b) == Some(a))
}

/// Whether two names are those of one file: the standard library cannot tell here.
#[cfg(not(unix))]
fn is_one_file(_: &Path, _: &Path) -> bool {
    false
}

/// Puts files in their places, unless the user asked to stop.
pub(crate) fn commit(files: OutputFiles, progress: &mut Progress) -> Result<(), Failure> {
    if progress.progress(Stage::Write, 0, 1).is_break() {
        return Err(Failure { exit: Exit::Interrupted, message: "interrupted".into() });
    }
    let names: Vec<String> = files.paths().map(|p| p.display().to_string()).collect();
    files.commit().map_err(Failure::input)?;
    names.iter().for_each(|name| progress.note(&format!("wrote {name}")));
    let _ = progress.progress(Stage::Write, 1, 1);
    Ok(())
}
