//! Solids of flat faces, with round holes and bosses: non-design parts.
//!
//! Whoever makes one has already merged coplanar triangles to faces.  Corners
//! and circles are listed once and shared by the faces that meet there, so that
//! what touches is the same edge.

use std::f64::consts::PI;

use nalgebra::{Point3, Vector3};

use super::error::{BodyError, positive};

/// How far a corner may lie off the plane of its face, relative to the size of
/// the solid: single-precision coordinates, merged and moved, stay below it.
const FLAT: f64 = 1e-5;

/// How far circles of one cylinder may differ in axis and radius, relative to the radius.
const ROUND: f64 = 1e-6;

/// A closed solid of flat and cylindrical faces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facets {
    /// Where straight edges end.
    pub corners: Vec<Point3<f64>>,
    /// Round edges, each shared by two faces.
    pub circles: Vec<Circle>,
    /// Every straight or round edge belongs to exactly two of them.
    pub faces: Vec<Facet>,
}

/// A round edge of a [`Facets`] solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    /// Centre.
    pub centre: Point3<f64>,
    /// Normal of its plane, of any length and either sign.
    pub axis: Vector3<f64>,
    /// Radius.
    pub radius: f64,
}

/// One face of a [`Facets`] solid.
#[derive(Clone, Debug, PartialEq)]
pub enum Facet {
    /// Plane, bounded by loops that may run either way round.
    Flat {
        /// Points out of the solid; of any length.
        normal: Vector3<f64>,
        /// The outside.
        outer: Loop,
        /// The holes.
        inner: Vec<Loop>,
    },
    /// The full cylinder between two circles.
    Round {
        /// Indices into [`Facets::circles`], in any order.
        circles: [usize; 2],
        /// Whether the solid lies outside the cylinder: a hole, not a boss.
        bore: bool,
    },
}

/// One closed boundary of a flat face.
#[derive(Clone, Debug, PartialEq)]
pub enum Loop {
    /// Straight edges from corner to corner and back to the first.
    Corners(Vec<u32>),
    /// One circle.
    Circle(usize),
}

impl Facets {
    /// Volume, mm³: ⅓ Σ (distance of the face plane from a point) × (face area).
    ///
    /// # Errors
    /// If a face is not flat or not round, or names what is not there.  Gaps
    /// between faces are found when the solid is written.
    pub fn volume(&self) -> Result<f64, BodyError> {
        self.check()?;
        let volume = (0..self.faces.len()).map(|face| self.cone_volume(face)).sum::<f64>();
        if volume.is_finite() && volume > 0.0 {
            Ok(volume)
        } else {
            Err(BodyError::NoVolume { volume })
        }
    }

    /// Signed volume between a face and the middle of the solid.
    pub(super) fn cone_volume(&self, face: usize) -> f64 {
        let middle = self.middle();
        match &self.faces[face] {
            Facet::Flat { normal, outer, inner } => {
                let normal = normal.normalize();
                let area =
                    self.loop_area(outer) - inner.iter().map(|l| self.loop_area(l)).sum::<f64>();
                (self.on_loop(outer) - middle).dot(&normal) * area / 3.0
            }
            Facet::Round { circles: [a, b], bore } => {
                // Over the full turn the axis part cancels: ⅓ r × 2πr h remains.
                let (a, b) = (&self.circles[*a], &self.circles[*b]);
                let height = (b.centre - a.centre).norm();
                let volume = 2.0 / 3.0 * PI * a.radius * a.radius * height;
                if *bore { -volume } else { volume }
            }
        }
    }

    /// Middle of the box around all corners and circles.
    fn middle(&self) -> Point3<f64> {
        let points = || self.corners.iter().copied().chain(self.circles.iter().map(|c| c.centre));
        let Some(first) = points().next() else { return Point3::origin() };
        let (low, high) = points().fold((first, first), |(l, h), p| (l.inf(&p), h.sup(&p)));
        nalgebra::center(&low, &high)
    }

    /// Largest distance of a coordinate from the origin.
    pub(super) fn reach(&self) -> f64 {
        let corners = self.corners.iter().map(|p| p.coords.amax());
        let circles = self.circles.iter().map(|c| c.centre.coords.amax() + c.radius);
        corners.chain(circles).fold(0.0, f64::max)
    }

    /// Area vector of a polygon, ½ Σ pᵢ × pᵢ₊₁, about its first corner.
    pub(super) fn area_vector(&self, corners: &[u32]) -> Vector3<f64> {
        let at = |i: u32| self.corners[i as usize];
        let origin = at(corners[0]);
        let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
        pairs.map(|(&a, &b)| (at(a) - origin).cross(&(at(b) - origin))).sum::<Vector3<f64>>() * 0.5
    }

    fn loop_area(&self, boundary: &Loop) -> f64 {
        match boundary {
            Loop::Corners(corners) => self.area_vector(corners).norm(),
            Loop::Circle(c) => PI * self.circles[*c].radius.powi(2),
        }
    }

    /// A point of the plane a loop lies in: the mean of its corners, or the centre.
    pub(super) fn on_loop(&self, boundary: &Loop) -> Point3<f64> {
        match boundary {
            Loop::Corners(corners) => {
                let sum: Vector3<f64> =
                    corners.iter().map(|&i| self.corners[i as usize].coords).sum();
                Point3::from(sum / corners.len() as f64)
            }
            Loop::Circle(c) => self.circles[*c].centre,
        }
    }

    /// Checks everything about single faces.
    pub(super) fn check(&self) -> Result<(), BodyError> {
        if self.corners.iter().any(|p| !p.coords.iter().all(|x| x.is_finite())) {
            return Err(BodyError::NotFinite { what: "a corner" });
        }
        for circle in &self.circles {
            positive("a radius", circle.radius)?;
            let direction = circle.axis.norm();
            if !circle.centre.coords.iter().all(|x| x.is_finite()) || !direction.is_normal() {
                return Err(BodyError::NotFinite { what: "a circle" });
            }
        }
        (0..self.faces.len()).try_for_each(|face| self.check_face(face))
    }

    fn check_face(&self, face: usize) -> Result<(), BodyError> {
        match &self.faces[face] {
            Facet::Flat { normal, outer, inner } => {
                if !normal.norm().is_normal() {
                    return Err(BodyError::NotFinite { what: "the normal of a face" });
                }
                std::iter::once(outer)
                    .chain(inner)
                    .try_for_each(|boundary| self.check_exists(face, boundary))?;
                self.check_flat(face, &normal.normalize(), outer, inner)
            }
            Facet::Round { circles: [a, b], .. } => {
                let (Some(a), Some(b)) = (self.circles.get(*a), self.circles.get(*b)) else {
                    return Err(BodyError::NoSuchCorner { face });
                };
                let axis = b.centre - a.centre;
                let along = |v: &Vector3<f64>| {
                    v.normalize().dot(&axis).abs() >= (1.0 - ROUND) * axis.norm()
                };
                let alike = (a.radius - b.radius).abs() <= ROUND * a.radius;
                let fits =
                    alike && axis.norm() > ROUND * a.radius && along(&a.axis) && along(&b.axis);
                if fits { Ok(()) } else { Err(BodyError::NotCylinder { face }) }
            }
        }
    }

    fn check_exists(&self, face: usize, boundary: &Loop) -> Result<(), BodyError> {
        let exists = match boundary {
            Loop::Corners(corners) => corners.iter().all(|&i| (i as usize) < self.corners.len()),
            Loop::Circle(c) => *c < self.circles.len(),
        };
        match boundary {
            _ if !exists => Err(BodyError::NoSuchCorner { face }),
            Loop::Corners(corners) if corners.len() < 3 => Err(BodyError::NoArea),
            _ => Ok(()),
        }
    }

    fn check_flat(
        &self,
        face: usize,
        normal: &Vector3<f64>,
        outer: &Loop,
        inner: &[Loop],
    ) -> Result<(), BodyError> {
        let on_plane = self.on_loop(outer);
        let height = |p: &Point3<f64>| (p - on_plane).dot(normal).abs();
        let off = std::iter::once(outer)
            .chain(inner)
            .flat_map(|boundary| match boundary {
                Loop::Corners(corners) => {
                    corners.iter().map(|&i| height(&self.corners[i as usize])).collect::<Vec<_>>()
                }
                Loop::Circle(c) => {
                    let circle = &self.circles[*c];
                    let tilt = circle.axis.normalize().cross(normal).norm() * circle.radius;
                    vec![height(&circle.centre) + tilt]
                }
            })
            .fold(0.0, f64::max);
        if off <= FLAT * self.reach() { Ok(()) } else { Err(BodyError::NotFlat { face, off }) }
    }
}
