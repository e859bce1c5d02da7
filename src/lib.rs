//! From a topology-optimized mesh to beams one can buy, cut and weld.
//!
//! ```text
//!    triangles, labelled          skeleton                 frame                 STEP · cut list
//!   ▓▓▓▒▒▒▒▒▒▒▒▒▒▒▒▒▒▓▓▓      ▐●──●──●──●──●▌         ▐═══════════▌           B01 CHS 60.3x4
//!   ▓▓▓▒▒▒▒▒▒▒▒▒▒▒▒▒▒▓▓▓  →   ▐    ◆         ▌    →   ▐    ╲╲      ▌    →     842.5 mm 45°/30°
//!        ▒▒▒▒▒                      ╲●──●──●▌               ╲═════▌          one solid a beam
//! ```
//!
//! | stage | takes | makes | module |
//! |---|---|---|---|
//! | read | a file | raw mesh and its labels | `beamwright_formats` |
//! | mesh | raw mesh | closed, oriented [`mesh::Surface`] with interface sections | [`mesh`] |
//! | march | surface | [`skeleton::Skeleton`] of skeletal points and branches | [`skeleton`] |
//! | measure | skeleton | section at every skeletal point | [`section`] |
//! | normalize | skeleton, sections | [`frame::Frame`] of straight beams with profiles | [`frame`] |
//! | join | frame | [`joint::Joints`]: how every beam is cut at its ends | [`joint`] |
//! | write | frame, joints | STEP, cut list, skeleton files | [`output`] |
//!
//! [`pipeline::run`] goes through all of them; [`evaluate`] holds any skeleton, also that of
//! another program, against the mesh it was made of.
//!
//! # Example
//!
//! ```
//! use beamwright::pipeline::{self, Settings};
//!
//! let sample = concat!(env!("CARGO_MANIFEST_DIR"), "/samples/single_bar.obj");
//! let outcome = pipeline::run(sample.as_ref(), &Settings::default(), &mut ())?;
//! let [bar] = outcome.frame.beams.as_slice() else { panic!("one bar is one beam") };
//! assert!((bar.length - 80.0).abs() < 0.01); // mm
//! assert!((bar.section.mean.area / 50.27 - 1.0).abs() < 0.01); // π 4², mm²
//! # Ok::<(), pipeline::PipelineError>(())
//! ```
//!
//! Lengths are in mm and angles in rad throughout. Nothing depends on the frame the mesh is given
//! in: a turned mesh gives the turned result, a scaled one the scaled result, and the same input
//! the same bytes.

mod cluster;
pub mod evaluate;
pub mod finding;
pub mod frame;
pub mod joint;
pub mod mesh;
pub mod observer;
pub mod output;
pub mod pipeline;
mod saddle;
pub mod section;
mod segment;
pub mod skeleton;
pub mod skeleton_file;
mod wording;
