//! Meshes made in code, with known axes, radii and counts.

#![allow(dead_code, unreachable_pub, reason = "each test file uses the part it needs")]

pub mod curves;
pub mod families;
pub mod frame;
pub mod program;
pub mod zero_surface;

use beamwright::mesh::{LabelParams, Surface, prepare};
use beamwright_formats::{Polygons, RawMesh};

/// Triangles over shared points; `non_design[f]` where a face had to be kept.
#[derive(Clone, Debug, Default)]
pub struct TestMesh {
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    pub non_design: Vec<bool>,
}

impl TestMesh {
    /// The mesh with the triangles labelled whose middle lies on a non-design part.
    pub fn labelled(mut self, is_non_design: impl Fn([f64; 3]) -> bool) -> Self {
        let middle = |t: &[u32; 3]| {
            [0, 1, 2].map(|k| t.iter().map(|&v| self.positions[v as usize][k]).sum::<f64>() / 3.0)
        };
        self.non_design = self.triangles.iter().map(|t| is_non_design(middle(t))).collect();
        self
    }

    /// What a reader would deliver.
    pub fn raw(&self) -> RawMesh {
        let mut faces = Polygons::default();
        self.triangles.iter().for_each(|t| faces.push(t.iter().copied()));
        let mut raw = RawMesh { positions: self.positions.clone(), faces, ..RawMesh::default() };
        if self.non_design.contains(&true) {
            raw.carriers.face_property = self.non_design.iter().map(|&n| i64::from(n)).collect();
        }
        raw
    }

    /// The prepared surface.
    pub fn surface(&self) -> Surface {
        prepare(&self.raw(), &LabelParams::default()).expect("a usable mesh")
    }

    /// The mesh with every point mapped.
    pub fn mapped(&self, map: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        Self { positions: self.positions.iter().map(|&p| map(p)).collect(), ..self.clone() }
    }

    /// As an OBJ file with the groups `design` and `non_design`.
    pub fn obj(&self) -> String {
        use std::fmt::Write;
        let mut text = String::new();
        for [x, y, z] in &self.positions {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for (label, name) in [(false, "design"), (true, "non_design")] {
            let _ = writeln!(text, "g {name}");
            for (f, [a, b, c]) in self.triangles.iter().enumerate() {
                if self.non_design.get(f).copied().unwrap_or(false) == label {
                    let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
                }
            }
        }
        text
    }
}
