//! Binary PLY: a labelled surface, and parts with a colour each.

use std::io::{self, Write};

use nalgebra::Point3;

use super::PartMesh;
use crate::mesh::Surface;

/// Bit of the face property `flags` that MeshLab reads as "selected".
const SELECTED: i32 = 32;

/// Colours of design and non-design faces.
const DESIGN: [u8; 3] = [200, 200, 200];
const NON_DESIGN: [u8; 3] = [225, 40, 40];

/// Writes a surface; its non-design faces are selected and red.
///
/// # Errors
/// What `out` says.
pub(in crate::output) fn write_labelled(surface: &Surface, out: &mut dyn Write) -> io::Result<()> {
    let mesh = &surface.mesh;
    let (points, triangles) = (mesh.positions().len(), mesh.triangles().len());
    header(out, "surface; flags 32: non-design", points, triangles, "int flags")?;
    mesh.positions().iter().try_for_each(|p| point(out, p))?;
    for (triangle, label) in mesh.triangles().iter().zip(&surface.labels.of_face) {
        let (flags, colour) = if label.is_design() { (0, DESIGN) } else { (SELECTED, NON_DESIGN) };
        corners(out, triangle)?;
        out.write_all(&flags.to_le_bytes())?;
        rgba(out, colour)?;
    }
    Ok(())
}

/// Writes parts one after the other, each in its colour, with its number from 1 as `quality`.
///
/// # Errors
/// What `out` says.
pub fn write_parts(parts: &[PartMesh], out: &mut dyn Write) -> io::Result<()> {
    let points = parts.iter().map(|p| p.points.len()).sum();
    let triangles = parts.iter().map(|p| p.triangles.len()).sum();
    header(out, "parts; quality: number of the part", points, triangles, "float quality")?;
    for part in parts {
        part.points.iter().try_for_each(|p| point(out, p))?;
    }
    let mut first = 0;
    for (number, part) in (1_u32..).zip(parts) {
        for triangle in &part.triangles {
            corners(out, &triangle.map(|i| i + first))?;
            out.write_all(&(number as f32).to_le_bytes())?;
            rgba(out, part.colour)?;
        }
        first += part.points.len() as u32;
    }
    Ok(())
}

fn header(
    out: &mut dyn Write,
    what: &str,
    points: usize,
    triangles: usize,
    of_face: &str,
) -> io::Result<()> {
    writeln!(out, "ply\nformat binary_little_endian 1.0\ncomment beamwright {what}; mm")?;
    writeln!(out, "element vertex {points}")?;
    writeln!(out, "property double x\nproperty double y\nproperty double z")?;
    writeln!(out, "element face {triangles}\nproperty list uchar int vertex_indices")?;
    writeln!(out, "property {of_face}")?;
    for channel in ["red", "green", "blue", "alpha"] {
        writeln!(out, "property uchar {channel}")?;
    }
    writeln!(out, "end_header")
}

fn point(out: &mut dyn Write, p: &Point3<f64>) -> io::Result<()> {
    p.iter().try_for_each(|c| out.write_all(&c.to_le_bytes()))
}

fn corners(out: &mut dyn Write, triangle: &[u32; 3]) -> io::Result<()> {
    out.write_all(&[3])?;
    triangle.iter().try_for_each(|c| out.write_all(&c.to_le_bytes()))
}

fn rgba(out: &mut dyn Write, [red, green, blue]: [u8; 3]) -> io::Result<()> {
    out.write_all(&[red, green, blue, 255])
}
