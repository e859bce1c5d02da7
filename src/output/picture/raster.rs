//! Pixels: triangles in a depth buffer, the mesh as glass over them, lines and labels on top.

use std::io::{self, Write};

use nalgebra::{Point2, Point3};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster};

use super::camera::Camera;
use super::{Facet, Model, Panel, SIZE, SKELETON, light, lit};
use crate::segment;

/// Pixels drawn for one pixel written, each way: smooths the edges.
const FINE: usize = 2;

const BACKGROUND: [u8; 3] = [255, 255, 255];
const LABEL: [u8; 3] = [70, 76, 86];

/// Half the width of the lines of the skeleton, fine pixels.
const LINE: f64 = 1.7;

/// Opacity of the mesh seen straight on and at its rim, when beams are shown through it.
const GLASS: [f64; 2] = [0.12, 0.55];

/// Distance of a label from the corner of its panel, pixels.
const LABEL_AT: f64 = 14.0;

/// Draws all panels and writes them as PNG.
pub(super) fn write(model: &Model, panels: &[Panel], out: &mut dyn Write) -> io::Result<()> {
    let mut canvas = Canvas::new(SIZE.map(|s| s as usize * FINE));
    for panel in panels {
        draw(&mut canvas, model, panel);
    }
    let mut image = canvas.reduced();
    for panel in panels {
        label(&mut image, panel);
    }
    let mut encoder = png::Encoder::new(out, SIZE[0] as u32, SIZE[1] as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(image.as_flattened())?;
    Ok(writer.finish()?)
}

fn draw(canvas: &mut Canvas, model: &Model, panel: &Panel) {
    let fine = panel.place.map(|x| x * FINE as f64);
    let camera = Camera::fit(panel.projection, &model.points, fine);
    if !panel.beams {
        model.mesh.iter().for_each(|f| canvas.facet(f, &camera));
        return;
    }
    model.beams.iter().for_each(|f| canvas.facet(f, &camera));
    canvas.glass(&model.mesh, &camera);
    for ends in &model.lines {
        canvas.line(&ends.map(|p| camera.project(&p)));
    }
}

struct Canvas {
    width: usize,
    height: usize,
    colour: Vec<[u8; 3]>,
    depth: Vec<f32>,
}

impl Canvas {
    fn new([width, height]: [usize; 2]) -> Self {
        let count = width * height;
        Self {
            width,
            height,
            colour: vec![BACKGROUND; count],
            depth: vec![f32::NEG_INFINITY; count],
        }
    }

    /// An opaque triangle.
    fn facet(&mut self, facet: &Facet, camera: &Camera) {
        let normal = camera.normal(&facet.corners);
        if normal.z <= 0.0 {
            return;
        }
        let colour = lit(facet.colour, light(&normal));
        let corners = facet.corners.map(|p| camera.project(&p));
        visit(&corners, self.width, self.height, |i, depth| {
            if depth > self.depth[i] {
                self.depth[i] = depth;
                self.colour[i] = colour;
            }
        });
    }

    /// The front of a surface laid over what is there; denser where it turns away.
    fn glass(&mut self, facets: &[Facet], camera: &Camera) {
        let mut front: Vec<(f32, [u8; 3], f32)> =
            vec![(f32::NEG_INFINITY, BACKGROUND, 0.0); self.colour.len()];
        for facet in facets {
            let normal = camera.normal(&facet.corners);
            if normal.z <= 0.0 {
                continue;
            }
            let rim = (1.0 - normal.z).powi(2);
            let opacity = (GLASS[0] + (GLASS[1] - GLASS[0]) * rim) as f32;
            let colour = lit(facet.colour, light(&normal));
            let corners = facet.corners.map(|p| camera.project(&p));
            visit(&corners, self.width, self.height, |i, depth| {
                if depth > front[i].0 {
                    front[i] = (depth, colour, opacity);
                }
            });
        }
        for (i, (depth, colour, opacity)) in front.into_iter().enumerate() {
            if depth > self.depth[i] {
                self.colour[i] = mixed(self.colour[i], colour, opacity);
            }
        }
    }

    /// A thick line on top of everything.
    fn line(&mut self, ends: &[Point3<f64>; 2]) {
        let [a, b] = ends.map(|p| Point2::new(p.x, p.y));
        let (low, high) = (a.inf(&b), a.sup(&b));
        for (x, y) in pixels([low.x - LINE, low.y - LINE], [high.x + LINE, high.y + LINE], self) {
            let p = Point2::new(x as f64 + 0.5, y as f64 + 0.5);
            if segment::distance(&p, &a, &b) <= LINE {
                self.colour[y * self.width + x] = SKELETON;
            }
        }
    }

    /// The mean of each block of fine pixels.
    fn reduced(&self) -> Vec<[u8; 3]> {
        let (width, height) = (self.width / FINE, self.height / FINE);
        let mean = |x: usize, y: usize, channel: usize| {
            let fine = (0..FINE * FINE).map(|k| {
                let (x, y) = (x * FINE + k % FINE, y * FINE + k / FINE);
                u32::from(self.colour[y * self.width + x][channel])
            });
            (fine.sum::<u32>() / (FINE * FINE) as u32) as u8
        };
        (0..width * height)
            .map(|i| std::array::from_fn(|channel| mean(i % width, i / width, channel)))
            .collect()
    }
}

/// Pixels whose centre may lie in a box, cut at the canvas.
fn pixels(
    low: [f64; 2],
    high: [f64; 2],
    canvas: &Canvas,
) -> impl Iterator<Item = (usize, usize)> + use<> {
    let range = |k: usize, size: usize| {
        let from = (low[k].floor().max(0.0) as usize).min(size);
        from..(high[k].ceil().max(0.0) as usize).min(size)
    };
    let (columns, rows) = (range(0, canvas.width), range(1, canvas.height));
    rows.flat_map(move |y| columns.clone().map(move |x| (x, y)))
}

/// Calls `pixel` with the index and the depth of every pixel whose centre lies in a triangle.
pub(super) fn visit(
    [a, b, c]: &[Point3<f64>; 3],
    width: usize,
    height: usize,
    mut pixel: impl FnMut(usize, f32),
) {
    let low = a.inf(b).inf(c);
    let high = a.sup(b).sup(c);
    let side = |p: &Point3<f64>, q: &Point3<f64>, x: f64, y: f64| {
        (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x)
    };
    let whole = side(a, b, c.x, c.y);
    if whole == 0.0 || !whole.is_finite() {
        return;
    }
    let end = |high: f64, size: usize| (high.ceil().max(0.0) as usize).min(size);
    for y in low.y.floor().max(0.0) as usize..end(high.y, height) {
        let py = y as f64 + 0.5;
        let (from, to) = span(&[[a, b], [b, c], [c, a]], py).unwrap_or((low.x, high.x));
        for x in from.floor().max(0.0) as usize..end(to, width) {
            let px = x as f64 + 0.5;
            let weights = [side(b, c, px, py), side(c, a, px, py), side(a, b, px, py)];
            if weights.iter().all(|w| w * whole >= 0.0) {
                let depth = (weights[0] * a.z + weights[1] * b.z + weights[2] * c.z) / whole;
                pixel(y * width + x, depth as f32);
            }
        }
    }
}

/// Where a row enters a triangle and leaves it, a pixel to spare; `None` where it only touches.
fn span(sides: &[[&Point3<f64>; 2]; 3], y: f64) -> Option<(f64, f64)> {
    let crossings = sides.iter().filter(|[p, q]| (p.y <= y) != (q.y <= y));
    let places = crossings.map(|[p, q]| p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x));
    let (low, high) =
        places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    (low <= high).then_some((low - 1.0, high + 1.0))
}

fn mixed(under: [u8; 3], over: [u8; 3], opacity: f32) -> [u8; 3] {
    std::array::from_fn(|k| {
        (f32::from(under[k]) * (1.0 - opacity) + f32::from(over[k]) * opacity).round() as u8
    })
}

/// The name of a view in its upper left corner.
fn label(image: &mut [[u8; 3]], panel: &Panel) {
    let width = SIZE[0] as usize;
    let [mut x, y] = [panel.place[0] + LABEL_AT, panel.place[1] + LABEL_AT].map(|c| c as usize);
    for letter in panel.label.chars() {
        let Some(raster) = get_raster(letter, FontWeight::Regular, RasterHeight::Size24) else {
            continue;
        };
        for (row, line) in raster.raster().iter().enumerate() {
            for (column, &opacity) in line.iter().enumerate() {
                let at = (y + row) * width + x + column;
                if let Some(pixel) = image.get_mut(at) {
                    *pixel = mixed(*pixel, LABEL, f32::from(opacity) / 255.0);
                }
            }
        }
        x += raster.width();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_triangles_of_a_square_cover_each_pixel() {
        let corner = |x: f64, y: f64| Point3::new(x, y, 7.0);
        let mut hits = [0; 16];
        let square = [corner(0.0, 0.0), corner(4.0, 0.0), corner(4.0, 4.0), corner(0.0, 4.0)];
        for t in [[0, 1, 2], [0, 2, 3]] {
            visit(&t.map(|i: usize| square[i]), 4, 4, |i, depth| {
                hits[i] += 1;
                assert!((depth - 7.0).abs() < 1e-6);
            });
        }
        assert!(hits.iter().all(|&n| n >= 1), "{hits:?}");
    }

    #[test]
    fn triangles_beyond_the_canvas_are_cut() {
        let far = [(-1e9, -1e9), (1e9, 0.0), (0.0, 1e9)].map(|(x, y)| Point3::new(x, y, 0.0));
        let mut count = 0;
        visit(&far, 8, 8, |_, _| count += 1);
        assert_eq!(count, 64);
    }
}
