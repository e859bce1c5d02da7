//! Parts of a size that tells of another unit, and parts too small for any file.

use std::path::Path;

use serde_json::Value;

use crate::common::frame::bar;
use crate::common::program::run;
use crate::names;

/// A folder with the bar of 62 mm in another unit, so that its numbers are `factor` times as large.
fn folder_with(factor: f64) -> tempfile::TempDir {
    let mut mesh = bar().mesh(2.0);
    mesh.positions.iter_mut().flatten().for_each(|x| *x *= factor);
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("bar.obj"), mesh.obj()).expect("a file");
    folder
}

/// What is said about the unit, and the line of the bar in the cut list.
fn reconstructed(folder: &Path, more: &[&str]) -> (Vec<String>, Value) {
    let words = ["reconstruct", "bar.obj", "-o", "a.step", "--cut-list", ".json", "--json"];
    let printed = run(folder, &[&words, more].concat()).succeeded();
    let summary: Value = serde_json::from_str(&printed).expect("JSON");
    let findings = summary["findings"].as_array().expect("findings").iter();
    let units = findings.filter(|f| f["kind"] == "unit").filter_map(|f| f["text"].as_str());
    let list = std::fs::read_to_string(folder.join("a.json")).expect("a cut list");
    let list: Value = serde_json::from_str(&list).expect("JSON");
    (units.map(String::from).collect(), list["pieces"][0].clone())
}

#[test]
fn a_part_in_metres_without_its_unit_is_told_and_its_cut_list_is_not_nought() {
    let folder = folder_with(1e-3);
    let (told, small) = reconstructed(folder.path(), &[]);
    let [told] = told.as_slice() else { panic!("{told:?}") };
    assert!(told.starts_with("the part is 0.0"), "{told}");
    assert!(told.ends_with(" mm across: is the file in metres? --unit m"), "{told}");
    let (told, right) = reconstructed(folder.path(), &["--unit", "m"]);
    assert!(told.is_empty(), "{told:?}");
    for (value, power) in
        [("length_mm", 1), ("area_mm2", 2), ("unit_surface_m2", 2), ("unit_mass_kg", 3)]
    {
        let [small, right] = [&small, &right].map(|p| p[value].as_f64().expect("a number"));
        let ratio = small / right * 1e3f64.powi(power);
        // Two digits at least.
        assert!((ratio - 1.0).abs() < 0.05, "{value}: {small} and {right}");
    }
    let printed = run(folder.path(), &["inspect", "bar.obj"]).succeeded();
    assert!(printed.contains("--unit m") && !printed.contains(" 0 mm³"), "{printed}");
}

#[test]
fn a_part_of_kilometres_is_told() {
    let folder = folder_with(1.0);
    assert!(reconstructed(folder.path(), &[]).0.is_empty());
    let folder = folder_with(2e3);
    let (told, _) = reconstructed(folder.path(), &[]);
    assert!(told.iter().any(|t| t.contains(" m across: ")), "{told:?}");
}

#[test]
fn a_part_too_small_for_a_solid_is_told_with_what_to_do() {
    let folder = folder_with(1e-7);
    let message = run(folder.path(), &["reconstruct", "bar.obj", "-o", "a.step"]).failed(1);
    let start = "cannot build bar.obj: no beam can be built as a solid; B001 ";
    let end = " mm thick, and CAD programs take lengths below 1e-5 mm for nothing; scale the part, or \
               tell the unit of the file with --unit";
    assert!(message.starts_with(start) && message.ends_with(end), "{message}");
    assert_eq!(names(folder.path()), ["bar.obj"]);
}

#[test]
fn a_part_of_a_scale_that_no_number_measures_is_told() {
    for (factor, across) in [(1e-160, "e-159"), (1e160, "e161"), (1e300, "e301")] {
        let folder = folder_with(factor);
        let message = run(folder.path(), &["reconstruct", "bar.obj", "-o", "a.step"]).failed(1);
        let end = format!(
            "{across} mm wide, and only parts from 1e-30 to 1e30 mm can be measured; scale it, or \
             remove the points that lie far out"
        );
        assert!(message.starts_with("cannot use bar.obj: the part is "), "{message}");
        assert!(message.ends_with(&end), "{message}");
        assert_eq!(names(folder.path()), ["bar.obj"]);
    }
}
