//! Shapes: the mesh from back to front; beside it the beams in its pale silhouette, with the skeleton
//! on top.
//!
//! Inside a panel a tenth of a pixel is the unit, so that corners are whole numbers.
//! Only presentation attributes are used, no style sheet: a page with a strict policy may hold it.

use std::fmt::Write as _;
use std::io::{self, Write};

use nalgebra::Point3;

use super::camera::Camera;
use super::layers::{Piece, layers};
use super::outline::Outline;
use super::{
    DESIGN, Facet, Model, NON_DESIGN, Panel, Projection, SIZE, SKELETON, light, lit, panel,
};
use crate::output::view::View;

/// Triangles longer than this part of the panel are cut, so that sorting by depth works where
/// beams cross.
const LONGEST: f64 = 0.05;

/// Light is drawn in so many steps: neighbouring facets then share a path.
const SHADES: f64 = 24.0;

/// The view of beams alone.
const ALONE: Panel = panel("beams", [0.0, 0.0, 900.0, 600.0], Projection::Isometric, true);

/// Writes all panels.
pub(super) fn write(model: &Model, panels: &[Panel], out: &mut dyn Write) -> io::Result<()> {
    let mut text = open(SIZE);
    for panel in panels {
        draw(&mut text, model, panel);
        let [x, y, ..] = panel.place;
        let _ = writeln!(
            text,
            "<text x=\"{}\" y=\"{}\" font-family=\"sans-serif\" font-size=\"20\" \
             fill=\"#464c56\">{}</text>",
            x + 14.0,
            y + 30.0,
            panel.label
        );
    }
    text.push_str("</svg>\n");
    out.write_all(text.as_bytes())
}

/// The isometric view of the beams in the mesh, for a page.
pub(in crate::output) fn beams(view: &View<'_>) -> String {
    let model = Model::new(view);
    let mut text = open([ALONE.place[2], ALONE.place[3]]);
    draw(&mut text, &model, &ALONE);
    text.push_str("</svg>\n");
    text
}

fn open([width, height]: [f64; 2]) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         role=\"img\" aria-label=\"mesh and beams\">\n"
    )
}

fn draw(text: &mut String, model: &Model, panel: &Panel) {
    let camera = model.camera(panel);
    text.push_str("<g transform=\"scale(.1)\">\n");
    if panel.beams {
        silhouette(text, &model.mesh, &camera);
        solids(text, &model.beams, &camera, panel);
        lines(text, &model.lines, &camera);
        rim(text, &model.mesh, &camera);
    } else {
        solids(text, &model.mesh, &camera, panel);
    }
    text.push_str("</g>\n");
}

/// Facets that look to the viewer, as they are seen.
fn facing<'a>(
    facets: impl IntoIterator<Item = &'a Facet>,
    camera: &Camera,
) -> impl Iterator<Item = [Point3<f64>; 3]> {
    facets
        .into_iter()
        .filter(|f| camera.normal(&f.corners).z > 0.0)
        .map(|f| f.corners.map(|p| camera.project(&p)))
}

/// The union of triangles as path data.
fn union(triangles: impl Iterator<Item = [Point3<f64>; 3]>) -> String {
    let mut outline = Outline::default();
    triangles.for_each(|corners| outline.add(&corners));
    outline.path()
}

/// All faces that look to the viewer, as one shape a colour.
fn silhouette(text: &mut String, mesh: &[Facet], camera: &Camera) {
    for colour in [DESIGN, NON_DESIGN] {
        let path = union(facing(mesh.iter().filter(|f| f.colour == colour), camera));
        if !path.is_empty() {
            let fill = hex(colour);
            let _ = writeln!(text, "<path fill=\"{fill}\" opacity=\".25\" d=\"{path}\"/>");
        }
    }
}

/// Where faces of the mesh begin to turn away.
fn rim(text: &mut String, mesh: &[Facet], camera: &Camera) {
    let path = union(facing(mesh, camera));
    let _ = writeln!(
        text,
        "<path fill=\"none\" stroke=\"#5b6573\" stroke-width=\"5\" opacity=\".6\" d=\"{path}\"/>"
    );
}

/// Opaque facets, layer upon layer.
fn solids(text: &mut String, facets: &[Facet], camera: &Camera, panel: &Panel) {
    let mut pieces = Vec::new();
    for facet in facets {
        let normal = camera.normal(&facet.corners);
        if normal.z > 0.0 {
            let shade = (light(&normal) * SHADES).round() / SHADES;
            let colour = lit(facet.colour, shade);
            cut(
                facet.corners.map(|p| camera.project(&p)),
                LONGEST * panel.place[2],
                &mut |corners| {
                    pieces.push(Piece { corners, colour });
                },
            );
        }
    }
    // The stroke closes the hair lines between neighbours.
    text.push_str("<g fill=\"currentColor\" stroke=\"currentColor\" stroke-width=\"4\">\n");
    for layer in layers(pieces, panel.place) {
        let path = layer.outline.path();
        if !path.is_empty() {
            let _ = writeln!(text, "<path color=\"{}\" d=\"{path}\"/>", hex(layer.colour));
        }
    }
    text.push_str("</g>\n");
}

/// Halves a triangle across its longest side until no side is longer than `longest`.
fn cut(corners: [Point3<f64>; 3], longest: f64, piece: &mut impl FnMut([Point3<f64>; 3])) {
    let length = |k: usize| (corners[(k + 1) % 3] - corners[k]).norm();
    let k = (0..3).max_by(|&i, &j| length(i).total_cmp(&length(j))).unwrap_or(0);
    // Sides that are no numbers end it too.
    if !(length(k) > longest && longest > 0.0 && length(k).is_finite()) {
        return piece(corners);
    }
    let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
    let middle = nalgebra::center(&a, &b);
    cut([a, middle, c], longest, piece);
    cut([middle, b, c], longest, piece);
}

fn lines(text: &mut String, lines: &[[Point3<f64>; 2]], camera: &Camera) {
    let mut path = String::new();
    for ends in lines {
        line(&mut path, &ends.map(|p| camera.project(&p)));
    }
    let stroke = hex(SKELETON);
    let _ = writeln!(
        text,
        "<path fill=\"none\" stroke=\"{stroke}\" stroke-width=\"15\" \
         stroke-linecap=\"round\" d=\"{path}\"/>"
    );
}

fn line(path: &mut String, [a, b]: &[Point3<f64>; 2]) {
    let [a, b] = [a, b].map(|p| [p.x, p.y].map(|x| (10.0 * x).round() as i32));
    let _ = write!(path, "M{} {}L{} {}", a[0], a[1], b[0], b[1]);
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cut_pieces_keep_the_area() {
        let corners = [(0.0, 0.0), (100.0, 0.0), (0.0, 3.0)].map(|(x, y)| Point3::new(x, y, 1.0));
        let (mut area, mut count) = (0.0, 0);
        cut(corners, 20.0, &mut |[a, b, c]| {
            area += (b - a).cross(&(c - a)).norm() / 2.0;
            count += 1;
        });
        assert!((area - 150.0).abs() < 1e-9 && count > 4, "{area} in {count}");
    }
}
