//! Pairs the sides of triangles over their edges and turns all triangles the same way round.
//!
//! Edges with two triangles are joined first; the orientation then spreads over them. An edge with
//! four or more triangles (two bodies that touch along it, common in voxel surfaces) is cut apart
//! so that each wedge of material keeps its own two triangles.

use std::f64::consts::TAU;

use nalgebra::Point3;

use super::edges::{EdgeGroups, ends};
use super::indexed::IndexedMesh;

/// No triangle on the other side.
pub(super) const NO_TWIN: u32 = u32::MAX;

/// Half-edge pairs of a surface whose triangles agree in orientation where they are joined.
#[derive(Debug)]
pub(super) struct Pairing {
    /// Twin of each half-edge, [`NO_TWIN`] at a border.
    pub(super) twins: Vec<u32>,
    /// Triangles turned round.
    pub(super) flipped: usize,
    /// Edges with more than two triangles that were cut apart.
    pub(super) split_edges: usize,
    /// Edges that stay without a sound pairing (an odd number of triangles, or triangles that do
    /// not enclose material), with the middle of the first.
    pub(super) unsound: Option<(usize, Point3<f64>)>,
    /// Middle of the first edge over which the two triangles cannot agree (a Möbius strip).
    pub(super) one_sided: Option<Point3<f64>>,
}

/// Pairs half-edges and orients the triangles of `mesh`, flipping where neighbours disagree.
pub(super) fn pair_and_orient(mesh: &mut IndexedMesh) -> Pairing {
    let mut pairing = Pairing {
        twins: vec![NO_TWIN; 3 * mesh.triangles.len()],
        flipped: 0,
        split_edges: 0,
        unsound: None,
        one_sided: None,
    };
    let mut crowded: Vec<Vec<u32>> = Vec::new();
    EdgeGroups::new(&mesh.triangles, mesh.positions.len()).for_each(&mesh.triangles, |group| {
        match group {
            [_] => {}
            &[g, h] => join(&mut pairing.twins, g, h),
            _ => crowded.push(group.to_vec()),
        }
    });
    spread_orientation(mesh, &mut pairing, &mut crowded);
    for group in &crowded {
        split_edge(mesh, &mut pairing, group);
    }
    pairing
}

fn join(twins: &mut [u32], g: u32, h: u32) {
    twins[g as usize] = h;
    twins[h as usize] = g;
}

/// Breadth first over joined triangles; within one piece the larger part keeps its turn.
fn spread_orientation(mesh: &mut IndexedMesh, pairing: &mut Pairing, crowded: &mut [Vec<u32>]) {
    let mut turn: Vec<Option<bool>> = vec![None; mesh.triangles.len()];
    let mut flips = vec![false; mesh.triangles.len()];
    let mut piece: Vec<u32> = Vec::new();
    for seed in 0..mesh.triangles.len() {
        if turn[seed].is_some() {
            continue;
        }
        turn[seed] = Some(false);
        piece.clear();
        piece.push(seed as u32);
        let mut next = 0;
        while let Some(&f) = piece.get(next) {
            next += 1;
            for h in 3 * f..3 * f + 3 {
                let t = pairing.twins[h as usize];
                if t == NO_TWIN {
                    continue;
                }
                let agree = ends(&mesh.triangles, h).0 != ends(&mesh.triangles, t).0;
                let wanted = turn[f as usize] == Some(agree);
                match turn[t as usize / 3] {
                    None => {
                        turn[t as usize / 3] = Some(wanted);
                        piece.push(t / 3);
                    }
                    Some(found) if found != wanted && pairing.one_sided.is_none() => {
                        pairing.one_sided = Some(middle(mesh, h));
                    }
                    Some(_) => {}
                }
            }
        }
        let turned = piece.iter().filter(|&&f| turn[f as usize] == Some(true)).count();
        let majority = 2 * turned > piece.len();
        for &f in piece.iter().filter(|&&f| (turn[f as usize] == Some(true)) != majority) {
            flips[f as usize] = true;
            pairing.flipped += 1;
        }
    }
    flip(mesh, &mut pairing.twins, &flips);
    for h in crowded.iter_mut().flatten() {
        *h = after_flip(*h, &flips);
    }
}

/// Where side `h` goes when its triangle (a, b, c) becomes (a, c, b): ab ↔ ca.
fn after_flip(h: u32, flips: &[bool]) -> u32 {
    if !flips[h as usize / 3] {
        return h;
    }
    h - h % 3 + [2, 1, 0][h as usize % 3]
}

/// Turns the marked triangles round and renumbers their sides in `twins`.
pub(super) fn flip(mesh: &mut IndexedMesh, twins: &mut [u32], flips: &[bool]) {
    if !flips.contains(&true) {
        return;
    }
    for (f, t) in mesh.triangles.iter_mut().enumerate().filter(|(f, _)| flips[*f]) {
        t.swap(1, 2);
        twins.swap(3 * f, 3 * f + 2);
    }
    for t in twins.iter_mut().filter(|t| **t != NO_TWIN) {
        *t = after_flip(*t, flips);
    }
}

/// Joins the triangles round a crowded edge pairwise across the material between them.
///
/// Looking along the edge a → b, angles grow counter-clockwise. A triangle whose half-edge runs
/// a → b has its outer side towards larger angles, one that runs b → a towards smaller angles; so
/// material lies between a b → a triangle and the next a → b triangle.
fn split_edge(mesh: &IndexedMesh, pairing: &mut Pairing, group: &[u32]) {
    let (a, b) = ends(&mesh.triangles, group[0]);
    let mut round: Vec<(f64, bool, u32)> = group
        .iter()
        .map(|&h| (angle_about(mesh, a, b, h), ends(&mesh.triangles, h).0 == a, h))
        .collect();
    round.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.2.cmp(&y.2)));
    let alternate = group.len().is_multiple_of(2)
        && (0..round.len()).all(|i| round[i].1 != round[(i + 1) % round.len()].1);
    if !alternate {
        let place = middle(mesh, group[0]);
        pairing.unsound =
            Some(pairing.unsound.map_or((1, place), |(count, first)| (count + 1, first)));
        return;
    }
    pairing.split_edges += 1;
    for i in (0..round.len()).filter(|&i| !round[i].1) {
        join(&mut pairing.twins, round[i].2, round[(i + 1) % round.len()].2);
    }
}

fn angle_about(mesh: &IndexedMesh, a: u32, b: u32, h: u32) -> f64 {
    let corner = |v: u32| mesh.positions[v as usize];
    let t = mesh.triangles[h as usize / 3];
    let apex = corner(t[(h as usize + 2) % 3]);
    let axis = corner(b) - corner(a);
    // Any frame across the edge will do: only the cyclic order counts.
    let least = axis.iamin();
    let mut across = nalgebra::Vector3::zeros();
    across[least] = 1.0;
    let u = axis.cross(&across);
    let v = axis.cross(&u) / axis.norm();
    let w = apex - corner(a);
    w.dot(&v).atan2(w.dot(&u)).rem_euclid(TAU)
}

/// Middle of the edge under a half-edge.
pub(super) fn middle(mesh: &IndexedMesh, h: u32) -> Point3<f64> {
    let (a, b) = ends(&mesh.triangles, h);
    nalgebra::center(&mesh.positions[a as usize], &mesh.positions[b as usize])
}
