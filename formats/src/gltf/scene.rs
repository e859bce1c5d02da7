//! The tree of nodes: which mesh stands where, and how often.

use std::path::Path;

use gltf::scene::Transform;
use gltf::{Document, Mesh, Node};

use super::malformed;
use crate::error::ReadError;

/// Most nodes above a mesh whose names its faces get, the nearest ones.
///
/// A made-up chain of nodes would otherwise give each of its meshes the names of all above it.
const MOST_NAMES_ABOVE: usize = 16;

/// A mesh at its place.
pub(super) struct Instance<'d> {
    /// The mesh.
    pub(super) mesh: Mesh<'d>,
    /// From the mesh to the scene, Z up.
    pub(super) placement: Placement,
    /// Names of the node and of those above it.
    pub(super) names: Vec<&'d str>,
}

/// Calls `take` for each mesh of the scene, in the order of the tree.
///
/// The scene is the one the file names, else its first, else all nodes; a file without nodes is a
/// collection of meshes, and each of them is taken once.
pub(super) fn walk<'d>(
    document: &'d Document,
    path: &Path,
    mut take: impl FnMut(Instance<'d>) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    if document.nodes().len() == 0 {
        for mesh in document.meshes() {
            take(Instance { mesh, placement: Placement::Z_UP, names: Vec::new() })?;
        }
        return Ok(());
    }
    // Marked before they are put on the stack, which thus never holds a node twice.
    let mut seen = vec![false; document.nodes().len()];
    let mut mark = |node: &Node<'_>| {
        let was_seen = std::mem::replace(&mut seen[node.index()], true);
        if was_seen { Err(met_twice(node, path)) } else { Ok(()) }
    };
    let mut names_above = Vec::new();
    let mut open = Vec::new();
    for root in roots(document, path)? {
        mark(&root)?;
        open.push((root, Placement::Z_UP, 0));
    }
    open.reverse();
    while let Some((node, above, depth)) = open.pop() {
        names_above.truncate(depth);
        names_above.push(node.name().unwrap_or_default());
        let placement = above.then(&Placement::of(&node.transform()));
        if let Some(mesh) = node.mesh() {
            let names = names_above.iter().rev().take(MOST_NAMES_ABOVE + 1).copied().collect();
            take(Instance { mesh, placement, names })?;
        }
        let children = open.len();
        for child in node.children() {
            mark(&child)?;
            open.push((child, placement, depth + 1));
        }
        open[children..].reverse();
    }
    Ok(())
}

fn roots<'d>(document: &'d Document, path: &Path) -> Result<Vec<Node<'d>>, ReadError> {
    if let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) {
        // One more than there are nodes is enough to find one of them twice.
        return Ok(scene.nodes().take(document.nodes().len() + 1).collect());
    }
    let mut is_child = vec![false; document.nodes().len()];
    for child in document.nodes().flat_map(|node| node.children()) {
        is_child[child.index()] = true;
    }
    let roots: Vec<_> = document.nodes().filter(|node| !is_child[node.index()]).collect();
    match document.nodes().next() {
        Some(node) if roots.is_empty() => Err(met_twice(&node, path)),
        _ => Ok(roots),
    }
}

fn met_twice(node: &Node<'_>, path: &Path) -> ReadError {
    let part = format!("nodes[{}]", node.index());
    malformed(
        path,
        part,
        "a node that is the child of one other at most",
        "one of several, or of itself",
    )
}

/// A linear map and a move: rows of a 3 × 4 matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placement {
    rows: [[f64; 4]; 3],
}

impl Placement {
    /// From Y up to Z up: (x, y, z) → (x, −z, y), right-handed as before.
    pub(super) const Z_UP: Self =
        Self { rows: [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0]] };

    fn of(transform: &Transform) -> Self {
        match *transform {
            Transform::Matrix { matrix } => {
                let row = |row: usize| [0, 1, 2, 3].map(|column| f64::from(matrix[column][row]));
                Self { rows: [row(0), row(1), row(2)] }
            }
            Transform::Decomposed { translation, rotation, scale } => {
                let turn = rotation_rows(rotation.map(f64::from));
                let row = |row: usize| {
                    let [x, y, z] = [0, 1, 2].map(|axis| turn[row][axis] * f64::from(scale[axis]));
                    [x, y, z, f64::from(translation[row])]
                };
                Self { rows: [row(0), row(1), row(2)] }
            }
        }
    }

    /// What `inner` does, and then this.
    fn then(&self, inner: &Self) -> Self {
        let rows = self.rows.map(|[a, b, c, d]| {
            let [i, j, k] = inner.rows;
            let mut row = [0, 1, 2, 3].map(|column| a * i[column] + b * j[column] + c * k[column]);
            row[3] += d;
            row
        });
        Self { rows }
    }

    /// Where a point goes.
    #[inline]
    pub(super) fn apply(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.rows.map(|[a, b, c, d]| a * x + b * y + c * z + d)
    }

    /// Whether left becomes right: the determinant is negative.
    pub(super) fn mirrors(&self) -> bool {
        let [[a, b, c, _], [d, e, f, _], [g, h, i, _]] = self.rows;
        a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0
    }
}

/// The matrix of a quaternion x, y, z, w of any length; no turn if it has none.
fn rotation_rows([x, y, z, w]: [f64; 4]) -> [[f64; 3]; 3] {
    let square = x * x + y * y + z * z + w * w;
    let s = if square > 0.0 { 2.0 / square } else { 0.0 };
    [
        [1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
        [s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)],
        [s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn y_up_becomes_z_up_without_mirroring() {
        assert_eq!(Placement::Z_UP.apply([1.0, 2.0, 3.0]), [1.0, -3.0, 2.0]);
        assert!(!Placement::Z_UP.mirrors());
    }

    #[test]
    fn parts_of_a_transform_act_as_their_matrix() {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let parts = Transform::Decomposed {
            translation: [1.0, 2.0, 3.0],
            rotation: [0.0, 0.0, half, half],
            scale: [2.0, 1.0, -1.0],
        };
        let (from_parts, from_matrix) =
            (Placement::of(&parts), Placement::of(&Transform::Matrix { matrix: parts.matrix() }));
        let p = [0.3, -0.7, 1.1];
        for (a, b) in from_parts.apply(p).into_iter().zip(from_matrix.apply(p)) {
            assert!((a - b).abs() < 1e-6, "{from_parts:?} {from_matrix:?}");
        }
        assert!(from_parts.mirrors());
        assert!(!from_parts.then(&from_parts).mirrors());
    }

    #[test]
    fn a_quaternion_of_no_length_does_not_turn() {
        assert_eq!(rotation_rows([0.0; 4]), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    }
}
