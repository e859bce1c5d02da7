//! Fewer triangles to look at: corners in one cell of a grid become one.

use nalgebra::{Point3, Vector3};
use rustc_hash::FxHashMap;

use crate::mesh::Surface;

/// Triangles to look at; each says whether it is design.
pub(super) struct Shown {
    pub(super) points: Vec<Point3<f64>>,
    pub(super) triangles: Vec<([u32; 3], bool)>,
}

/// Growth of the cells from one try to the next: a fifth overshoots the limit by two fifths at most.
const GROWTH: f64 = 1.2;

impl Shown {
    /// All triangles of a surface.
    pub(super) fn of(surface: &Surface) -> Self {
        let labels = surface.labels.of_face.iter().map(|l| l.is_design());
        let triangles = surface.mesh.triangles().iter().copied().zip(labels).collect();
        Self { points: surface.mesh.positions().to_vec(), triangles }
    }

    /// Merges corners until no more than `most` triangles are left; unchanged when there are no
    /// more to begin with.
    pub(super) fn reduced(self, most: usize) -> Self {
        let (low, high) = super::view::bounds(&self.points);
        // A surface of n triangles crosses about n / 2 cells.
        let mut cell = (high - low).norm() / (most as f64).sqrt().max(1.0);
        let mut shown = self.points.len();
        let mut result = None;
        while result.as_ref().map_or(self.triangles.len(), |r: &Self| r.triangles.len()) > most
            && shown > 0
            && cell.is_finite()
        {
            let clustered = self.clustered(&low, cell);
            shown = clustered.points.len();
            result = Some(clustered);
            cell *= GROWTH;
        }
        result.unwrap_or(self)
    }

    fn clustered(&self, low: &Point3<f64>, cell: f64) -> Self {
        let mut cells: FxHashMap<[i64; 3], u32> = FxHashMap::default();
        let mut sums: Vec<(Vector3<f64>, f64)> = Vec::new();
        let of_point: Vec<u32> = self
            .points
            .iter()
            .map(|p| {
                let key = std::array::from_fn(|k| ((p[k] - low[k]) / cell).floor() as i64);
                let index = *cells.entry(key).or_insert_with(|| {
                    sums.push((Vector3::zeros(), 0.0));
                    sums.len() as u32 - 1
                });
                let sum = &mut sums[index as usize];
                *sum = (sum.0 + p.coords, sum.1 + 1.0);
                index
            })
            .collect();
        let triangles = self
            .triangles
            .iter()
            .map(|(t, label)| (t.map(|v| of_point[v as usize]), *label))
            .filter(|([a, b, c], _)| a != b && b != c && c != a)
            .collect();
        Self { points: sums.into_iter().map(|(s, n)| Point3::from(s / n)).collect(), triangles }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of 2 n² triangles.
    fn square(n: u32) -> Shown {
        let at = |x: u32, y: u32| y * (n + 1) + x;
        let points = (0..=n).flat_map(|y| (0..=n).map(move |x| (x, y)));
        let cells = (0..n).flat_map(|y| (0..n).map(move |x| (x, y)));
        Shown {
            points: points.map(|(x, y)| Point3::new(f64::from(x), f64::from(y), 0.0)).collect(),
            triangles: cells
                .flat_map(|(x, y)| {
                    let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
                    [([a, b, c], true), ([a, c, d], true)]
                })
                .collect(),
        }
    }

    #[test]
    fn a_surface_below_the_limit_stays_as_it_is() {
        let shown = square(10).reduced(200);
        assert_eq!((shown.points.len(), shown.triangles.len()), (121, 200));
    }

    #[test]
    fn a_surface_above_it_comes_below_but_not_far() {
        let shown = square(100).reduced(5000);
        assert!((1000..=5000).contains(&shown.triangles.len()), "{}", shown.triangles.len());
    }
}
