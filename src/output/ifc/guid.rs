//! Identifiers of IFC: 128 bits in 22 characters, the same for the same thing in every file.

use std::fmt::{self, Display, Formatter};

/// An identifier made of names.
pub(super) struct Guid(u128);

/// The 64 characters of the format, in its own order.
const DIGITS: &[u8; 64] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";

impl Guid {
    /// The identifier of a thing by the names that lead to it: FNV-1a with 128 bits.
    pub(super) fn of(names: &[&str]) -> Self {
        const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013B;
        const BASIS: u128 = 0x6C62_272E_07BB_0142_62B8_2175_6295_C58D;
        let bytes = names.iter().flat_map(|n| n.bytes().chain([0xFF]));
        Self(bytes.fold(BASIS, |hash, byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME)))
    }
}

impl Display for Guid {
    /// In quotes; the first character stands for two bits, each other one for six.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let digit = |shift: u32| char::from(DIGITS[(self.0 >> shift) as usize & 63]);
        let first = char::from(DIGITS[(self.0 >> 126) as usize]);
        write!(f, "'{first}")?;
        (0..21).rev().try_for_each(|i| write!(f, "{}", digit(6 * i)))?;
        write!(f, "'")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_are_22_characters_and_differ() {
        let [a, b] = [Guid::of(&["ab", "c"]), Guid::of(&["a", "bc"])].map(|g| g.to_string());
        assert_eq!((a.len(), b.len()), (24, 24));
        assert_ne!(a, b);
        assert_eq!(Guid(0).to_string(), "'0000000000000000000000'");
        assert_eq!(Guid(u128::MAX).to_string(), "'3$$$$$$$$$$$$$$$$$$$$$'");
    }
}
