//! Profiles: the standard or fitted shapes a section is matched to.
//!
//! Local axes, the same for every shape: the beam runs along x, the section lies in y, z with the
//! origin at the centroid. `b` is the size along y, `h` the size along z. In the plane of the
//! section y is the first coordinate and z the second.
//!
//! ```text
//!           z ▲                     z ▲                      z ▲
//!        ┌────┴────┐ ─            ▄▄▄▄┴▄▄▄▄ ─            ▐▌    │       ─
//!        │    │    │              ▀▀▀▐█▌▀▀▀ t_f          ▐▌    │
//!        │    ●────┼──► y h          ▐●▌────► y  h       ▐▌    ●────► y  h
//!        │         │              ▄▄▄▐█▌▄▄▄              ▐▌
//!        └─────────┘ ─            ▀▀▀▀▀▀▀▀▀ ─            ▐▙▄▄▄▄▄▄      ─
//!        │◄── b ──►│              │◄─ b ─►│              │◄─ b ─►│
//!
//!        I_y = ∫ z² dA            I_z = ∫ y² dA          x towards the reader
//! ```
//!
//! A fitted shape has h ≥ b, so that y is its strong axis: I_y = I_1. Catalogue shapes keep the
//! axes of their standard, in which y is the strong axis too; the principal axes of an angle are
//! turned against its legs, and [`SectionProperties::principal_angle`] says by how much.
//!
//! | shape           | area and moments       | torsion constant                              |
//! |-----------------|------------------------|-----------------------------------------------|
//! | round, tube     | exact                  | exact                                         |
//! | ellipse         | exact                  | exact                                         |
//! | rectangle       | exact                  | series, exact                                 |
//! | box             | exact, with its radii  | EN 10210-2 annex A                            |
//! | I               | exact, with fillets    | tables to EN 10365                            |
//! | C, L            | exact, with fillets    | El Darwish and Johnston (1965)                |
//! | freeform        | exact on its spline    | numerical, [`torsion`](super::torsion)        |

mod hollow;
mod moduli;
mod open;
mod shape;
mod solid;

use std::fmt;

use super::error::SectionError;
use super::moments::Moments;
use super::outline::Region;
use super::piece::Piece;
use super::properties::SectionProperties;
pub use moduli::Moduli;
pub use shape::Shape;

/// Density of structural steel, kg/m³ (EN 1991-1-1, table A.4).
pub const STEEL: f64 = 7850.0;

/// A shape, and what it is called if it comes from a catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The shape.
    pub shape: Shape,
    /// Its entry in a catalogue.
    pub designation: Option<Designation>,
}

/// What a profile is ordered by.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Designation {
    /// Name of the profile, such as `IPE 200`.
    pub name: String,
    /// Family it belongs to, such as `IPE`.
    pub family: String,
    /// Standard it is made to, such as `EN 10365`.
    pub standard: String,
}

impl Profile {
    /// A profile made to measure.
    ///
    /// # Errors
    /// If a size of the shape is not positive or leaves no room for another.
    ///
    /// # Examples
    /// ```
    /// # use beamwright::section::{Profile, Shape};
    /// let bar = Profile::new(Shape::Rectangle { b: 10.0, h: 20.0 })?;
    /// assert_eq!(bar.to_string(), "Rect 10x20");
    /// assert!(Profile::new(Shape::Tube { d: 20.0, t: 11.0 }).is_err());
    /// # Ok::<(), beamwright::section::SectionError>(())
    /// ```
    pub fn new(shape: Shape) -> Result<Self, SectionError> {
        shape.check()?;
        Ok(Self { shape, designation: None })
    }

    /// The region it fills, origin at the centroid.
    pub fn region(&self) -> Region {
        self.shape.region()
    }

    /// Area, moments about the local axes, principal axes and torsion constant.
    ///
    /// # Errors
    /// Only for a freeform outline whose torsion constant cannot be computed.
    pub fn properties(&self) -> Result<SectionProperties, SectionError> {
        let pieces = self.region().pieces();
        let moments = Moments::of_pieces(&pieces);
        let reach = moduli::reach(&pieces, moments.centroid());
        let j = self.shape.torsion_constant()?;
        Ok(SectionProperties::assemble(&moments, j, Piece::length(&pieces), reach))
    }

    /// Elastic and plastic section moduli about the local axes.
    pub fn moduli(&self) -> Moduli {
        Moduli::of(&self.region().pieces())
    }

    /// Length of the outer outline, mm: the surface to paint in mm² per mm.
    pub fn outer_perimeter(&self) -> f64 {
        Piece::length(&self.region().outer.pieces())
    }

    /// Mass per metre, kg/m.
    ///
    /// * `density`: kg/m³; [`STEEL`] for steel.
    pub fn mass_per_metre(&self, density: f64) -> f64 {
        const SQUARE_METRES_PER_SQUARE_MM: f64 = 1e-6;
        Moments::of_pieces(&self.region().pieces()).area * SQUARE_METRES_PER_SQUARE_MM * density
    }

    /// Name of the family: that of the catalogue, or that of the shape.
    pub fn family(&self) -> &str {
        self.designation.as_ref().map_or(self.shape.family(), |d| &d.family)
    }
}

impl fmt::Display for Profile {
    /// The name in the catalogue, or family and sizes in mm.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.designation {
            Some(designation) => f.write_str(&designation.name),
            None => self.shape.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn name_of_the_catalogue_comes_before_that_of_the_sizes() {
        let mut tube = Profile::new(Shape::Tube { d: 60.3, t: 4.0 }).unwrap();
        assert_eq!((tube.to_string().as_str(), tube.family()), ("Tube 60.3x4", "tube"));
        tube.designation = Some(Designation {
            name: "CHS 60.3x4".into(),
            family: "CHS".into(),
            standard: "EN 10210-2".into(),
        });
        assert_eq!((tube.to_string().as_str(), tube.family()), ("CHS 60.3x4", "CHS"));
    }

    #[test]
    fn steel_bar_of_a_square_metre_weighs_its_density_per_metre() {
        let bar = Profile::new(Shape::Rectangle { b: 1000.0, h: 1000.0 }).unwrap();
        assert!((bar.mass_per_metre(STEEL) - STEEL).abs() < 1e-9);
        assert!((bar.outer_perimeter() - 4000.0).abs() < 1e-9);
    }
}
