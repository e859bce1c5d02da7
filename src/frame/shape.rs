//! The solid a beam is built as: its profile, and which outline stands where along it.

use std::f64::consts::PI;

use crate::section::matching::{MatchErrors, Matched};
use crate::section::outline::Region;
use crate::section::{Profile, SectionProperties, Shape};

/// How the shape runs from one end of a beam to the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Loft {
    /// The mean section all along.
    #[default]
    Constant,
    /// Straight from the section at one end to that at the other.
    Taper,
    /// Through the sections along the beam.
    Multi,
}

/// The solid of a beam, in its axes turned by `roll`.
#[derive(Clone, Debug, PartialEq)]
pub struct BeamShape {
    /// The profile that stands for the beam in lists.
    pub profile: Profile,
    /// Properties of the profile about its own axes.
    pub properties: SectionProperties,
    /// Angle from the beam's axis y to that of the profile, rad.
    pub roll: f64,
    /// Relative errors of the profile against the mean section; `None` where nothing was measured.
    pub errors: Option<MatchErrors>,
    /// Outlines from the first node to the second; at least two.
    pub stations: Vec<ShapeStation>,
}

/// One outline of a shape.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeStation {
    /// Part 0..1 of the beam's length.
    pub at: f64,
    /// The region the beam fills there.
    pub region: Region,
}

impl BeamShape {
    /// The matched profile all along the beam.
    pub fn constant(matched: Matched) -> Self {
        let region = matched.profile.region();
        Self {
            roll: matched.roll,
            errors: Some(matched.errors),
            properties: matched.properties,
            profile: matched.profile,
            stations: both_ends(region),
        }
    }

    /// A profile nothing was measured for.
    pub fn assumed(profile: Profile, properties: SectionProperties) -> Self {
        let stations = both_ends(profile.region());
        Self { profile, properties, roll: 0.0, errors: None, stations }
    }

    /// A round bar of an area, until the beam is matched.
    pub(crate) fn unmatched(area: f64) -> Self {
        let shape = Shape::Round { d: round_of_area(area) };
        let radius = (area / PI).sqrt();
        let i = 0.25 * PI * radius.powi(4);
        let properties = SectionProperties {
            area,
            centroid: nalgebra::Point2::origin(),
            i_xx: i,
            i_yy: i,
            i_xy: 0.0,
            i_1: i,
            i_2: i,
            principal_angle: 0.0,
            i_p: 2.0 * i,
            j: 2.0 * i,
            perimeter: 2.0 * PI * radius,
            reach: radius,
        };
        Self::assumed(Profile { shape, designation: None }, properties)
    }

    /// Whether the section is the same all along.
    pub fn is_constant(&self) -> bool {
        self.stations.windows(2).all(|w| w[0].region == w[1].region)
    }

    /// Name for lists and files: that of the profile, and whether the beam tapers.
    pub fn name(&self) -> String {
        if self.is_constant() {
            self.profile.to_string()
        } else {
            format!("{} tapered", self.profile)
        }
    }
}

fn both_ends(region: Region) -> Vec<ShapeStation> {
    vec![ShapeStation { at: 0.0, region: region.clone() }, ShapeStation { at: 1.0, region }]
}

/// Diameter of the round bar of an area, mm.
pub(crate) fn round_of_area(area: f64) -> f64 {
    2.0 * (area / PI).sqrt()
}
