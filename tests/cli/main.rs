//! The manners of the program: exit codes, messages, streams, whole files, hostile input.

#[path = "../common/mod.rs"]
mod common;

mod ending;
mod hostile;
mod non_design;
mod streams;
mod unit;
mod whole_files;

use std::path::{Path, PathBuf};

use tempfile::{TempDir, tempdir};

use common::frame::bar;

/// The path of a sample.
fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name).with_extension("obj")
}

/// A folder with a labelled bar, `bar.obj`: the smallest input that runs through.
fn folder_with_bar() -> TempDir {
    let folder = tempdir().expect("a folder");
    std::fs::write(folder.path().join("bar.obj"), bar().mesh(2.0).obj()).expect("a file");
    folder
}

/// Names of the files in a folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}
