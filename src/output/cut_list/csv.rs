//! The cut list for spreadsheets: tables below each other, all of the same number of columns, with
//! an empty line between.

use std::io::{self, Write};

use super::CutList;
use crate::wording::figures;

/// Head of the first table.
const PIECES: [&str; COLUMNS] = [
    "piece",
    "mark",
    "quantity",
    "profile",
    "family",
    "standard",
    "material",
    "length_mm",
    "axis_length_mm",
    "angle_1_deg",
    "angle_2_deg",
    "saddle_1_mm",
    "saddle_2_mm",
    "twist_deg",
    "lean_deg",
    "off_mm",
    "area_mm2",
    "unit_mass_kg",
    "mass_kg",
    "unit_surface_m2",
    "branch",
];

const COLUMNS: usize = 21;

/// What the columns mean.
const LEGEND: [(&str, &str); 12] = [
    ("mark", "beams cut like this, as in the STEP file"),
    ("length_mm", "to saw off a bar, from the farthest corner to the farthest"),
    ("axis_length_mm", "along the axis between the cuts"),
    ("angle_1_deg, angle_2_deg", "of the cuts at both ends; 0 is square"),
    ("saddle_1_mm, saddle_2_mm", "diameter of the member the end is cut to fit; 0 is a plane"),
    (
        "twist_deg",
        "turn between the cuts about the axis; 0 a parallelogram, 180 a trapezium, + clockwise",
    ),
    ("lean_deg", "direction in which cut 1 rises, from axis y of the profile, + clockwise"),
    ("off_mm", "farthest a corner of one of the beams lies from that of the piece"),
    ("area_mm2", "of the profile"),
    ("unit_mass_kg", "of one piece; mass_kg of all"),
    ("unit_surface_m2", "to paint on one piece, without the cuts"),
    ("branch", "of the skeleton the beams came from, counted from 0"),
];

pub(super) fn write(list: &CutList, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table { out: csv::Writer::from_writer(out) };
    table.row(PIECES)?;
    for p in &list.pieces {
        let branches: Vec<String> = p.branches.iter().map(u32::to_string).collect();
        table.row([
            p.piece.clone(),
            p.marks.join(" "),
            p.quantity.to_string(),
            text(&p.profile),
            text(&p.family),
            text(&p.standard),
            text(&p.material),
            p.length_mm.to_string(),
            p.axis_length_mm.to_string(),
            p.angle_1_deg.to_string(),
            p.angle_2_deg.to_string(),
            p.saddle_1_mm.to_string(),
            p.saddle_2_mm.to_string(),
            p.twist_deg.to_string(),
            p.lean_deg.to_string(),
            p.off_mm.to_string(),
            p.area_mm2.to_string(),
            p.unit_mass_kg.to_string(),
            p.mass_kg.to_string(),
            p.unit_surface_m2.to_string(),
            branches.join(" "),
        ])?;
    }
    totals(list, &mut table)?;
    bars(list, &mut table)?;
    table.head(&["legend"])?;
    for (column, meaning) in LEGEND {
        table.row([column, meaning])?;
    }
    table.out.flush()
}

fn totals(list: &CutList, table: &mut Table<'_>) -> io::Result<()> {
    table.head(&["total", "", "quantity", "profile", "", "standard", "", "length_mm"])?;
    for t in &list.totals {
        let mut row = vec![String::new(); COLUMNS];
        row[2] = t.quantity.to_string();
        row[3] = text(&t.profile);
        row[5] = text(&t.standard);
        row[7] = figures(t.length_mm, 3);
        row[18] = figures(t.mass_kg, 6);
        row[19] = figures(t.surface_m2, 6);
        table.row(row)?;
    }
    let all = list.total();
    let mut row = vec![String::new(); COLUMNS];
    row[0] = all.profile;
    row[2] = all.quantity.to_string();
    row[7] = figures(all.length_mm, 3);
    row[18] = figures(all.mass_kg, 6);
    row[19] = figures(all.surface_m2, 6);
    table.row(row)
}

fn bars(list: &CutList, table: &mut Table<'_>) -> io::Result<()> {
    let Some(nesting) = &list.nesting else { return Ok(()) };
    table.head(&["bar", "pieces", "quantity", "profile", "", "", "", "length_mm", "offcut_mm"])?;
    for (i, bar) in nesting.bars.iter().enumerate() {
        let mut row = vec![String::new(); COLUMNS];
        row[0] = (i + 1).to_string();
        row[1] = bar.pieces.join(" ");
        row[2] = bar.pieces.len().to_string();
        row[3] = text(&bar.profile);
        row[7] = nesting.stock.length_mm.to_string();
        row[8] = format!("{:.3}", bar.offcut_mm);
        table.row(row)?;
    }
    table.row(["waste".to_owned(), format!("{:.1} %", 100.0 * nesting.waste)])?;
    for piece in &nesting.too_long {
        table.row([
            piece.as_str(),
            "longer than a bar, not nested: order it longer, or splice it",
        ])?;
    }
    Ok(())
}

struct Table<'a> {
    out: csv::Writer<&'a mut dyn Write>,
}

impl Table<'_> {
    /// A line, filled up to the common number of columns.
    fn row<S: AsRef<str>>(&mut self, cells: impl IntoIterator<Item = S>) -> io::Result<()> {
        let mut cells: Vec<String> = cells.into_iter().map(|c| c.as_ref().to_owned()).collect();
        cells.resize(COLUMNS, String::new());
        self.out.write_record(&cells).map_err(io::Error::other)
    }

    /// An empty line and the head of another table.
    fn head(&mut self, names: &[&str]) -> io::Result<()> {
        self.row([""; COLUMNS])?;
        self.row(names)
    }
}

/// A text that no spreadsheet takes for a formula.
fn text(text: &str) -> String {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) {
        format!("'{text}")
    } else {
        text.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_that_looks_like_a_formula_is_made_text() {
        assert_eq!(text("=HYPERLINK(1)"), "'=HYPERLINK(1)");
        assert_eq!(text("IPE 200"), "IPE 200");
    }
}
