use std::collections::HashMap;
use std::f64::consts::TAU;

use proptest::prelude::*;

use super::*;
use crate::Polygons;

/// A mesh of one polygon that goes through all points.
fn polygon(positions: &[Point3]) -> RawMesh {
    let mut faces = Polygons::default();
    faces.push(0..positions.len() as u32);
    RawMesh { positions: positions.to_vec(), faces, ..RawMesh::default() }
}

fn flat_polygon(points: &[Point2]) -> RawMesh {
    polygon(&points.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>())
}

fn normal_of(mesh: &RawMesh, triangle: [u32; 3]) -> Point3 {
    newell_normal(triangle.map(|corner| mesh.positions[corner as usize]).into_iter())
}

/// Asserts that the triangles of a polygon cover it once, with each of its edges in one of them.
fn assert_is_whole(mesh: &RawMesh) {
    let ring = mesh.faces.corners_of(0);
    let triangles = mesh.triangulate();
    assert_eq!(triangles.corners.len(), ring.len() - 2, "{triangles:?}");
    let mut edges = HashMap::new();
    for &[a, b, c] in &triangles.corners {
        for edge in [[a, b], [b, c], [c, a]] {
            *edges.entry(edge).or_insert(0) += 1;
        }
    }
    for (&[a, b], &count) in &edges {
        assert_eq!(count, 1, "edge {a} {b} in {triangles:?}");
        let place = ring.iter().position(|&corner| corner == a).unwrap();
        let is_boundary = ring[(place + 1) % ring.len()] == b;
        assert_ne!(is_boundary, edges.contains_key(&[b, a]), "edge {a} {b} in {triangles:?}");
    }
}

/// Asserts that no triangle is turned over or without area, and that their areas make up the whole.
fn assert_is_sound(mesh: &RawMesh) {
    assert_is_whole(mesh);
    let whole = newell_normal(mesh.positions.iter().copied());
    let size = dot(whole, whole).sqrt();
    let mut sum = 0.0;
    for triangle in mesh.triangulate().corners {
        let area = dot(normal_of(mesh, triangle), whole) / size;
        assert!(area > 1e-12 * size, "{triangle:?} of {:?}", mesh.positions);
        sum += area;
    }
    assert!((sum - size).abs() < 1e-9 * size, "{sum} {size}");
}

#[test]
fn triangles_stay_as_they_are() {
    let mut mesh = flat_polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    mesh.faces.push([2, 1, 0]);
    let triangles = mesh.triangulate();
    assert_eq!(triangles.corners, [[0, 1, 2], [2, 1, 0]]);
    assert_eq!(triangles.face, [0, 1]);
}

#[test]
fn a_quadrilateral_is_cut_along_its_better_diagonal() {
    let dart = [[0.0, 0.0], [2.0, 2.0], [1.0, 0.0], [2.0, -2.0]];
    for turn in 0..4 {
        let mut turned = dart;
        turned.rotate_left(turn);
        assert_is_sound(&flat_polygon(&turned));
    }
    let on_line = flat_polygon(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]]);
    assert_eq!(on_line.triangulate().corners, [[1, 2, 3], [1, 3, 0]]);
    let square = flat_polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    assert_eq!(square.triangulate().corners, [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn corners_on_straight_lines_stay_corners() {
    // A square with several points on each side, beginning at any of them.
    let mut points = Vec::new();
    for k in 0..4 {
        points.push([f64::from(k), 0.0]);
    }
    points.extend([
        [3.0, 1.0],
        [3.0, 3.0],
        [2.5, 3.0],
        [1.0, 3.0],
        [0.0, 3.0],
        [0.0, 2.0],
        [0.0, 0.1],
    ]);
    for _ in 0..points.len() {
        points.rotate_left(1);
        assert_is_sound(&flat_polygon(&points));
    }
}

#[test]
fn concave_polygons_are_cut_inside() {
    let comb: Vec<Point2> = (0..20)
        .flat_map(|tooth| {
            let x = f64::from(tooth);
            [[x, 0.0], [x + 0.3, 5.0], [x + 0.6, 0.1]]
        })
        .chain([[25.0, -1.0], [-1.0, -1.0]])
        .collect();
    let comb: Vec<Point2> = comb.into_iter().rev().collect();
    assert_is_sound(&flat_polygon(&comb));
    let spiral: Vec<Point2> = (0..100)
        .map(|k| (f64::from(k), 1.0))
        .chain((0..100).rev().map(|k| (f64::from(k), 0.8)))
        .map(|(k, width)| {
            let (sin, cos) = (0.3 * k).sin_cos();
            let radius = (1.0 + 0.1 * k) * width;
            [radius * cos, radius * sin]
        })
        .collect();
    assert_is_whole(&flat_polygon(&spiral));
}

#[test]
fn a_star_that_goes_round_twice_is_no_fan() {
    let star: Vec<Point2> = (0..5)
        .map(|corner| {
            let (sin, cos) = (2.0 * TAU * f64::from(corner) / 5.0).sin_cos();
            [cos, sin]
        })
        .collect();
    assert!(!is_fan(&star));
    assert_eq!(flat_polygon(&star).triangulate().corners.len(), 3);
}

#[test]
fn repeated_corners_fall_out() {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let triangles_of = |corners: &[u32]| {
        let mut mesh = RawMesh { positions: positions.clone(), ..RawMesh::default() };
        mesh.faces.push(corners.iter().copied());
        mesh.triangulate().corners
    };
    assert_eq!(triangles_of(&[0, 0, 1]), [[0; 3]; 0]);
    assert_eq!(triangles_of(&[0, 1, 0, 1, 0]), [[0; 3]; 0]);
    assert_eq!(triangles_of(&[2, 2, 2, 2, 2, 2]), [[0; 3]; 0]);
    assert_eq!(triangles_of(&[0, 0, 1, 1, 2, 2, 0]), [[0, 1, 2]]);
    assert_eq!(triangles_of(&[0, 1, 1, 2, 3, 0]), [[0, 1, 2], [0, 2, 3]]);
    // Out to a corner and back again, anywhere in the polygon.
    for corners in [[0, 1, 2, 3, 2], [1, 2, 3, 2, 0], [2, 3, 2, 0, 1], [3, 2, 0, 1, 2]] {
        assert_eq!(triangles_of(&corners).len(), 1, "{corners:?}");
    }
    assert_eq!(triangles_of(&[1, 3, 1, 2, 3, 2, 0, 3, 0, 1, 3, 0]).len(), 2);
}

#[test]
fn a_hole_joined_by_a_bridge_is_left_open() {
    let outer = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let inner = [[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]];
    let positions: Vec<Point3> = outer.into_iter().chain(inner).map(|[x, y]| [x, y, 0.0]).collect();
    let mut mesh = RawMesh { positions, ..RawMesh::default() };
    mesh.faces.push([0, 1, 2, 3, 0, 4, 5, 6, 7, 4]);
    let triangles = mesh.triangulate().corners;
    let areas = triangles.iter().map(|&triangle| normal_of(&mesh, triangle)[2]);
    assert!(areas.clone().all(|area| area > 0.0), "{triangles:?}");
    assert!((areas.sum::<f64>() - 12.0).abs() < 1e-12);
}

#[test]
fn polygons_without_a_normal_still_keep_their_edges() {
    let line: Vec<Point3> = (0..6).map(|k| [f64::from(k), 0.0, 0.0]).collect();
    assert_is_whole(&polygon(&line));
    assert_is_whole(&polygon(&[[1.0, 2.0, 3.0]; 7]));
    let bow_tie = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    assert_is_whole(&flat_polygon(&bow_tie));
}

#[test]
fn coordinates_may_be_huge_or_tiny() {
    let shape: [Point2; 6] =
        [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.5], [0.5, 0.5], [0.0, 2.0]];
    for scale in [1e300, 1e-300, f64::MAX / 4.0] {
        let scaled = shape.map(|point| point.map(|coordinate| coordinate * scale));
        let expected = flat_polygon(&shape).triangulate();
        assert_eq!(flat_polygon(&scaled).triangulate(), expected, "{scale}");
    }
    let opposite =
        [[-f64::MAX, 0.0], [f64::MAX, 0.0], [f64::MAX, f64::MAX], [0.0, 1.0], [1.0, f64::MAX]];
    assert_is_whole(&flat_polygon(&opposite));
}

/// A star-shaped polygon, mostly concave, turned into space.
fn star() -> impl Strategy<Value = Vec<Point3>> {
    let radii = proptest::collection::vec(0.2..1.0_f64, 5..60);
    (radii, proptest::array::uniform3(-1.0..1.0_f64), -1e3..1e3_f64).prop_filter_map(
        "a direction needs a length",
        |(radii, direction, far)| {
            let length = dot(direction, direction).sqrt();
            if length < 0.1 {
                return None;
            }
            let [u, v] = plane_of(direction.map(|coordinate| coordinate / length));
            let count = radii.len() as f64;
            let corner = |(number, radius): (usize, f64)| {
                let (sin, cos) = (TAU * number as f64 / count).sin_cos();
                [0, 1, 2].map(|axis| far + radius * (cos * u[axis] + sin * v[axis]))
            };
            Some(radii.into_iter().enumerate().map(corner).collect())
        },
    )
}

/// A polygon on a coarse grid: many corners on straight lines, coordinates exact.
fn staircase() -> impl Strategy<Value = Vec<Point2>> {
    proptest::collection::vec(1..5_u8, 2..30).prop_map(|heights| {
        let bottom = (0..=heights.len()).map(|x| [x as f64, 0.0]);
        let top = heights.iter().enumerate().rev().flat_map(|(x, &height)| {
            [[x as f64 + 1.0, f64::from(height)], [x as f64, f64::from(height)]]
        });
        let mut points: Vec<Point2> = bottom.chain(top).collect();
        points.dedup();
        points
    })
}

proptest! {
    #[test]
    fn star_shaped_polygons_are_covered_once(positions in star()) {
        assert_is_sound(&polygon(&positions));
    }

    #[test]
    fn staircases_keep_every_corner(points in staircase(), turn in 0..60_usize) {
        let mut points = points;
        let count = points.len();
        points.rotate_left(turn % count);
        assert_is_sound(&flat_polygon(&points));
    }

    #[test]
    fn any_corners_at_all_give_triangles_of_these_corners(
        positions in proptest::collection::vec(proptest::array::uniform3(-2.0..2.0_f64), 1..12),
        corners in proptest::collection::vec(0..12_u32, 3..200),
    ) {
        let count = positions.len() as u32;
        let mut mesh = RawMesh { positions, ..RawMesh::default() };
        mesh.faces.push(corners.iter().map(|corner| corner % count));
        for [a, b, c] in mesh.triangulate().corners {
            prop_assert!(a != b && b != c && c != a);
            prop_assert!([a, b, c].into_iter().all(|corner| corner < count));
        }
    }
}
