//! From a topology-optimized mesh to beams one can buy, cut and weld.
pub mod finding;
pub mod mesh;
pub mod observer;
pub mod output;
pub mod section;
pub mod skeleton;
