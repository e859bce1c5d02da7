//! Gives every fan of triangles its own vertex, so that no two fans share one.

use super::indexed::IndexedMesh;

/// Splits the vertices at which separate fans touch; the number of vertices made.
///
/// All half-edges must have twins.
pub(super) fn split_shared_vertices(mesh: &mut IndexedMesh, twins: &[u32]) -> usize {
    let before = mesh.positions.len();
    let mut seen_corner = vec![false; 3 * mesh.triangles.len()];
    let mut owned = vec![false; mesh.positions.len()];
    for h in 0..twins.len() as u32 {
        if seen_corner[h as usize] {
            continue;
        }
        let v = mesh.triangles[h as usize / 3][h as usize % 3];
        let fan_vertex = if std::mem::replace(&mut owned[v as usize], true) {
            mesh.positions.push(mesh.positions[v as usize]);
            mesh.positions.len() as u32 - 1
        } else {
            v
        };
        let mut at = h;
        while !std::mem::replace(&mut seen_corner[at as usize], true) {
            mesh.triangles[at as usize / 3][at as usize % 3] = fan_vertex;
            at = twins[previous(at) as usize];
        }
    }
    mesh.positions.len() - before
}

fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

/// Drops the points no triangle uses; the number dropped.
pub(super) fn drop_unused_points(mesh: &mut IndexedMesh) -> usize {
    let mut new_index = vec![u32::MAX; mesh.positions.len()];
    for &v in mesh.triangles.iter().flatten() {
        new_index[v as usize] = 0;
    }
    let before = mesh.positions.len();
    let mut kept = 0u32;
    let mut index = 0;
    mesh.positions.retain(|_| {
        let used = new_index[index] == 0;
        if used {
            new_index[index] = kept;
            kept += 1;
        }
        index += 1;
        used
    });
    for v in mesh.triangles.iter_mut().flatten() {
        *v = new_index[*v as usize];
    }
    before - mesh.positions.len()
}
