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
    /// The profile in the size it has there.
    pub profile: Profile,
    /// The region the beam fills there: that of the profile, turned with the beam's twist.
    pub region: Region,
}

impl BeamShape {
    /// The matched profile all along the beam.
    pub fn constant(matched: Matched) -> Self {
        let stations = both_ends(&matched.profile);
        Self {
            roll: matched.roll,
            errors: Some(matched.errors),
            properties: matched.properties,
            profile: matched.profile,
            stations,
        }
    }

    /// A profile nothing was measured for.
    pub fn assumed(profile: Profile, properties: SectionProperties) -> Self {
        let stations = both_ends(&profile);
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

    /// Name for lists and files, plain ASCII: that of the profile; of a beam that tapers the sizes
    /// at both ends, the larger first, so that it is the same end for end.
    ///
    /// | shape                        | name                        |
    /// |------------------------------|-----------------------------|
    /// | the same all along           | `Rect 10x20`                |
    /// | straight from end to end     | `Rect 10x20 to 8x16`        |
    /// | … and round                  | `Cone 40 to 25`             |
    /// | through *n* sections         | `Cone 40 to 25 in 5 sections` |
    /// | the same, but turned         | `Rect 10x20 twisted`        |
    pub fn name(&self) -> String {
        if self.is_constant() {
            return self.profile.to_string();
        }
        let profiles = || self.stations.iter().map(|s| &s.profile);
        if profiles().all(|p| *p == self.stations[0].profile) {
            return format!("{} twisted", self.stations[0].profile);
        }
        let ends = [&self.stations[0].profile, &self.stations[self.stations.len() - 1].profile];
        let area = |p: &Profile| p.properties().map_or(0.0, |own| own.area);
        let [large, small] = if area(ends[1]) > area(ends[0]) { [ends[1], ends[0]] } else { ends };
        let [large, small] = [large, small].map(ToString::to_string);
        let sizes = |name: &str| name.split_once(' ').map_or("", |n| n.1).to_owned();
        let kind = match &self.profile.shape {
            Shape::Round { .. } => "Cone",
            _ => large.split_once(' ').map_or("", |n| n.0),
        };
        let taper = format!("{kind} {} to {}", sizes(&large), sizes(&small));
        match self.stations.len() {
            2 => taper,
            count => format!("{taper} in {count} sections"),
        }
    }
}

fn both_ends(profile: &Profile) -> Vec<ShapeStation> {
    let station = |at| ShapeStation { at, profile: profile.clone(), region: profile.region() };
    vec![station(0.0), station(1.0)]
}

/// Diameter of the round bar of an area, mm.
fn round_of_area(area: f64) -> f64 {
    2.0 * (area / PI).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tapered(shapes: &[Shape]) -> BeamShape {
        let profiles: Vec<Profile> =
            shapes.iter().map(|s| Profile::new(s.clone()).unwrap()).collect();
        let properties = profiles[0].properties().unwrap();
        let stations = profiles.iter().enumerate().map(|(i, p)| ShapeStation {
            at: i as f64 / (profiles.len() - 1) as f64,
            profile: p.clone(),
            region: p.region(),
        });
        let stations = stations.collect();
        BeamShape { stations, ..BeamShape::assumed(profiles[0].clone(), properties) }
    }

    #[test]
    fn a_taper_is_named_by_both_its_ends_the_larger_first() {
        let round = |d: f64| Shape::Round { d };
        assert_eq!(tapered(&[round(40.0), round(25.0)]).name(), "Cone 40 to 25");
        assert_eq!(tapered(&[round(25.0), round(40.0)]).name(), "Cone 40 to 25");
        let flat = |b: f64, h: f64| Shape::Rectangle { b, h };
        assert_eq!(tapered(&[flat(10.0, 20.0), flat(8.0, 16.5)]).name(), "Rect 10x20 to 8x16.5");
        let waist = tapered(&[round(40.0), round(20.0), round(25.0)]);
        assert_eq!(waist.name(), "Cone 40 to 25 in 3 sections");
    }

    #[test]
    fn what_does_not_taper_is_named_by_its_profile() {
        let flat = Shape::Rectangle { b: 10.0, h: 20.0 };
        let mut bar = tapered(&[flat.clone(), flat]);
        assert_eq!(bar.name(), "Rect 10x20");
        bar.stations[1].region = bar.stations[1].region.turned(0.2);
        assert_eq!(bar.name(), "Rect 10x20 twisted");
    }
}
