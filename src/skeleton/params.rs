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

/// Where the local march places its junctions.
///
/// Where straight axes meet is not the middle of the lump of material round the junction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Junctions {
    /// Where axes meet, in a part that is a frame of straight bars; in the middle elsewhere.
    #[default]
    Auto,
    /// Where the straight axes of the branches meet (thesis §5.2.6).
    Axes,
    /// In the middle of the material: smallest by eq. (2.2), about a radius off the axes.
    Centred,
}

/// Parameters of the march. All lengths are relative to the branch.
#[derive(Clone, Debug, PartialEq)]
pub struct SkeletonParams {
    /// In which frame the identifier box is carried along.  Default: local.
    pub orientation: Orientation,

    /// Where junctions are placed; the global march has its own rule.  Default: auto.
    pub junctions: Junctions,

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
        Self {
            orientation: Orientation::Local,
            junctions: Junctions::Auto,
            step: 1.0,
            width_ratio: 1.3,
        }
    }
}

impl SkeletonParams {
    /// Defaults for a skeleton that becomes beams: straight bars want the junctions on their axes.
    #[must_use]
    pub fn for_beams() -> Self {
        Self { junctions: Junctions::Axes, ..Self::default() }
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
