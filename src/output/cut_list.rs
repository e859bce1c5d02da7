//! The cut list: what to saw.

use std::io::{self, Write};

use serde::Serialize;

use super::assembly::mark;
use crate::frame::Frame;

/// One line of the cut list.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CutListRow {
    /// Mark of the beam, as in the STEP file.
    pub mark: String,
    /// Profile.
    pub profile: String,
    /// Length, mm.
    pub length_mm: f64,
    /// Area of the profile, mm².
    pub area_mm2: f64,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Branch of the skeleton it came from, from 0.
    pub branch: u32,
}

/// The cut list of a frame; `density` in kg/m³.
pub fn rows(frame: &Frame, density: f64) -> Vec<CutListRow> {
    frame
        .beams
        .iter()
        .enumerate()
        .map(|(i, beam)| CutListRow {
            mark: mark(i),
            profile: guarded(&beam.shape.name()),
            length_mm: rounded(beam.cut_length, 3),
            area_mm2: rounded(beam.shape.properties.area, 3),
            mass_kg: rounded(beam.cut_length * beam.shape.properties.area * density * 1e-9, 6),
            branch: beam.branch,
        })
        .collect()
}

/// A text that no spreadsheet takes for a formula.
fn guarded(text: &str) -> String {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) {
        format!("'{text}")
    } else {
        text.into()
    }
}

fn rounded(x: f64, digits: i32) -> f64 {
    let scale = 10f64.powi(digits);
    (x * scale).round() / scale
}

/// Writes the rows as CSV with a header.
///
/// # Errors
/// What `out` says.
pub fn write_csv(rows: &[CutListRow], out: &mut dyn Write) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    for row in rows {
        csv.serialize(row).map_err(io::Error::other)?;
    }
    csv.flush()
}
