//! Profile definitions of IFC. Their origin is the middle of the bounding box; ours the centroid.

use nalgebra::Point2;

use crate::output::part21::{Fault, Id, List, Part21, Real, Text};
use crate::section::contours::Contours;
use crate::section::{Profile, Shape};

/// Points on a quarter of a freeform outline.
const PER_QUARTER: usize = 12;

/// Writes the definition of a profile.
pub(super) fn write(part: &mut Part21<'_>, profile: &Profile, name: &str) -> Result<Id, Fault> {
    if let Shape::Freeform(_) = profile.shape {
        return freeform(part, profile, name);
    }
    let at = middle(part, profile)?;
    let head = format!(".AREA.,{},{at}", Text(name));
    let r = Real;
    let radius = |x: f64| if x > 0.0 { Real(x).to_string() } else { "$".to_owned() };
    match profile.shape {
        Shape::Round { d } => {
            part.entity(format_args!("IFCCIRCLEPROFILEDEF({head},{})", r(0.5 * d)))
        }
        Shape::Tube { d, t } => {
            part.entity(format_args!("IFCCIRCLEHOLLOWPROFILEDEF({head},{},{})", r(0.5 * d), r(t)))
        }
        Shape::Rectangle { b, h } => {
            part.entity(format_args!("IFCRECTANGLEPROFILEDEF({head},{},{})", r(b), r(h)))
        }
        Shape::Ellipse { b, h } => {
            part.entity(format_args!("IFCELLIPSEPROFILEDEF({head},{},{})", r(0.5 * b), r(0.5 * h)))
        }
        Shape::Box { b, h, t, r_o, r_i } => part.entity(format_args!(
            "IFCRECTANGLEHOLLOWPROFILEDEF({head},{},{},{},{},{})",
            r(b),
            r(h),
            r(t),
            radius(r_i),
            radius(r_o)
        )),
        Shape::I { h, b, t_w, t_f, r: fillet } => part.entity(format_args!(
            "IFCISHAPEPROFILEDEF({head},{},{},{},{},{},$,$)",
            r(b),
            r(h),
            r(t_w),
            r(t_f),
            radius(fillet)
        )),
        Shape::C { h, b, t_w, t_f, r: fillet } => part.entity(format_args!(
            "IFCUSHAPEPROFILEDEF({head},{},{},{},{},{},$,$)",
            r(h),
            r(b),
            r(t_w),
            r(t_f),
            radius(fillet)
        )),
        Shape::L { h, b, t, r_1, r_2 } => part.entity(format_args!(
            "IFCLSHAPEPROFILEDEF({head},{},{},{},{},{},$)",
            r(h),
            r(b),
            r(t),
            radius(r_1),
            radius(r_2)
        )),
        Shape::Freeform(_) => freeform(part, profile, name),
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
