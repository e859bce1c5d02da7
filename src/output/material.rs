//! What the beams are of.

use crate::section::profile::STEEL;

/// A material, as lists and analysis programs want it.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name, as printed.
    pub name: String,
    /// Density, kg/m³.  Default: 7850.
    pub density: f64,
    /// Elastic modulus, MPa.  Default: 210 000, structural steel (EN 1993-1-1, 3.2.6).
    pub elastic_modulus: f64,
    /// Poisson's ratio.  Default: 0.3.
    pub poisson: f64,
}

impl Default for Material {
    fn default() -> Self {
        Self { name: "steel".into(), density: STEEL, elastic_modulus: 210_000.0, poisson: 0.3 }
    }
}
