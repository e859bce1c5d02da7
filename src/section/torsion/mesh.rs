//! Triangulates a region for the torsion constant: constrained Delaunay, refined (spade).

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Point2, Vector2};
use spade::{AngleLimit, ConstrainedDelaunayTriangulation, RefinementParameters, Triangulation};

use crate::section::contours::signed_area;
use crate::section::error::SectionError;
use crate::section::rays::crossings;

/// Smallest angle asked for, degrees. 22 keeps the triangles well shaped for the elements and is
/// reached without running away; 30 doubles the triangles along noisy contours.
const SMALLEST_ANGLE: f64 = 22.0;

/// Triangles smaller than this part of the largest are left as they are, whatever their angles:
/// they sit between short sides of the contour, where φ is nearly 0.
const LEAVE_ALONE: f64 = 0.001;

/// Part of the area by which the triangles may differ from the polygons: their roundings only.
const SAME_AREA: f64 = 1e-6;

/// Most points added to a region: a strip of five thousand by one thickness may need as many.
const MOST_VERTICES: usize = 250_000;

/// A triangulated region.
pub(super) struct Mesh {
    pub(super) points: Vec<Point2<f64>>,
    /// Counter-clockwise corners.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Sides between material and void, material on the left, by their rim.
    rims: Vec<Vec<[u32; 2]>>,
}

type Cdt = ConstrainedDelaunayTriangulation<spade::Point2<f64>>;

/// Triangulates polygons by the even–odd rule, no triangle larger than `largest`.
pub(super) fn triangulate(
    polygons: &[Vec<Point2<f64>>],
    largest: f64,
) -> Result<Mesh, SectionError> {
    let most = most_vertices(polygons, largest);
    if most > MOST_VERTICES {
        return Err(SectionError::NotTriangulated);
    }
    let cdt = constrained(polygons)?;
    let parameters = RefinementParameters::new()
        .with_angle_limit(AngleLimit::from_deg(SMALLEST_ANGLE))
        .with_max_allowed_area(largest)
        .with_min_required_area(LEAVE_ALONE * largest)
        .with_max_additional_vertices(most);
    let mesh = within_constraints(cdt.clone(), parameters.clone());
    let areas = polygons.iter().map(|p| signed_area(p).abs());
    let expected =
        2.0 * polygons.first().map_or(0.0, |p| signed_area(p).abs()) - areas.sum::<f64>();
    let mesh = if (mesh.area() - expected).abs() <= SAME_AREA * expected {
        mesh
    } else {
        by_even_odd_rule(cdt, parameters, polygons)
    };
    if mesh.triangles.is_empty() { Err(SectionError::NotTriangulated) } else { Ok(mesh) }
}

/// The sides of the polygons as edges of a triangulation.
fn constrained(polygons: &[Vec<Point2<f64>>]) -> Result<Cdt, SectionError> {
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
    Ok(cdt)
}

/// The refined triangles that an odd number of constraint edges parts from the outside.
fn within_constraints(mut cdt: Cdt, parameters: RefinementParameters<f64>) -> Mesh {
    let refined = cdt.refine(parameters.exclude_outer_faces(true));
    let void: BTreeSet<usize> = refined.excluded_faces.iter().map(|face| face.index()).collect();
    Mesh::of(&cdt, |face, _| !void.contains(&face))
}

/// The refined triangles whose middle lies in the polygons.
///
/// A contour that runs twice along a line is one edge to the triangulation, which then takes the
/// wrong side for the inside; here both runs count.
fn by_even_odd_rule(
    mut cdt: Cdt,
    parameters: RefinementParameters<f64>,
    polygons: &[Vec<Point2<f64>>],
) -> Mesh {
    cdt.refine(parameters);
    Mesh::of(&cdt, |_, corners| {
        let [a, b, c] = corners.map(|p| p.coords);
        let middle = Point2::from((a + b + c) / 3.0);
        let crossed = polygons.iter().flat_map(|p| crossings(p, middle, Vector2::x())).count();
        !crossed.is_multiple_of(2)
    })
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
    /// The triangles that `keep` says are inside, by their number and corners.
    fn of(cdt: &Cdt, keep: impl Fn(usize, [Point2<f64>; 3]) -> bool) -> Self {
        let points: Vec<Point2<f64>> =
            cdt.vertices().map(|v| Point2::new(v.position().x, v.position().y)).collect();
        let triangles: Vec<[u32; 3]> = cdt
            .inner_faces()
            .map(|face| (face.fix().index(), face.vertices().map(|v| v.fix().index())))
            .filter(|(face, corners)| keep(*face, corners.map(|i| points[i])))
            .map(|(_, corners)| corners.map(|i| i as u32))
            .collect();
        Self { points, rims: rims(&triangles), triangles }
    }

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
