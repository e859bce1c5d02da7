//! Pictures without a graphics card: the mesh, the beams in it, and three plain views.
//!
//! ```text
//!   ┌───────────────┬───────────────┐
//!   │ mesh          │ beams         │   isometric
//!   ├─────────┬─────┴───┬───────────┤
//!   │ front   │ top     │ side      │   along +y, −z, −x
//!   └─────────┴─────────┴───────────┘
//! ```
//!
//! | file | how |
//! |---|---|
//! | `.png` | triangles drawn into a depth buffer at twice the size |
//! | `.svg` | what is seen of mesh and beams as polygons, true text |

mod camera;
mod layers;
mod outline;
mod raster;
mod svg;

use std::io::{self, Write};
use std::path::Path;

use nalgebra::{Point3, Vector3};

use super::view::View;
use camera::{Camera, Projection};

pub(super) use svg::beams as svg_of_beams;

/// What a picture is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// Pixels.
    Png,
    /// Shapes.
    Svg,
}

impl PictureFormat {
    /// What a file name asks for.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        [("png", Self::Png), ("svg", Self::Svg)]
            .into_iter()
            .find(|(e, _)| extension.eq_ignore_ascii_case(e))
            .map(|(_, format)| format)
    }
}

/// Writes a picture of a result.
///
/// # Errors
/// What `out` says.
pub fn write(format: PictureFormat, view: &View<'_>, out: &mut dyn Write) -> io::Result<()> {
    let model = Model::new(view);
    match format {
        PictureFormat::Png => raster::write(&model, &PANELS, out),
        PictureFormat::Svg => svg::write(&model, &PANELS, out),
    }
}

/// Width and height of a picture, pixels.
const SIZE: [f64; 2] = [1500.0, 1000.0];

/// One view in a picture.
struct Panel {
    label: &'static str,
    /// Left, top, width, height, pixels.
    place: [f64; 4],
    projection: Projection,
    /// Whether the beams are shown; else the mesh alone.
    beams: bool,
}

const PANELS: [Panel; 5] = [
    panel("mesh", [0.0, 0.0, 750.0, 600.0], Projection::Isometric, false),
    panel("beams", [750.0, 0.0, 750.0, 600.0], Projection::Isometric, true),
    panel("front", [0.0, 600.0, 500.0, 400.0], Projection::Front, true),
    panel("top", [500.0, 600.0, 500.0, 400.0], Projection::Top, true),
    panel("side", [1000.0, 600.0, 500.0, 400.0], Projection::Side, true),
];

const fn panel(label: &'static str, place: [f64; 4], projection: Projection, beams: bool) -> Panel {
    Panel { label, place, projection, beams }
}

/// Colours of design and non-design faces and of the skeleton.
const DESIGN: [u8; 3] = [168, 178, 190];
const NON_DESIGN: [u8; 3] = [206, 88, 80];
const SKELETON: [u8; 3] = [20, 24, 32];

/// A triangle with its colour.
struct Facet {
    corners: [Point3<f64>; 3],
    colour: [u8; 3],
}

/// What is drawn, as loose triangles and lines.
struct Model {
    mesh: Vec<Facet>,
    beams: Vec<Facet>,
    lines: Vec<[Point3<f64>; 2]>,
    points: Vec<Point3<f64>>,
}

impl Model {
    fn new(view: &View<'_>) -> Self {
        let mesh = &view.surface.mesh;
        let labels = &view.surface.labels.of_face;
        let faces = mesh.faces().zip(labels);
        let beams = view.parts.iter().flat_map(|part| {
            part.triangles
                .iter()
                .map(|t| Facet { corners: t.map(|i| part.points[i as usize]), colour: part.colour })
        });
        Self {
            mesh: faces
                .map(|(f, l)| Facet { corners: mesh.corners(f), colour: colour(l.is_design()) })
                .collect(),
            beams: beams.collect(),
            lines: view.skeleton.segments().map(|s| s.map(|p| view.skeleton.position(p))).collect(),
            points: mesh.positions().to_vec(),
        }
    }

    /// The camera that fits the mesh into a panel.
    fn camera(&self, panel: &Panel) -> Camera {
        Camera::fit(panel.projection, &self.points, panel.place)
    }
}

fn colour(design: bool) -> [u8; 3] {
    if design { DESIGN } else { NON_DESIGN }
}

/// Where the light comes from, in the axes of the picture: from the upper left, before it.
const LIGHT: [f64; 3] = [-0.35, 0.5, 0.79];

/// Light a face with this normal (in the axes of the picture) gets: 0.4 to 1.
fn light(normal: &Vector3<f64>) -> f64 {
    0.7 + 0.3 * normal.dot(&Vector3::from(LIGHT))
}

/// A colour in that light.
fn lit(colour: [u8; 3], light: f64) -> [u8; 3] {
    colour.map(|c| (f64::from(c) * light).clamp(0.0, 255.0) as u8)
}
