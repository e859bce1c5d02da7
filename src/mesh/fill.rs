//! Closes small and flat openings of a surface.
//!
//! Converters leave cracks (T-corners), single missing triangles and flat uncapped ends. Closing
//! those cannot change what the part is; any other opening is left to the user.

use nalgebra::{Point3, Vector3};

use super::indexed::IndexedMesh;
use super::orient::NO_TWIN;

/// An opening of at most this many edges is closed whatever its shape: a missing triangle or
/// quadrilateral and its neighbours, never the end of a strut (which has at least a dozen).
const SMALL_OPENING: usize = 8;

/// An opening is flat when no border point is farther from its mean plane than this part of its
/// radius of gyration. Voxel steps (about 0.3) stay above it, rounded coordinates far below.
const FLATNESS: f64 = 1e-3;

/// A crack encloses less than this part of the square of its perimeter (a disc: 0.08).
const CRACK: f64 = 1e-4;

/// What [`close_openings`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Filled {
    /// Openings closed.
    pub(super) closed: usize,
    /// Border edges and openings that remain, and the middle of the first border edge.
    pub(super) left: Option<(usize, usize, Point3<f64>)>,
}

/// Closes the openings of an oriented surface by fans round their middle; extends `twins`.
pub(super) fn close_openings(mesh: &mut IndexedMesh, twins: &mut Vec<u32>) -> Filled {
    let mut filled = Filled::default();
    for border in borders(twins) {
        let rim: Vec<Point3<f64>> =
            border.iter().map(|&h| mesh.positions[origin(mesh, h) as usize]).collect();
        if border.len() <= SMALL_OPENING || is_flat_or_crack(&rim) {
            close(mesh, twins, &border, &rim);
            filled.closed += 1;
        } else {
            let first = super::orient::middle(mesh, border[0]);
            let (edges, loops, place) = filled.left.unwrap_or((0, 0, first));
            filled.left = Some((edges + border.len(), loops + 1, place));
        }
    }
    filled
}

/// Closed chains of border half-edges; each runs with the surface on its left.
fn borders(twins: &[u32]) -> Vec<Vec<u32>> {
    let mut seen = vec![false; twins.len()];
    let mut found = Vec::new();
    for start in 0..twins.len() as u32 {
        if twins[start as usize] != NO_TWIN || seen[start as usize] {
            continue;
        }
        let mut border = Vec::new();
        let mut at = start;
        while !std::mem::replace(&mut seen[at as usize], true) {
            border.push(at);
            at = next_border(twins, at);
        }
        found.push(border);
    }
    found
}

/// The border half-edge that leaves the target of `h`, found by turning about it.
fn next_border(twins: &[u32], h: u32) -> u32 {
    let mut at = next(h);
    while twins[at as usize] != NO_TWIN {
        at = next(twins[at as usize]);
    }
    at
}

fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

fn origin(mesh: &IndexedMesh, h: u32) -> u32 {
    mesh.triangles[h as usize / 3][h as usize % 3]
}

fn is_flat_or_crack(rim: &[Point3<f64>]) -> bool {
    let middle = mean(rim);
    let doubled_area: Vector3<f64> =
        (0..rim.len()).map(|i| (rim[i] - middle).cross(&(rim[(i + 1) % rim.len()] - middle))).sum();
    let perimeter: f64 = (0..rim.len()).map(|i| (rim[(i + 1) % rim.len()] - rim[i]).norm()).sum();
    if doubled_area.norm() < 2.0 * CRACK * perimeter * perimeter {
        return true;
    }
    let normal = doubled_area.normalize();
    let size =
        (rim.iter().map(|p| (p - middle).norm_squared()).sum::<f64>() / rim.len() as f64).sqrt();
    rim.iter().all(|p| (p - middle).dot(&normal).abs() <= FLATNESS * size)
}

fn mean(points: &[Point3<f64>]) -> Point3<f64> {
    Point3::from(points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / points.len() as f64)
}

/// Adds a fan of triangles from the border to its middle (one triangle where three edges will do).
fn close(mesh: &mut IndexedMesh, twins: &mut Vec<u32>, border: &[u32], rim: &[Point3<f64>]) {
    let corners: Vec<u32> = border.iter().map(|&h| origin(mesh, h)).collect();
    let n = corners.len();
    if n == 3 {
        add_triangle(mesh, twins, [corners[1], corners[0], corners[2]]);
        let first = twins.len() as u32 - 3;
        for (side, h) in [(0, border[0]), (1, border[2]), (2, border[1])] {
            join(twins, first + side, h);
        }
        return;
    }
    mesh.positions.push(mean(rim));
    let hub = mesh.positions.len() as u32 - 1;
    let first = twins.len() as u32;
    for i in 0..n {
        add_triangle(mesh, twins, [corners[(i + 1) % n], corners[i], hub]);
        join(twins, first + 3 * i as u32, border[i]);
    }
    for i in 0..n {
        // Side 1 runs corner i → hub; the triangle before it runs hub → corner i.
        let before = (i + n - 1) % n;
        join(twins, first + 3 * i as u32 + 1, first + 3 * before as u32 + 2);
    }
}

fn add_triangle(mesh: &mut IndexedMesh, twins: &mut Vec<u32>, corners: [u32; 3]) {
    mesh.triangles.push(corners);
    mesh.sources.push(u32::MAX);
    twins.extend([NO_TWIN; 3]);
}

fn join(twins: &mut [u32], g: u32, h: u32) {
    twins[g as usize] = h;
    twins[h as usize] = g;
}
