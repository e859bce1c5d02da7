//! The torsion constant J of Saint-Venant for any region, with holes or without.
//!
//! Prandtl's stress function φ solves Δφ = −2 in the region, is 0 on the outer contour and a
//! constant c_k on each hole, such that the warping closes around it; then (Timoshenko and
//! Goodier, Theory of Elasticity, §§104, 115)
//!
//! ```text
//! J = 2 ∫ φ dA + 2 Σ c_k A_k          A_k  area of the hole k
//! ```
//!
//! φ is the minimum of ½ ∫ |∇φ|² − 2 ∫ φ − 2 Σ c_k A_k, so that the condition at the holes needs
//! no equation of its own: all points on a hole share one unknown.
//!
//! | step                           | file       |
//! |--------------------------------|------------|
//! | triangulate the region         | `mesh`     |
//! | quadratic triangles            | `element`  |
//! | solve along the longer extent  | `envelope` |
//!
//! Quadratic triangles hold the parabola of φ across a thin wall exactly, so that one triangle
//! across a wall is enough and thin open shapes cost no accuracy. J is approached from below.
//! Measured on the shapes of the tests: circle of 64 corners, square, rectangles to 1:20,
//! ellipses, equilateral triangle, thin and thick tubes and I sections within 0.2 %.
//!
//! # What it does not promise
//!
//! * Contours that cross themselves are read by the even–odd rule.
//! * Contours are thinned to [`SHORTEST_SIDE`] before; J is scaled by the square of the area lost.

mod element;
mod envelope;
mod mesh;

use nalgebra::Point2;

use super::contours::{Contours, sides, signed_area};
use super::error::SectionError;
use element::Stiffness;
use mesh::{Mesh, triangulate};

/// Shortest side that is kept, in mean wall thicknesses 2 A / perimeter.
///
/// Plane sections of a mesh have slivers of sides where the plane passes by a corner; each would
/// be surrounded by a fan of tiny triangles. The sides of a circle of 64 corners are 0.1 long and
/// must stay, those of a tube of D/t = 50 with as many corners are 2.5 long.
pub const SHORTEST_SIDE: f64 = 0.03;

/// Largest triangle, in squares of the mean wall thickness.
///
/// A square bar is 2 thick, 50 triangles at this size, and 0.1 % off; twice as large, it is 0.5 %
/// off, and half as large all takes twice the time.
const LARGEST_TRIANGLE: f64 = 0.08;

/// Inward turn from which a corner is sharp, rad: those of a circular hole of 24 corners (0.26)
/// need no care, the fillet corners of a T (1.57) do.
const SHARP_INWARD: f64 = 0.35;

/// Farthest added corner, in wall thicknesses and as a part of the side, and the ratio of one
/// distance to the next. Three distances down to 1/9 leave 0.1 % of a T.
const GRADED_FROM: f64 = 0.2;
const GRADED_PART: f64 = 0.4;
const GRADING: f64 = 1.0 / 3.0;

/// Torsion constant of a region, mm⁴.
///
/// # Errors
/// If the region has no area or cannot be triangulated.
///
/// # Examples
/// ```
/// # use beamwright::section::{Contours, torsion::torsion_constant};
/// # use nalgebra::Point2;
/// let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
/// let square = Contours::solid(corners.map(|(x, y)| Point2::new(x, y)).to_vec());
/// let j = torsion_constant(&square)?;
/// assert!((j / 2.2492 - 1.0).abs() < 0.002); // 0.1406 a⁴
/// # Ok::<(), beamwright::section::SectionError>(())
/// ```
pub fn torsion_constant(contours: &Contours) -> Result<f64, SectionError> {
    let exact = contours.moments()?;
    let perimeter: f64 =
        contours.polygons().flat_map(|p| sides(p)).map(|(p, q)| (q - p).norm()).sum();
    let thickness = 2.0 * exact.area / perimeter;
    let scaled = |p: &Point2<f64>| Point2::from((p - exact.centroid()) / thickness);
    let polygons: Vec<Vec<Point2<f64>>> = contours
        .polygons()
        .map(|polygon| thinned(polygon.iter().map(scaled).collect()))
        .filter(|polygon| polygon.len() > 2)
        .map(|polygon| graded(&polygon))
        .collect();
    let mesh = triangulate(&polygons, LARGEST_TRIANGLE)?;
    let j = stress_function_integral(&mesh).ok_or(SectionError::NotTriangulated)?;
    let lost = exact.area / (mesh.area() * thickness * thickness);
    Ok(j * lost * lost * thickness.powi(4))
}

/// Drops corners nearer than [`SHORTEST_SIDE`] to the one before; lengths in wall thicknesses.
fn thinned(polygon: Vec<Point2<f64>>) -> Vec<Point2<f64>> {
    let mut kept: Vec<Point2<f64>> = Vec::with_capacity(polygon.len());
    for p in polygon {
        if kept.last().is_none_or(|q| (p - q).norm() >= SHORTEST_SIDE) {
            kept.push(p);
        }
    }
    while kept.len() > 1 && (kept[kept.len() - 1] - kept[0]).norm() < SHORTEST_SIDE {
        kept.pop();
    }
    kept
}

/// Adds corners on the sides next to sharp inward corners, ever nearer to them.
///
/// There |∇φ| grows without bound, and even triangles would leave J of a T 0.5 % too small, of a
/// noisy contour 1.5 %.
fn graded(polygon: &[Point2<f64>]) -> Vec<Point2<f64>> {
    let n = polygon.len();
    let left = if signed_area(polygon) > 0.0 { 1.0 } else { -1.0 };
    let inward = |i: usize| {
        let (u, v) = (polygon[i] - polygon[(i + n - 1) % n], polygon[(i + 1) % n] - polygon[i]);
        left * u.perp(&v).atan2(u.dot(&v)) < -SHARP_INWARD
    };
    let mut points = Vec::with_capacity(2 * n);
    for i in 0..n {
        let (p, q) = (polygon[i], polygon[(i + 1) % n]);
        let length = (q - p).norm();
        let from = GRADED_FROM.min(GRADED_PART * length);
        let steps = [1.0, GRADING, GRADING * GRADING].map(|g| from * g / length);
        points.push(p);
        if inward(i) {
            points.extend(steps.iter().rev().map(|t| p + (q - p) * *t));
        }
        if inward((i + 1) % n) {
            points.extend(steps.iter().map(|t| q + (p - q) * *t));
        }
    }
    points
}

/// 2 ∫ φ dA + 2 Σ c_k A_k on a triangulated region.
fn stress_function_integral(mesh: &Mesh) -> Option<f64> {
    let mut stiffness = Stiffness::of(mesh)?;
    for (hole, area) in mesh.hole_areas().into_iter().enumerate() {
        stiffness.load_hole(hole, area);
    }
    Some(stiffness.solve())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;

    fn ring(n: usize, at: impl Fn(f64) -> (f64, f64)) -> Vec<Point2<f64>> {
        (0..n)
            .map(|i| {
                let (x, y) = at(TAU * i as f64 / n as f64);
                Point2::new(x, y)
            })
            .collect()
    }

    fn rectangle(b: f64, h: f64) -> Contours {
        let corners = [(0.0, 0.0), (b, 0.0), (b, h), (0.0, h)];
        Contours::solid(corners.map(|(x, y)| Point2::new(x, y)).to_vec())
    }

    #[track_caller]
    fn check(contours: &Contours, exact: f64, tolerance: f64) {
        let j = torsion_constant(contours).unwrap();
        assert!((j / exact - 1.0).abs() < tolerance, "J = {j}, exact {exact}: {}", j / exact - 1.0);
    }

    /// Timoshenko and Goodier, §109, table: J = k₁ b³ h.
    #[test]
    fn rectangles_agree_with_the_table_of_timoshenko() {
        for (ratio, k) in [(1.0, 0.1406), (1.5, 0.1958), (2.0, 0.229), (4.0, 0.281), (10.0, 0.312)]
        {
            check(&rectangle(3.0, 3.0 * ratio), k * 27.0 * 3.0 * ratio, 0.003);
        }
    }

    /// J = h b³ / 3 (1 − 0.63025 b/h) beyond 1:5 (same place).
    #[test]
    fn thin_rectangle_loses_its_two_ends() {
        check(&rectangle(1.0, 20.0), 20.0 / 3.0 * (1.0 - 0.63025 / 20.0), 0.001);
    }

    /// J = a⁴ √3 / 80 (Timoshenko and Goodier, §108).
    #[test]
    fn equilateral_triangle_has_side_to_the_fourth_root_3_over_80() {
        let corners = [(0.0, 0.0), (2.0, 0.0), (1.0, 3.0f64.sqrt())];
        let triangle = Contours::solid(corners.map(|(x, y)| Point2::new(x, y)).to_vec());
        check(&triangle, 16.0 * 3.0f64.sqrt() / 80.0, 0.002);
    }

    #[test]
    fn ellipse_has_pi_a3_b3_over_a2_plus_b2() {
        for (a, b) in [(5.0, 5.0), (7.5, 4.0), (9.0, 2.0)] {
            // Corners outside the ellipse such that the polygon has its area.
            let n = 128;
            let s = (TAU / n as f64 / (TAU / n as f64).sin()).sqrt();
            let ellipse = ring(n, |t| (s * a * t.cos(), s * b * t.sin()));
            let exact = PI * f64::powi(a * b, 3) / (a * a + b * b);
            check(&Contours::solid(ellipse), exact, 0.002);
        }
    }

    /// Thick: ½ π (R⁴ − r⁴); thin: Bredt, 4 A_m² t / s.
    #[test]
    fn tubes_thick_and_thin_close_the_shear_flow() {
        for (inner, outer) in [(2.0, 5.0), (4.0, 5.0), (4.8, 5.0)] {
            let n = 96;
            let s = (TAU / n as f64 / (TAU / n as f64).sin()).sqrt();
            let circle = |r: f64| ring(n, |t| (s * r * t.cos(), s * r * t.sin()));
            let tube = Contours { outer: circle(outer), holes: vec![circle(inner)] };
            check(&tube, 0.5 * PI * (outer.powi(4) - inner.powi(4)), 0.003);
            if inner > 4.5 {
                let (r, t) = (0.5 * (inner + outer), outer - inner);
                check(&tube, 4.0 * (PI * r * r).powi(2) * t / (TAU * r), 0.003);
            }
        }
    }

    #[test]
    fn slit_opens_the_tube_and_takes_its_stiffness() {
        let (r, t) = (10.0, 1.0);
        let arc =
            |r: f64| ring(100, move |a| (r * (0.01 + a * 0.99).cos(), r * (0.01 + a * 0.99).sin()));
        let mut outline = arc(r + 0.5 * t);
        outline.extend(arc(r - 0.5 * t).into_iter().rev());
        let j = torsion_constant(&Contours::solid(outline)).unwrap();
        assert!(j < 0.34 * TAU * r * t.powi(3), "{j}");
    }

    /// Two squares joined by a line that is run there and back.
    #[test]
    fn contour_may_run_twice_along_a_line() {
        let corners = [
            (0.0, 0.0),
            (2.0, 0.0),
            (2.0, 1.0),
            (5.0, 1.0),
            (5.0, 0.0),
            (7.0, 0.0),
            (7.0, 2.0),
            (5.0, 2.0),
            (5.0, 1.0),
            (2.0, 1.0),
            (2.0, 2.0),
            (0.0, 2.0),
        ];
        let joined = Contours::solid(corners.map(|(x, y)| Point2::new(x, y)).to_vec());
        check(&joined, 2.0 * 0.1406 * 16.0, 0.005);
    }

    #[test]
    fn contour_that_crosses_itself_has_a_torsion_constant() {
        let bow = [(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 3.0)];
        let bow = Contours::solid(bow.map(|(x, y)| Point2::new(x, y)).to_vec());
        assert!(torsion_constant(&bow).is_ok_and(|j| j > 0.0));
    }
}
