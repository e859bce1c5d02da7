//! The frame as a CalculiX model: beam elements with sections, node sets for supports and loads.
//!
//! ```text
//! *NODE, *ELEMENT, TYPE=B32R     every beam in elements about two radii long, nodes shared
//! *BEAM SECTION                  CIRC, RECT, PIPE or BOX; other shapes as the rectangle of equal
//!                                I₁ and I₂, with the density that gives the mass of the shape
//! *NSET, NSET=NON_DESIGN_1       nodes at the interface sections of each non-design set
//! ```
//!
//! The file has no step: supports and loads are the user's. `*INCLUDE` it, or append a step as the
//! comment at its end shows. CalculiX expands beams to solids: where beams of different direction
//! share a node it joins them by a rigid body (user's manual, "Beam elements").
//! Units: mm, N, MPa, t.

use std::collections::BTreeMap;
use std::io::{self, Write};

use nalgebra::Point3;

use super::assembly::mark;
use super::material::Material;
use super::plain::one_line;
use crate::frame::{Beam, Frame};
use crate::mesh::InterfaceSection;
use crate::section::Shape;

/// Length of an element in section radii; shorter ones make the expanded solids squat.
const ELEMENT: f64 = 4.0;

/// Most elements in one beam.
const MOST_ELEMENTS: usize = 20;

/// Writes the model.
///
/// * `name`: of the part, for the head.
/// * `interfaces`: what the nodes of interface sections belong to.
///
/// # Errors
/// What `out` says.
pub fn write(
    name: &str,
    frame: &Frame,
    interfaces: &[InterfaceSection],
    material: &Material,
    out: &mut dyn Write,
) -> io::Result<()> {
    let model = Model::of(frame);
    writeln!(out, "*HEADING\nbeams of {}, mm N MPa t", one_line(name))?;
    writeln!(out, "*NODE, NSET=ALL")?;
    for (i, p) in model.nodes.iter().enumerate() {
        writeln!(out, "{}, {:.9e}, {:.9e}, {:.9e}", i + 1, p.x, p.y, p.z)?;
    }
    let mut number = 0;
    for (i, elements) in model.elements.iter().enumerate() {
        writeln!(out, "*ELEMENT, TYPE=B32R, ELSET={}", mark(i))?;
        for [a, m, b] in elements {
            number += 1;
            writeln!(out, "{number}, {}, {}, {}", a + 1, m + 1, b + 1)?;
        }
    }
    node_sets(frame, interfaces, out)?;
    for (i, beam) in frame.beams.iter().enumerate() {
        section(&mark(i), beam, material, out)?;
    }
    writeln!(
        out,
        "** Supports and loads are yours, for instance:\n\
         ** *STEP\n** *STATIC\n** *BOUNDARY\n** NON_DESIGN_1, 1, 6\n** *CLOAD\n\
         ** NON_DESIGN_2, 3, -100.\n** *NODE FILE\n** U\n** *END STEP"
    )
}

/// Nodes and elements of all beams.
struct Model {
    nodes: Vec<Point3<f64>>,
    /// Elements of each beam: first node, middle node, last node.
    elements: Vec<Vec<[usize; 3]>>,
}

impl Model {
    fn of(frame: &Frame) -> Self {
        let mut nodes: Vec<Point3<f64>> = frame.nodes.iter().map(|n| n.position).collect();
        let elements = frame
            .beams
            .iter()
            .map(|beam| {
                let spans = beam.spans().map(|(ends, _)| ends.map(|n| n.index()));
                let radius = (beam.shape.properties.area / std::f64::consts::PI).sqrt();
                spans.flat_map(|ends| span(&mut nodes, ends, radius)).collect()
            })
            .collect();
        Self { nodes, elements }
    }
}

/// The elements of a straight span between two nodes.
fn span(nodes: &mut Vec<Point3<f64>>, [a, b]: [usize; 2], radius: f64) -> Vec<[usize; 3]> {
    let (start, way) = (nodes[a], nodes[b] - nodes[a]);
    let wanted = (way.norm() / (ELEMENT * radius)).ceil();
    let count = if wanted.is_finite() { (wanted as usize).clamp(1, MOST_ELEMENTS) } else { 1 };
    let mut at = a;
    (0..count)
        .map(|k| {
            let mut place = |part: f64| {
                nodes.push(start + way * part);
                nodes.len() - 1
            };
            let middle = place((k as f64 + 0.5) / count as f64);
            let end = if k + 1 == count { b } else { place((k as f64 + 1.0) / count as f64) };
            [std::mem::replace(&mut at, end), middle, end]
        })
        .collect()
}

/// The nodes at the interface sections of each non-design set.
fn node_sets(
    frame: &Frame,
    interfaces: &[InterfaceSection],
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut sets: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (i, node) in frame.nodes.iter().enumerate() {
        if let Some(section) = node.interface.and_then(|s| interfaces.get(s as usize)) {
            sets.entry(section.set.0).or_default().push(i + 1);
        }
    }
    for (set, nodes) in sets {
        writeln!(out, "*NSET, NSET=NON_DESIGN_{}", set + 1)?;
        nodes.iter().try_for_each(|n| writeln!(out, "{n},"))?;
    }
    Ok(())
}

/// The section of one beam, and a material of its own where the density has to make up for the
/// area.
fn section(mark: &str, beam: &Beam, material: &Material, out: &mut dyn Write) -> io::Result<()> {
    let Dimensions { kind, sizes, area } = Dimensions::of(beam);
    let density = material.density * 1e-12 * beam.shape.properties.area / area;
    writeln!(out, "** {mark}: {}", one_line(&beam.shape.name()))?;
    writeln!(out, "*MATERIAL, NAME=M_{mark}")?;
    writeln!(out, "*ELASTIC\n{:?}, {:?}", material.elastic_modulus, material.poisson)?;
    writeln!(out, "*DENSITY\n{density:.9e}")?;
    writeln!(out, "*BEAM SECTION, ELSET={mark}, MATERIAL=M_{mark}, SECTION={kind}")?;
    let sizes: Vec<String> = sizes.iter().map(|x| format!("{x:.9}")).collect();
    writeln!(out, "{}", sizes.join(", "))?;
    let y = beam.axes.rolled(beam.shape.roll).y;
    writeln!(out, "{:.12}, {:.12}, {:.12}", y.x, y.y, y.z)
}

/// A section as CalculiX knows it: sizes along the profile's y and z.
struct Dimensions {
    kind: &'static str,
    sizes: Vec<f64>,
    /// Area it has there, mm².
    area: f64,
}

impl Dimensions {
    fn of(beam: &Beam) -> Self {
        let p = &beam.shape.properties;
        let new = |kind, sizes, area| Self { kind, sizes, area };
        match beam.shape.profile.shape {
            Shape::Round { d } => new("CIRC", vec![d, d], p.area),
            Shape::Ellipse { b, h } => new("CIRC", vec![b, h], p.area),
            Shape::Rectangle { b, h } => new("RECT", vec![b, h], p.area),
            Shape::Tube { d, t } => new("PIPE", vec![0.5 * d, t], p.area),
            Shape::Box { b, h, t, .. } => {
                let area = b * h - (b - 2.0 * t) * (h - 2.0 * t);
                new("BOX", vec![b, h, t, t, t, t], area)
            }
            _ => {
                // b h³ / 12 = I_y and h b³ / 12 = I_z: h/b = √(I_y/I_z).
                let ratio = (p.i_xx / p.i_yy).sqrt();
                let b = (12.0 * p.i_yy / ratio).powf(0.25);
                new("RECT", vec![b, ratio * b], ratio * b * b)
            }
        }
    }
}
