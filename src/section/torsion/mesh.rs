//! Triangulates a region for the torsion constant: constrained Delaunay, refined (spade).

use std::collections::BTreeMap;

use nalgebra::Point2;
use spade::{AngleLimit, ConstrainedDelaunayTriangulation, RefinementParameters, Triangulation};

use crate::section::error::SectionError;
use crate::section::properties::signed_area;

/// Smallest angle asked for, degrees. 22 keeps the triangles well shaped for the elements and is
/// reached without running away; 30 doubles the triangles along noisy contours.
const SMALLEST_ANGLE: f64 = 22.0;

/// Triangles smaller than this part of the largest are left as they are, whatever their angles:
/// they sit between short sides of the contour, where φ is nearly 0.
const LEAVE_ALONE: f64 = 0.02;

/// A triangulated region.
pub(super) struct Mesh {
    pub(super) points: Vec<Point2<f64>>,
    /// Counter-clockwise corners.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Sides between material and void, material on the left, by their rim.
    rims: Vec<Vec<[u32; 2]>>,
}

/// Triangulates polygons by the even–odd rule, no triangle larger than `largest`.
pub(super) fn triangulate(
    polygons: &[Vec<Point2<f64>>],
    largest: f64,
) -> Result<Mesh, SectionError> {
    type Cdt = ConstrainedDelaunayTriangulation<spade::Point2<f64>>;
    let mut cdt = Cdt::new();
    for polygon in polygons {
        let mut handles = Vec::with_capacity(polygon.len());
        for p in polygon {
            let handle = cdt.insert(spade::Point2::new(p.x, p.y));
            handles.push(handle.map_err(|_| SectionError::NotTriangulated)?);
        }
        for (i, &from) in handles.iter().enumerate() {
            let to = handles[(i + 1) % handles.len()];
            if from != to {
                cdt.add_constraint_and_split(from, to, |p| p);
            }
        }
    }
    let parameters = RefinementParameters::new()
        .exclude_outer_faces(true)
        .with_angle_limit(AngleLimit::from_deg(SMALLEST_ANGLE))
        .with_max_allowed_area(largest)
        .with_min_required_area(LEAVE_ALONE * largest)
        .with_max_additional_vertices(most_vertices(polygons, largest));
    let refined = cdt.refine(parameters);
    let void: std::collections::BTreeSet<usize> =
        refined.excluded_faces.iter().map(|face| face.index()).collect();
    let points = cdt
        .vertices()
        .map(|v| {
            let p = v.position();
            Point2::new(p.x, p.y)
        })
        .collect();
    let triangles: Vec<[u32; 3]> = cdt
        .inner_faces()
        .filter(|face| !void.contains(&face.fix().index()))
        .map(|face| face.vertices().map(|v| v.fix().index() as u32))
        .collect();
    if triangles.is_empty() {
        return Err(SectionError::NotTriangulated);
    }
    Ok(Mesh { points, rims: rims(&triangles), triangles })
}

/// Bound on the points added, so that refinement ends on any contour: four times what fills the
/// region evenly, and eight for each corner of the contours.
fn most_vertices(polygons: &[Vec<Point2<f64>>], largest: f64) -> usize {
    let area: f64 = polygons.iter().map(|p| signed_area(p).abs()).sum();
    let corners: usize = polygons.iter().map(Vec::len).sum();
    (4.0 * area / largest) as usize + 8 * corners
}

/// Sides that belong to one triangle only, chained into connected rims.
fn rims(triangles: &[[u32; 3]]) -> Vec<Vec<[u32; 2]>> {
    let mut open = BTreeMap::new();
    for t in triangles {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            if open.remove(&(b, a)).is_none() {
                open.insert((a, b), ());
            }
        }
    }
    let mut from: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (a, b) in open.into_keys() {
        from.entry(a).or_default().push(b);
    }
    let mut rims = Vec::new();
    while let Some((&first, _)) = from.first_key_value() {
        rims.push(walk(first, &mut from));
    }
    rims
}

/// All sides that can be reached from a corner, taken out of `from`.
fn walk(first: u32, from: &mut BTreeMap<u32, Vec<u32>>) -> Vec<[u32; 2]> {
    let mut rim = Vec::new();
    let mut open = vec![first];
    while let Some(a) = open.pop() {
        for b in from.remove(&a).unwrap_or_default() {
            rim.push([a, b]);
            open.push(b);
        }
    }
    rim
}

impl Mesh {
    /// Twice the signed area of a triangle.
    pub(super) fn doubled_area(&self, t: &[u32; 3]) -> f64 {
        let [a, b, c] = t.map(|i| self.points[i as usize]);
        (b - a).perp(&(c - a))
    }

    pub(super) fn area(&self) -> f64 {
        0.5 * self.triangles.iter().map(|t| self.doubled_area(t)).sum::<f64>()
    }

    /// Sides between material and void, and the hole they go around, if it is one.
    ///
    /// A rim around a hole runs clockwise, so that its signed area is negative.
    pub(super) fn rim_sides(&self) -> Vec<([u32; 2], Option<usize>)> {
        let mut holes = 0;
        let mut all = Vec::new();
        for rim in &self.rims {
            let hole = (self.rim_area(rim) < 0.0).then(|| {
                holes += 1;
                holes - 1
            });
            all.extend(rim.iter().map(|&side| (side, hole)));
        }
        all
    }

    fn rim_area(&self, rim: &[[u32; 2]]) -> f64 {
        let corner = |i: u32| self.points[i as usize].coords;
        0.5 * rim.iter().map(|&[a, b]| corner(a).perp(&corner(b))).sum::<f64>()
    }

    /// Area of each hole, in the order of [`rim_sides`](Self::rim_sides).
    pub(super) fn hole_areas(&self) -> Vec<f64> {
        self.rims.iter().map(|rim| -self.rim_area(rim)).filter(|&area| area > 0.0).collect()
    }
}
