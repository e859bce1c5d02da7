//! What the properties of a PLY element mean to us.

use ply_rs_bw::ply::{PropertyType, ScalarType};

use crate::colour::Scale;

/// What an element is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ElementKind {
    /// `element vertex`.
    Point,
    /// `element face`.
    Face,
    /// Anything else, passed over.
    Other,
}

impl ElementKind {
    pub(super) fn of(name: &str) -> Self {
        match name {
            "vertex" => Self::Point,
            "face" => Self::Face,
            _ => Self::Other,
        }
    }
}

/// Where the value of a property goes.
///
/// The header handed to `ply-rs-bw` has these letters in place of the names of the file: they are
/// quick to tell apart for each value, and the file's names may hold what its grammar refuses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    X,
    Y,
    Z,
    Red,
    Green,
    Blue,
    Corners,
    Flags,
    Quality,
    NonDesign,
    Label,
    Unused,
}

impl Slot {
    const LETTERS: [(Self, u8); 11] = [
        (Self::X, b'x'),
        (Self::Y, b'y'),
        (Self::Z, b'z'),
        (Self::Red, b'r'),
        (Self::Green, b'g'),
        (Self::Blue, b'b'),
        (Self::Corners, b'c'),
        (Self::Flags, b'f'),
        (Self::Quality, b'q'),
        (Self::NonDesign, b'n'),
        (Self::Label, b'l'),
    ];

    /// The slot that a property goes to by its name, apart from [`Slot::Label`].
    pub(super) fn of(kind: ElementKind, name: &str, property: &PropertyType) -> Self {
        let name = name.to_ascii_lowercase();
        if let PropertyType::List(_, item) = property {
            let is_corners = matches!(name.as_str(), "vertex_indices" | "vertex_index");
            let is_face = kind == ElementKind::Face;
            let takes = is_face && is_corners && is_integer_type(item);
            return if takes { Self::Corners } else { Self::Unused };
        }
        match (kind, name.as_str()) {
            (ElementKind::Other, ..) => Self::Unused,
            (ElementKind::Point, "x") => Self::X,
            (ElementKind::Point, "y") => Self::Y,
            (ElementKind::Point, "z") => Self::Z,
            (_, "red" | "r" | "diffuse_red") => Self::Red,
            (_, "green" | "g" | "diffuse_green") => Self::Green,
            (_, "blue" | "b" | "diffuse_blue") => Self::Blue,
            (ElementKind::Face, "flags") if is_integer(property) => Self::Flags,
            (ElementKind::Face, "quality") => Self::Quality,
            (ElementKind::Face, name) if is_non_design(name) => Self::NonDesign,
            _ => Self::Unused,
        }
    }

    /// The name handed to `ply-rs-bw`; `number` keeps those of unused properties apart.
    pub(super) fn name(self, number: usize) -> String {
        match Self::LETTERS.iter().find(|(slot, _)| *slot == self) {
            Some((_, letter)) => char::from(*letter).to_string(),
            None => format!("u{number}"),
        }
    }

    /// The slot of a name handed to `ply-rs-bw`.
    #[inline]
    pub(super) fn of_name(name: &str) -> Self {
        match name.as_bytes() {
            [b'x'] => Self::X,
            [b'y'] => Self::Y,
            [b'z'] => Self::Z,
            [b'r'] => Self::Red,
            [b'g'] => Self::Green,
            [b'b'] => Self::Blue,
            [b'c'] => Self::Corners,
            [b'f'] => Self::Flags,
            [b'q'] => Self::Quality,
            [b'n'] => Self::NonDesign,
            [b'l'] => Self::Label,
            _ => Self::Unused,
        }
    }
}

fn is_non_design(name: &str) -> bool {
    name.replace(['_', '-'], "").contains("nondesign")
}

/// The type of a property by the words between `property` and its name.
pub(super) fn property_type(words: &[&str]) -> Option<PropertyType> {
    match words {
        ["list", count, item] => Some(PropertyType::List(scalar_type(count)?, scalar_type(item)?)),
        [scalar] => Some(PropertyType::Scalar(scalar_type(scalar)?)),
        _ => None,
    }
}

fn scalar_type(word: &str) -> Option<ScalarType> {
    match word {
        "char" | "int8" => Some(ScalarType::Char),
        "uchar" | "uint8" => Some(ScalarType::UChar),
        "short" | "int16" => Some(ScalarType::Short),
        "ushort" | "uint16" => Some(ScalarType::UShort),
        "int" | "int32" => Some(ScalarType::Int),
        "uint" | "uint32" => Some(ScalarType::UInt),
        "float" | "float32" => Some(ScalarType::Float),
        "double" | "float64" => Some(ScalarType::Double),
        _ => None,
    }
}

/// Whether a property is a single integer.
pub(super) fn is_integer(property: &PropertyType) -> bool {
    matches!(property, PropertyType::Scalar(scalar) if is_integer_type(scalar))
}

/// Whether a type of number is an integer.
pub(super) fn is_integer_type(scalar: &ScalarType) -> bool {
    !matches!(scalar, ScalarType::Float | ScalarType::Double)
}

/// Bytes of a number in a binary file.
pub(super) fn size_of(scalar: &ScalarType) -> u64 {
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// What the numbers of a colour mean, by their type.
pub(super) fn scale_of(property: &PropertyType) -> Scale {
    match property {
        PropertyType::Scalar(ScalarType::UShort) => Scale::Words,
        property if is_integer(property) => Scale::Bytes,
        _ => Scale::Guessed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_a_slot_leads_back_to_it() {
        for (slot, _) in Slot::LETTERS {
            assert_eq!(Slot::of_name(&slot.name(0)), slot);
        }
        assert_eq!(Slot::of_name(&Slot::Unused.name(7)), Slot::Unused);
    }

    #[test]
    fn only_names_like_non_design_are_the_face_property() {
        let integer = PropertyType::Scalar(ScalarType::Int);
        for name in ["non_design", "nondesign", "NonDesign", "is-non-design", "non_design_flag"] {
            assert_eq!(Slot::of(ElementKind::Face, name, &integer), Slot::NonDesign, "{name}");
        }
        for name in ["design", "label", "region"] {
            assert_eq!(Slot::of(ElementKind::Face, name, &integer), Slot::Unused, "{name}");
        }
        assert_eq!(Slot::of(ElementKind::Point, "non_design", &integer), Slot::Unused);
    }
}
