//! Lists of profiles: a table for people, JSON for programs.

use std::fmt::Write;

use serde::Serialize;

use super::{Catalogue, Entry};
use crate::section::profile::STEEL;

/// mm² per cm² and mm⁴ per cm⁴: tables of standards are in cm.
const CM2: f64 = 1e2;
const CM4: f64 = 1e4;

/// A table of profiles, 80 columns wide at most, ending in a legend.
///
/// # Examples
/// ```
/// # use beamwright::section::catalogue::{Catalogue, table};
/// let text = table(&Catalogue::builtin().search("IPE 200"));
/// assert!(text.lines().any(|line| line.starts_with("IPE 200") && line.contains("28.48")));
/// assert!(text.lines().all(|line| line.chars().count() <= 80));
/// ```
pub fn table(entries: &[&Entry]) -> String {
    let mut text = String::new();
    let mut family = None;
    for entry in entries {
        if family != Some((entry.family(), entry.standard())) {
            family = Some((entry.family(), entry.standard()));
            heading(&mut text, entry);
        }
        let p = &entry.properties;
        let cells = [p.area / CM2, p.i_xx / CM4, p.i_yy / CM4, p.j / CM4];
        let _ = write!(text, "{:<24}", cut(entry.name(), 24));
        for value in cells.into_iter().chain([entry.mass_per_metre(STEEL)]) {
            let _ = write!(text, " {:>10}", four_digits(value));
        }
        text.push('\n');
    }
    if entries.is_empty() {
        return "no profile found\n".to_owned();
    }
    let _ = writeln!(
        text,
        "\n{} {}. A in cm², I and J in cm⁴, mass in kg/m (steel).",
        entries.len(),
        if entries.len() == 1 { "profile" } else { "profiles" }
    );
    text
}

fn heading(text: &mut String, entry: &Entry) {
    if !text.is_empty() {
        text.push('\n');
    }
    let title = match entry.standard() {
        "" => entry.family().to_owned(),
        standard => format!("{}: {standard}", entry.family()),
    };
    let _ = writeln!(text, "{}", cut(&title, 80));
    let _ = write!(text, "{:<24}", "name");
    for column in ["A", "I_y", "I_z", "J", "mass"] {
        let _ = write!(text, " {column:>10}");
    }
    text.push('\n');
}

/// A table of the families of a catalogue, 80 columns wide at most.
pub fn families_table(catalogue: &Catalogue) -> String {
    let mut text = format!("{:<16} {:>8}  {}\n", "family", "profiles", "standard");
    for family in catalogue.families() {
        let _ = writeln!(
            text,
            "{:<16} {:>8}  {}",
            cut(&family.name, 16),
            family.count,
            cut(&family.standard, 53)
        );
    }
    text
}

/// The first `width` characters.
fn cut(text: &str, width: usize) -> String {
    text.chars().take(width).collect()
}

/// A number with four digits at least, in at most ten characters.
fn four_digits(value: f64) -> String {
    let decimals = (3 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 7) as usize;
    let text = format!("{value:.decimals$}");
    if text.len() > 10 { format!("{value:.3e}") } else { text }
}

/// One profile in a JSON list; lengths in mm.
#[derive(Serialize)]
struct Item<'e> {
    name: &'e str,
    family: &'e str,
    standard: &'e str,
    shape: &'static str,
    area: f64,
    i_y: f64,
    i_z: f64,
    i_1: f64,
    i_2: f64,
    j: f64,
    w_el_y: f64,
    w_el_z: f64,
    w_pl_y: f64,
    w_pl_z: f64,
    perimeter: f64,
    mass: f64,
}

/// A JSON array of profiles: sizes and properties in mm, mass in kg/m of steel.
pub fn json_listing(entries: &[&Entry]) -> String {
    let items: Vec<Item<'_>> = entries.iter().map(|entry| item(entry)).collect();
    serde_json::to_string_pretty(&items).unwrap_or_else(|_| "[]".to_owned())
}

fn item(entry: &Entry) -> Item<'_> {
    let (p, m) = (&entry.properties, entry.profile.moduli());
    Item {
        name: entry.name(),
        family: entry.family(),
        standard: entry.standard(),
        shape: entry.profile.shape.family(),
        area: p.area,
        i_y: p.i_xx,
        i_z: p.i_yy,
        i_1: p.i_1,
        i_2: p.i_2,
        j: p.j,
        w_el_y: m.w_el_y,
        w_el_z: m.w_el_z,
        w_pl_y: m.w_pl_y,
        w_pl_z: m.w_pl_z,
        perimeter: entry.profile.outer_perimeter(),
        mass: entry.mass_per_metre(STEEL),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_all_profiles_fit_eighty_columns() {
        let all = Catalogue::builtin();
        let text = table(&all.entries().iter().collect::<Vec<_>>());
        assert!(text.lines().all(|line| line.chars().count() <= 80));
        assert!(families_table(all).lines().all(|line| line.chars().count() <= 80));
    }

    #[test]
    fn json_holds_what_the_table_holds() {
        let listing = json_listing(&Catalogue::builtin().search("HEB 200"));
        let list: serde_json::Value = serde_json::from_str(&listing).unwrap();
        assert_eq!(list[0]["name"], "HEB 200");
        assert!((list[0]["i_y"].as_f64().unwrap() / 1e4 - 5696.0).abs() < 1.0);
    }

    #[test]
    fn nothing_found_says_so() {
        assert_eq!(table(&[]), "no profile found\n");
    }
}
