//! Catalogues of profiles: standard tables that are compiled in, and the user's own.
//!
//! | step                              | file      |
//! |-----------------------------------|-----------|
//! | text of a CSV or JSON file to rows| `csv`, `json` |
//! | a row to a checked entry          | `row`     |
//! | the compiled-in tables            | `builtin` |
//! | tables for people and programs    | `listing` |
//!
//! The format of the files is documented in `docs/profiles.md`.

mod builtin;
mod csv;
mod error;
mod json;
mod listing;
mod row;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::OnceLock;

use super::profile::Profile;
use super::properties::SectionProperties;
pub use error::{CatalogueError, Place, RowFault};
pub use listing::{families_table, json_listing, table};

/// A list of profiles that can be ordered.
///
/// Invariant: names are unique, and every profile has a designation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Catalogue {
    entries: Vec<Entry>,
}

/// One profile of a catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The shape and its designation.
    pub profile: Profile,
    /// Its properties, computed from the shape.
    pub properties: SectionProperties,
    /// Mass per metre as the standard states it, kg/m.
    pub nominal_mass: Option<f64>,
}

/// A family of a catalogue.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Family {
    /// Its name.
    pub name: String,
    /// The standard its first profile is made to.
    pub standard: String,
    /// Profiles in it.
    pub count: usize,
}

/// Largest file that is read, bytes. The tables of all standards together have a tenth of that.
const LARGEST_FILE: u64 = 16 << 20;

impl Catalogue {
    /// The tables that come with the program.
    ///
    /// # Examples
    /// ```
    /// # use beamwright::section::Catalogue;
    /// let found = Catalogue::builtin().find("IPE 200").unwrap();
    /// assert_eq!(found.standard(), "EN 10365:2017");
    /// assert!((found.properties.i_1 / 1e4 - 1943.0).abs() < 1.0); // cm⁴
    /// ```
    pub fn builtin() -> &'static Self {
        static BUILTIN: OnceLock<Catalogue> = OnceLock::new();
        BUILTIN.get_or_init(builtin::read)
    }

    /// Reads the user's own catalogue, CSV or JSON by its extension.
    ///
    /// # Errors
    /// If the file cannot be read, is not in the documented format, or describes a profile that
    /// cannot be; the message names the file and the line.
    pub fn read(path: &Path) -> Result<Self, CatalogueError> {
        Self::of_file(path)
            .map_err(|fault| CatalogueError::File { path: path.to_owned(), fault: Box::new(fault) })
    }

    fn of_file(path: &Path) -> Result<Self, CatalogueError> {
        let failed =
            |fault: std::io::Error| CatalogueError::Unreadable { fault: fault.to_string() };
        let size = std::fs::metadata(path).map_err(failed)?.len();
        if size > LARGEST_FILE {
            return Err(CatalogueError::TooLarge { bytes: size });
        }
        let bytes = std::fs::read(path).map_err(failed)?;
        let text = utf8(&bytes)?;
        let stem = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        let is_json = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
        if is_json { Self::parse_json(text, &stem) } else { Self::parse_csv(text, &stem) }
    }

    /// Reads a catalogue from the text of a CSV file.
    ///
    /// * `family`: name of the family if the file does not give one.
    ///
    /// # Errors
    /// If the text is not in the documented format, or describes a profile that cannot be; the
    /// message names the line.
    pub fn parse_csv(text: &str, family: &str) -> Result<Self, CatalogueError> {
        Self::of_rows(csv::rows(text, family)?)
    }

    /// Reads a catalogue from the text of a JSON file.
    ///
    /// * `family`: name of the family if the file does not give one.
    ///
    /// # Errors
    /// If the text is not in the documented format, or describes a profile that cannot be; the
    /// message names the line.
    pub fn parse_json(text: &str, family: &str) -> Result<Self, CatalogueError> {
        Self::of_rows(json::rows(text, family)?)
    }

    fn of_rows(rows: Vec<row::Row>) -> Result<Self, CatalogueError> {
        let mut seen = BTreeMap::new();
        let mut entries = Vec::with_capacity(rows.len());
        for row in rows {
            let entry = row.entry()?;
            if let Some(&first) = seen.get(entry.name()) {
                let fault = RowFault::Twice { name: entry.name().to_owned(), first };
                return Err(CatalogueError::Row { place: row.place, fault });
            }
            seen.insert(entry.name().to_owned(), row.place);
            entries.push(entry);
        }
        if entries.is_empty() { Err(CatalogueError::Empty) } else { Ok(Self { entries }) }
    }

    /// All profiles, in the order of the tables.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Adds the profiles of another catalogue; those with a name already there replace it.
    pub fn extend(&mut self, other: Self) {
        let named = |(place, entry): (usize, &Entry)| (entry.name().to_owned(), place);
        let places: BTreeMap<String, usize> = self.entries.iter().enumerate().map(named).collect();
        for entry in other.entries {
            match places.get(entry.name()) {
                Some(&place) => self.entries[place] = entry,
                None => self.entries.push(entry),
            }
        }
    }

    /// The profile of a name; case, spaces and × or x do not matter.
    pub fn find(&self, name: &str) -> Option<&Entry> {
        let wanted = folded(name);
        self.entries.iter().find(|entry| folded(entry.name()) == wanted)
    }

    /// Profiles whose name, family or standard contain all words of a text, in the order of the
    /// tables; all profiles if the text is blank.
    ///
    /// # Examples
    /// ```
    /// # use beamwright::section::Catalogue;
    /// let names: Vec<_> = Catalogue::builtin().search("chs 60.3×4").iter().map(|e| e.name()).collect();
    /// assert_eq!(names, ["CHS 60.3x4"]);
    /// ```
    pub fn search(&self, text: &str) -> Vec<&Entry> {
        let words: Vec<String> = text.split_whitespace().map(folded).collect();
        let hit = |entry: &&Entry| {
            let all = [entry.name(), entry.family(), entry.standard()].map(folded);
            words.iter().all(|word| all.iter().any(|text| text.contains(word)))
        };
        self.entries.iter().filter(hit).collect()
    }

    /// The families in the order of the tables.
    pub fn families(&self) -> Vec<Family> {
        let mut families: Vec<Family> = Vec::new();
        for entry in &self.entries {
            match families.iter_mut().find(|family| family.name == entry.family()) {
                Some(family) => family.count += 1,
                None => families.push(Family {
                    name: entry.family().to_owned(),
                    standard: entry.standard().to_owned(),
                    count: 1,
                }),
            }
        }
        families
    }

    /// The part of the catalogue with the given families; all of it if there are none.
    ///
    /// # Errors
    /// If a family is not in the catalogue.
    pub fn of_families<S: AsRef<str>>(&self, names: &[S]) -> Result<Self, CatalogueError> {
        if names.is_empty() {
            return Ok(self.clone());
        }
        let known = self.families();
        let wanted: Vec<String> = names.iter().map(|name| folded(name.as_ref())).collect();
        for (name, wanted) in names.iter().zip(&wanted) {
            if !known.iter().any(|family| folded(&family.name) == *wanted) {
                return Err(CatalogueError::UnknownFamily {
                    name: name.as_ref().to_owned(),
                    known: known.iter().map(|f| f.name.clone()).collect::<Vec<_>>().join(", "),
                });
            }
        }
        let belongs = |entry: &&Entry| wanted.contains(&folded(entry.family()));
        Ok(Self { entries: self.entries.iter().filter(belongs).cloned().collect() })
    }
}

impl Entry {
    /// Name of the profile.
    pub fn name(&self) -> &str {
        self.profile.designation.as_ref().map_or("", |d| &d.name)
    }

    /// Family of the profile.
    pub fn family(&self) -> &str {
        self.profile.family()
    }

    /// Standard the profile is made to; empty if the file names none.
    pub fn standard(&self) -> &str {
        self.profile.designation.as_ref().map_or("", |d| &d.standard)
    }

    /// Mass per metre, kg/m: as the standard states it, else from the area.
    ///
    /// * `density`: kg/m³, used if the standard states no mass.
    pub fn mass_per_metre(&self, density: f64) -> f64 {
        self.nominal_mass.unwrap_or_else(|| self.profile.mass_per_metre(density))
    }
}

/// A name as it is compared: lower case, without spaces, x for ×.
fn folded(text: &str) -> String {
    let letters = text.chars().filter(|c| !c.is_whitespace());
    letters.flat_map(char::to_lowercase).map(|c| if c == '×' { 'x' } else { c }).collect()
}

fn utf8(bytes: &[u8]) -> Result<&str, CatalogueError> {
    std::str::from_utf8(bytes).map_err(|fault| {
        let before = &bytes[..fault.valid_up_to()];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        CatalogueError::NotText { line: line as u64 }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn search_takes_words_in_any_order_and_case() {
        let all = Catalogue::builtin();
        assert!(all.search("200 ipe").iter().any(|e| e.name() == "IPE 200"));
        assert!(all.search("EN 10219").iter().all(|e| e.standard().contains("10219")));
        assert!(all.search("no such thing").is_empty());
        assert_eq!(all.search("  ").len(), all.entries().len());
    }

    #[test]
    fn families_can_be_chosen_and_wrong_ones_are_named() {
        let chosen = Catalogue::builtin().of_families(&["ipe", "CHS"]).unwrap();
        assert!(chosen.entries().iter().all(|e| ["IPE", "CHS"].contains(&e.family())));
        let fault = Catalogue::builtin().of_families(&["IPE", "XYZ"]).unwrap_err();
        assert!(fault.to_string().contains("XYZ") && fault.to_string().contains("HEB"), "{fault}");
    }

    #[test]
    fn own_profile_replaces_the_one_of_its_name() {
        let mut all = Catalogue::builtin().clone();
        let count = all.entries().len();
        let own = "# family: SHOP\n# shape: round\nname,d\nIPE 200,20\nBar 21,21\n";
        all.extend(Catalogue::parse_csv(own, "own").unwrap());
        assert_eq!(all.entries().len(), count + 1);
        assert_eq!(all.find("ipe200").unwrap().family(), "SHOP");
    }
}
