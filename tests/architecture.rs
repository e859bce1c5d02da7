//! The table of `docs/architecture.md` says which folder may use which; the code keeps to it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// What each folder of `src` may use, by the rows of the table that name one.
fn allowed() -> BTreeMap<String, BTreeSet<String>> {
    let page = fs::read_to_string("docs/architecture.md").unwrap();
    let row = |line: &str| {
        let [_, folder, _, uses, _] = line.split('|').collect::<Vec<_>>()[..] else { return None };
        let folder = folder.trim().strip_prefix("`src/")?.strip_suffix("/`")?;
        let uses = uses.split('`').skip(1).step_by(2).map(str::to_owned);
        Some((folder.to_owned(), uses.collect()))
    };
    page.lines().filter_map(row).collect()
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let below = |path: PathBuf| if path.is_dir() { sources(&path) } else { vec![path] };
    entries.flat_map(below).filter(|path| path.extension().is_some_and(|e| e == "rs")).collect()
}

/// The modules at the top of the crate that a file names outside of its tests and comments.
fn used(file: &Path) -> BTreeSet<String> {
    let text = fs::read_to_string(file).unwrap();
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let named = lines.flat_map(|line| line.split("crate::").skip(1));
    let is_of_a_name = |c: &char| c.is_alphanumeric() || *c == '_';
    named.map(|rest| rest.chars().take_while(is_of_a_name).collect()).collect()
}

#[test]
fn folders_use_only_what_the_page_says() {
    let allowed = allowed();
    assert!(allowed.len() > 8, "the table is gone: {allowed:?}");
    let mut astray = Vec::new();
    for (folder, uses) in allowed.iter().filter(|(folder, _)| *folder != "cli") {
        let is_shared = |name: &String| Path::new("src").join(name).with_extension("rs").is_file();
        for file in sources(&Path::new("src").join(folder)) {
            if file.ends_with("tests.rs") {
                continue;
            }
            for name in used(&file) {
                let is_above = ["pipeline", "cli"].contains(&name.as_str());
                let may = name == *folder || uses.contains(&name) || is_shared(&name);
                if is_above || !may {
                    astray.push(format!("{} uses {name}", file.display()));
                }
            }
        }
    }
    assert!(astray.is_empty(), "{}", astray.join("\n"));
}

#[test]
fn every_folder_is_in_the_page() {
    let allowed = allowed();
    for entry in fs::read_dir("src").unwrap().map(|entry| entry.unwrap().path()) {
        let name = entry.file_name().unwrap().to_string_lossy().into_owned();
        assert!(!entry.is_dir() || allowed.contains_key(&name), "{name} has no row");
    }
}

#[test]
fn use_goes_one_way() {
    let allowed = allowed();
    let mut settled: BTreeSet<&String> = BTreeSet::new();
    while settled.len() < allowed.len() {
        let rests = |uses: &BTreeSet<String>| {
            uses.iter().all(|used| !allowed.contains_key(used) || settled.contains(used))
        };
        let next = allowed.iter().find(|(name, uses)| !settled.contains(name) && rests(uses));
        settled.insert(next.unwrap_or_else(|| panic!("a circle beyond {settled:?}")).0);
    }
}
