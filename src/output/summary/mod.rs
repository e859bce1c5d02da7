//! What a run found, in numbers: for machines as JSON, for people as a table of 80 columns (`table`).

pub(super) mod table;

use serde::Serialize;

use super::beam_table::{self, BeamRow};
use crate::finding::Finding;
use crate::frame::{self, BeamVolumes, Frame};
use crate::mesh::{InterfaceKind, InterfaceSection, Label, MeshReport, Surface};
use crate::skeleton::verify::Homotopy;
use crate::skeleton::{PointKind, Skeleton};

/// The mesh: what was read and mended.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshSummary {
    /// Triangles of the surface that is used.
    pub triangles: usize,
    /// Its points.
    pub vertices: usize,
    /// Separate bodies.
    pub bodies: usize,
    /// Tunnels through the whole surface.
    pub genus: usize,
    /// Enclosed volume, mm³.
    pub volume: f64,
    /// Area, mm².
    pub area: f64,
    /// Diagonal of the bounding box, mm.
    pub diagonal: f64,
    /// What was mended, by name; only what occurred.
    pub mended: Vec<(String, usize)>,
    /// Volumes of hollows that were left out, mm³.
    pub cavities: Vec<f64>,
    /// Volumes of floating islands that were left out, mm³.
    pub islands: Vec<f64>,
}

/// The labels: which source was followed and what it marks.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LabelSummary {
    /// The source that was followed; none: no labels.
    pub source: Option<&'static str>,
    /// Faces marked by each source that is present.
    pub marked: Vec<(&'static str, usize)>,
    /// Design faces after cleaning.
    pub design_faces: usize,
    /// Non-design faces after cleaning.
    pub non_design_faces: usize,
    /// Non-design sets.
    pub sets: usize,
    /// Interface sections.
    pub interfaces: Vec<InterfaceSummary>,
}

/// One interface section.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InterfaceSummary {
    /// The non-design set beyond it, from 0.
    pub set: u32,
    /// Area centroid, mm.
    pub centroid: [f64; 3],
    /// Into the design part.
    pub normal: [f64; 3],
    /// Area, mm².
    pub area: f64,
    /// Edges of the loop.
    pub edges: usize,
    /// `section` or `rim`.
    pub kind: &'static str,
}

/// The skeleton.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SkeletonSummary {
    /// Compactness: number of skeletal points.
    pub points: usize,
    /// Branches.
    pub branches: usize,
    /// Junctions.
    pub junctions: usize,
    /// Ends in interface sections.
    pub interface_ends: usize,
    /// Free ends.
    pub free_ends: usize,
    /// Independent cycles.
    pub cycles: usize,
    /// Cycles the design part has.
    pub expected_cycles: usize,
    /// Connected parts.
    pub components: usize,
    /// Connected parts the design part has.
    pub expected_components: usize,
    /// Length of all branches, mm.
    pub length: f64,
}

/// The frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrameSummary {
    /// Nodes.
    pub nodes: usize,
    /// Beams.
    pub beams: usize,
    /// Length of all beams between their nodes, mm.
    pub length: f64,
    /// Sum of the volumes of the beams from node to node, overlaps at joints counted for every
    /// beam, mm³.
    pub volume: f64,
    /// Volume of all beams together, overlaps at joints counted once, mm³.
    pub volume_together: f64,
    /// What of that lies outside of the part, mm³.
    pub volume_outside: f64,
    /// Volume of the design part, mm³.
    pub design_volume: f64,
    /// The beams one by one.
    pub table: Vec<BeamRow>,
}

/// A finding, as printed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FindingSummary {
    /// Kind in kebab case.
    pub kind: &'static str,
    /// Whether a promise is broken.
    pub breach: bool,
    /// One sentence.
    pub text: String,
    /// Where, mm.
    pub place: Option<[f64; 3]>,
}

/// Everything one run has to say; parts that were not run are left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Name of the input file.
    pub input: String,
    /// The mesh.
    pub mesh: MeshSummary,
    /// Its labels.
    pub labels: LabelSummary,
    /// The skeleton.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skeleton: Option<SkeletonSummary>,
    /// The frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<FrameSummary>,
    /// What is odd.
    pub findings: Vec<FindingSummary>,
}

impl Summary {
    /// What is known of a surface.
    pub fn new(input: impl Into<String>, surface: &Surface, findings: &[Finding]) -> Self {
        Self {
            input: input.into(),
            mesh: MeshSummary::new(&surface.report),
            labels: LabelSummary::new(surface),
            skeleton: None,
            frame: None,
            findings: findings.iter().map(FindingSummary::new).collect(),
        }
    }

    /// Adds the skeleton.
    pub fn with_skeleton(mut self, surface: &Surface, skeleton: &Skeleton) -> Self {
        self.skeleton = Some(SkeletonSummary::new(surface, skeleton));
        self
    }

    /// Adds the frame.
    pub fn with_frame(mut self, surface: &Surface, frame: &Frame) -> Self {
        let volumes = frame::volumes(frame, &surface.tree);
        let mut all = BeamVolumes::default();
        volumes.iter().for_each(|v| all += *v);
        self.frame = Some(FrameSummary {
            nodes: frame.nodes.len(),
            beams: frame.beams.len(),
            length: frame.beams.iter().map(|b| b.length).sum(),
            volume: all.alone,
            volume_together: all.share,
            volume_outside: all.outside,
            design_volume: surface.design_volume(),
            table: beam_table::rows_with_volumes(frame, &volumes),
        });
        self
    }

    /// Whether a promise is broken.
    pub fn has_breach(&self) -> bool {
        self.findings.iter().any(|f| f.breach)
    }
}

impl MeshSummary {
    fn new(report: &MeshReport) -> Self {
        let mended = [
            ("merged_points", report.merged_points),
            ("merged_near_points", report.merged_near_points),
            ("degenerate_triangles", report.degenerate_triangles),
            ("duplicate_triangles", report.duplicate_triangles),
            ("flipped_triangles", report.flipped_triangles),
            ("split_edges", report.split_edges),
            ("split_vertices", report.split_vertices),
            ("closed_openings", report.closed_openings),
        ];
        Self {
            triangles: report.triangles,
            vertices: report.vertices,
            bodies: report.bodies,
            genus: report.genus,
            volume: report.volume,
            area: report.area,
            diagonal: report.extent,
            mended: mended.iter().filter(|m| m.1 > 0).map(|m| (m.0.to_owned(), m.1)).collect(),
            cavities: report.cavities.iter().map(|s| s.volume.abs()).collect(),
            islands: report.islands.iter().map(|s| s.volume.abs()).collect(),
        }
    }
}

impl LabelSummary {
    fn new(surface: &Surface) -> Self {
        let counts = &surface.report.labels;
        let design_faces = surface.labels.of_face.iter().filter(|l| **l == Label::Design).count();
        Self {
            source: counts.used.map(|s| s.describe()),
            marked: counts.marked.iter().map(|(s, n)| (s.describe(), *n)).collect(),
            design_faces,
            non_design_faces: surface.labels.of_face.len() - design_faces,
            sets: surface.labels.sets,
            interfaces: surface.interfaces.iter().map(InterfaceSummary::new).collect(),
        }
    }
}

impl InterfaceSummary {
    fn new(section: &InterfaceSection) -> Self {
        Self {
            set: section.set.0,
            centroid: section.centroid.into(),
            normal: section.normal.into(),
            area: section.area,
            edges: section.half_edges.len(),
            kind: match section.kind {
                InterfaceKind::Section => "section",
                InterfaceKind::Rim => "rim",
            },
        }
    }
}

impl SkeletonSummary {
    fn new(surface: &Surface, skeleton: &Skeleton) -> Self {
        let expected = Homotopy::of(surface);
        Self {
            points: skeleton.points.len(),
            branches: skeleton.branches.len(),
            junctions: skeleton.count(PointKind::Junction),
            interface_ends: skeleton.count(PointKind::Interface),
            free_ends: skeleton.count(PointKind::End),
            cycles: skeleton.cycle_rank(),
            expected_cycles: expected.cycles,
            components: skeleton.components(),
            expected_components: expected.components,
            length: skeleton.branches.iter().map(|b| skeleton.length(b)).sum(),
        }
    }
}

impl FindingSummary {
    fn new(finding: &Finding) -> Self {
        Self {
            kind: finding.kind.name(),
            breach: finding.breach,
            text: finding.text.clone(),
            place: finding.place.map(Into::into),
        }
    }
}
