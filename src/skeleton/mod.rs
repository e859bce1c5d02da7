//! The skeleton.
pub mod error;
pub mod graph;
pub mod identifier_box;
pub(crate) mod inside;
pub mod local;
pub mod params;
