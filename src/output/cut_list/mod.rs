//! The cut list: what to order, saw and paint.
//!
//! Beams that are one piece (see [`Alike`](crate::joint::Alike)) are one line with a quantity.
//! Lines are sorted by profile and then by length, so that they do not depend on the order of faces
//! in the mesh; `P01` is the first.
//!
//! | module | what |
//! |---|---|
//! | [`piece`] | one kind of piece: beams that are cut alike |
//! | [`nesting`] | pieces laid into stock bars |
//! | `csv` | the list as a table for spreadsheets |

mod csv;
pub mod nesting;
pub mod piece;

use std::io::{self, Write};

use serde::Serialize;

pub use nesting::{Bar, LONGEST_BAR, Nesting, Stock, StockError};
pub use piece::Piece;

use crate::finding::{Finding, FindingKind};
use crate::frame::Frame;
use crate::joint::Joints;
use crate::output::assembly::SolidSize;
use crate::output::material::Material;

/// What the list is told.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CutListParams {
    /// What the beams are of.
    pub material: Material,
    /// Bars the pieces are cut from, if they are to be nested.
    pub stock: Option<Stock>,
}

/// Sums over all pieces of one profile.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProfileTotal {
    /// The profile.
    pub profile: String,
    /// Its standard; empty for one made to measure.
    pub standard: String,
    /// Number of pieces.
    pub quantity: usize,
    /// Length to saw, mm.
    pub length_mm: f64,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Surface to paint, m².
    pub surface_m2: f64,
}

/// The cut list of a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CutList {
    format: &'static str,
    version: u32,
    /// Name of the material.
    pub material: String,
    /// Density, kg/m³.
    pub density: f64,
    /// Kinds of pieces.
    pub pieces: Vec<Piece>,
    /// Sums by profile.
    pub totals: Vec<ProfileTotal>,
    /// The pieces in stock bars, if asked for.
    pub nesting: Option<Nesting>,
}

impl CutList {
    /// Lists the beams of a frame as they are cut.
    ///
    /// * `sizes`: of the kinds of pieces, as their solids have them
    ///   ([`Assembly::sizes`](super::assembly::Assembly::sizes)): masses and surfaces are those of
    ///   the STEP file.
    pub fn new(
        frame: &Frame,
        joints: &Joints,
        sizes: &[SolidSize],
        params: &CutListParams,
    ) -> Self {
        let pieces = piece::pieces(frame, joints, sizes, params);
        let totals = totals(&pieces);
        let nesting = params.stock.map(|stock| nesting::nest(&pieces, stock));
        Self {
            format: "beamwright-cut-list",
            version: 1,
            material: params.material.name.clone(),
            density: params.material.density,
            pieces,
            totals,
            nesting,
        }
    }

    /// Mass of all pieces, kg.
    pub fn mass(&self) -> f64 {
        self.totals.iter().map(|t| t.mass_kg).sum()
    }

    /// Sums over all profiles.
    pub fn total(&self) -> ProfileTotal {
        let sum = |of: fn(&ProfileTotal) -> f64| self.totals.iter().map(of).sum();
        ProfileTotal {
            profile: "all".into(),
            standard: String::new(),
            quantity: self.totals.iter().map(|t| t.quantity).sum(),
            length_mm: sum(|t| t.length_mm),
            mass_kg: sum(|t| t.mass_kg),
            surface_m2: sum(|t| t.surface_m2),
        }
    }

    /// What the user should know: pieces that are longer than a stock bar.
    pub fn findings(&self) -> Vec<Finding> {
        let Some(nesting) = &self.nesting else { return Vec::new() };
        let is_too_long = |p: &&Piece| nesting.too_long.contains(&p.piece);
        let text = |p: &Piece| {
            format!(
                "{} ({} of {}) is {:.1} mm long, a stock bar {} mm; it is in no bar: order it \
                 longer, or splice it",
                p.piece, p.quantity, p.profile, p.length_mm, nesting.stock.length_mm
            )
        };
        let pieces = self.pieces.iter().filter(is_too_long);
        pieces.map(|p| Finding::note(FindingKind::Stock, None, text(p))).collect()
    }

    /// Writes the list as CSV: pieces, totals, bars and a legend, with empty lines between.
    ///
    /// # Errors
    /// What `out` says.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        csv::write(self, out)
    }

    /// Writes the list as JSON, indented.
    ///
    /// # Errors
    /// What `out` says.
    pub fn write_json(&self, out: &mut dyn Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *out, self)?;
        out.write_all(b"\n")
    }
}

fn totals(pieces: &[Piece]) -> Vec<ProfileTotal> {
    let mut totals: Vec<ProfileTotal> = Vec::new();
    for piece in pieces {
        let quantity = piece.quantity as f64;
        let same = totals.last_mut().filter(|t| t.profile == piece.profile);
        let (length, mass) = (piece.length_mm * quantity, piece.unit_mass_kg * quantity);
        let surface = piece.unit_surface_m2 * quantity;
        match same {
            Some(total) => {
                total.quantity += piece.quantity;
                total.length_mm += length;
                total.mass_kg += mass;
                total.surface_m2 += surface;
            }
            None => totals.push(ProfileTotal {
                profile: piece.profile.clone(),
                standard: piece.standard.clone(),
                quantity: piece.quantity,
                length_mm: length,
                mass_kg: mass,
                surface_m2: surface,
            }),
        }
    }
    totals
}
