//! The section of the object at every skeletal point of a branch (thesis §5.2.3).

use std::ops::ControlFlow;

use nalgebra::{Point2, Point3, Unit};

use super::moments::Moments;
use crate::mesh::Surface;
use crate::mesh::contour::{Extent, Plane, contour_round};
use crate::observer::Observer;
use crate::section::contours::Contours;
use crate::section::{SectionError, SectionProperties};
use crate::skeleton::{PointKind, Skeleton};

/// A plane section of one branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// The skeletal point, counted from 0.
    pub point: u32,
    /// Through the skeletal point, across the branch.
    pub plane: Plane,
    /// The closed contour, counter-clockwise seen against the plane's normal, mm.
    pub contour: Vec<Point3<f64>>,
    /// Area, mm².
    pub area: f64,
    /// Area centroid, mm.
    pub centroid: Point3<f64>,
}

impl Section {
    /// Radius of the disc of equal area, mm.
    pub fn radius(&self) -> f64 {
        (self.area / std::f64::consts::PI).sqrt()
    }

    /// All its area properties, in the plane's axes; the torsion constant takes the time.
    ///
    /// # Errors
    /// A contour that crosses itself or is no region.
    pub fn properties(&self) -> Result<SectionProperties, SectionError> {
        SectionProperties::of_contours(&Contours::solid(self.outline()))
    }

    /// The contour in the plane's axes about its centroid, mm.
    pub fn outline(&self) -> Vec<Point2<f64>> {
        let (u, v) = self.plane.axes();
        let flat = |p: &Point3<f64>| {
            let d = p - self.centroid;
            Point2::new(d.dot(&u), d.dot(&v))
        };
        self.contour.iter().map(flat).collect()
    }
}

/// Sections reach no farther from their point than this many radii of it: beyond, the plane runs
/// along another branch.
const REACH: f64 = 8.0;

/// The section at every point; `None` at ends and junctions, where no closed contour surrounds the
/// point, and where the contour crosses itself so that it bounds no region.
pub fn sections(surface: &Surface, skeleton: &Skeleton) -> Vec<Option<Section>> {
    sections_watched(surface, skeleton, &mut ()).continue_value().unwrap_or_default()
}

/// The same, unless the observer asks to stop.
pub(crate) fn sections_watched(
    surface: &Surface,
    skeleton: &Skeleton,
    observer: &mut impl Observer,
) -> ControlFlow<(), Vec<Option<Section>>> {
    let mut found = vec![None; skeleton.points.len()];
    for branch in &skeleton.branches {
        for w in branch.points.windows(3) {
            observer.keep_on()?;
            let [before, at, after] = [w[0], w[1], w[2]].map(|p| skeleton.position(p));
            let point = &skeleton.points[w[1] as usize];
            if point.kind == PointKind::Branch {
                found[w[1] as usize] = section(surface, w[1], at, after - before, point.radius);
            }
        }
    }
    ControlFlow::Continue(found)
}

fn section(
    surface: &Surface,
    point: u32,
    at: Point3<f64>,
    along: nalgebra::Vector3<f64>,
    radius: f64,
) -> Option<Section> {
    let plane = Plane::new(at, Unit::try_new(along, 0.0)?);
    let contour = contour_round(&surface.mesh, &surface.tree, &plane, REACH * radius)?;
    let Extent { centroid, area, .. } = Extent::of(&contour, &plane);
    let section = Section { point, plane, contour: contour.points, area, centroid };
    Moments::of_polygon(&section.outline()).is_of_a_region().then_some(section)
}
