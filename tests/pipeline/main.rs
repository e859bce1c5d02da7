//! The way from file to results through the real program: what must not change them.

#[path = "../common/mod.rs"]
mod common;
#[path = "../../formats/tests/common/mod.rs"]
mod writers;

mod formats;
mod motion;
mod objects;
mod repetition;
