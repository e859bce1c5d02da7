//! Boundary representation: truck's topology over our own curves and surfaces.
//!
//! `truck-topology` is generic over what lies on its vertices, edges and faces.
//! Its own modelling geometry knows no cylinder, cone or ellipse, which a CAD
//! user wants to pick, so the solids here carry [`Curve`] and [`Surface`]
//! instead; B-spline geometry in them is `truck-modeling`'s.  What truck does
//! for every body: wires are checked to be closed and simple, shells to be
//! connected, closed, oriented and manifold ([`solid_of`]), and ruled sides are
//! its homotopies.
//!
//! Two habits of STEP have no counterpart in truck and are kept beside it: a
//! closed edge has one vertex (`Edge::new_unchecked`), and a face that closes
//! on itself, as a cylinder does, has a seam ([`Skin::seam`]).

mod coped;
mod curve;
mod facets;
mod loft;

use nalgebra::{Point3, UnitVector3, Vector3};
use truck_modeling::{NurbsCurve, NurbsSurface, Vector4};

use super::body::Body;
use super::coped::Coped;
use super::error::BodyError;
use super::levels::Levels;

pub(super) type Vertex = truck_topology::Vertex<Point3<f64>>;
pub(super) type Edge = truck_topology::Edge<Point3<f64>, Curve>;
pub(super) type Wire = truck_topology::Wire<Point3<f64>, Curve>;
pub(super) type Face = truck_topology::Face<Point3<f64>, Curve, Skin>;
pub(super) type Shell = truck_topology::Shell<Point3<f64>, Curve, Skin>;
pub(super) type Solid = truck_topology::Solid<Point3<f64>, Curve, Skin>;

/// The line an edge follows from its first vertex to its second.
#[derive(Clone, Debug)]
pub(super) enum Curve {
    /// Straight; the vertices say all.
    Line,
    Conic(Conic),
    Spline(NurbsCurve<Vector4>),
}

/// `centre + p cos θ + q sin θ`, run in the direction of growing θ.
///
/// p and q are conjugate half-diameters: a circle if p ⟂ q and |p| = |q|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Conic {
    pub(super) centre: Point3<f64>,
    pub(super) p: Vector3<f64>,
    pub(super) q: Vector3<f64>,
}

/// An axis with a direction across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axes {
    pub(super) origin: Point3<f64>,
    pub(super) z: UnitVector3<f64>,
    pub(super) x: UnitVector3<f64>,
}

/// What a face lies on.
#[derive(Clone, Debug)]
pub(super) enum Surface {
    /// Normal to z.
    Plane(Axes),
    /// About z.
    Cylinder {
        axes: Axes,
        radius: f64,
    },
    /// About z, growing along it from `radius` at the origin.
    Cone {
        axes: Axes,
        radius: f64,
        half_angle: f64,
    },
    Sphere {
        axes: Axes,
        radius: f64,
    },
    /// A conic swept along a direction.
    Extrusion {
        along: Conic,
        direction: UnitVector3<f64>,
    },
    /// Wound counter-clockwise: first parameter along the outline, second along the beam.
    Spline(Box<NurbsSurface<Vector4>>),
}

/// A surface and, where it closes on itself, the line where it does.
#[derive(Clone, Debug)]
pub(super) struct Skin {
    pub(super) surface: Surface,
    /// From the vertex of the first boundary to that of the second.
    pub(super) seam: Option<Curve>,
}

impl Axes {
    /// Axes about a direction, with x as near to `x` as can be.
    ///
    /// Falls back to any direction across z if `x` is parallel to it.
    pub(super) fn about(origin: Point3<f64>, z: Vector3<f64>, x: Vector3<f64>) -> Self {
        let z = UnitVector3::new_normalize(z);
        let across = x - *z * z.dot(&x);
        let across = if across.norm() > 1e-9 * x.norm() { across } else { curve::across(&z) };
        Self { origin, z, x: UnitVector3::new_normalize(across) }
    }
}

impl Body {
    /// Builds the whole boundary, as it would be written, and returns the volume, mm³.
    ///
    /// # Errors
    /// If the body is not a solid; unlike [`volume`](Self::volume) this also finds gaps between
    /// faces.
    pub fn check(&self) -> Result<f64, BodyError> {
        build(self).map(|(volume, _)| volume)
    }
}

/// Finds the volume of a body and builds its boundary, checked by truck.
///
/// # Errors
/// If the body is not a solid.
pub(super) fn build(body: &Body) -> Result<(f64, Solid), BodyError> {
    match body {
        Body::Loft(loft) => {
            if let Some(coped) = Coped::of(loft) {
                let coped = coped?;
                return Ok((coped.volume(), coped::solid(&coped)?));
            }
            let levels = Levels::new(loft)?;
            Ok((levels.volume()?, loft::solid(&levels)?))
        }
        Body::Sphere { radius } => Ok((body.volume()?, sphere(*radius)?)),
        Body::Facets(facets) => Ok((body.volume()?, facets::solid(facets)?)),
    }
}

/// A whole sphere is one face without any edge.
fn sphere(radius: f64) -> Result<Solid, BodyError> {
    let axes = Axes::about(Point3::origin(), Vector3::z(), Vector3::x());
    let skin = Skin { surface: Surface::Sphere { axes, radius }, seam: None };
    solid_of(vec![vec![face(Vec::new(), skin, true)?].into()])
}

/// A face from its wires, which run counter-clockwise as seen from outside.
///
/// `same_sense`: whether the normal of the surface points outside, too.
fn face(wires: Vec<Wire>, skin: Skin, same_sense: bool) -> Result<Face, BodyError> {
    if same_sense {
        return Face::try_new(wires, skin).map_err(not_closed);
    }
    let inverse = wires.iter().map(Wire::inverse).collect();
    let mut face = Face::try_new(inverse, skin).map_err(not_closed)?;
    face.invert();
    Ok(face)
}

/// The solid within shells, if truck finds each closed, oriented and manifold.
fn solid_of(shells: Vec<Shell>) -> Result<Solid, BodyError> {
    Solid::try_new(shells).map_err(not_closed)
}

fn not_closed(error: truck_topology::errors::Error) -> BodyError {
    BodyError::NotClosed(error.to_string())
}
