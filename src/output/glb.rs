//! Binary glTF 2.0: the mesh, the skeleton as lines, one named node a beam.
//!
//! ```text
//!   part ─┬─ mesh ─┬─ design        translucent
//!         │        └─ non-design
//!         ├─ skeleton               lines
//!         └─ beams ─┬─ B001 CHS 60.3x4    its figures in `extras`
//!                   └─ …
//! ```
//!
//! glTF demands metres and Y up: a point (x, y, z) mm is written as (x, z, −y) / 1000. Surfaces
//! carry no normals, so that viewers show them faceted, as they are.

use std::io::{self, Write};

use nalgebra::Point3;
use serde_json::{Value, json};

use super::beam_table;
use super::view::{View, bounds};

/// glTF's words for numbers.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;
const LINES: u32 = 1;
const TRIANGLES: u32 = 4;

const METRES: f64 = 1e-3;

/// Colours of what is no beam: design, non-design, skeleton; sRGB with opacity.
const DESIGN: ([u8; 3], f32) = ([176, 184, 194], 0.3);
const NON_DESIGN: ([u8; 3], f32) = ([200, 60, 60], 0.5);
const SKELETON: ([u8; 3], f32) = ([30, 30, 30], 1.0);

/// Writes a result as one .glb file.
///
/// # Errors
/// What `out` says.
pub fn write(name: &str, view: &View<'_>, out: &mut dyn Write) -> io::Result<()> {
    let mut file = File::default();
    let children: Vec<usize> =
        [mesh(&mut file, view), skeleton(&mut file, view), beams(&mut file, view)]
            .into_iter()
            .flatten()
            .collect();
    let root = file.node(json!({ "name": name, "children": children }));
    file.write(root, out)
}

fn mesh(file: &mut File, view: &View<'_>) -> Option<usize> {
    let mesh = &view.surface.mesh;
    let faces = |design: bool| -> Vec<u32> {
        let labels = &view.surface.labels.of_face;
        let wanted = mesh.triangles().iter().zip(labels).filter(|(_, l)| l.is_design() == design);
        wanted.flat_map(|(t, _)| *t).collect()
    };
    let positions = file.positions(mesh.positions())?;
    let mut child = |name: &str, design: bool, (rgb, alpha): ([u8; 3], f32)| {
        let indices = file.indices(&faces(design))?;
        let material = file.material(name, rgb, alpha);
        Some(file.body(name, TRIANGLES, [positions, indices, material]))
    };
    let children: Vec<usize> =
        [child("design", true, DESIGN), child("non-design", false, NON_DESIGN)]
            .into_iter()
            .flatten()
            .collect();
    Some(file.node(json!({ "name": "mesh", "children": children })))
}

fn skeleton(file: &mut File, view: &View<'_>) -> Option<usize> {
    let points: Vec<Point3<f64>> = view.skeleton.points.iter().map(|p| p.position).collect();
    let segments: Vec<u32> = view.skeleton.segments().flatten().collect();
    let parts = [
        file.positions(&points)?,
        file.indices(&segments)?,
        file.material("skeleton", SKELETON.0, SKELETON.1),
    ];
    Some(file.body("skeleton", LINES, parts))
}

fn beams(file: &mut File, view: &View<'_>) -> Option<usize> {
    let rows = beam_table::rows(view.frame);
    let mut materials: Vec<([u8; 3], usize)> = Vec::new();
    let mut children = Vec::new();
    for (row, part) in rows.iter().zip(view.beam_meshes()) {
        let Some(part) = part else { continue };
        let corners: Vec<u32> = part.triangles.iter().flatten().copied().collect();
        let (Some(positions), Some(indices)) =
            (file.positions(&part.points), file.indices(&corners))
        else {
            continue;
        };
        let known = materials.iter().find(|m| m.0 == part.colour).map(|m| m.1);
        let material = known.unwrap_or_else(|| {
            let made = file.material(&row.profile, part.colour, 1.0);
            materials.push((part.colour, made));
            made
        });
        let node = file.body(&part.name, TRIANGLES, [positions, indices, material]);
        file.nodes[node]["extras"] = json!(row);
        children.push(node);
    }
    (!children.is_empty()).then(|| file.node(json!({ "name": "beams", "children": children })))
}

/// The tables of a glTF file and its binary part.
#[derive(Default)]
struct File {
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    accessors: Vec<Value>,
    views: Vec<Value>,
    binary: Vec<u8>,
}

impl File {
    fn node(&mut self, node: Value) -> usize {
        push(&mut self.nodes, node)
    }

    /// A node with one primitive of positions, indices and material.
    fn body(&mut self, name: &str, mode: u32, [positions, indices, material]: [usize; 3]) -> usize {
        let primitive = json!({
            "attributes": { "POSITION": positions },
            "indices": indices,
            "material": material,
            "mode": mode,
        });
        let mesh = push(&mut self.meshes, json!({ "name": name, "primitives": [primitive] }));
        self.node(json!({ "name": name, "mesh": mesh }))
    }

    fn material(&mut self, name: &str, rgb: [u8; 3], alpha: f32) -> usize {
        let [r, g, b] = rgb.map(linear);
        let mut material = json!({
            "name": name,
            "doubleSided": true,
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, alpha],
                "metallicFactor": 0.0,
                "roughnessFactor": 0.7,
            },
        });
        if alpha < 1.0 {
            material["alphaMode"] = json!("BLEND");
        }
        push(&mut self.materials, material)
    }

    /// An accessor of points; `None` for none, which glTF does not allow.
    fn positions(&mut self, points: &[Point3<f64>]) -> Option<usize> {
        let places: Vec<Point3<f64>> = points.iter().map(up).collect();
        let written = |p: &Point3<f64>| [p.x as f32, p.y as f32, p.z as f32];
        let (low, high) = bounds(&places);
        let bytes = places.iter().flat_map(written).flat_map(f32::to_le_bytes).collect();
        let accessor = json!({
            "componentType": FLOAT,
            "type": "VEC3",
            "count": points.len(),
            "min": written(&low),
            "max": written(&high),
        });
        self.accessor(accessor, VERTICES, bytes)
    }

    fn indices(&mut self, indices: &[u32]) -> Option<usize> {
        let bytes = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        let accessor = json!({
            "componentType": UNSIGNED_INT,
            "type": "SCALAR",
            "count": indices.len(),
        });
        self.accessor(accessor, INDICES, bytes)
    }

    fn accessor(&mut self, mut accessor: Value, target: u32, bytes: Vec<u8>) -> Option<usize> {
        if bytes.is_empty() {
            return None;
        }
        accessor["bufferView"] = json!(push(
            &mut self.views,
            json!({
                "buffer": 0,
                "byteOffset": self.binary.len(),
                "byteLength": bytes.len(),
                "target": target,
            })
        ));
        self.binary.extend(bytes);
        Some(push(&mut self.accessors, accessor))
    }

    fn write(self, root: usize, out: &mut dyn Write) -> io::Result<()> {
        let mut content = json!({
            "asset": { "version": "2.0", "generator": "beamwright" },
            "scene": 0,
            "scenes": [{ "nodes": [root] }],
            "nodes": self.nodes,
        });
        // glTF does not allow empty lists.
        if !self.binary.is_empty() {
            content["buffers"] = json!([{ "byteLength": self.binary.len() }]);
            content["bufferViews"] = self.views.into();
            content["accessors"] = self.accessors.into();
            content["meshes"] = self.meshes.into();
            content["materials"] = self.materials.into();
        }
        container(serde_json::to_vec(&content)?, self.binary, out)
    }
}

/// Adds to a table; the place it got.
fn push(table: &mut Vec<Value>, value: Value) -> usize {
    table.push(value);
    table.len() - 1
}

/// From mm, Z up, to metres, Y up.
fn up(p: &Point3<f64>) -> Point3<f64> {
    Point3::new(p.x, p.z, -p.y) * METRES
}

/// A channel of sRGB as linear light (IEC 61966-2-1).
fn linear(channel: u8) -> f32 {
    let c = f32::from(channel) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// The .glb container: a header and two chunks, each padded to four bytes.
fn container(mut json: Vec<u8>, mut binary: Vec<u8>, out: &mut dyn Write) -> io::Result<()> {
    json.resize(json.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let chunks = [(b"JSON", json), (b"BIN\0", binary)];
    let total = 12 + chunks.iter().map(|(_, c)| 8 + c.len()).sum::<usize>();
    let word = |n: usize| u32::try_from(n).map(u32::to_le_bytes).map_err(io::Error::other);
    out.write_all(b"glTF")?;
    out.write_all(&2u32.to_le_bytes())?;
    out.write_all(&word(total)?)?;
    for (kind, content) in chunks {
        out.write_all(&word(content.len())?)?;
        out.write_all(kind)?;
        out.write_all(&content)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_is_y_and_a_metre_is_a_thousand_millimetres() {
        assert_eq!(up(&Point3::new(1000.0, 2000.0, 3000.0)), Point3::new(1.0, 3.0, -2.0));
    }

    #[test]
    fn chunks_are_padded_to_four_bytes() {
        let mut out = Vec::new();
        container(b"{}".to_vec(), vec![1], &mut out).unwrap();
        assert_eq!(out.len(), 12 + 8 + 4 + 8 + 4);
        assert_eq!(out[8..12], (out.len() as u32).to_le_bytes());
    }
}
