//! A section on the way of a beam.

use nalgebra::Point2;

use super::moments::Moments;

/// A section of the mesh seen along a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct BeamStation {
    /// The skeletal point it was measured at.
    pub point: u32,
    /// Part 0..1 of the beam's length.
    pub at: f64,
    /// Contour in y, z about its centroid, mm.
    pub contour: Vec<Point2<f64>>,
    /// Its moments.
    pub moments: Moments,
    /// Distance of the centroid from the axis, mm.
    pub off_axis: f64,
    /// 1 for a section like its neighbours, towards 0 for one swollen by a junction.
    pub weight: f64,
}

impl BeamStation {
    /// Whether it is so much larger or smaller than its neighbours that it hardly counts.
    pub fn is_outlier(&self) -> bool {
        self.weight < 0.5
    }
}
