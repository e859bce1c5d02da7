//! Rows of a JSON catalogue: `{ "family": …, "profiles": [ { "name": …, "d": … } ] }`.

use std::collections::BTreeMap;

use serde_json::{Map, Value};

use super::error::{CatalogueError, Place, RowFault};
use super::row::Row;

/// The rows of a file.
pub(super) fn rows(text: &str, family: &str) -> Result<Vec<Row>, CatalogueError> {
    let text = text.trim_start_matches('\u{feff}');
    let value: Value = serde_json::from_str(text).map_err(|fault| CatalogueError::Json {
        line: fault.line() as u64,
        fault: fault.to_string(),
    })?;
    let Value::Object(file) = value else { return Err(CatalogueError::Empty) };
    let Some(Value::Array(profiles)) = file.get("profiles") else {
        return Err(CatalogueError::Empty);
    };
    let mut shared = BTreeMap::from([("family".to_owned(), family.to_owned())]);
    add_values(&mut shared, &file, Place::Profile(0))?;
    let numbered = profiles.iter().zip(1..);
    numbered
        .map(|(profile, number)| {
            let place = Place::Profile(number);
            let Value::Object(profile) = profile else {
                let fault = RowFault::Name { text: String::new() };
                return Err(CatalogueError::Row { place, fault });
            };
            let mut values = shared.clone();
            add_values(&mut values, profile, place)?;
            Ok(Row { place, values })
        })
        .collect()
}

fn add_values(
    values: &mut BTreeMap<String, String>,
    object: &Map<String, Value>,
    place: Place,
) -> Result<(), CatalogueError> {
    for (key, value) in object {
        let key = key.to_lowercase();
        let text = match value {
            Value::String(text) if key == "shape" || key == "unit" => text.trim().to_lowercase(),
            Value::String(text) => text.trim().to_owned(),
            Value::Number(number) => number.to_string(),
            Value::Null => continue,
            Value::Array(_) if key == "profiles" => continue,
            other => {
                let text = other.to_string().chars().take(40).collect();
                let fault = RowFault::NotANumber { column: key, text };
                return Err(CatalogueError::Row { place, fault });
            }
        };
        if !text.is_empty() {
            values.insert(key, text);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::Catalogue;

    #[test]
    fn values_of_the_file_hold_for_all_its_profiles() {
        let text = r#"{ "family": "BAR", "shape": "Round", "unit": "cm",
                        "profiles": [ { "name": "R20", "d": 2 }, { "name": "R30", "d": "3" } ] }"#;
        let own = Catalogue::parse_json(text, "own").unwrap();
        assert_eq!(own.entries().len(), 2);
        assert_eq!(own.entries()[1].family(), "BAR");
        assert!((own.entries()[1].properties.reach - 15.0).abs() < 1e-9);
    }

    #[test]
    fn faults_name_their_line_or_profile() {
        let fault = |text: &str| Catalogue::parse_json(text, "own").unwrap_err().to_string();
        assert!(fault("{\n \"profiles\": [,]").starts_with("line 2: malformed JSON"));
        let unknown = r#"{"shape": "round", "profiles": [{"name": "A", "d": 3}, {"name": "B"}]}"#;
        assert_eq!(fault(unknown), "profile 2: no d, which round needs");
        assert_eq!(
            fault("[]"),
            "it has no profiles: a .csv lists them one a line below its header, a .json in `profiles`"
        );
        let nested = r#"{"profiles": [{"name": "A", "d": [3]}]}"#;
        assert_eq!(fault(nested), "profile 1: d must be a number, but is \"[3]\"");
    }

    #[test]
    fn deep_nesting_is_refused_without_overflow() {
        let text = "[".repeat(100_000);
        assert!(Catalogue::parse_json(&text, "own").is_err());
    }
}
