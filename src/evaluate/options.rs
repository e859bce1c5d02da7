//! What the evaluation can be told.

use serde::Serialize;

use super::error::EvaluateError;

/// Which sphere r of eq. (2.2) is the radius of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BoundingSphere {
    /// The smallest one that holds all vertices of the mesh.
    #[default]
    Smallest,
    /// The one about the centre of the bounding box.
    BoxCentred,
}

/// Options of the evaluation. The defaults are those of the thesis, where it says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EvaluateOptions {
    /// Distance of the points at equal spacing, mm.
    ///
    /// Default: the mean strut radius 2 V / A of the design part.
    pub step: Option<f64>,

    /// Half the side of the cube in which crossings are collected, mm.
    ///
    /// Default: the largest distance of a point of an interface section from its centre (thesis
    /// §4.4); without labels twice the mean strut radius.
    pub cube_half: Option<f64>,

    /// Which sphere r is the radius of.  Default: the smallest.
    pub sphere: BoundingSphere,
}

impl EvaluateOptions {
    /// Checks every option against its range.
    ///
    /// # Errors
    /// The first option that is out of its range.
    pub fn check(&self) -> Result<(), EvaluateError> {
        for (name, value) in [("--resample", self.step), ("--cube", self.cube_half)] {
            if let Some(value) = value.filter(|v| !(*v > 0.0 && v.is_finite())) {
                return Err(EvaluateError::OutOfRange { name, value });
            }
        }
        Ok(())
    }
}
