//! Units of length that a file may be in.

use std::fmt;
use std::str::FromStr;

/// Unit of length of a file; everything is converted to millimetres.
///
/// OFF, OBJ, PLY and STL carry no unit and are taken for millimetres unless told otherwise; glTF is
/// in metres by its specification.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Millimetre.
    Mm,
    /// Centimetre.
    Cm,
    /// Metre.
    M,
    /// Inch, 25.4 mm.
    Inch,
}

impl Unit {
    /// All units, for messages and flags.
    pub const ALL: [Self; 4] = [Self::Mm, Self::Cm, Self::M, Self::Inch];

    /// Millimetres in one of the unit.
    pub fn to_mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::M => 1000.0,
            Self::Inch => 25.4,
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::M => "m",
            Self::Inch => "in",
        })
    }
}

/// A word that is no unit of length.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown unit {word:?}; known are mm, cm, m, in")]
pub struct UnknownUnit {
    /// The word.
    pub word: String,
}

impl FromStr for Unit {
    type Err = UnknownUnit;

    fn from_str(word: &str) -> Result<Self, UnknownUnit> {
        match word.trim().to_ascii_lowercase().as_str() {
            "mm" => Ok(Self::Mm),
            "cm" => Ok(Self::Cm),
            "m" => Ok(Self::M),
            "in" | "inch" => Ok(Self::Inch),
            _ => Err(UnknownUnit { word: word.to_owned() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_read_from_its_own_name() {
        for unit in Unit::ALL {
            assert_eq!(unit.to_string().parse(), Ok(unit));
        }
        assert_eq!("Inch".parse(), Ok(Unit::Inch));
        let error = "ft".parse::<Unit>().unwrap_err();
        assert_eq!(error.to_string(), "unknown unit \"ft\"; known are mm, cm, m, in");
    }
}
