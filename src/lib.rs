//! From a topology-optimized mesh to beams one can buy, cut and weld.
pub mod evaluate;
pub mod finding;
pub mod frame;
pub mod mesh;
pub mod observer;
pub mod output;
pub mod pipeline;
pub mod section;
pub mod skeleton;
pub mod skeleton_file;
