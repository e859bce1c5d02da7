//! Section properties for analysts: at every skeletal point, and as means along every beam.
//!
//! As JSON with the outlines, or as CSV with one line a section. `docs/sections.md` documents both.

use std::io::{self, Write};
use std::path::Path;

use nalgebra::{Point3, Vector3};
use serde::Serialize;

use super::assembly::mark;
use super::beam_table::{BeamRow, rows};
use crate::frame::{BeamStation, Frame, Section};
use crate::skeleton::Skeleton;

/// Name of the JSON format.
const FORMAT: &str = "beamwright-sections";

/// Version of the JSON format.
const VERSION: u32 = 1;

/// How sections are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionFormat {
    /// Sections with outlines, and beams.
    Json,
    /// One line a section.
    Csv,
}

impl SectionFormat {
    /// The format a file name asks for by its ending.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "json" => Some(Self::Json),
            "csv" => Some(Self::Csv),
            _ => None,
        }
    }
}

/// One section with its properties; lengths in mm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SectionRow {
    /// Skeletal point it goes through.
    pub point: u32,
    /// Branch of that point.
    pub branch: u32,
    /// Mark of the beam it counts for; none if its beam was joined to a node.
    pub beam: Option<String>,
    /// Part 0..1 of the beam's length.
    pub at: Option<f64>,
    /// Weight in the means of the beam, 0..1.
    pub weight: Option<f64>,
    /// Whether it is so unlike its neighbours that it hardly counts.
    pub outlier: bool,
    /// Area centroid.
    pub centroid: [f64; 3],
    /// Normal of the plane, along the branch.
    pub normal: [f64; 3],
    /// Area A, mm².
    pub area: f64,
    /// Largest second moment I₁, mm⁴.
    pub i_1: f64,
    /// Smallest second moment I₂, mm⁴.
    pub i_2: f64,
    /// Direction of axis 1, about which the second moment is largest.
    pub axis_1: [f64; 3],
    /// Polar moment I₁ + I₂, mm⁴.
    pub i_p: f64,
    /// Torsion constant J, mm⁴.
    pub j: f64,
    /// Length of the contour.
    pub perimeter: f64,
    /// The contour, counter-clockwise seen against the normal.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outline: Vec<[f64; 3]>,
}

#[derive(Serialize)]
struct File<'a> {
    format: &'a str,
    version: u32,
    unit: &'a str,
    sections: Vec<SectionRow>,
    beams: Vec<BeamRow>,
}

/// The properties of every section, in the order of branches and points.
///
/// A contour that is no plane region (it touches itself) is left out.
fn section_rows(
    skeleton: &Skeleton,
    sections: &[Option<Section>],
    frame: &Frame,
) -> Vec<SectionRow> {
    let mut of_point = vec![None; sections.len()];
    for (i, beam) in frame.beams.iter().enumerate() {
        for station in &beam.section.stations {
            of_point[station.point as usize] = Some((i, station));
        }
    }
    let points = skeleton
        .branches
        .iter()
        .enumerate()
        .flat_map(|(b, branch)| branch.points.iter().map(move |&p| (b as u32, p as usize)));
    points.filter_map(|(branch, p)| row(branch, sections[p].as_ref()?, of_point[p])).collect()
}

fn row(
    branch: u32,
    section: &Section,
    station: Option<(usize, &BeamStation)>,
) -> Option<SectionRow> {
    let properties = section.properties().ok()?;
    let (u, v) = section.plane.axes();
    let (sin, cos) = properties.principal_angle.sin_cos();
    Some(SectionRow {
        point: section.point,
        branch,
        beam: station.map(|(beam, _)| mark(beam)),
        at: station.map(|(_, s)| s.at),
        weight: station.map(|(_, s)| s.weight),
        outlier: station.is_some_and(|(_, s)| s.is_outlier()),
        centroid: section.centroid.into(),
        normal: section.plane.normal.into_inner().into(),
        area: properties.area,
        i_1: properties.i_1,
        i_2: properties.i_2,
        axis_1: Vector3::into(u * cos + v * sin),
        i_p: properties.i_p,
        j: properties.j,
        perimeter: properties.perimeter,
        outline: section.contour.iter().map(|p| Point3::into(*p)).collect(),
    })
}

/// Writes all sections of a frame.
///
/// # Errors
/// What `out` says.
pub fn write(
    format: SectionFormat,
    skeleton: &Skeleton,
    sections: &[Option<Section>],
    frame: &Frame,
    out: &mut dyn Write,
) -> io::Result<()> {
    let found = section_rows(skeleton, sections, frame);
    match format {
        SectionFormat::Csv => write_csv(&found, out),
        SectionFormat::Json => {
            let beams = rows(frame);
            let file =
                File { format: FORMAT, version: VERSION, unit: "mm", sections: found, beams };
            serde_json::to_writer(&mut *out, &file)?;
            writeln!(out)
        }
    }
}

const CSV_HEADER: [&str; 21] = [
    "point",
    "branch",
    "beam",
    "at",
    "weight",
    "outlier",
    "x_mm",
    "y_mm",
    "z_mm",
    "normal_x",
    "normal_y",
    "normal_z",
    "area_mm2",
    "i_1_mm4",
    "i_2_mm4",
    "axis_1_x",
    "axis_1_y",
    "axis_1_z",
    "i_p_mm4",
    "j_mm4",
    "perimeter_mm",
];

fn write_csv(rows: &[SectionRow], out: &mut dyn Write) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record(CSV_HEADER).map_err(io::Error::other)?;
    for row in rows {
        csv.write_record(csv_fields(row)).map_err(io::Error::other)?;
    }
    csv.flush()
}

fn csv_fields(row: &SectionRow) -> Vec<String> {
    let optional = |x: Option<f64>| x.map(|x| format!("{x:.4}")).unwrap_or_default();
    let mut fields = vec![
        row.point.to_string(),
        row.branch.to_string(),
        row.beam.clone().unwrap_or_default(),
        optional(row.at),
        optional(row.weight),
        row.outlier.to_string(),
    ];
    let mut numbers = |values: &[f64]| fields.extend(values.iter().map(|x| format!("{x:.6}")));
    numbers(&row.centroid);
    numbers(&row.normal);
    numbers(&[row.area, row.i_1, row.i_2]);
    numbers(&row.axis_1);
    numbers(&[row.i_p, row.j, row.perimeter]);
    fields
}
