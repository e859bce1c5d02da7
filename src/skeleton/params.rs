//! What the march can be told.

/// In which frame the identifier box is carried along.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Orientation {
    /// The box turns with the branch (thesis §5.2.2).
    #[default]
    Local,
    /// The box stays aligned with the global axes (thesis chapter 3).
    Global,
}

/// Parameters of the march. All lengths are relative to the branch.
#[derive(Clone, Debug, PartialEq)]
pub struct SkeletonParams {
    /// In which frame the identifier box is carried along.  Default: local.
    pub orientation: Orientation,

    /// Distance between two skeletal points, in mean strut radii 2 V / A of the design part.
    ///
    /// Smaller follows bends more closely and costs time in proportion.
    /// Range: `[0.1, 2]`.  Default: `1`.
    pub step: f64,

    /// Growth of the box, from one to the next, at which a junction begins (thesis §3.4.2.6).
    ///
    /// Smaller ends branches earlier; larger follows them deeper into the junctions.
    /// Range: `(1, 3]`.  Default: `1.3`.
    pub width_ratio: f64,
}

impl Default for SkeletonParams {
    fn default() -> Self {
        Self { orientation: Orientation::Local, step: 1.0, width_ratio: 1.3 }
    }
}

/// A parameter outside its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{name} must lie in {range}, but is {value}")]
pub struct OutOfRange {
    /// The parameter, as on the command line.
    pub name: &'static str,
    /// Its range.
    pub range: &'static str,
    /// What was given.
    pub value: f64,
}

impl SkeletonParams {
    /// Checks every parameter against its range.
    ///
    /// # Errors
    /// The first parameter that is out of its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        if !(0.1..=2.0).contains(&self.step) {
            return Err(OutOfRange { name: "--step", range: "[0.1, 2]", value: self.step });
        }
        if !(self.width_ratio > 1.0 && self.width_ratio <= 3.0) {
            return Err(OutOfRange {
                name: "--width-ratio",
                range: "(1, 3]",
                value: self.width_ratio,
            });
        }
        Ok(())
    }
}
