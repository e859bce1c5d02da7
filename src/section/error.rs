//! Why a section has no properties.

/// Why the properties of a section cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SectionError {
    /// A coordinate or a size is not a finite number.
    #[error("{what} is not a finite number")]
    NotFinite {
        /// What was wrong.
        what: &'static str,
    },

    /// A size is zero or negative.
    #[error("{what} must be greater than 0 mm, but is {value}")]
    NotPositive {
        /// The size in words.
        what: &'static str,
        /// Its value, mm.
        value: f64,
    },

    /// A size does not leave room for another.
    #[error("{what} is {value} mm, but must not exceed {limit} mm")]
    TooLarge {
        /// The size in words.
        what: &'static str,
        /// Its value, mm.
        value: f64,
        /// The most it can be, mm.
        limit: f64,
    },

    /// An outline has fewer than three distinct points.
    #[error("an outline needs three distinct points, but has {points}")]
    TooFewPoints {
        /// Distinct points found.
        points: usize,
    },

    /// The region encloses no area.
    #[error("the outline encloses no area")]
    NoArea,

    /// A hole does not lie within the outer outline, or holes overlap.
    #[error("the holes take up {holes} mm² of an outline of {outer} mm²")]
    HolesTooLarge {
        /// Area of the holes, mm².
        holes: f64,
        /// Area within the outer outline, mm².
        outer: f64,
    },

    /// The region could not be triangulated for the torsion constant.
    #[error("the outline cannot be triangulated; it crosses or touches itself")]
    NotTriangulated,
}

/// Refuses what is not a positive finite number.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), SectionError> {
    if !value.is_finite() {
        Err(SectionError::NotFinite { what })
    } else if value <= 0.0 {
        Err(SectionError::NotPositive { what, value })
    } else {
        Ok(())
    }
}

/// Refuses what is not a finite number of `0..=limit`.
pub(crate) fn within(what: &'static str, value: f64, limit: f64) -> Result<(), SectionError> {
    if !value.is_finite() {
        Err(SectionError::NotFinite { what })
    } else if value < 0.0 {
        Err(SectionError::NotPositive { what, value })
    } else if value > limit {
        Err(SectionError::TooLarge { what, value, limit })
    } else {
        Ok(())
    }
}
