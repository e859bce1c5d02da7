//! The shapes a profile can have.

use std::fmt;

use super::super::contours::Contours;
use super::super::error::{SectionError, positive, within};
use super::super::freeform::Freeform;
use super::super::moments::Moments;
use super::super::outline::{Outline, Region};
use super::super::torsion::torsion_constant;
use super::{hollow, open, solid};

/// A shape with its sizes in mm; `b` along y, `h` along z (see the [module](super) for the axes).
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Solid round.
    Round {
        /// Diameter.
        d: f64,
    },
    /// Round tube.
    Tube {
        /// Outer diameter.
        d: f64,
        /// Wall thickness, less than d/2.
        t: f64,
    },
    /// Solid rectangle.
    Rectangle {
        /// Width.
        b: f64,
        /// Height.
        h: f64,
    },
    /// Rectangular hollow section.
    Box {
        /// Outer width.
        b: f64,
        /// Outer height.
        h: f64,
        /// Wall thickness.
        t: f64,
        /// Outer corner radius; 0 is sharp.
        r_o: f64,
        /// Inner corner radius; 0 is sharp.
        r_i: f64,
    },
    /// Solid ellipse.
    Ellipse {
        /// Width, twice the half-axis along y.
        b: f64,
        /// Height, twice the half-axis along z.
        h: f64,
    },
    /// Doubly symmetric I or H with parallel flanges.
    I {
        /// Height.
        h: f64,
        /// Flange width.
        b: f64,
        /// Web thickness.
        t_w: f64,
        /// Flange thickness.
        t_f: f64,
        /// Root fillet.
        r: f64,
    },
    /// Channel with parallel flanges, web on the side of −y.
    C {
        /// Height.
        h: f64,
        /// Flange width.
        b: f64,
        /// Web thickness.
        t_w: f64,
        /// Flange thickness.
        t_f: f64,
        /// Root fillet.
        r: f64,
    },
    /// Angle, corner towards −y and −z.
    L {
        /// Length of the leg along z.
        h: f64,
        /// Length of the leg along y.
        b: f64,
        /// Thickness of both legs.
        t: f64,
        /// Root fillet.
        r_1: f64,
        /// Toe radius.
        r_2: f64,
    },
    /// A closed smooth outline; counts about its own centroid.
    Freeform(Freeform),
}

/// Corners for each span of a spline when its torsion constant is computed; spans are about
/// 1/48 of the way around, and the polygon takes less than a thousandth off the area.
const CORNERS_PER_SPAN: usize = 2;

impl Shape {
    /// Name of the family in lower case, as on the command line.
    pub fn family(&self) -> &'static str {
        match self {
            Self::Round { .. } => "round",
            Self::Tube { .. } => "tube",
            Self::Rectangle { .. } => "rectangle",
            Self::Box { .. } => "box",
            Self::Ellipse { .. } => "ellipse",
            Self::I { .. } => "i",
            Self::C { .. } => "c",
            Self::L { .. } => "l",
            Self::Freeform(_) => "freeform",
        }
    }

    /// Checks that the sizes are positive and leave room for each other.
    ///
    /// # Errors
    /// The first size that does not.
    pub fn check(&self) -> Result<(), SectionError> {
        match *self {
            Self::Round { d } => positive("the diameter", d),
            Self::Tube { d, t } => {
                positive("the diameter", d)?;
                positive("the wall", t)?;
                within("the wall", t, 0.5 * d)
            }
            Self::Rectangle { b, h } | Self::Ellipse { b, h } => {
                positive("the width", b)?;
                positive("the height", h)
            }
            Self::Box { b, h, t, r_o, r_i } => hollow::check(b, h, t, r_o, r_i),
            Self::I { h, b, t_w, t_f, r } => open::check(h, b, t_w, t_f, r, 2.0),
            Self::C { h, b, t_w, t_f, r } => open::check(h, b, t_w, t_f, r, 1.0),
            Self::L { h, b, t, r_1, r_2 } => open::check_angle(h, b, t, r_1, r_2),
            Self::Freeform(ref curve) => {
                let pieces = Outline::Freeform(curve.clone()).pieces();
                if Moments::of_pieces(&pieces).area > 0.0 {
                    Ok(())
                } else {
                    Err(SectionError::NoArea)
                }
            }
        }
    }

    /// The region, origin at the centroid.
    pub fn region(&self) -> Region {
        match *self {
            Self::Round { d } => Region::solid(Outline::circle(0.5 * d)),
            Self::Tube { d, t } => Region {
                outer: Outline::circle(0.5 * d),
                holes: vec![Outline::circle(0.5 * d - t)],
            },
            Self::Rectangle { b, h } => Region::solid(solid::rectangle(b, h, 0.0)),
            Self::Box { b, h, t, r_o, r_i } => Region {
                outer: solid::rectangle(b, h, r_o),
                holes: vec![solid::rectangle(b - 2.0 * t, h - 2.0 * t, r_i)],
            },
            Self::Ellipse { b, h } => Region::solid(Outline::ellipse(0.5 * b, 0.5 * h)),
            Self::I { h, b, t_w, t_f, r } => Region::solid(open::i_outline(h, b, t_w, t_f, r)),
            Self::C { h, b, t_w, t_f, r } => Region::solid(open::c_outline(h, b, t_w, t_f, r)),
            Self::L { h, b, t, r_1, r_2 } => Region::solid(open::l_outline(h, b, t, r_1, r_2)),
            Self::Freeform(ref curve) => {
                let pieces = Outline::Freeform(curve.clone()).pieces();
                let to_centroid = Moments::of_pieces(&pieces).centroid().coords;
                Region::solid(Outline::Freeform(curve.mapped(|p| p - to_centroid)))
            }
        }
    }

    /// Torsion constant J, mm⁴; the [module](super) says by which formula.
    ///
    /// # Errors
    /// Only for a freeform outline that cannot be triangulated.
    pub fn torsion_constant(&self) -> Result<f64, SectionError> {
        Ok(match *self {
            Self::Round { d } => solid::round_torsion(d),
            Self::Tube { d, t } => solid::round_torsion(d) - solid::round_torsion(d - 2.0 * t),
            Self::Rectangle { b, h } => solid::rectangle_torsion(b, h),
            Self::Ellipse { b, h } => solid::ellipse_torsion(b, h),
            Self::Box { b, h, t, r_o, r_i } => hollow::box_torsion(b, h, t, r_o, r_i),
            Self::I { h, b, t_w, t_f, r } => open::i_torsion(h, b, t_w, t_f, r),
            Self::C { h, b, t_w, t_f, r } => open::c_torsion(h, b, t_w, t_f, r),
            Self::L { h, b, t, r_1, .. } => open::l_torsion(h, b, t, r_1),
            Self::Freeform(_) => {
                torsion_constant(&Contours::of_region(&self.region(), CORNERS_PER_SPAN))?
            }
        })
    }

    /// The shape with all sizes multiplied.
    pub fn scaled(&self, s: f64) -> Self {
        match *self {
            Self::Round { d } => Self::Round { d: s * d },
            Self::Tube { d, t } => Self::Tube { d: s * d, t: s * t },
            Self::Rectangle { b, h } => Self::Rectangle { b: s * b, h: s * h },
            Self::Ellipse { b, h } => Self::Ellipse { b: s * b, h: s * h },
            Self::Box { b, h, t, r_o, r_i } => {
                Self::Box { b: s * b, h: s * h, t: s * t, r_o: s * r_o, r_i: s * r_i }
            }
            Self::I { h, b, t_w, t_f, r } => {
                Self::I { h: s * h, b: s * b, t_w: s * t_w, t_f: s * t_f, r: s * r }
            }
            Self::C { h, b, t_w, t_f, r } => {
                Self::C { h: s * h, b: s * b, t_w: s * t_w, t_f: s * t_f, r: s * r }
            }
            Self::L { h, b, t, r_1, r_2 } => {
                Self::L { h: s * h, b: s * b, t: s * t, r_1: s * r_1, r_2: s * r_2 }
            }
            Self::Freeform(ref curve) => Self::Freeform(curve.mapped(|p| p * s)),
        }
    }

    /// Smallest turn, rad, that brings the shape onto itself; 0 if every turn does.
    pub fn symmetry(&self) -> f64 {
        use std::f64::consts::{FRAC_PI_2, PI, TAU};
        match *self {
            Self::Round { .. } | Self::Tube { .. } => 0.0,
            Self::Rectangle { b, h } | Self::Box { b, h, .. } if b == h => FRAC_PI_2,
            Self::Ellipse { b, h } if b == h => 0.0,
            Self::Rectangle { .. } | Self::Box { .. } | Self::Ellipse { .. } | Self::I { .. } => PI,
            Self::C { .. } | Self::L { .. } | Self::Freeform(_) => TAU,
        }
    }
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (kind, sizes) = match *self {
            Self::Round { d } => ("Round", vec![d]),
            Self::Tube { d, t } => ("Tube", vec![d, t]),
            Self::Rectangle { b, h } => ("Rect", vec![b, h]),
            Self::Ellipse { b, h } => ("Ellipse", vec![b, h]),
            Self::Box { b, h, t, .. } => ("Box", vec![b, h, t]),
            Self::I { h, b, t_w, t_f, .. } => ("I", vec![h, b, t_w, t_f]),
            Self::C { h, b, t_w, t_f, .. } => ("C", vec![h, b, t_w, t_f]),
            Self::L { h, b, t, .. } => ("L", vec![h, b, t]),
            Self::Freeform(ref curve) => {
                let area = Moments::of_pieces(&Outline::Freeform(curve.clone()).pieces()).area;
                return write!(f, "Freeform A{}", size(area));
            }
        };
        let sizes: Vec<String> = sizes.into_iter().map(size).collect();
        write!(f, "{kind} {}", sizes.join("x"))
    }
}

/// A size for a name: two decimals, or three digits below 1, without trailing zeros.
pub(crate) fn size(value: f64) -> String {
    let decimals = if value.abs() >= 1.0 || value == 0.0 {
        2
    } else {
        (2 - value.abs().log10().floor() as i32).clamp(2, 12) as usize
    };
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_carry_sizes_without_trailing_zeros() {
        assert_eq!(Shape::Round { d: 12.5 }.to_string(), "Round 12.5");
        assert_eq!(Shape::Tube { d: 60.3, t: 4.0 }.to_string(), "Tube 60.3x4");
        assert_eq!(Shape::Ellipse { b: 8.123_4, h: 0.012_34 }.to_string(), "Ellipse 8.12x0.0123");
    }

    #[test]
    fn sizes_without_room_are_named() {
        let wall = Shape::Tube { d: 10.0, t: 6.0 }.check().unwrap_err();
        assert_eq!(wall.to_string(), "the wall is 6 mm, but must not exceed 5 mm");
        assert!(Shape::Round { d: -1.0 }.check().is_err());
        assert!(Shape::Rectangle { b: f64::NAN, h: 1.0 }.check().is_err());
        let web = Shape::I { h: 100.0, b: 50.0, t_w: 60.0, t_f: 8.0, r: 5.0 };
        assert!(web.check().is_err());
        assert!(Shape::L { h: 50.0, b: 50.0, t: 60.0, r_1: 5.0, r_2: 2.0 }.check().is_err());
    }

    #[test]
    fn doubled_shape_has_sixteenfold_torsion_constant() {
        let shapes = [
            Shape::Tube { d: 60.3, t: 4.0 },
            Shape::Box { b: 50.0, h: 90.0, t: 5.0, r_o: 7.5, r_i: 5.0 },
            Shape::I { h: 200.0, b: 100.0, t_w: 5.6, t_f: 8.5, r: 12.0 },
            Shape::L { h: 80.0, b: 60.0, t: 7.0, r_1: 8.0, r_2: 4.0 },
        ];
        for shape in shapes {
            let [one, two] = [1.0, 2.0].map(|s| shape.scaled(s).torsion_constant().unwrap());
            assert!((two / one - 16.0).abs() < 1e-9, "{shape}");
        }
    }
}
