//! What the shop has: material and stock bars.

use beamwright::output::cut_list::{CutListParams, LONGEST_BAR, Stock};
use beamwright::output::material::Material;
use clap::Args;

use super::exit::Failure;

#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Material and stock")]
pub(crate) struct ShopArgs {
    /// Name of the material, as printed in the cut list
    #[arg(long, value_name = "NAME", default_value = "steel")]
    pub(crate) material: String,

    /// Density for the masses, kg/m³ (steel: 7850, aluminium: 2700)
    #[arg(long, value_name = "KG/M3", allow_negative_numbers = true,
        default_value_t = Material::default().density)]
    pub(crate) density: f64,

    /// Elastic modulus for the CalculiX model, MPa (steel: 210000, aluminium: 70000)
    #[arg(long, value_name = "MPA", allow_negative_numbers = true,
        default_value_t = Material::default().elastic_modulus)]
    pub(crate) elastic_modulus: f64,

    /// Poisson's ratio for the CalculiX model
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true,
        default_value_t = Material::default().poisson)]
    pub(crate) poisson: f64,

    /// Lay the pieces into stock bars of this length, mm
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) stock_length: Option<f64>,

    /// Width of a saw cut between pieces of a stock bar, mm
    #[arg(long, value_name = "MM", allow_negative_numbers = true, default_value_t = 2.0)]
    pub(crate) kerf: f64,
}

impl ShopArgs {
    pub(crate) fn material(&self) -> Material {
        Material {
            name: self.material.clone(),
            density: self.density,
            elastic_modulus: self.elastic_modulus,
            poisson: self.poisson,
        }
    }

    /// Whether every number is one that can be.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        self.material().check().map_err(Failure::usage)?;
        // Without bars a saw cut still has to be a width.
        let length_mm = self.stock_length.unwrap_or(LONGEST_BAR);
        Stock { length_mm, kerf_mm: self.kerf }.check().map_err(Failure::usage)
    }

    pub(crate) fn cut_list_params(&self) -> CutListParams {
        CutListParams {
            material: self.material(),
            stock: self.stock_length.map(|length_mm| Stock { length_mm, kerf_mm: self.kerf }),
        }
    }
}
