//! What leaves the program: STEP for manufacturing.
pub mod step;
