//! What every STEP file begins with: header, protocol, units, accuracy.

use crate::output::part21::{Fault, Id, Part21, Real, Text};

/// Accuracy of the geometry relative to the size of the model.
const ACCURACY: f64 = 1e-9;

/// Entities that everything else refers to.
pub(super) struct Context {
    /// PRODUCT_CONTEXT.
    pub(super) product: Id,
    /// PRODUCT_DEFINITION_CONTEXT.
    pub(super) definition: Id,
    /// The geometric context with units and accuracy.
    pub(super) geometry: Id,
    pub(super) millimetre: Id,
    pub(super) radian: Id,
}

/// Writes the header section and opens the data section.
///
/// The time stamp is a constant: the same document gives the same bytes.
pub(super) fn header(part: &mut Part21<'_>, name: &str) -> Result<(), Fault> {
    let name = Text(name);
    let system = concat!("beamwright ", env!("CARGO_PKG_VERSION"));
    part.raw(&format!(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n\
         FILE_NAME({name},'1970-01-01T00:00:00',(''),(''),'{system}','{system}','');\n\
         FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\nENDSEC;\nDATA;\n"
    ))
}

/// Writes the protocol, the units and the accuracy for a model of size `reach`.
pub(super) fn context(part: &mut Part21<'_>, reach: f64) -> Result<Context, Fault> {
    let application = part.entity(format_args!(
        "APPLICATION_CONTEXT('core data for automotive mechanical design processes')"
    ))?;
    part.entity(format_args!(
        "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,\
         {application})"
    ))?;
    let product = part.entity(format_args!("PRODUCT_CONTEXT('',{application},'mechanical')"))?;
    let definition = part.entity(format_args!(
        "PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')"
    ))?;
    let millimetre =
        part.entity(format_args!("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))"))?;
    let radian =
        part.entity(format_args!("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))"))?;
    let steradian =
        part.entity(format_args!("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())"))?;
    let accuracy = Real(accuracy(reach));
    let uncertainty = part.entity(format_args!(
        "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({accuracy}),{millimetre},\
         'distance_accuracy_value','confusion accuracy')"
    ))?;
    let geometry = part.entity(format_args!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)\
         GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({uncertainty}))\
         GLOBAL_UNIT_ASSIGNED_CONTEXT(({millimetre},{radian},{steradian}))\
         REPRESENTATION_CONTEXT('',''))"
    ))?;
    Ok(Context { product, definition, geometry, millimetre, radian })
}

/// Distance below which points are the same, mm: a power of ten.
fn accuracy(reach: f64) -> f64 {
    let exponent = (reach * ACCURACY).log10().ceil();
    10f64.powi(if exponent.is_finite() { exponent as i32 } else { -7 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accuracy_follows_the_size_of_the_model() {
        assert_eq!(accuracy(1000.0), 1e-6);
        assert_eq!(accuracy(300.0), 1e-6);
        assert_eq!(accuracy(0.01), 1e-11);
        assert_eq!(accuracy(0.0), 1e-7);
    }
}
