//! Profile definitions of IFC. Their origin is the middle of the bounding box; ours the centroid.

use std::fmt::{self, Display, Formatter};

use nalgebra::Point2;

use crate::output::part21::{Fault, Id, List, Part21, Real, Text};
use crate::section::contours::Contours;
use crate::section::{Profile, Shape};

/// Points on a quarter of a freeform outline.
const PER_QUARTER: usize = 12;

/// Writes the definition of a profile.
pub(super) fn write(part: &mut Part21<'_>, profile: &Profile, name: &str) -> Result<Id, Fault> {
    let round = |radius: f64| (radius > 0.0).then_some(radius);
    let (entity, sizes) = match profile.shape {
        Shape::Freeform(_) => return freeform(part, profile, name),
        Shape::Round { d } => ("CIRCLE", vec![Some(0.5 * d)]),
        Shape::Tube { d, t } => ("CIRCLEHOLLOW", vec![Some(0.5 * d), Some(t)]),
        Shape::Rectangle { b, h } => ("RECTANGLE", vec![Some(b), Some(h)]),
        Shape::Ellipse { b, h } => ("ELLIPSE", vec![Some(0.5 * b), Some(0.5 * h)]),
        Shape::Box { b, h, t, r_o, r_i } => {
            ("RECTANGLEHOLLOW", vec![Some(b), Some(h), Some(t), round(r_i), round(r_o)])
        }
        Shape::I { h, b, t_w, t_f, r } => {
            ("ISHAPE", vec![Some(b), Some(h), Some(t_w), Some(t_f), round(r), None, None])
        }
        Shape::C { h, b, t_w, t_f, r } => {
            ("USHAPE", vec![Some(h), Some(b), Some(t_w), Some(t_f), round(r), None, None])
        }
        Shape::L { h, b, t, r_1, r_2 } => {
            ("LSHAPE", vec![Some(h), Some(b), Some(t), round(r_1), round(r_2), None])
        }
    };
    let at = middle(part, profile)?;
    let (name, sizes) = (Text(name), Sizes(sizes));
    part.entity(format_args!("IFC{entity}PROFILEDEF(.AREA.,{name},{at}{sizes})"))
}

/// Sizes in the order of an entity, each behind a comma; `None` is one that is not given.
struct Sizes(Vec<Option<f64>>);

impl Display for Sizes {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|size| match size {
            Some(size) => write!(f, ",{}", Real(*size)),
            None => f.write_str(",$"),
        })
    }
}

/// Placement of the middle of the bounding box.
fn middle(part: &mut Part21<'_>, profile: &Profile) -> Result<Id, Fault> {
    let outline = Contours::of_region(&profile.region(), PER_QUARTER).outer;
    let start = outline.first().copied().unwrap_or_else(Point2::origin);
    let (low, high) = outline.iter().fold((start, start), |(l, h), p| (l.inf(p), h.sup(p)));
    let at = nalgebra::center(&low, &high);
    let at = part.entity(format_args!("IFCCARTESIANPOINT(({},{}))", Real(at.x), Real(at.y)))?;
    part.entity(format_args!("IFCAXIS2PLACEMENT2D({at},$)"))
}

fn freeform(part: &mut Part21<'_>, profile: &Profile, name: &str) -> Result<Id, Fault> {
    let outline = Contours::of_region(&profile.region(), PER_QUARTER).outer;
    let mut points = Vec::with_capacity(outline.len() + 1);
    for p in &outline {
        points.push(part.entity(format_args!(
            "IFCCARTESIANPOINT(({},{}))",
            Real(p.x),
            Real(p.y)
        ))?);
    }
    points.extend(points.first().copied());
    let curve = part.entity(format_args!("IFCPOLYLINE({})", List(&points)))?;
    part.entity(format_args!("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,{},{curve})", Text(name)))
}
