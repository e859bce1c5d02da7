//! Non-design sets (thesis §3.4.1.1), cleaned of the specks that label noise leaves.

use super::edges::Buckets;
use super::half_edge::HalfEdgeMesh;
use super::id::{FaceId, HalfEdgeId, SetId};
use super::interface_section::{LoopFrame, border_loops};
use super::label::Label;

/// A patch of faces is a speck when its area is below this part of the area of a typical interface
/// section. A pad that carries a strut is at least as large as the strut's section (1); a strut is
/// larger still; label noise is a few triangles (below 0.1).
const SPECK: f64 = 0.25;

/// The labels of all faces and what was cleaned.
#[derive(Clone, Debug, Default)]
pub struct Labels {
    /// Label of each face.
    pub of_face: Vec<Label>,
    /// Number of non-design sets.
    pub sets: usize,
    /// Specks of design inside non-design parts, given to the part.
    pub design_specks: usize,
    /// Specks of non-design on the design part, given to the design part.
    pub non_design_specks: usize,
}

impl Labels {
    /// Whether a face could be shaped.
    pub fn is_design(&self, face: FaceId) -> bool {
        self.of_face[face.index()].is_design()
    }

    /// Gathers non-design faces that share a node into sets; swaps the labels of specks first.
    pub(super) fn new(mesh: &HalfEdgeMesh, mut non_design: Vec<bool>) -> Self {
        let mut labels = Self::default();
        if non_design.contains(&true) {
            labels.clean(mesh, &mut non_design);
        }
        labels.number_sets(mesh, &non_design);
        labels
    }

    fn clean(&mut self, mesh: &HalfEdgeMesh, non_design: &mut [bool]) {
        let typical = typical_loop_area(mesh, non_design);
        // Twice: a speck may hold a speck.
        for _ in 0..2 {
            for patch in patches(mesh, non_design) {
                let area: f64 = patch.iter().map(|&f| mesh.face_area(f)).sum();
                if area >= SPECK * typical {
                    continue;
                }
                let was_design = !non_design[patch[0].index()];
                *(if was_design {
                    &mut self.design_specks
                } else {
                    &mut self.non_design_specks
                }) += 1;
                patch.iter().for_each(|f| non_design[f.index()] = was_design);
            }
        }
    }

    fn number_sets(&mut self, mesh: &HalfEdgeMesh, non_design: &[bool]) {
        self.of_face = vec![Label::Design; mesh.face_count()];
        let faces_at = faces_at_vertices(mesh);
        let mut seen_vertex = vec![false; mesh.positions().len()];
        for seed in mesh.faces().filter(|f| non_design[f.index()]) {
            if !self.is_design(seed) {
                continue;
            }
            let set = SetId::new(self.sets);
            self.sets += 1;
            let mut stack = vec![seed];
            self.of_face[seed.index()] = Label::NonDesign(set);
            while let Some(face) = stack.pop() {
                for v in mesh.triangles()[face.index()] {
                    if std::mem::replace(&mut seen_vertex[v as usize], true) {
                        continue;
                    }
                    for &next in faces_at.bucket(v as usize) {
                        let next = FaceId(next);
                        if non_design[next.index()] && self.is_design(next) {
                            self.of_face[next.index()] = Label::NonDesign(set);
                            stack.push(next);
                        }
                    }
                }
            }
        }
    }
}

fn faces_at_vertices(mesh: &HalfEdgeMesh) -> Buckets {
    let mut at = Buckets::new(mesh.positions().len());
    mesh.triangles().iter().flatten().for_each(|&v| at.count(v as usize));
    at.finish_counting();
    for (f, t) in mesh.triangles().iter().enumerate() {
        t.iter().for_each(|&v| at.put(v as usize, f as u32));
    }
    at
}

/// Patches of equal label, connected over edges.
fn patches(mesh: &HalfEdgeMesh, non_design: &[bool]) -> Vec<Vec<FaceId>> {
    let mut seen = vec![false; mesh.face_count()];
    let mut found = Vec::new();
    for seed in mesh.faces() {
        if std::mem::replace(&mut seen[seed.index()], true) {
            continue;
        }
        let mut patch = vec![seed];
        let mut next = 0;
        while let Some(&face) = patch.get(next) {
            next += 1;
            for g in face.half_edges().map(|h| mesh.neighbour(h)) {
                if non_design[g.index()] == non_design[seed.index()] && !seen[g.index()] {
                    seen[g.index()] = true;
                    patch.push(g);
                }
            }
        }
        found.push(patch);
    }
    found
}

/// The loop area that divides the sum of all loop areas in half: many small loops of label noise
/// do not shift it.
fn typical_loop_area(mesh: &HalfEdgeMesh, non_design: &[bool]) -> f64 {
    let is_design = |h: HalfEdgeId| !non_design[h.face().index()];
    let mut areas: Vec<f64> = border_loops(mesh, is_design)
        .iter()
        .map(|l| {
            LoopFrame::of(&l.iter().map(|&h| mesh.position(mesh.origin(h))).collect::<Vec<_>>())
                .area
        })
        .collect();
    areas.sort_by(f64::total_cmp);
    let half = areas.iter().sum::<f64>() / 2.0;
    let mut sum = 0.0;
    areas
        .into_iter()
        .find(|a| {
            sum += a;
            sum >= half
        })
        .unwrap_or(0.0)
}
