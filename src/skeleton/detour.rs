//! A way through the material where the straight one leaves it: steps on a lattice.
//!
//! ```text
//!    a ●╮   · · ·           the lattice is laid along a → b; steps that cross the surface are
//!    ▒▒▒╰▫─▫╮ · ·           not made, so every place reached lies inside
//!      hole ▒▫ · ·          ● ends   ▫ steps taken
//!    ▒▒▒▒▒▒▒▒╰─● b
//! ```
//!
//! The search is A*: it ends with the shortest way on the lattice, or says that there is none
//! within reach. Corners of the way that are not needed are left out.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use nalgebra::{Point3, Vector3};
use rustc_hash::FxHashMap;

use super::error::SkeletonError;
use super::watch::Watch;
use crate::mesh::id::FaceId;
use crate::mesh::{HalfEdgeMesh, TriangleTree};
use crate::observer::Observer;

/// Lattice steps from end to end, coarse first: walls thinner than a fortieth of the way are not
/// followed, and a finer lattice costs eight times as much.
const FINENESS: [f64; 3] = [10.0, 20.0, 40.0];

/// Places looked at on one lattice; enough to fill the ball about the finest one's ends.
const PLACES: usize = 60_000;

/// Points between `a` and `b` over which the way does not cross the surface; none where one of the two
/// lies outside, as on meshes that cross themselves.
pub(super) fn detour(
    mesh: &HalfEdgeMesh,
    tree: &TriangleTree,
    [a, b]: [&Point3<f64>; 2],
    watch: &mut Watch<'_, impl Observer>,
) -> Result<Option<Vec<Point3<f64>>>, SkeletonError> {
    if !(tree.contains(a) && tree.contains(b)) {
        return Ok(None);
    }
    let Some(axes) = axes(mesh, tree, a, b) else { return Ok(None) };
    for n in FINENESS {
        if let Some(way) = (Lattice { tree, a, b, axes: axes / n }).way(watch)? {
            return Ok(Some(without_idle_corners(tree, &way)));
        }
    }
    Ok(None)
}

/// Right-angled axes as long as the way, tied to the part so that they turn with it.
fn axes(
    mesh: &HalfEdgeMesh,
    tree: &TriangleTree,
    a: &Point3<f64>,
    b: &Point3<f64>,
) -> Option<nalgebra::Matrix3<f64>> {
    let along = (b - a).try_normalize(0.0)?;
    let (_, _, face) = tree.nearest(a)?;
    let across = mesh
        .corners(FaceId(face))
        .map(|corner| (corner - a).cross(&along))
        .into_iter()
        .max_by(|v, w| v.norm_squared().total_cmp(&w.norm_squared()))?
        .try_normalize(0.0)?;
    Some(nalgebra::Matrix3::from_columns(&[along, across, along.cross(&across)]) * (b - a).norm())
}

type Cell = [i32; 3];

/// Places at whole steps from `a`.
struct Lattice<'a> {
    tree: &'a TriangleTree,
    a: &'a Point3<f64>,
    b: &'a Point3<f64>,
    axes: nalgebra::Matrix3<f64>,
}

impl Lattice<'_> {
    fn place(&self, [i, j, k]: Cell) -> Point3<f64> {
        self.a + self.axes * Vector3::new(i.into(), j.into(), k.into())
    }

    /// Way still to go, in steps.
    fn left(&self, cell: Cell) -> f64 {
        (self.b - self.place(cell)).norm() / self.axes.column(0).norm()
    }

    fn way(
        &self,
        watch: &mut Watch<'_, impl Observer>,
    ) -> Result<Option<Vec<Point3<f64>>>, SkeletonError> {
        let mut best: FxHashMap<Cell, (u32, Cell)> = FxHashMap::default();
        let most = PLACES.min(watch.places_left);
        let last = self.search(&mut best, most, watch)?;
        watch.places_left = watch.places_left.saturating_sub(best.len());
        Ok(last.map(|cell| self.traced(&best, cell)))
    }

    /// The place from which `b` is seen, once it is reached; `best` has the way there.
    fn search(
        &self,
        best: &mut FxHashMap<Cell, (u32, Cell)>,
        most: usize,
        watch: &mut Watch<'_, impl Observer>,
    ) -> Result<Option<Cell>, SkeletonError> {
        let start = [0; 3];
        let mut open = BinaryHeap::new();
        best.insert(start, (0, start));
        open.push(Reverse((rank(self.left(start)), 0, start)));
        let mut looked = 0;
        while let Some(Reverse((_, steps, cell))) = open.pop() {
            watch.keep_on()?;
            watch.looks_left = watch.looks_left.saturating_sub(std::mem::take(&mut looked));
            if best[&cell].0 < steps {
                continue;
            }
            let here = self.place(cell);
            if self.left(cell) < 2.0 && !self.tree.is_crossed_by(&here, self.b) {
                return Ok(Some(cell));
            }
            if best.len() > most || watch.looks_left == 0 {
                return Ok(None);
            }
            for next in neighbours(cell) {
                if best.get(&next).is_some_and(|(s, _)| *s <= steps + 1) {
                    continue;
                }
                let there = self.place(next);
                if self.tree.first_crossing_counted(&here, &there, &mut looked).is_some() {
                    continue;
                }
                best.insert(next, (steps + 1, cell));
                let rank = rank(f64::from(steps + 1) + self.left(next));
                open.push(Reverse((rank, steps + 1, next)));
            }
        }
        Ok(None)
    }

    /// The way from `a` to `b` over `cell`, both ends included.
    fn traced(&self, best: &FxHashMap<Cell, (u32, Cell)>, mut cell: Cell) -> Vec<Point3<f64>> {
        let mut way = vec![*self.b];
        while cell != [0; 3] {
            way.push(self.place(cell));
            cell = best[&cell].1;
        }
        way.push(*self.a);
        way.reverse();
        way
    }
}

/// Order of a length in steps; a thousandth decides.
fn rank(steps: f64) -> u64 {
    (steps * 1e3) as u64
}

fn neighbours([i, j, k]: Cell) -> [Cell; 6] {
    [[i + 1, j, k], [i, j + 1, k], [i, j - 1, k], [i, j, k + 1], [i, j, k - 1], [i - 1, j, k]]
}

/// The corners of a way without its ends and without those that can be cut off inside.
fn without_idle_corners(tree: &TriangleTree, way: &[Point3<f64>]) -> Vec<Point3<f64>> {
    let mut kept = Vec::new();
    let mut at = 0;
    loop {
        let seen = (at + 2..way.len()).rev().find(|&k| !tree.is_crossed_by(&way[at], &way[k]));
        at = seen.unwrap_or(at + 1);
        if at + 1 >= way.len() {
            return kept;
        }
        kept.push(way[at]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LabelParams, prepare};
    use beamwright_formats::{Polygons, RawMesh};

    /// A square frame of 10 mm with bars of 2 mm, around a square opening.
    fn square_frame() -> RawMesh {
        let mut positions = Vec::new();
        for z in [0.0, 2.0] {
            for half in [3.0, 5.0] {
                for [x, y] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
                    positions.push([half * x, half * y, z]);
                }
            }
        }
        let mut faces = Polygons::default();
        let mut quad = |a: u32, b: u32, c: u32, d: u32| {
            faces.push([a, b, c]);
            faces.push([a, c, d]);
        };
        for k in 0..4 {
            let n = (k + 1) % 4;
            quad(4 + k, 4 + n, 12 + n, 12 + k); // outer
            quad(n, k, 8 + k, 8 + n); // inner
            quad(8 + k, 12 + k, 12 + n, 8 + n); // top
            quad(k, n, 4 + n, 4 + k); // bottom
        }
        RawMesh { positions, faces, ..RawMesh::default() }
    }

    #[test]
    fn a_way_is_found_round_an_opening() {
        let surface = prepare(&square_frame(), &LabelParams::default()).expect("a closed mesh");
        let (a, b) = (Point3::new(-4.0, 0.0, 1.0), Point3::new(4.0, 0.2, 1.0));
        let way = detour(&surface.mesh, &surface.tree, [&a, &b], &mut Watch::new(&mut ()))
            .expect("nobody stops it")
            .expect("a way");
        let all: Vec<Point3<f64>> = std::iter::once(a).chain(way).chain([b]).collect();
        assert!(all.len() >= 4, "two corners at least: {all:?}");
        assert!(all.windows(2).all(|w| !surface.tree.is_crossed_by(&w[0], &w[1])));
    }
}
