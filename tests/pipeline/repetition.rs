//! The same input gives the same bytes, run after run, with any number of threads.

use std::collections::BTreeMap;
use std::path::Path;

use tempfile::tempdir;

use crate::common::program::command;

/// Every output of a run in a folder of its own, by name; standard output as well.
fn outputs(sample: &str, threads: &str) -> BTreeMap<String, Vec<u8>> {
    let folder = tempdir().expect("a folder");
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    let ran = command(folder.path())
        .arg("reconstruct")
        .arg(samples.join(sample).with_extension("obj"))
        .args(["-o", "out.step", "--skeleton", "out.json", "--cut-list", "out.csv"])
        .args(["--export", "out.mlp", "--json"])
        .env("RAYON_NUM_THREADS", threads)
        .output()
        .expect("the program starts");
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let mut all = BTreeMap::from([("standard output".to_owned(), ran.stdout)]);
    for entry in std::fs::read_dir(folder.path()).expect("the folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        all.insert(name, std::fs::read(path).expect("an output"));
    }
    all
}

#[test]
fn two_runs_with_one_or_two_threads_write_the_same_bytes() {
    for sample in ["cantilever", "four_fixings", "single_bar", "y_form"] {
        let first = outputs(sample, "1");
        assert!(first.len() >= 9, "{:?}", first.keys());
        for threads in ["1", "2"] {
            let again = outputs(sample, threads);
            assert!(first.keys().eq(again.keys()));
            for (name, bytes) in &first {
                assert!(*bytes == again[name], "{sample}: {name} differs, {threads} thread(s)");
            }
        }
    }
}
