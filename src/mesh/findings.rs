//! What is odd about a mesh, in words: its unit, what was mended, what was left out, its labels.

use super::label::LabelSource;
use super::prepare::{MeshReport, Surface};
use crate::finding::{Finding, FindingKind};
use crate::wording::{counted, figures};

/// A part no larger than this, mm, is in doubt: a frame of 3 m in a file in metres is 3 mm across, a
/// coupon of printed lattice 8 mm.
const SMALL_PART: f64 = 5.0;

/// A part larger than this, mm, is in doubt: a bracket of 150 mm read in metres is 150 m across, the
/// truss of a hall 60 m.
const LARGE_PART: f64 = 1e5;

/// Words for a part whose size tells that its file may be in another unit of length.
///
/// * `extent`: diagonal of its bounding box, mm.
pub fn unit_in_doubt(extent: f64) -> Option<String> {
    if extent < SMALL_PART {
        let across = figures(extent, 1);
        Some(format!("the part is {across} mm across: is the file in metres? --unit m"))
    } else if extent > LARGE_PART {
        let across = figures(extent * 1e-3, 0);
        Some(format!(
            "the part is {across} m across: is the file in millimetres? --unit mm; if it is in \
             micrometres, scale it"
        ))
    } else {
        None
    }
}

/// What was mended and left out, in words.
pub fn findings(surface: &Surface) -> Vec<Finding> {
    let report = &surface.report;
    let mut findings = Vec::new();
    if let Some(text) = unit_in_doubt(report.extent) {
        findings.push(Finding::note(FindingKind::Unit, None, text));
    }
    let mended = [
        (report.merged_near_points, "near point merged", "near points merged"),
        (
            report.degenerate_triangles,
            "triangle without area dropped",
            "triangles without area dropped",
        ),
        (report.duplicate_triangles, "repeated triangle dropped", "repeated triangles dropped"),
        (report.flipped_triangles, "triangle turned round", "triangles turned round"),
        (
            report.split_edges,
            "edge of more than two triangles cut apart",
            "edges of more than two triangles cut apart",
        ),
        (
            report.split_vertices,
            "vertex shared by separate fans split",
            "vertices shared by separate fans split",
        ),
        (report.closed_openings, "opening closed", "openings closed"),
    ];
    for (count, one, many) in mended.into_iter().filter(|m| m.0 > 0) {
        let text = counted(count, one, many);
        findings.push(Finding::note(FindingKind::MeshMended, None, text));
    }
    findings.extend(left_out(report));
    findings.extend(label_findings(surface));
    findings
}

/// Hollows and bodies that are no part of the surface.
fn left_out(report: &MeshReport) -> impl Iterator<Item = Finding> + '_ {
    let hollows = report.cavities.iter().map(|hollow| {
        let volume = hollow.volume.abs();
        let text =
            format!("a closed hollow of {volume:.3} mm³ was left out; sections are taken as solid");
        Finding::note(FindingKind::Cavity, Some(hollow.place), text)
    });
    let islands = report.islands.iter().map(|island| {
        let volume = island.volume.abs();
        let text =
            format!("a body of {volume:.3} mm³ that touches no non-design part was left out");
        Finding::note(FindingKind::FloatingIsland, Some(island.place), text)
    });
    hollows.chain(islands)
}

fn label_findings(surface: &Surface) -> Vec<Finding> {
    let counts = &surface.report.labels;
    let note = |text: String| Finding::note(FindingKind::Labels, None, text);
    let mut findings = Vec::new();
    for (source, marked) in &counts.marked {
        let asked_for = matches!(source, LabelSource::SecondMesh | LabelSource::Box);
        if asked_for && *marked == 0 {
            let of = source.describe();
            findings.push(note(format!(
                "the {of} marks no face as non-design: does it lie where the part does?"
            )));
        }
    }
    let labels = &surface.labels;
    for (count, of, taken_for) in [
        (labels.non_design_specks, "non-design", "design"),
        (labels.design_specks, "design", "non-design"),
    ] {
        if count > 0 {
            let specks = counted(count, "speck", "specks");
            findings.push(note(format!("{specks} of {of} label counted as {taken_for}")));
        }
    }
    findings
}
