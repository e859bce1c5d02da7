//! Rows of a CSV catalogue: a header, one profile a line, `# key: value` lines for what all share.

use std::collections::BTreeMap;

use csv::{ReaderBuilder, StringRecord, Trim};

use super::error::{CatalogueError, Place, RowFault};
use super::row::Row;

/// What may be given once for the whole file.
const SHARED: [&str; 4] = ["family", "standard", "shape", "unit"];

/// The rows of a file.
///
/// Fields are parted by commas or, if the header has them, by semicolons; then a comma in a
/// number is its decimal point, as spreadsheets of many countries write it.
pub(super) fn rows(text: &str, family: &str) -> Result<Vec<Row>, CatalogueError> {
    let text = text.trim_start_matches('\u{feff}');
    let shared = shared_values(text, family);
    let header = text.lines().find(|line| !line.starts_with('#') && !line.trim().is_empty());
    let semicolons = header.is_some_and(|line| line.contains(';'));
    let mut reader = ReaderBuilder::new()
        .delimiter(if semicolons { b';' } else { b',' })
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let columns = reader.headers().map_err(|fault| failed(&fault))?.clone();
    let columns: Vec<String> = columns.iter().map(str::to_lowercase).collect();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|fault| failed(&fault))?;
        let place = Place::Line(record.position().map_or(0, |at| line_of(text, at)));
        rows.push(Row { place, values: values(&record, &columns, &shared, semicolons) });
    }
    Ok(rows)
}

/// The values of `# key: value` lines; the name of the file stands in for the family.
fn shared_values(text: &str, family: &str) -> BTreeMap<String, String> {
    let mut shared = BTreeMap::from([("family".to_owned(), family.to_owned())]);
    for line in text.lines().filter_map(|line| line.strip_prefix('#')) {
        let Some((key, value)) = line.split_once(':') else { continue };
        let (key, value) = (key.trim().to_lowercase(), value.trim());
        if SHARED.contains(&key.as_str()) && !value.is_empty() {
            let value = folded(&key, value);
            shared.insert(key, value);
        }
    }
    shared
}

/// Line of a record: the reader notes where the blank lines and comments before it begin.
fn line_of(text: &str, at: &csv::Position) -> u64 {
    let rest = usize::try_from(at.byte()).ok().and_then(|byte| text.get(byte..)).unwrap_or("");
    let skipped = |line: &&str| line.trim().is_empty() || line.starts_with('#');
    at.line() + rest.lines().take_while(skipped).count() as u64
}

fn values(
    record: &StringRecord,
    columns: &[String],
    shared: &BTreeMap<String, String>,
    semicolons: bool,
) -> BTreeMap<String, String> {
    let mut values = shared.clone();
    for (column, value) in columns.iter().zip(record) {
        if value.is_empty() {
            continue;
        }
        let is_text = column == "name" || SHARED.contains(&column.as_str());
        let value =
            if semicolons && !is_text { value.replace(',', ".") } else { folded(column, value) };
        values.insert(column.clone(), value);
    }
    values
}

/// Shapes and units are words, whatever their case.
fn folded(column: &str, value: &str) -> String {
    if column == "shape" || column == "unit" { value.to_lowercase() } else { value.to_owned() }
}

fn failed(fault: &csv::Error) -> CatalogueError {
    let line = fault.position().map_or(1, csv::Position::line);
    match fault.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => CatalogueError::Row {
            place: Place::Line(line),
            fault: RowFault::Fields { found: *len, expected: *expected_len },
        },
        _ => CatalogueError::NotText { line },
    }
}

#[cfg(test)]
mod tests {
    use super::super::Catalogue;

    fn fault(text: &str) -> String {
        Catalogue::parse_csv(text, "own").unwrap_err().to_string()
    }

    #[test]
    fn faults_name_their_line() {
        let head = "# shape: tube\nname,d,t\n";
        assert_eq!(
            fault(&format!("{head}A,20,2\nB,20,x\n")),
            "line 4: t must be a number, but is \"x\""
        );
        assert_eq!(
            fault(&format!("{head}A,20\n")),
            "line 3: 2 fields where the header has 3; give each column of the header its field"
        );
        assert_eq!(fault(&format!("{head}A,20,\n")), "line 3: no t, which tube needs");
        assert_eq!(
            fault(&format!("{head}A,20,11\n")),
            "line 3: the wall is 11 mm, but must not exceed 10 mm"
        );
        assert_eq!(
            fault(&format!("{head}A,20,2\n\nA,30,2\n")),
            "line 5: \"A\" was already given at line 3; rename or remove one of them"
        );
        assert!(fault(&format!("{head}A,1e9,2\n")).starts_with("line 3: d is 1000000000 mm"));
        assert!(fault("name,shape,d\nA,ball,3\n").starts_with("line 2: unknown shape \"ball\""));
        assert_eq!(fault("name,d\nA,3\n"), "line 2: no shape, which every profile needs");
        assert_eq!(
            fault(""),
            "it has no profiles: a .csv lists them one a line below its header, a .json in `profiles`"
        );
    }

    #[test]
    fn mistyped_size_is_found_by_the_published_area() {
        let text = "# shape: round\nname,d,area\nA,20,314.2\nB,21,314.2\n";
        assert!(fault(text).starts_with("line 4: area is stated as 314.2, but the sizes give 346"));
    }

    #[test]
    fn semicolons_and_decimal_commas_are_read() {
        let text = "\u{feff}# Shape: Rectangle\r\nName;b;h\r\nF 12,5;12,5;40\r\n";
        let own = Catalogue::parse_csv(text, "own").unwrap();
        assert_eq!(own.entries()[0].name(), "F 12,5");
        assert!((own.entries()[0].properties.area - 500.0).abs() < 1e-9);
        assert_eq!(own.entries()[0].family(), "own");
    }

    #[test]
    fn inches_are_converted() {
        let text = "# unit: in\n# shape: round\nname,d,mass\nR1,1,2.67\n";
        let own = Catalogue::parse_csv(text, "own").unwrap();
        let entry = &own.entries()[0];
        assert!((entry.properties.area - 506.707).abs() < 1e-3);
        assert!((entry.mass_per_metre(7850.0) - 3.973).abs() < 1e-3);
    }
}
