//! What goes into a STEP file: a tree of groups, with parts as its leaves.

use nalgebra::Isometry3;

use super::Body;

/// Everything of one STEP file.
///
/// The document becomes the root assembly, each group an assembly below it.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Name of the root assembly.
    pub name: String,
    /// The branches of the tree, in file order.
    pub groups: Vec<Group>,
}

/// An assembly of parts and further groups, such as "Beams".
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// Name shown in the tree.
    pub name: String,
    /// Parts placed directly in this group.
    pub parts: Vec<Part>,
    /// Groups below this one.  A group without any part in it is left out.
    pub groups: Vec<Group>,
}

/// One solid at its place.
///
/// Parts with equal [`body`](Part::body), [`product`](Part::product),
/// [`colour`](Part::colour) and [`properties`](Part::properties) share one
/// product in the file, placed several times, so that a CAD user who edits one
/// edits all.  What tells them apart, a mark such as "B012", belongs into
/// [`name`](Part::name).
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Name of this instance, e.g. `"B012 CHS 60.3x4"`.
    pub name: String,
    /// Name of the product, e.g. `"CHS 60.3x4 L=842.5"`.
    pub product: String,
    /// Red, green, blue (sRGB).
    pub colour: [u8; 3],
    /// From the coordinates of the body to those of the document.
    pub placement: Isometry3<f64>,
    /// The shape.
    pub body: Body,
    /// What else is known, such as profile, length and mass.
    pub properties: Vec<Property>,
}

/// One named fact about a product.
#[derive(Clone, Debug, PartialEq)]
pub struct Property {
    /// Name, e.g. `"length"`.
    pub name: String,
    /// Value with its unit.
    pub value: Value,
}

impl Property {
    /// Makes a property from a name and a value.
    pub fn new(name: impl Into<String>, value: Value) -> Self {
        Self { name: name.into(), value }
    }

    /// Makes a property that is text.
    pub fn text(name: impl Into<String>, value: impl Into<String>) -> Self {
        Self::new(name, Value::Text(value.into()))
    }
}

/// The value of a [`Property`].
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Text.
    Text(String),
    /// A length in mm.
    Length(f64),
    /// An area in mm².
    Area(f64),
    /// A volume in mm³.
    Volume(f64),
    /// A mass in kg.
    Mass(f64),
    /// An angle in degrees.
    Degrees(f64),
    /// A number without unit.
    Number(f64),
    /// A whole number.
    Count(i32),
}

impl Value {
    /// The number of the value, if it is one.
    pub(super) fn number(&self) -> Option<f64> {
        match *self {
            Self::Text(_) => None,
            Self::Count(n) => Some(f64::from(n)),
            Self::Length(x)
            | Self::Area(x)
            | Self::Volume(x)
            | Self::Mass(x)
            | Self::Degrees(x)
            | Self::Number(x) => Some(x),
        }
    }
}
