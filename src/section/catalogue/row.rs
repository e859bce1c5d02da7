//! One row of a catalogue file: named values that become a checked profile.

use std::collections::BTreeMap;

use super::Entry;
use super::error::{CatalogueError, Place, RowFault};
use crate::section::profile::{Designation, Profile, Shape};
use crate::section::properties::SectionProperties;

/// Named values of one profile, as text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) place: Place,
    /// Values by lower-case column; blank ones are left out.
    pub(super) values: BTreeMap<String, String>,
}

/// Smallest and largest size of a profile, mm: foil and ships lie between.
const SIZES: [f64; 2] = [1e-3, 1e5];

/// Part by which a published area or second moment may differ from that of the shape. Tables are
/// rounded to three digits, fillets differ between editions; mistyped sizes make more.
const PUBLISHED_TOLERANCE: f64 = 0.03;

/// The same for a published torsion constant, for which tables use several approximations: those
/// of W shapes to the AISC manual differ by up to 8 % from the formula of EN 10365.
const PUBLISHED_TORSION_TOLERANCE: f64 = 0.12;

/// mm per inch, and kg/m per lb/ft.
const INCH: f64 = 25.4;
const POUND_PER_FOOT: f64 = 1.488_163_944;

const SHAPES: &str = "round, tube, rectangle, box, ellipse, i, c, l";
const UNITS: &str = "mm, cm, m, in";

/// Longest name of a profile; a cut list has to hold it.
const LONGEST_NAME: usize = 80;

impl Row {
    /// The profile of the row.
    pub(super) fn entry(&self) -> Result<Entry, CatalogueError> {
        self.checked().map_err(|fault| CatalogueError::Row { place: self.place, fault })
    }

    fn checked(&self) -> Result<Entry, RowFault> {
        let name = self.name("name")?.ok_or(RowFault::Name { text: String::new() })?;
        let designation = Designation {
            name,
            family: self.name("family")?.unwrap_or_default(),
            standard: self.name("standard")?.unwrap_or_default(),
        };
        let mut profile = Profile::new(self.shape()?)?;
        profile.designation = Some(designation);
        let properties = profile.properties()?;
        self.compare(&properties)?;
        let in_pounds = self.text("unit") == Some("in");
        let nominal_mass =
            self.number("mass")?.map(|m| if in_pounds { m * POUND_PER_FOOT } else { m });
        if let Some(mass) = nominal_mass.filter(|m| !(m.is_finite() && *m > 0.0)) {
            return Err(RowFault::NotANumber { column: "mass".into(), text: mass.to_string() });
        }
        Ok(Entry { profile, properties, nominal_mass })
    }

    fn text(&self, column: &str) -> Option<&str> {
        self.values.get(column).map(String::as_str)
    }

    fn name(&self, column: &str) -> Result<Option<String>, RowFault> {
        let Some(text) = self.text(column) else { return Ok(None) };
        let sound = text.chars().count() <= LONGEST_NAME && !text.chars().any(char::is_control);
        if sound {
            Ok(Some(text.to_owned()))
        } else {
            Err(RowFault::Name { text: text.chars().take(LONGEST_NAME).collect() })
        }
    }

    fn number(&self, column: &str) -> Result<Option<f64>, RowFault> {
        let Some(text) = self.text(column) else { return Ok(None) };
        text.parse().ok().filter(|x: &f64| x.is_finite()).map(Some).ok_or_else(|| {
            RowFault::NotANumber {
                column: column.to_owned(),
                text: text.chars().take(LONGEST_NAME).collect(),
            }
        })
    }

    /// mm per unit of the file.
    fn unit(&self) -> Result<f64, RowFault> {
        match self.text("unit").unwrap_or("mm") {
            "mm" => Ok(1.0),
            "cm" => Ok(10.0),
            "m" => Ok(1000.0),
            "in" => Ok(INCH),
            other => Err(RowFault::Unknown { what: "unit", text: other.to_owned(), known: UNITS }),
        }
    }

    /// A size in mm that must be there.
    fn size(&self, column: &'static str) -> Result<f64, RowFault> {
        let needed_by = || self.text("shape").unwrap_or_default().to_owned();
        let value = self.number(column)?;
        let value = value.ok_or_else(|| RowFault::Missing { column, needed_by: needed_by() })?;
        let millimetres = value * self.unit()?;
        if (SIZES[0]..=SIZES[1]).contains(&millimetres) {
            Ok(millimetres)
        } else {
            Err(RowFault::Size { column: column.to_owned(), millimetres })
        }
    }

    /// A radius in mm, 0 if it is not given.
    fn radius(&self, column: &'static str) -> Result<f64, RowFault> {
        match self.number(column)? {
            None => Ok(0.0),
            Some(0.0) => Ok(0.0),
            Some(_) => self.size(column),
        }
    }

    fn shape(&self) -> Result<Shape, RowFault> {
        let size = |column| self.size(column);
        let shape = self.text("shape").ok_or_else(|| RowFault::Missing {
            column: "shape",
            needed_by: "every profile".into(),
        })?;
        Ok(match shape {
            "round" => Shape::Round { d: size("d")? },
            "tube" => Shape::Tube { d: size("d")?, t: size("t")? },
            "rectangle" => Shape::Rectangle { b: size("b")?, h: size("h")? },
            "ellipse" => Shape::Ellipse { b: size("b")?, h: size("h")? },
            "box" => Shape::Box {
                b: size("b")?,
                h: size("h")?,
                t: size("t")?,
                r_o: self.radius("r_o")?,
                r_i: self.radius("r_i")?,
            },
            "i" => {
                let (h, b, t_w, t_f, r) = self.web_and_flanges()?;
                Shape::I { h, b, t_w, t_f, r }
            }
            "c" => {
                let (h, b, t_w, t_f, r) = self.web_and_flanges()?;
                Shape::C { h, b, t_w, t_f, r }
            }
            "l" => Shape::L {
                h: size("h")?,
                b: size("b")?,
                t: size("t")?,
                r_1: self.radius("r_1")?,
                r_2: self.radius("r_2")?,
            },
            other => {
                let text = other.chars().take(LONGEST_NAME).collect();
                return Err(RowFault::Unknown { what: "shape", text, known: SHAPES });
            }
        })
    }

    fn web_and_flanges(&self) -> Result<(f64, f64, f64, f64, f64), RowFault> {
        let size = |column| self.size(column);
        Ok((size("h")?, size("b")?, size("t_w")?, size("t_f")?, self.radius("r")?))
    }

    /// Compares published values, where the row has them, with those of the shape.
    fn compare(&self, own: &SectionProperties) -> Result<(), RowFault> {
        let unit = self.unit()?;
        let checks = [
            ("area", 2, own.area, PUBLISHED_TOLERANCE),
            ("i_y", 4, own.i_xx, PUBLISHED_TOLERANCE),
            ("i_z", 4, own.i_yy, PUBLISHED_TOLERANCE),
            ("j", 4, own.j, PUBLISHED_TORSION_TOLERANCE),
        ];
        for (column, power, computed, tolerance) in checks {
            let Some(published) = self.number(column)? else { continue };
            let stated = published * unit.powi(power);
            if (stated / computed - 1.0).abs() > tolerance {
                return Err(RowFault::Disagrees { column, stated, computed });
            }
        }
        Ok(())
    }
}
