//! Shapes: the mesh as a pale silhouette, beams from back to front, the skeleton on top.
//!
//! Only presentation attributes are used, no style sheet: a page with a strict policy may hold it.

use std::fmt::Write as _;
use std::io::{self, Write};

use nalgebra::Point3;

use super::camera::Camera;
use super::{
    DESIGN, Edge, Facet, Model, NON_DESIGN, Panel, Projection, SIZE, SKELETON, light, lit, panel,
};
use crate::output::view::View;

/// Triangles longer than this part of the panel are cut, so that sorting by depth works where
/// beams cross. Halving it doubles the file; at twice the length beams show through each other.
const LONGEST: f64 = 0.15;

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
    silhouette(text, &model.pale, &camera, if panel.beams { 0.25 } else { 0.9 });
    if panel.beams {
        let longest = LONGEST * panel.place[2];
        solids(text, &model.beams, &camera, longest);
        lines(text, &model.lines, &camera);
    }
    outlines(text, model, &camera);
}

/// All faces that look to the viewer, as one shape a colour.
fn silhouette(text: &mut String, mesh: &[Facet], camera: &Camera, opacity: f64) {
    for colour in [DESIGN, NON_DESIGN] {
        let mut path = String::new();
        for facet in mesh.iter().filter(|f| f.colour == colour) {
            if camera.normal(&facet.corners).z > 0.0 {
                polygon(&mut path, &facet.corners.map(|p| camera.project(&p)));
            }
        }
        if !path.is_empty() {
            let fill = hex(colour);
            let _ = writeln!(text, "<path fill=\"{fill}\" opacity=\"{opacity}\" d=\"{path}\"/>");
        }
    }
}

/// Opaque facets from back to front; neighbours in the order of one colour share a path.
fn solids(text: &mut String, facets: &[Facet], camera: &Camera, longest: f64) {
    let mut seen: Vec<(f64, [u8; 3], [Point3<f64>; 3])> = Vec::new();
    for facet in facets {
        let normal = camera.normal(&facet.corners);
        if normal.z > 0.0 {
            let shade = (light(&normal) * SHADES).round() / SHADES;
            cut(facet.corners.map(|p| camera.project(&p)), longest, &mut |piece| {
                let depth = piece.iter().map(|p| p.z).sum::<f64>();
                seen.push((depth, lit(facet.colour, shade), piece));
            });
        }
    }
    seen.sort_by(|a, b| a.0.total_cmp(&b.0));
    for run in seen.chunk_by(|a, b| a.1 == b.1) {
        let fill = hex(run[0].1);
        let mut path = String::new();
        run.iter().for_each(|(_, _, corners)| polygon(&mut path, corners));
        // The stroke closes the hair lines between neighbours.
        let _ = writeln!(
            text,
            "<path fill=\"{fill}\" stroke=\"{fill}\" stroke-width=\".4\" d=\"{path}\"/>"
        );
    }
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
        "<path fill=\"none\" stroke=\"{stroke}\" stroke-width=\"1.5\" \
         stroke-linecap=\"round\" d=\"{path}\"/>"
    );
}

/// Edges of the mesh between a face that looks to the viewer and one that does not.
fn outlines(text: &mut String, model: &Model, camera: &Camera) {
    let mut path = String::new();
    for Edge { ends, normals } in &model.edges {
        let [a, b] = normals.map(|n| camera.turn(&n).z > 0.0);
        if a != b {
            line(&mut path, &ends.map(|p| camera.project(&p)));
        }
    }
    let _ = writeln!(
        text,
        "<path fill=\"none\" stroke=\"#5b6573\" stroke-width=\".5\" opacity=\".6\" d=\"{path}\"/>"
    );
}

fn polygon(path: &mut String, [a, b, c]: &[Point3<f64>; 3]) {
    let _ = write!(path, "M{:.1} {:.1}L{:.1} {:.1} {:.1} {:.1}Z", a.x, a.y, b.x, b.y, c.x, c.y);
}

fn line(path: &mut String, [a, b]: &[Point3<f64>; 2]) {
    let _ = write!(path, "M{:.1} {:.1}L{:.1} {:.1}", a.x, a.y, b.x, b.y);
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
