//! Boxes for the tests of this module.

use nalgebra::Point3;

/// The eight corners of a box and its twelve triangles, turned outwards.
pub(super) fn corners_and_triangles(
    low: [f64; 3],
    high: [f64; 3],
) -> ([Point3<f64>; 8], Vec<[u32; 3]>) {
    let side = |corner: usize, k: usize| if corner >> k & 1 == 1 { high[k] } else { low[k] };
    let corners = std::array::from_fn(|i| Point3::from([0, 1, 2].map(|k| side(i, k))));
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    (corners, halves.collect())
}

/// The triangles of a box by their corners.
pub(super) fn triangles(low: [f64; 3], high: [f64; 3]) -> Vec<[Point3<f64>; 3]> {
    let (corners, triangles) = corners_and_triangles(low, high);
    triangles.into_iter().map(|t| t.map(|v| corners[v as usize])).collect()
}
