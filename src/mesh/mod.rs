//! The surface: welded, closed, oriented, labelled.
//!
//! [`prepare`](prepare::prepare) turns what a reader delivers into a [`Surface`]; everything later
//! works on that.

mod border;
pub mod contour;
mod edges;
pub mod error;
mod fans;
mod fill;
mod findings;
pub mod half_edge;
pub mod id;
pub mod indexed;
pub mod interface_section;
pub mod label;
mod near;
mod order;
mod orient;
mod plane;
pub mod prepare;
mod ray;
pub mod set;
mod shadow;
pub mod shell;
#[cfg(test)]
mod test_box;
pub mod triangle_tree;

pub(crate) use border::LoopFrame;
pub use error::MeshError;
pub use findings::{findings, unit_in_doubt};
pub use half_edge::HalfEdgeMesh;
pub use interface_section::{InterfaceKind, InterfaceSection};
pub use label::{Label, LabelParams};
pub(crate) use prepare::prepare_watched;
pub use prepare::{MeshReport, Surface, prepare};
pub use set::Labels;
pub(crate) use shadow::Shadow;
pub use triangle_tree::TriangleTree;
