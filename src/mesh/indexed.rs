//! Triangles over shared points, with one label a triangle: what welding makes of a file.

use beamwright_formats::RawMesh;
use nalgebra::Point3;
use rustc_hash::FxHashMap;

/// Triangles over shared points; not yet known to be closed, oriented or manifold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IndexedMesh {
    /// Points, mm; each position occurs once.
    pub positions: Vec<Point3<f64>>,
    /// Corners of each triangle; no two are equal.
    pub triangles: Vec<[u32; 3]>,
    /// Polygon of the file each triangle was cut from (`u32::MAX`: made by a repair).
    pub sources: Vec<u32>,
}

/// What [`weld`] merged and dropped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WeldCounts {
    /// Points that repeated an earlier point.
    pub merged_points: usize,
    /// Triangles with two equal corners.
    pub degenerate: usize,
    /// Triangles that repeated an earlier one, or cancelled one with the opposite orientation.
    pub duplicate: usize,
}

/// Triangulates the polygons of a file and merges equal points.
///
/// Triangles that lose their area by it are dropped, repeated triangles are dropped, and two
/// triangles over the same corners with opposite orientation (a membrane between two bodies that
/// touch) cancel each other.
pub fn weld(raw: &RawMesh) -> (IndexedMesh, WeldCounts) {
    let cut = raw.triangulate();
    let (positions, of_point) = distinct_points(&raw.positions);
    let mut counts = WeldCounts {
        merged_points: raw.positions.len() - positions.len(),
        ..WeldCounts::default()
    };
    let mut mesh = IndexedMesh { positions, ..IndexedMesh::default() };
    mesh.triangles.reserve_exact(cut.corners.len());
    mesh.sources.reserve_exact(cut.corners.len());
    for (corners, &source) in cut.corners.iter().zip(&cut.face) {
        let corners = corners.map(|c| of_point[c as usize]);
        if has_repeated_corner(&corners) {
            counts.degenerate += 1;
        } else {
            mesh.triangles.push(corners);
            mesh.sources.push(source);
        }
    }
    counts.duplicate = mesh.drop_duplicates();
    (mesh, counts)
}

fn has_repeated_corner([a, b, c]: &[u32; 3]) -> bool {
    a == b || b == c || c == a
}

/// The distinct points in order of first occurrence, and for each point its index among them.
fn distinct_points(points: &[[f64; 3]]) -> (Vec<Point3<f64>>, Vec<u32>) {
    let mut seen: FxHashMap<[u64; 3], u32> =
        FxHashMap::with_capacity_and_hasher(points.len() / 2, Default::default());
    let mut distinct = Vec::new();
    let index = points
        .iter()
        .map(|p| {
            // −0 and 0 are the same place.
            let p = p.map(|x| x + 0.0);
            *seen.entry(p.map(f64::to_bits)).or_insert_with(|| {
                distinct.push(Point3::from(p));
                distinct.len() as u32 - 1
            })
        })
        .collect();
    (distinct, index)
}

impl IndexedMesh {
    /// Merges points by `of_point` (old index to new), then drops what lost its area.
    pub(super) fn merge_points(&mut self, of_point: &[u32], positions: Vec<Point3<f64>>) -> usize {
        self.positions = positions;
        for corner in self.triangles.iter_mut().flatten() {
            *corner = of_point[*corner as usize];
        }
        let keep: Vec<bool> = self.triangles.iter().map(|t| !has_repeated_corner(t)).collect();
        self.retain(&keep)
    }

    /// Keeps the triangles marked true; the number of those dropped.
    fn retain(&mut self, keep: &[bool]) -> usize {
        let before = self.triangles.len();
        let mut marks = keep.iter();
        self.triangles.retain(|_| *marks.next().unwrap_or(&true));
        let mut marks = keep.iter();
        self.sources.retain(|_| *marks.next().unwrap_or(&true));
        before - self.triangles.len()
    }

    /// Drops repeated triangles and cancels opposite ones; the number dropped.
    pub(super) fn drop_duplicates(&mut self) -> usize {
        let mut by_lowest = super::edges::Buckets::new(self.positions.len());
        for t in &self.triangles {
            by_lowest.count(lowest(t));
        }
        by_lowest.finish_counting();
        for (i, t) in self.triangles.iter().enumerate() {
            by_lowest.put(lowest(t), i as u32);
        }
        let mut keep = vec![true; self.triangles.len()];
        for faces in by_lowest.iter() {
            for (i, &f) in faces.iter().enumerate() {
                let twice = faces[..i]
                    .iter()
                    .rev()
                    .find(|&&g| keep[g as usize] && same_corners(&self.at(f), &self.at(g)));
                if let Some(&g) = twice {
                    keep[f as usize] = false;
                    if is_even_turn(&self.at(f)) != is_even_turn(&self.at(g)) {
                        keep[g as usize] = false;
                    }
                }
            }
        }
        self.retain(&keep)
    }

    fn at(&self, face: u32) -> [u32; 3] {
        self.triangles[face as usize]
    }
}

fn lowest(t: &[u32; 3]) -> usize {
    t[0].min(t[1]).min(t[2]) as usize
}

fn same_corners(s: &[u32; 3], t: &[u32; 3]) -> bool {
    s.iter().all(|v| t.contains(v))
}

/// Whether the corners, begun at the lowest, ascend.
fn is_even_turn(t: &[u32; 3]) -> bool {
    let k = (0..3).min_by_key(|&k| t[k]).unwrap_or(0);
    t[(k + 1) % 3] < t[(k + 2) % 3]
}

#[cfg(test)]
mod tests {
    use super::*;
    use beamwright_formats::Polygons;

    fn raw(positions: &[[f64; 3]], faces: &[&[u32]]) -> RawMesh {
        let mut polygons = Polygons::default();
        for f in faces {
            polygons.push(f.iter().copied());
        }
        RawMesh { positions: positions.to_vec(), faces: polygons, ..RawMesh::default() }
    }

    const SQUARE: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];

    #[test]
    fn equal_points_become_one() {
        let twice: Vec<[f64; 3]> = SQUARE.iter().chain(&SQUARE).copied().collect();
        let (mesh, counts) = weld(&raw(&twice, &[&[0, 1, 2], &[4, 6, 7]]));
        assert_eq!(mesh.positions.len(), 4);
        assert_eq!(counts.merged_points, 4);
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn minus_zero_is_zero() {
        let (mesh, _) = weld(&raw(
            &[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [-0.0, 0., -0.0], [0., 0., 1.]],
            &[&[0, 1, 2], &[3, 2, 4]],
        ));
        assert_eq!(mesh.positions.len(), 4);
    }

    #[test]
    fn a_repeated_triangle_stays_once_and_a_membrane_vanishes() {
        let (mesh, counts) = weld(&raw(&SQUARE, &[&[0, 1, 2], &[1, 2, 0], &[0, 2, 3], &[3, 2, 0]]));
        assert_eq!(mesh.triangles, [[0, 1, 2]]);
        assert_eq!(counts.duplicate, 3);
    }
}
