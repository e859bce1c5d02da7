//! Writes solids as a STEP file (ISO 10303-21, AP214) any CAD program reads.
//!
//! A [`Document`] is a tree of named groups with [`Part`]s as its leaves; a
//! part is a [`Body`] in its own coordinates, a placement, a colour and
//! properties.  The model knows neither skeleton nor frame.
//!
//! ```
//! use beamwright::output::step::{self, Body, Document, Group, Part, Property, Value};
//! use nalgebra::{Isometry3, Vector3};
//!
//! let length = 842.5;
//! let beam = Part {
//!     name: "B012 CHS 60.3x4".into(),
//!     product: "CHS 60.3x4 L=842.5".into(),
//!     colour: [70, 130, 180],
//!     placement: Isometry3::translation(0.0, 0.0, 100.0),
//!     body: Body::tube(30.15, 26.15, length),
//!     properties: vec![Property::new("length", Value::Length(length))],
//! };
//! let beams = Group { name: "Beams".into(), parts: vec![beam], groups: vec![] };
//! let document = Document { name: "frame".into(), groups: vec![beams] };
//! let mut file = Vec::new();
//! step::write(&document, &mut file)?;
//! assert!(file.starts_with(b"ISO-10303-21;"));
//! # Ok::<(), step::StepError>(())
//! ```
//!
//! # What comes out
//!
//! * Surfaces and edges as exact as STEP can say them: planes, cylinders,
//!   cones, spheres, lines, circles, ellipses; B-splines only where a shape is
//!   freeform or turns on its way.  A user can pick the axis of a round beam.
//! * One product per distinct solid, placed as often as it occurs; a style per
//!   colour; properties as user-defined attributes.
//! * The same bytes for the same document.
//!
//! # How it is made
//!
//! ```text
//! Document ─catalogue→ distinct products, checked, with their volume
//!   Body ─levels→ outlines laid into their cuts ─brep→ truck solid, checked closed
//!     ─geometry, topology→ entities ─product, assembly→ the tree
//! ```
//!
//! `truck-topology` holds the boundary of every solid and decides whether it is
//! one; `truck-modeling` gives B-spline curves, surfaces and ruled lofts.
//! Entities are written here: `truck-stepio` has no names, colours, assemblies
//! or analytic surfaces, and serves the tests as a second reader.
//!
//! # What does not hold
//!
//! Bodies are not checked against each other (beams overlap at nodes), and a
//! freeform outline is only tested for crossing itself on a fine polygon.
//! FreeCAD's `Shape.Volume` is up to a few percent off for B-spline sides; the
//! shape itself is exact.

mod assembly;
mod blend;
mod body;
mod brep;
mod catalogue;
mod closed_spline;
mod context;
mod coped;
mod crossing;
mod document;
mod error;
mod facets;
mod gauss;
mod geometry;
mod levels;
mod loft;
mod piece;
mod product;
mod ring;
mod sections;
mod side;
mod skin;
mod spline;
mod tolerance;
mod topology;
mod volume;

pub use body::Body;
pub(crate) use closed_spline::ClosedSpline;
pub use document::{Document, Group, Part, Property, Value};
pub use error::{BodyError, StepError};
pub use facets::{Circle, Facet, Facets, Loop};
pub use loft::{Between, EndCut, Loft, Station};
pub use tolerance::SHORTEST;

pub use crate::saddle::Saddle;

use crate::output::part21::{self, Part21};
use catalogue::Catalogue;
use product::Products;

/// Writes a document as a STEP file.
///
/// # Errors
/// If there is no part, if a body is not a solid, if a number is not finite,
/// or if the output fails.  All bodies are checked before the first byte.
pub fn write(document: &Document, out: &mut impl std::io::Write) -> Result<(), StepError> {
    let catalogue = Catalogue::of(document)?;
    let of = |fault: part21::Fault| fault.of(document.name.clone());
    let mut part = Part21::new(out);
    context::header(&mut part, &document.name).map_err(of)?;
    let context = context::context(&mut part, catalogue.reach).map_err(of)?;
    let products = Products::new(&mut part, context).map_err(of)?;
    assembly::write_tree(document, &catalogue, products)?;
    part.raw("ENDSEC;\nEND-ISO-10303-21;\n").map_err(of)?;
    part.finish().map_err(of)
}
