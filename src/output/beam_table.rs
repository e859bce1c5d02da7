//! What is known of every beam, in numbers: measured means, profile, errors.

use serde::Serialize;

use super::assembly::mark;
use crate::frame::{Beam, BeamAxes, BeamVolumes, Frame, Moments};
use crate::section::MatchTarget;
use crate::section::matching::MatchErrors;

/// One beam; lengths in mm, angles in rad.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BeamRow {
    /// Mark, as in the STEP file and the cut list.
    pub mark: String,
    /// Branches of the skeleton it runs along.
    pub branches: Vec<u32>,
    /// Nodes from end to end, those it passes between them.
    pub nodes: Vec<u32>,
    /// First end of the axis.
    pub start: [f64; 3],
    /// Second end of the axis.
    pub end: [f64; 3],
    /// Axis y of the profile; axis z is the axis of the beam × y.
    pub y: [f64; 3],
    /// Length from node to node.
    pub length: f64,
    /// Length it is cut to.
    pub cut_length: f64,
    /// Means of its sections; none where nothing was measured.
    pub measured: Option<MeasuredRow>,
    /// Family of the profile, such as `round` or `CHS`.
    pub family: String,
    /// Name of the profile, such as `CHS 60.3x4`.
    pub profile: String,
    /// Standard of the profile, if it has one.
    pub standard: Option<String>,
    /// Properties of the profile.
    pub area: f64,
    /// I about axis y of the profile, mm⁴.
    pub i_y: f64,
    /// I about axis z of the profile, mm⁴.
    pub i_z: f64,
    /// Torsion constant of the profile, mm⁴.
    pub j: f64,
    /// Angle from the strong axis of the section to axis y of the profile.
    pub roll: f64,
    /// Part 0..1 of its volume that sticks out of the part, if that was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outside: Option<f64>,
    /// Errors of the profile, its value over the measured one less 1.
    pub errors: Option<ErrorRow>,
}

/// Robust means along a beam.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeasuredRow {
    /// Number of sections.
    pub sections: usize,
    /// Those so unlike their neighbours that they hardly count.
    pub outliers: usize,
    /// Skeletal points of the outliers.
    pub outlier_points: Vec<u32>,
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
    /// Torsion constant J of the mean contour, mm⁴.
    pub j: f64,
    /// Values at the two ends, from straight lines through the sections.
    pub ends: [EndRow; 2],
    /// Farthest a centroid lies from the axis of the beam.
    pub farthest_off_axis: f64,
}

/// The section at one end of a beam.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EndRow {
    /// Area A, mm².
    pub area: f64,
    /// Largest second moment I₁, mm⁴.
    pub i_1: f64,
    /// Smallest second moment I₂, mm⁴.
    pub i_2: f64,
}

/// Relative errors of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorRow {
    /// Error of the area.
    pub area: f64,
    /// Error of I₁.
    pub i_1: f64,
    /// Error of I₂.
    pub i_2: f64,
    /// Error of J.
    pub j: f64,
}

impl From<&MatchErrors> for ErrorRow {
    fn from(errors: &MatchErrors) -> Self {
        let MatchErrors { area, i_1, i_2, j } = *errors;
        Self { area, i_1, i_2, j }
    }
}

impl From<&Moments> for EndRow {
    fn from(moments: &Moments) -> Self {
        let (i_1, i_2, _) = moments.principal();
        Self { area: moments.area, i_1, i_2 }
    }
}

/// All beams of a frame, in order.
pub fn rows(frame: &Frame) -> Vec<BeamRow> {
    frame.beams.iter().enumerate().map(|(i, beam)| row(i, beam, frame)).collect()
}

/// All beams of a frame, and how much of each sticks out of the part.
pub fn rows_with_volumes(frame: &Frame, volumes: &[BeamVolumes]) -> Vec<BeamRow> {
    let mut rows = rows(frame);
    for (row, v) in rows.iter_mut().zip(volumes) {
        row.outside = (v.share > 0.0).then(|| v.outside / v.share);
    }
    rows
}

fn row(index: usize, beam: &Beam, frame: &Frame) -> BeamRow {
    let [start, end] = frame.axis(beam);
    let shape = &beam.shape;
    let designation = shape.profile.designation.as_ref();
    BeamRow {
        mark: mark(index),
        branches: beam.spans().map(|(_, branch)| branch).collect(),
        nodes: nodes(beam),
        start: start.into(),
        end: end.into(),
        y: beam.axes.rolled(shape.roll).y.into_inner().into(),
        length: beam.length,
        cut_length: beam.cut_length,
        measured: beam.measured.as_ref().map(|target| measured(target, beam)),
        family: shape.profile.family().to_owned(),
        profile: shape.name(),
        standard: designation.map(|d| d.standard.clone()),
        area: shape.properties.area,
        i_y: shape.properties.i_xx,
        i_z: shape.properties.i_yy,
        j: shape.properties.j,
        roll: shape.roll,
        outside: None,
        errors: shape.errors.as_ref().map(ErrorRow::from),
    }
}

fn nodes(beam: &Beam) -> Vec<u32> {
    let last = beam.ends[1].0;
    beam.spans().map(|([from, _], _)| from.0).chain([last]).collect()
}

fn measured(target: &MatchTarget, beam: &Beam) -> MeasuredRow {
    let stations = &beam.section.stations;
    let axes: BeamAxes = beam.axes.rolled(target.principal_angle);
    let outliers = stations.iter().filter(|s| s.is_outlier());
    MeasuredRow {
        sections: stations.len(),
        outliers: beam.section.outliers(),
        outlier_points: outliers.map(|s| s.point).collect(),
        area: target.area,
        i_1: target.i_1,
        i_2: target.i_2,
        axis_1: axes.y.into_inner().into(),
        i_p: target.i_1 + target.i_2,
        j: target.j,
        ends: beam.section.ends.each_ref().map(EndRow::from),
        farthest_off_axis: stations.iter().map(|s| s.off_axis).fold(0.0, f64::max),
    }
}
