//! Regions of the section plane given as polygons.

use nalgebra::{Point2, Rotation2, Vector2};

use super::outline::{Outline, Region};

/// A region of the section plane given as polygons.
///
/// The polygons may run either way round; the last corner is not repeated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contours {
    /// The outer contour, mm.
    pub outer: Vec<Point2<f64>>,
    /// Contours of the holes, mm.
    pub holes: Vec<Vec<Point2<f64>>>,
}

impl Contours {
    /// A region without holes.
    pub fn solid(outer: Vec<Point2<f64>>) -> Self {
        Self { outer, holes: Vec::new() }
    }

    /// The polygons of a region with curved outlines; see [`Outline::to_polygon`] for the fineness.
    pub fn of_region(region: &Region, per_quarter: usize) -> Self {
        let polygon = |outline: &Outline| outline.to_polygon(per_quarter);
        Self { outer: polygon(&region.outer), holes: region.holes.iter().map(polygon).collect() }
    }

    /// All polygons, the outer one first.
    pub fn polygons(&self) -> impl Iterator<Item = &Vec<Point2<f64>>> {
        std::iter::once(&self.outer).chain(&self.holes)
    }

    /// The region turned about the origin by an angle in rad and then shifted.
    pub fn moved(&self, angle: f64, shift: Vector2<f64>) -> Self {
        let turn = Rotation2::new(angle);
        let moved = |polygon: &Vec<Point2<f64>>| polygon.iter().map(|p| turn * p + shift).collect();
        Self { outer: moved(&self.outer), holes: self.holes.iter().map(moved).collect() }
    }
}

/// The sides of a polygon as (start, end).
pub(crate) fn sides(
    polygon: &[Point2<f64>],
) -> impl Iterator<Item = (Point2<f64>, Point2<f64>)> + '_ {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

/// Signed area ½ Σ (xᵢ yᵢ₊₁ − xᵢ₊₁ yᵢ), mm²; positive if counter-clockwise.
pub fn signed_area(polygon: &[Point2<f64>]) -> f64 {
    0.5 * sides(polygon).map(|(p, q)| p.x * q.y - q.x * p.y).sum::<f64>()
}
