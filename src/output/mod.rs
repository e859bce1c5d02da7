//! What leaves the program: STEP for manufacturing, the cut list, summaries, whole files.

pub mod assembly;
pub mod beam_table;
pub mod calculix;
mod cap;
pub mod cut_list;
mod decimate;
pub mod dxf;
pub mod files;
pub mod glb;
pub mod ifc;
pub mod material;
pub mod mesh_export;
pub mod mlp;
pub mod non_design;
mod part21;
pub mod picture;
mod plain;
pub mod report;
pub mod sections;
pub mod step;
pub mod summary;
pub mod view;

pub use files::{OutputFiles, WriteError, check_target};
