//! The tables of the page, as texts ready to print.

use rustc_hash::FxHashMap;

use crate::evaluate::Evaluation;
use crate::output::beam_table::{self, BeamRow};
use crate::output::cut_list::{CutList, Piece};
use crate::output::view::View;

use super::Report;
use super::measure::{Along, along};
use super::nesting::Diagram;

/// All tables.
pub(super) struct Tables {
    pub(super) beams: Vec<BeamLine>,
    pub(super) total_length: String,
    pub(super) total_mass: String,
    pub(super) skeletons: Vec<String>,
    pub(super) centeredness: Vec<(&'static str, Vec<String>)>,
    pub(super) nesting: Option<Diagram>,
}

/// One beam.
pub(super) struct BeamLine {
    pub(super) mark: String,
    pub(super) profile: String,
    pub(super) length: String,
    pub(super) area: String,
    pub(super) mass: String,
    pub(super) deviation: String,
    pub(super) offset: String,
    pub(super) error: String,
}

impl Tables {
    pub(super) fn new(report: &Report<'_>) -> Self {
        let View { frame, skeleton, .. } = report.view;
        let rows = beam_table::rows(frame);
        let along = along(frame, skeleton, &report.measures.offsets);
        let masses = masses(report.cut_list);
        let mass = |row: &BeamRow| masses.get(row.mark.as_str()).copied().unwrap_or_default();
        let beams = rows.iter().zip(&along);
        Self {
            beams: beams.map(|(row, along)| BeamLine::new(row, along, mass(row))).collect(),
            total_length: format!("{:.1}", rows.iter().map(|r| r.cut_length).sum::<f64>()),
            total_mass: kilograms(report.cut_list.mass()),
            skeletons: report.measures.evaluated.iter().map(|e| e.name.clone()).collect(),
            centeredness: FIGURES
                .iter()
                .map(|(label, cell)| {
                    let cells = report.measures.evaluated.iter().map(|e| cell(&e.evaluation));
                    (*label, cells.collect())
                })
                .collect(),
            nesting: report.cut_list.nesting.as_ref().map(Diagram::new),
        }
    }
}

impl BeamLine {
    fn new(row: &BeamRow, along: &Along, mass: f64) -> Self {
        Self {
            mark: row.mark.clone(),
            profile: row.profile.clone(),
            length: format!("{:.1}", row.cut_length),
            area: format!("{:.1}", row.area),
            mass: kilograms(mass),
            deviation: format!("{:.2}", along.deviation),
            offset: along.offset.map_or_else(dash, |x| format!("{x:.3}")),
            error: worst_error(row).map_or_else(dash, |x| format!("{:.1}", 100.0 * x)),
        }
    }
}

/// The largest error of A, I₁ and I₂, a fraction; `None` where nothing was measured.
pub(super) fn worst_error(row: &BeamRow) -> Option<f64> {
    let e = row.errors?;
    Some([e.area, e.i_1, e.i_2].into_iter().fold(0.0, |worst, x| worst.max(x.abs())))
}

/// Mass of each beam by its mark, kg.
fn masses<'a>(list: &'a CutList) -> FxHashMap<&'a str, f64> {
    let of_piece = |p: &'a Piece| p.marks.iter().map(|m| (m.as_str(), p.unit_mass_kg));
    list.pieces.iter().flat_map(of_piece).collect()
}

fn kilograms(mass: f64) -> String {
    if mass < 1.0 { format!("{mass:.4}") } else { format!("{mass:.2}") }
}

fn dash() -> String {
    "–".into()
}

/// One line of the table of centeredness.
type Figure = (&'static str, fn(&Evaluation) -> String);

const FIGURES: &[Figure] = &[
    ("skeletal points", |e| e.raw.points.to_string()),
    ("E_center, eq. (2.2)", |e| figure(e.raw.e_center)),
    ("E_center at equal spacing", |e| figure(e.resampled.e_center)),
    ("E with true rays, equal spacing", |e| figure(e.resampled.e_true)),
    ("offset / section radius, mean", |e| figure(e.resampled.offset.mean)),
    ("offset on the shafts, mean", |e| figure(e.resampled.offset.shaft_mean)),
    ("offset on the shafts, largest", |e| figure(e.resampled.offset.shaft_max)),
    ("points outside", |e| e.raw.points_outside.to_string()),
    ("length outside, %", |e| format!("{:.2}", 100.0 * e.outside.fraction)),
    ("segments through the surface", |e| e.outside.segments_through_surface.to_string()),
    ("surface without branch, %", |e| format!("{:.2}", 100.0 * e.coverage.uncovered)),
    ("cycles / of the mesh", |e| {
        format!("{} / {}", e.topology.cycle_rank, e.topology.expected_cycle_rank)
    }),
    ("components / of the mesh", |e| {
        format!("{} / {}", e.topology.components, e.topology.expected_components)
    }),
    ("free ends", |e| e.topology.free_ends.to_string()),
    ("length, mm", |e| format!("{:.1}", e.topology.length)),
];

fn figure(value: Option<f64>) -> String {
    value.map_or_else(dash, |v| format!("{v:.4}"))
}
