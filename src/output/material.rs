//! What the beams are of.

use crate::section::profile::STEEL;
use crate::skeleton::params::OutOfRange;

/// A material, as lists and analysis programs want it.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name, as printed.
    pub name: String,
    /// Density, kg/m³.  Range: `(0, 30000]`; osmium has 22,590.  Default: 7850.
    pub density: f64,
    /// Elastic modulus, MPa.  Range: `(0, 2e6]`; diamond has 1.1e6.  Default: 210 000, structural
    /// steel (EN 1993-1-1, 3.2.6).
    pub elastic_modulus: f64,
    /// Poisson's ratio.  Range: `[0, 0.5)`; at 0.5 nothing can be compressed.  Default: 0.3.
    pub poisson: f64,
}

impl Default for Material {
    fn default() -> Self {
        Self { name: "steel".into(), density: STEEL, elastic_modulus: 210_000.0, poisson: 0.3 }
    }
}

impl Material {
    /// Checks every number against its range.
    ///
    /// # Errors
    /// The first number that is out of its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let is_within = |x: f64, most: f64| x > 0.0 && x <= most;
        let checks = [
            ("--density", "(0, 30000] kg/m³", self.density, is_within(self.density, 3e4)),
            (
                "--elastic-modulus",
                "(0, 2e6] MPa",
                self.elastic_modulus,
                is_within(self.elastic_modulus, 2e6),
            ),
            ("--poisson", "[0, 0.5)", self.poisson, (0.0..0.5).contains(&self.poisson)),
        ];
        match checks.into_iter().find(|check| !check.3) {
            Some((name, range, value, _)) => Err(OutOfRange { name, range, value }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_no_material_has_are_refused() {
        let steel = Material::default();
        assert_eq!(steel.check(), Ok(()));
        for x in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
            assert!(Material { density: x, ..steel.clone() }.check().is_err(), "{x}");
            assert!(Material { elastic_modulus: x, ..steel.clone() }.check().is_err(), "{x}");
        }
        for x in [-0.1, 0.5, 1.0, f64::NAN] {
            assert!(Material { poisson: x, ..steel.clone() }.check().is_err(), "{x}");
        }
        let message = Material { poisson: 0.5, ..steel }.check().unwrap_err().to_string();
        assert_eq!(message, "--poisson must lie in [0, 0.5), but is 0.5");
    }
}
