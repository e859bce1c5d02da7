//! The command line of beamwright.
fn main() {}
