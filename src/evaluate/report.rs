//! Evaluations of several skeletons of one mesh, for people and for machines.

use std::fmt::Write;

use serde::Serialize;

use super::Evaluation;
use super::compare::Comparison;
use super::post_process::PostProcessing;

/// Name and version of the JSON document.
const FORMAT: (&str, u32) = ("beamwright-evaluation", 1);

/// Width of the names of the figures, characters.
const LABEL: usize = 32;

/// Width of a column.
const COLUMN: usize = 12;

/// Skeletons side by side: 32 + 4 × 12 = 80 characters; more are put below.
const COLUMNS: usize = 4;

/// One skeleton of a report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Evaluated {
    /// Its name, for instance that of its file.
    pub name: String,
    /// What was done to it before, if anything.
    pub post_processing: Option<PostProcessing>,
    /// Its figures.
    #[serde(flatten)]
    pub evaluation: Evaluation,
}

/// Two skeletons of a report, compared.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compared {
    /// Name of S₁.
    pub first: String,
    /// Name of S₂.
    pub second: String,
    /// Their distances.
    #[serde(flatten)]
    pub comparison: Comparison,
}

/// Evaluations of several skeletons of one mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    format: &'static str,
    version: u32,
    /// The skeletons, in the order given.
    pub skeletons: Vec<Evaluated>,
    /// Comparisons of them.
    pub comparisons: Vec<Compared>,
}

impl Report {
    /// Puts a report together.
    pub fn new(skeletons: Vec<Evaluated>, comparisons: Vec<Compared>) -> Self {
        Self { format: FORMAT.0, version: FORMAT.1, skeletons, comparisons }
    }

    /// The report as JSON, indented; lengths in mm.
    ///
    /// # Errors
    /// None for figures that are numbers, as those of an evaluation are.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }

    /// The report as a table of at most 80 columns.
    pub fn to_table(&self) -> String {
        let mut text = String::new();
        for skeletons in self.skeletons.chunks(COLUMNS) {
            if !text.is_empty() {
                text.push('\n');
            }
            table(&mut text, skeletons);
        }
        for c in &self.comparisons {
            comparison(&mut text, c);
        }
        text
    }
}

/// One line of the table.
type Row = (&'static str, fn(&Evaluation) -> String);

/// The lines of the table; a name without a figure is a heading.
const ROWS: &[Row] = &[
    ("skeletal points (compactness)", |e| e.raw.points.to_string()),
    ("  evaluated by the criterion", |e| e.raw.evaluated.to_string()),
    ("E_center, eq. (2.2)", |e| figure(e.raw.e_center)),
    ("  equal spacing", |e| figure(e.resampled.e_center)),
    ("  equal spacing, shafts only", |e| figure(e.resampled.e_center_shaft)),
    ("E with true rays", |e| figure(e.raw.e_true)),
    ("  equal spacing", |e| figure(e.resampled.e_true)),
    ("  equal spacing, shafts only", |e| figure(e.resampled.e_true_shaft)),
    ("offset / section radius, mean", |e| figure(e.resampled.offset.mean)),
    ("  shafts only", |e| figure(e.resampled.offset.shaft_mean)),
    ("  largest on the shafts", |e| figure(e.resampled.offset.shaft_max)),
    ("Hu's degree (1 is best)", |e| figure(e.resampled.hu_degree)),
    ("points outside", |e| e.raw.points_outside.to_string()),
    ("length outside, %", |e| percent(e.outside.fraction)),
    ("segments through the surface", |e| e.outside.segments_through_surface.to_string()),
    ("surface without branch, %", |e| percent(e.coverage.uncovered)),
    ("components / of the mesh", |e| of(e.topology.components, e.topology.expected_components)),
    ("cycles / of the mesh", |e| of(e.topology.cycle_rank, e.topology.expected_cycle_rank)),
    ("free ends", |e| e.topology.free_ends.to_string()),
    ("ends at interface sections", |e| e.topology.interface_ends.to_string()),
    ("junctions (clusters)", |e| {
        format!("{} ({})", e.topology.junctions, e.topology.junction_clusters)
    }),
    ("branches (shorter than 2 radii)", |e| {
        format!("{} ({})", e.topology.branches, e.topology.short_branches)
    }),
    ("length, mm", |e| format!("{:.1}", e.topology.length)),
];

fn table(text: &mut String, skeletons: &[Evaluated]) {
    let Some(first) = skeletons.first() else { return };
    let mesh = &first.evaluation.mesh;
    // Writing into a String cannot fail.
    let _ = writeln!(
        text,
        "r {:.3} mm (bounding sphere), mean strut radius {:.3} mm, cube {:.3} mm\n",
        mesh.r,
        mesh.r_mean,
        2.0 * mesh.cube_half
    );
    let _ = write!(text, "{:LABEL$}", "");
    for name in skeletons.iter().map(|s| shortened(&s.name)) {
        let _ = write!(text, "{name:>COLUMN$}");
    }
    text.push('\n');
    for (label, cell) in ROWS {
        let _ = write!(text, "{label:LABEL$}");
        for skeleton in skeletons {
            let _ = write!(text, "{:>COLUMN$}", cell(&skeleton.evaluation));
        }
        text.push('\n');
    }
}

fn comparison(text: &mut String, c: &Compared) {
    let d = &c.comparison;
    let _ = writeln!(
        text,
        "\n{} - {}: Hausdorff {:.4} mm\n  D12 mean {:.4} max {:.4} mm, D21 mean {:.4} max {:.4} mm",
        shortened(&c.first),
        shortened(&c.second),
        d.hausdorff,
        d.d12_mean,
        d.d12_max,
        d.d21_mean,
        d.d21_max
    );
}

/// The end of a name that fits a column: files of one folder differ there.
fn shortened(name: &str) -> String {
    let count = name.chars().count();
    let room = COLUMN - 1;
    if count <= room {
        return name.to_owned();
    }
    std::iter::once('…').chain(name.chars().skip(count - room + 1)).collect()
}

fn figure(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |v| format!("{v:.5}"))
}

fn percent(fraction: f64) -> String {
    format!("{:.2}", 100.0 * fraction)
}

fn of(found: usize, expected: usize) -> String {
    format!("{found} / {expected}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_name_keeps_its_end() {
        assert_eq!(shortened("run/cantilever/mcf.obj"), "…er/mcf.obj");
        assert_eq!(shortened("mcf.obj"), "mcf.obj");
    }

    #[test]
    fn no_line_label_is_wider_than_its_column() {
        assert!(ROWS.iter().all(|(label, _)| label.chars().count() < LABEL));
        const { assert!(LABEL + COLUMNS * COLUMN <= 80) };
    }
}
