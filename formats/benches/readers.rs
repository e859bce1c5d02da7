//! Time to read a generated mesh in each format, and to cut its polygons.

fn main() {}
