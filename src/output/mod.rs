//! What leaves the program: STEP for manufacturing, the cut list, summaries, whole files.

pub mod assembly;
pub mod beam_table;
pub mod cut_list;
pub mod files;
pub mod mesh_export;
pub mod mlp;
pub mod sections;
pub mod step;
pub mod summary;

pub use files::{OutputFiles, WriteError, check_target};
