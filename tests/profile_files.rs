//! Catalogue files of users: what the documentation shows is read, what is broken is answered.

use std::path::{Path, PathBuf};

use beamwright::section::Catalogue;
use beamwright::section::catalogue::{CatalogueError, table};
use proptest::prelude::*;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The first fenced block of a language in the documentation of the format.
fn documented(language: &str) -> String {
    let text = std::fs::read_to_string(root().join("docs/profiles.md")).unwrap();
    let (_, after) = text.split_once(&format!("```{language}\n")).unwrap();
    after.split_once("```").unwrap().0.to_owned()
}

#[test]
fn documented_csv_is_read() {
    let own = Catalogue::parse_csv(&documented("csv"), "file").unwrap();
    assert_eq!(own.entries().len(), 2);
    assert_eq!(own.entries()[0].family(), "SHOP");
    assert_eq!(own.entries()[1].nominal_mass, Some(2.84));
    // The stated masses are those of the sizes.
    for entry in own.entries() {
        let mass = entry.profile.mass_per_metre(7850.0);
        assert!((mass / entry.nominal_mass.unwrap() - 1.0).abs() < 0.02, "{mass}");
    }
}

#[test]
fn documented_json_is_read() {
    let own = Catalogue::parse_json(&documented("json"), "file").unwrap();
    assert_eq!(own.entries().len(), 2);
    assert_eq!(own.entries()[1].standard(), "stock list 2024");
}

#[test]
fn files_are_read_by_their_extension() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("own.CSV"), documented("csv")).unwrap();
    std::fs::write(path("own.Json"), documented("json")).unwrap();
    assert_eq!(Catalogue::read(&path("own.CSV")).unwrap().entries().len(), 2);
    assert_eq!(Catalogue::read(&path("own.Json")).unwrap().entries().len(), 2);
}

#[test]
fn unreadable_files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.csv");
    let fault_of = |file: &Path| match Catalogue::read(file) {
        Err(CatalogueError::File { path, fault }) if path == file => *fault,
        other => panic!("{other:?}"),
    };
    assert!(matches!(fault_of(&missing), CatalogueError::Unreadable { .. }));
    assert!(Catalogue::read(folder.path()).is_err());
    let binary = folder.path().join("binary.csv");
    std::fs::write(&binary, b"name,d\nA,\xff\n").unwrap();
    assert_eq!(fault_of(&binary), CatalogueError::NotText { line: 2 });
    let large = folder.path().join("large.csv");
    std::fs::File::create(&large).unwrap().set_len(1 << 30).unwrap();
    assert!(matches!(fault_of(&large), CatalogueError::TooLarge { .. }));
}

#[test]
fn long_lists_are_read_and_joined_quickly() {
    let rows: String = (0..50_000).map(|i| format!("R{i},{}\n", 1 + i)).collect();
    let own = Catalogue::parse_csv(&format!("# shape: round\nname,d\n{rows}"), "own").unwrap();
    let mut all = Catalogue::builtin().clone();
    all.extend(own);
    assert!(all.entries().len() > 50_000);
}

fn tables() -> Vec<PathBuf> {
    let folder = std::fs::read_dir(root().join("data/profiles")).unwrap();
    let mut tables: Vec<PathBuf> = folder.map(|entry| entry.unwrap().path()).collect();
    tables.sort();
    tables
}

#[test]
fn every_data_file_is_compiled_in() {
    let count: usize =
        tables().iter().map(|path| Catalogue::read(path).unwrap().entries().len()).sum();
    assert_eq!(count, Catalogue::builtin().entries().len());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_text_is_answered(text in "\\PC{0,200}") {
        let _ = Catalogue::parse_csv(&text, "own");
        let _ = Catalogue::parse_json(&text, "own");
    }

    #[test]
    fn any_numbers_are_answered(
        shape in "round|tube|rectangle|ellipse|box|i|c|l",
        values in prop::collection::vec(prop_oneof![-1e12..1e12f64, 0.0..50.0f64, Just(f64::NAN)], 12),
    ) {
        let names = "name,shape,d,b,h,t,t_w,t_f,r,r_o,r_i,r_1,r_2";
        let values: Vec<String> = values.iter().take(11).map(f64::to_string).collect();
        let text = format!("{names}\nA,{shape},{}\n", values.join(","));
        if let Ok(own) = Catalogue::parse_csv(&text, "own") {
            let p = own.entries()[0].properties;
            prop_assert!(p.area > 0.0 && p.i_2 > 0.0 && p.j.is_finite(), "{text}{p:?}");
            table(&own.entries().iter().collect::<Vec<_>>());
        }
    }

    #[test]
    fn damaged_tables_are_answered(table in 0usize..18, at in 0.0..1.0f64, with in "\\PC{0,3}") {
        let text = std::fs::read_to_string(&tables()[table]).unwrap();
        let mut head: Vec<char> = text.chars().take(2000).collect();
        let place = (at * head.len() as f64) as usize;
        head.splice(place..(place + 2).min(head.len()), with.chars());
        let _ = Catalogue::parse_csv(&head.into_iter().collect::<String>(), "own");
    }
}
