//! A MeshLab project: the mesh with its labels, the skeleton and the beams as layers.
//!
//! | file | layer | what it carries |
//! |---|---|---|
//! | `NAME.mlp` | – | the project: layers by relative file names |
//! | `NAME.input.ply` | mesh | non-design faces selected (`flags` 32) and red |
//! | `NAME.skeleton.ply` | skeleton | edges; radius in `quality`, coloured by how far off centre |
//! | `NAME.off_centre.ply` | off-centre, hidden | the same, how far off centre in `quality` |
//! | `NAME.beams.ply` | beams | triangles in the colours of the STEP file; beam number in `quality` |
//!
//! MeshLab 2020.09 and PyMeshLab 2025.7 open it. The project says nothing of how layers are drawn:
//! that part of the format differs between versions and stops some from opening it.

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::files::{OutputFiles, WriteError};
use super::mesh_export::{part_meshes, write_labelled, write_parts};
use super::step::Document;
use crate::frame::Section;
use crate::mesh::Surface;
use crate::skeleton::Skeleton;

/// What is shown.
#[derive(Clone, Copy, Debug)]
pub struct Project<'a> {
    /// The mesh.
    pub surface: &'a Surface,
    /// Its skeleton.
    pub skeleton: &'a Skeleton,
    /// The section at each skeletal point, for the colours; may be empty.
    pub sections: &'a [Option<Section>],
    /// The beams, as they go into the STEP file.
    pub document: &'a Document,
}

/// Endings of the layers, with their labels; hidden ones wait to be shown.
const LAYERS: [Layer; 4] = [
    Layer { ending: ".input.ply", label: "mesh", is_shown: true },
    Layer { ending: ".skeleton.ply", label: "skeleton", is_shown: true },
    Layer { ending: ".off_centre.ply", label: "off-centre", is_shown: false },
    Layer { ending: ".beams.ply", label: "beams", is_shown: true },
];

struct Layer {
    ending: &'static str,
    label: &'static str,
    is_shown: bool,
}

/// The files of a project: the project itself, mesh, skeleton twice, beams.
pub fn targets(path: &Path) -> [PathBuf; 5] {
    let beside = |ending: &str| {
        let mut name = path.file_stem().map_or_else(OsString::new, OsString::from);
        name.push(ending);
        path.with_file_name(name)
    };
    let [mesh, skeleton, off_centre, beams] = LAYERS.map(|layer| beside(layer.ending));
    [path.to_owned(), mesh, skeleton, off_centre, beams]
}

/// Adds the files of a project to those that are written together.
///
/// * `path`: of the `.mlp` file; the layers go beside it.
///
/// # Errors
/// The first file that cannot be written.
pub fn add(files: &mut OutputFiles, path: &Path, project: &Project<'_>) -> Result<(), WriteError> {
    let [top, mesh, skeleton, centre, beams] = targets(path);
    let off_centre = off_centre(project.skeleton, project.sections);
    let edges =
        |quality| EdgeLayer { skeleton: project.skeleton, off_centre: &off_centre, quality };
    files.add(&top, |out| write_project([&mesh, &skeleton, &centre, &beams], out))?;
    files.add(&mesh, |out| write_labelled(project.surface, out))?;
    files.add(&skeleton, |out| edges(Quality::Radius).write(out))?;
    files.add(&centre, |out| edges(Quality::OffCentre).write(out))?;
    files.add(&beams, |out| write_parts(&part_meshes(project.document), out))
}

fn write_project(paths: [&Path; 4], out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "<!DOCTYPE MeshLabDocument>\n<MeshLabProject>\n <MeshGroup>")?;
    for (Layer { label, is_shown, .. }, path) in LAYERS.iter().zip(paths) {
        let name = escaped(&path.file_name().unwrap_or_default().to_string_lossy());
        let shown = u8::from(*is_shown);
        writeln!(out, "  <MLMesh label=\"{label}\" filename=\"{name}\" visible=\"{shown}\">")?;
        writeln!(out, "   <MLMatrix44>\n1 0 0 0 \n0 1 0 0 \n0 0 1 0 \n0 0 0 1 \n</MLMatrix44>")?;
        writeln!(out, "  </MLMesh>")?;
    }
    writeln!(out, " </MeshGroup>\n <RasterGroup/>\n</MeshLabProject>")
}

/// A text as the value of an XML attribute.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}

/// How far each skeletal point lies from the centroid of its section, in section radii; `None`
/// where no section is known.
fn off_centre(skeleton: &Skeleton, sections: &[Option<Section>]) -> Vec<Option<f64>> {
    let of = |(i, point): (usize, &crate::skeleton::graph::SkeletalPoint)| {
        let section = sections.get(i)?.as_ref()?;
        let off = (point.position - section.centroid).norm() / section.radius();
        off.is_finite().then_some(off)
    };
    skeleton.points.iter().enumerate().map(of).collect()
}

/// Off-centre by this many section radii, and more, is shown in the last colour.
const FAR_OFF: f64 = 0.5;

/// From well centred to far off, told apart by colour-blind eyes as well: blue, yellow, red.
const SCALE: [[f64; 3]; 3] = [[0.0, 69.0, 178.0], [240.0, 228.0, 66.0], [204.0, 26.0, 26.0]];

/// Of points of which nothing is known.
const GREY: [u8; 3] = [90, 90, 90];

fn colour(off_centre: Option<f64>) -> [u8; 3] {
    let Some(off) = off_centre else { return GREY };
    let at = (off / FAR_OFF).clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
    let i = (at as usize).min(SCALE.len() - 2);
    let t = at - i as f64;
    std::array::from_fn(|k| (SCALE[i][k] + t * (SCALE[i + 1][k] - SCALE[i][k])).round() as u8)
}

/// What MeshLab shows and measures as the one number of each point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quality {
    Radius,
    OffCentre,
}

/// Edges as MeshLab reads them; the reader of skeleton files takes them as well.
struct EdgeLayer<'a> {
    skeleton: &'a Skeleton,
    off_centre: &'a [Option<f64>],
    quality: Quality,
}

impl EdgeLayer<'_> {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.header(out)?;
        for (point, off) in self.skeleton.points.iter().zip(self.off_centre) {
            let [x, y, z] = point.position.into();
            let [red, green, blue] = colour(*off);
            let quality = match self.quality {
                Quality::Radius => point.radius,
                Quality::OffCentre => off.unwrap_or(0.0),
            };
            writeln!(out, "{x} {y} {z} {quality} {red} {green} {blue} 255")?;
        }
        self.skeleton.segments().try_for_each(|[a, b]| writeln!(out, "{a} {b}"))
    }

    fn header(&self, out: &mut dyn Write) -> io::Result<()> {
        let quality = match self.quality {
            Quality::Radius => "radius, mm",
            Quality::OffCentre => {
                "distance from the centroid of the section, in section radii; 0 without one"
            }
        };
        writeln!(out, "ply\nformat ascii 1.0\ncomment beamwright skeleton, mm")?;
        writeln!(out, "comment quality: {quality}")?;
        writeln!(out, "element vertex {}", self.skeleton.points.len())?;
        for name in ["x", "y", "z", "quality"] {
            writeln!(out, "property double {name}")?;
        }
        for channel in ["red", "green", "blue", "alpha"] {
            writeln!(out, "property uchar {channel}")?;
        }
        writeln!(out, "element edge {}", self.skeleton.segments().count())?;
        writeln!(out, "property int vertex1\nproperty int vertex2\nend_header")
    }
}

#[cfg(test)]
mod tests {
    use beamwright_formats::Unit;

    use super::*;
    use crate::skeleton::graph::{Branch, PointKind, SkeletalPoint};
    use crate::skeleton_file::{Format, read_bytes};
    use nalgebra::Point3;

    fn bar() -> Skeleton {
        let point = |x: f64| SkeletalPoint {
            position: Point3::new(x, 0.5, -1.0),
            radius: 2.0,
            kind: PointKind::Branch,
        };
        Skeleton {
            points: vec![point(0.0), point(1.0), point(2.0)],
            branches: vec![Branch { points: vec![0, 1, 2] }],
        }
    }

    #[test]
    fn layers_stand_beside_the_project() {
        let [project, layers @ ..] = targets(Path::new("out/a.b.mlp"));
        assert_eq!(project, Path::new("out/a.b.mlp"));
        let names = ["input", "skeleton", "off_centre", "beams"];
        assert_eq!(layers, names.map(|name| PathBuf::from(format!("out/a.b.{name}.ply"))));
    }

    #[test]
    fn file_names_are_escaped() {
        let path = Path::new("a \"b\" & <c>.input.ply");
        let mut out = Vec::new();
        write_project([path; 4], &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        assert!(text.contains("filename=\"a &quot;b&quot; &amp; &lt;c&gt;.input.ply\""), "{text}");
    }

    #[test]
    fn colours_run_from_blue_over_yellow_to_red() {
        assert_eq!(colour(Some(0.0)), [0, 69, 178]);
        assert_eq!(colour(Some(0.25)), [240, 228, 66]);
        assert_eq!(colour(Some(0.5)), [204, 26, 26]);
        assert_eq!(colour(Some(9.0)), [204, 26, 26]);
        assert_eq!(colour(None), GREY);
    }

    /// The first number of each point after its position.
    fn qualities(quality: Quality, off_centre: &[Option<f64>]) -> Vec<f64> {
        let mut out = Vec::new();
        EdgeLayer { skeleton: &bar(), off_centre, quality }.write(&mut out).unwrap();
        let graph = read_bytes(&out, Format::Ply, Unit::Mm).unwrap();
        assert_eq!(graph.branches.len(), 1);
        graph.points.iter().map(|p| p.radius).collect()
    }

    #[test]
    fn edge_layers_are_read_back_with_their_quality() {
        let off_centre = [None, Some(0.1), Some(0.6)];
        assert_eq!(qualities(Quality::Radius, &off_centre), [2.0, 2.0, 2.0]);
        assert_eq!(qualities(Quality::OffCentre, &off_centre), [0.0, 0.1, 0.6]);
    }
}
