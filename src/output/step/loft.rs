//! Beams: outlines at stations along +z, connected, and cut off at both ends.
//!
//! ```text
//!      start cut                              end cut
//!        ╲   ┌──────────┬───────────────┬─────╱
//!         ╲  │ station 0│ station 1     │    ╱ station 2     z ─►
//!          ╲ │          │               │   ╱
//!           ╲└──────────┴───────────────┴──╱
//! ```
//!
//! The axis of the beam is z; a cut passes through the axis where its end
//! station stands.  Between stations the surface is ruled or smooth.
//!
//! # How oblique cuts are made
//!
//! Where the sides next to a cut are planes, cylinders, cones or straight
//! prisms, they are prolonged or trimmed to the cutting plane, and the edge is
//! the exact section: a line, an ellipse, an affine image of the outline.  A
//! B-spline side (a twisted, elliptic or freeform taper, a smooth loft) has no
//! such exact section.  There, and where a cut would reach past the next
//! station, the planes of all stations are turned instead, in proportion to
//! how far they are from either end, until the end stations lie in the cuts:
//! the outline seen along the axis stays what it was, and the sides never fold.

use nalgebra::Vector3;

use crate::saddle::Saddle;
use crate::section::outline::Outline;

/// A beam along +z.
#[derive(Clone, Debug, PartialEq)]
pub struct Loft {
    /// Two or more sections, ascending in z.
    pub stations: Vec<Station>,
    /// How the surface runs from station to station.
    pub between: Between,
    /// How the beam is cut at the first station.
    pub start: EndCut,
    /// How the beam is cut at the last station.
    pub end: EndCut,
}

/// One section of a [`Loft`].
///
/// All stations of a loft have the same number of holes, and their outlines
/// the same pieces in the same order: a circle can become an ellipse, a
/// rectangle a larger or turned one, a freeform curve another.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Height along the axis, mm.
    pub z: f64,
    /// The outside.
    pub outer: Outline,
    /// The bores, clear of the outside and of each other.
    pub holes: Vec<Outline>,
}

/// How the surface runs from station to station.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Between {
    /// Straight lines from each station to the next.
    #[default]
    Ruled,
    /// One smooth surface through all stations (a natural cubic spline).
    Smooth,
}

/// How an end of a beam is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum EndCut {
    /// At a right angle to the axis.
    #[default]
    Square,
    /// In a plane through the axis at the end station.
    Plane {
        /// Normal of the plane, of any length and either sign; at most 80° off the axis.
        normal: Vector3<f64>,
    },
    /// Along the side of a round member, which it meets on the axis at the end station. The beam
    /// must be a round bar or tube of constant section about its axis, its radius that of the
    /// member or at most 0.999 of it; the member lies at most 80° off a right angle to the beam.
    Saddle(Saddle),
}

impl Loft {
    /// A beam of constant section from z = 0 to `length`, cut square.
    pub fn prism(outer: Outline, holes: Vec<Outline>, length: f64) -> Self {
        let start = Station { z: 0.0, outer, holes };
        let end = Station { z: length, ..start.clone() };
        Self::between_stations(vec![start, end])
    }

    /// A solid beam from one outline at z = 0 to another at `length`, cut square.
    pub fn taper(from: Outline, to: Outline, length: f64) -> Self {
        let station = |z, outer| Station { z, outer, holes: Vec::new() };
        Self::between_stations(vec![station(0.0, from), station(length, to)])
    }

    /// A ruled beam through stations, cut square.
    pub fn between_stations(stations: Vec<Station>) -> Self {
        let (start, end) = (EndCut::Square, EndCut::Square);
        Self { stations, between: Between::Ruled, start, end }
    }

    /// The same beam with its ends cut in planes of the given normals.
    pub fn cut(self, start: Vector3<f64>, end: Vector3<f64>) -> Self {
        Self { start: EndCut::Plane { normal: start }, end: EndCut::Plane { normal: end }, ..self }
    }
}
