//! Points, directions, curves and surfaces as STEP entities.
//!
//! Equal points, directions and placements are written once.  Coordinates have
//! thirteen digits: the rest is rounding, and differs from machine to machine.

use nalgebra::{Point3, UnitVector3, Vector3};
use rustc_hash::FxHashMap;
use truck_modeling::{KnotVec, NurbsCurve, NurbsSurface, Vector4};

use super::brep::{Axes, Conic, Curve, Surface};
use crate::output::part21::{Fault, Flag, Id, List, Part21, Real};

/// Below this a component of a direction is rounding, and written as 0.
const NO_COMPONENT: f64 = 1e-15;

/// Digits of a coordinate.
const DIGITS: i32 = 13;

type Key = [u64; 3];

/// Writes geometry, each point, direction and placement once.
pub(super) struct Geometry<'w, 'a> {
    pub(super) part: &'w mut Part21<'a>,
    points: FxHashMap<Key, Id>,
    directions: FxHashMap<Key, Id>,
    vectors: FxHashMap<Id, Id>,
    placements: FxHashMap<[Id; 3], Id>,
}

impl<'w, 'a> Geometry<'w, 'a> {
    pub(super) fn new(part: &'w mut Part21<'a>) -> Self {
        Self {
            part,
            points: FxHashMap::default(),
            directions: FxHashMap::default(),
            vectors: FxHashMap::default(),
            placements: FxHashMap::default(),
        }
    }

    pub(super) fn point(&mut self, p: &Point3<f64>) -> Result<Id, Fault> {
        let p = p.coords.map(shortened);
        let key = key(&p);
        if let Some(id) = self.points.get(&key) {
            return Ok(*id);
        }
        let id = self.part.entity(format_args!("CARTESIAN_POINT('',{})", reals(&p)))?;
        self.points.insert(key, id);
        Ok(id)
    }

    fn direction(&mut self, d: &UnitVector3<f64>) -> Result<Id, Fault> {
        let d = d.map(|x| if x.abs() < NO_COMPONENT { 0.0 } else { shortened(x) });
        let key = key(&d);
        if let Some(id) = self.directions.get(&key) {
            return Ok(*id);
        }
        let id = self.part.entity(format_args!("DIRECTION('',{})", reals(&d)))?;
        self.directions.insert(key, id);
        Ok(id)
    }

    pub(super) fn placement(&mut self, axes: &Axes) -> Result<Id, Fault> {
        let ids = [self.point(&axes.origin)?, self.direction(&axes.z)?, self.direction(&axes.x)?];
        if let Some(id) = self.placements.get(&ids) {
            return Ok(*id);
        }
        let [o, z, x] = ids;
        let id = self.part.entity(format_args!("AXIS2_PLACEMENT_3D('',{o},{z},{x})"))?;
        self.placements.insert(ids, id);
        Ok(id)
    }

    fn vector(&mut self, direction: &UnitVector3<f64>) -> Result<Id, Fault> {
        let direction = self.direction(direction)?;
        if let Some(id) = self.vectors.get(&direction) {
            return Ok(*id);
        }
        let id = self.part.entity(format_args!("VECTOR('',{direction},1.)"))?;
        self.vectors.insert(direction, id);
        Ok(id)
    }

    /// The curve of an edge between two points.
    pub(super) fn curve(
        &mut self,
        curve: &Curve,
        from: &Point3<f64>,
        to: &Point3<f64>,
    ) -> Result<Id, Fault> {
        match curve {
            Curve::Line => {
                let start = self.point(from)?;
                let along = self.vector(&UnitVector3::new_normalize(to - from))?;
                self.part.entity(format_args!("LINE('',{start},{along})"))
            }
            Curve::Conic(conic) => self.conic(conic),
            Curve::Spline(spline) => self.spline_curve(spline),
        }
    }

    fn conic(&mut self, conic: &Conic) -> Result<Id, Fault> {
        let axes = self.placement(&conic.axes())?;
        if let Some(radius) = conic.radius() {
            return self.part.entity(format_args!("CIRCLE('',{axes},{})", Real(radius)));
        }
        let (major, minor) = conic.half_axes();
        let (a, b) = (Real(major.norm()), Real(minor.norm()));
        self.part.entity(format_args!("ELLIPSE('',{axes},{a},{b})"))
    }

    pub(super) fn surface(&mut self, surface: &Surface) -> Result<Id, Fault> {
        match surface {
            Surface::Plane(axes) => {
                let axes = self.placement(axes)?;
                self.part.entity(format_args!("PLANE('',{axes})"))
            }
            Surface::Cylinder { axes, radius } => {
                let axes = self.placement(axes)?;
                self.part.entity(format_args!("CYLINDRICAL_SURFACE('',{axes},{})", Real(*radius)))
            }
            Surface::Cone { axes, radius, half_angle } => {
                let axes = self.placement(axes)?;
                let (radius, angle) = (Real(*radius), Real(*half_angle));
                self.part.entity(format_args!("CONICAL_SURFACE('',{axes},{radius},{angle})"))
            }
            Surface::Sphere { axes, radius } => {
                let axes = self.placement(axes)?;
                self.part.entity(format_args!("SPHERICAL_SURFACE('',{axes},{})", Real(*radius)))
            }
            Surface::Extrusion { along, direction } => {
                let (along, vector) = (self.conic(along)?, self.vector(direction)?);
                self.part.entity(format_args!("SURFACE_OF_LINEAR_EXTRUSION('',{along},{vector})"))
            }
            Surface::Spline(spline) => self.spline_surface(spline),
        }
    }

    fn spline_curve(&mut self, curve: &NurbsCurve<Vector4>) -> Result<Id, Fault> {
        let points = self.control_points(curve.control_points())?;
        let closed = Flag(points.first() == points.last());
        let (knots, times) = curve.knot_vec().to_single_multi();
        let (degree, points) = (curve.degree(), List(&points));
        let (knots, times) = (List(knots.iter().map(|k| Real(*k))), List(&times));
        let weights = curve.control_points();
        if weights.iter().all(|p| p.w == 1.0) {
            return self.part.entity(format_args!(
                "B_SPLINE_CURVE_WITH_KNOTS('',{degree},{points},.UNSPECIFIED.,{closed},.F.,\
                 {times},{knots},.UNSPECIFIED.)"
            ));
        }
        let weights = List(weights.iter().map(|p| Real(p.w)));
        self.part.entity(format_args!(
            "(BOUNDED_CURVE()B_SPLINE_CURVE({degree},{points},.UNSPECIFIED.,{closed},.F.)\
             B_SPLINE_CURVE_WITH_KNOTS({times},{knots},.UNSPECIFIED.)CURVE()\
             GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE({weights})\
             REPRESENTATION_ITEM(''))"
        ))
    }

    fn spline_surface(&mut self, surface: &NurbsSurface<Vector4>) -> Result<Id, Fault> {
        let grid = surface.non_rationalized().control_points();
        let rows =
            grid.iter().map(|row| self.control_points(row)).collect::<Result<Vec<_>, _>>()?;
        let closed = Flag(rows.first() == rows.last());
        let (u, v) = surface.degrees();
        let points = List(rows.iter().map(List));
        let [(u_knots, u_times), (v_knots, v_times)] =
            [surface.uknot_vec(), surface.vknot_vec()].map(KnotVec::to_single_multi);
        let [u_knots, v_knots] = [&u_knots, &v_knots].map(|k| List(k.iter().map(|k| Real(*k))));
        let (u_times, v_times) = (List(&u_times), List(&v_times));
        if grid.iter().flatten().all(|p| p.w == 1.0) {
            return self.part.entity(format_args!(
                "B_SPLINE_SURFACE_WITH_KNOTS('',{u},{v},{points},.UNSPECIFIED.,{closed},.F.,.F.,\
                 {u_times},{v_times},{u_knots},{v_knots},.UNSPECIFIED.)"
            ));
        }
        let weights = List(grid.iter().map(|row| List(row.iter().map(|p| Real(p.w)))));
        self.part.entity(format_args!(
            "(BOUNDED_SURFACE()B_SPLINE_SURFACE({u},{v},{points},.UNSPECIFIED.,{closed},.F.,.F.)\
             B_SPLINE_SURFACE_WITH_KNOTS({u_times},{v_times},{u_knots},{v_knots},.UNSPECIFIED.)\
             GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE({weights})\
             REPRESENTATION_ITEM('')SURFACE())"
        ))
    }

    fn control_points(&mut self, points: &[Vector4]) -> Result<Vec<Id>, Fault> {
        points.iter().map(|p| self.point(&(Point3::new(p.x, p.y, p.z) / p.w))).collect()
    }
}

/// The number to [`DIGITS`] digits.
fn shortened(x: f64) -> f64 {
    let decimals = f64::from(DIGITS - 1) - x.abs().log10().floor();
    // Powers of ten up to here are exact, and the quotient the nearest to the decimal.
    if !(0.0..=22.0).contains(&decimals) {
        return x;
    }
    let scale = 10f64.powi(decimals as i32);
    (x * scale).round() / scale
}

/// Bits of three numbers, with both zeros the same.
fn key(v: &Vector3<f64>) -> Key {
    [v.x, v.y, v.z].map(|x| (x + 0.0).to_bits())
}

fn reals(v: &Vector3<f64>) -> List<[Real; 3]> {
    List([Real(v.x), Real(v.y), Real(v.z)])
}
