//! Writes documents of every kind, with what a CAD kernel must find in them.
//!
//! With `BEAMWRIGHT_STEP_OUT` set to a folder, each document of the family goes
//! there as `NAME.step`, beside `NAME.json` with the expected tree, names,
//! colours, placements, volumes and properties; `tests/occt/check_step.py`
//! compares the two through OCCT.  Without it, writing alone is tested.

mod step_family;

use std::fmt::Write as _;
use std::path::PathBuf;

use beamwright::output::step::{self, Body, Document, EndCut, Group, Loft, Part, Value};
use beamwright::section::Outline;
use step_family::{Case, cases};

#[test]
fn documents_of_every_kind_are_written() {
    let folder = std::env::var_os("BEAMWRIGHT_STEP_OUT").map(PathBuf::from);
    for Case { name, document } in cases() {
        let mut text = Vec::new();
        step::write(&document, &mut text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(text.is_ascii() && text.ends_with(b"END-ISO-10303-21;\n"));
        if let Some(folder) = &folder {
            std::fs::create_dir_all(folder).unwrap();
            std::fs::write(folder.join(format!("{name}.step")), text).unwrap();
            std::fs::write(folder.join(format!("{name}.json")), expectation(&document)).unwrap();
        }
    }
}

/// What OCCT must find, as JSON.
fn expectation(document: &Document) -> String {
    let mut parts = Vec::new();
    for group in &document.groups {
        list(group, &mut vec![&document.name], &mut parts);
    }
    format!("{{\"parts\": [\n{}\n]}}\n", parts.join(",\n"))
}

fn list<'d>(group: &'d Group, path: &mut Vec<&'d str>, parts: &mut Vec<String>) {
    path.push(&group.name);
    parts.extend(group.parts.iter().map(|part| expected_part(part, path)));
    for below in &group.groups {
        list(below, path, parts);
    }
    path.pop();
}

fn expected_part(part: &Part, path: &[&str]) -> String {
    let path: Vec<String> = path.iter().map(|name| quoted(name)).collect();
    let volume = part.body.volume().unwrap();
    let matrix: Vec<String> =
        part.placement.to_homogeneous().transpose().iter().take(12).map(f64::to_string).collect();
    let mut properties = String::new();
    for (i, property) in part.properties.iter().enumerate() {
        let comma = if i > 0 { ", " } else { "" };
        let value = match &property.value {
            Value::Text(text) => quoted(text),
            Value::Count(n) => n.to_string(),
            Value::Length(x)
            | Value::Area(x)
            | Value::Volume(x)
            | Value::Mass(x)
            | Value::Degrees(x)
            | Value::Number(x) => x.to_string(),
        };
        write!(properties, "{comma}{}: {value}", quoted(&property.name)).unwrap();
    }
    format!(
        "{{\"name\": {}, \"product\": {}, \"path\": [{}], \"colour\": {:?}, \"volume\": {volume:?}, \
         \"accuracy\": {:e}, \"placement\": [{}], \"properties\": {{{properties}}}}}",
        quoted(&part.name),
        quoted(&part.product),
        path.join(", "),
        part.colour,
        accuracy(&part.body),
        matrix.join(", "),
    )
}

/// How well OCCT's volume can be expected to agree with the formula.
///
/// OCCT interpolates the edges of saddles on thicker members, and of oblique cuts in the parameters
/// of a cone or of a bore off the axis, and integrates up to that; everything
/// else agrees to rounding.  Corners of a mesh are off their planes by single precision.
fn accuracy(body: &Body) -> f64 {
    match body {
        Body::Loft(loft) if is_fish_mouth(loft) => 1e-9,
        Body::Loft(loft) if has_saddle(loft) || has_oblique_cone(loft) => 1e-6,
        Body::Facets(facets) if facets.corners.iter().any(|p| p.x.fract() != 0.0) => 1e-6,
        _ => 1e-9,
    }
}

fn has_saddle(loft: &Loft) -> bool {
    [loft.start, loft.end].iter().any(|cut| matches!(cut, EndCut::Saddle(_)))
}

/// Whether the edges of a bar with saddles are ellipses.
fn is_fish_mouth(loft: &Loft) -> bool {
    let station = &loft.stations[0];
    let Outline::Circle { radius: own, .. } = station.outer else { return false };
    has_saddle(loft)
        && station.holes.is_empty()
        && [loft.start, loft.end].iter().all(|cut| match cut {
            EndCut::Saddle(saddle) => saddle.radius == own,
            _ => true,
        })
}

fn has_oblique_cone(loft: &Loft) -> bool {
    let oblique = [loft.start, loft.end].iter().any(|cut| *cut != EndCut::Square);
    let (first, last) = (&loft.stations[0], &loft.stations[loft.stations.len() - 1]);
    let off_axis =
        |hole: &Outline| matches!(hole, Outline::Circle { centre, .. } if centre.x != 0.0);
    let cone = matches!(first.outer, Outline::Circle { .. }) && first.outer != last.outer;
    oblique && (cone || first.holes.iter().any(off_axis))
}

/// A JSON string.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            ' '..='~' => out.push(c),
            _ => {
                let mut units = [0; 2];
                for unit in c.encode_utf16(&mut units) {
                    write!(out, "\\u{unit:04x}").unwrap();
                }
            }
        }
    }
    out.push('"');
    out
}
