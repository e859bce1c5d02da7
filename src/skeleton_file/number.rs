//! Numbers as they are written.

use std::fmt;

/// Prints a number with the fewest digits from which the same number is read again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shortest(pub(super) f64);

impl fmt::Display for Shortest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // −0 and 0 are the same place.
        write!(f, "{:?}", self.0 + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_as_few_as_tell_the_number() {
        assert_eq!(Shortest(0.1).to_string(), "0.1");
        assert_eq!(Shortest(-0.0).to_string(), "0.0");
        assert_eq!(Shortest(1e-300).to_string(), "1e-300");
        assert_eq!(Shortest(1.0 / 3.0).to_string().parse(), Ok(1.0 / 3.0));
    }
}
