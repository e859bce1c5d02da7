//! Readers of surface meshes: file in, [`RawMesh`] out.
pub mod raw_mesh;
pub use raw_mesh::{LabelCarriers, Polygons, RawMesh};
