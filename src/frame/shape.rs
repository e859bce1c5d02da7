//! The solid shape of a beam: which outline stands where along it.

use nalgebra::Point2;

use super::beam_section::{BeamSection, Moments};
use crate::section::freeform::average_outline;
use crate::section::outline::{Outline, Region};

/// How the shape runs from one end of a beam to the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Loft {
    /// The mean section all along.
    #[default]
    Constant,
    /// Straight from the section at one end to that at the other.
    Taper,
}

/// The outlines along a beam, in its axes y and z.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// What it is called in lists and files: "Round 12.5".
    pub name: String,
    /// Outlines from the first node to the second.
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

/// Points of a freeform outline: a round one is followed within a thousandth of its radius.
const OUTLINE_POINTS: usize = 32;

/// The averaged real contour of a beam, constant or scaled to the areas at its ends.
pub fn freeform(section: &BeamSection, loft: Loft) -> Option<Shape> {
    let contours: Vec<Vec<Point2<f64>>> =
        section.stations.iter().filter(|s| s.weight >= 0.5).map(|s| s.contour.clone()).collect();
    let mean = average_outline(&contours, OUTLINE_POINTS).ok()?;
    let scaled = |to: &Moments| {
        let factor = (to.area / section.mean.area).sqrt();
        let points = mean.points().iter().map(|p| p * factor).collect();
        let outer = Outline::Freeform(crate::section::freeform::Freeform::through(points).ok()?);
        Some(Region::solid(outer))
    };
    let [from, to] = match loft {
        Loft::Constant => [scaled(&section.mean)?, scaled(&section.mean)?],
        Loft::Taper => [scaled(&section.ends[0])?, scaled(&section.ends[1])?],
    };
    let stations =
        vec![ShapeStation { at: 0.0, region: from }, ShapeStation { at: 1.0, region: to }];
    Some(Shape { name: format!("Freeform {:.0} mm²", section.mean.area), stations })
}

/// A round bar.
pub fn round(radius: f64) -> Shape {
    let region = Region::solid(Outline::circle(radius));
    let stations = [0.0, 1.0].map(|at| ShapeStation { at, region: region.clone() }).to_vec();
    Shape { name: format!("Round {:.1}", 2.0 * radius), stations }
}
