//! Non-design sets (thesis §3.4.1.1), cleaned of the specks that label noise leaves.

use nalgebra::Point3;

use super::border::{LoopFrame, border_loops};
use super::edges::Buckets;
use super::half_edge::HalfEdgeMesh;
use super::id::{FaceId, HalfEdgeId, SetId};
use super::label::Label;

/// A patch of faces is a speck when its area is below this part of the area of a typical interface
/// section. A pad that carries a strut is at least as large as the strut's section (1); a strut is
/// larger still; label noise is a few triangles (below 0.1).
const SPECK: f64 = 0.25;

/// A patch of design faces with one border, and smaller than so many times the area inside it, is a
/// part of the non-design part it lies on: a face of a pad that was not labelled has 1, the end of
/// a strut that pokes out of a pad 1 to 3. A peg one and a half radii long has 4.
const LUMP: f64 = 3.0;

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
        let mut borders = Border::all(mesh, non_design);
        let typical = typical_area(&borders);
        // Twice: a speck may hold a speck.
        for round in 0..2 {
            if round > 0 {
                borders = Border::all(mesh, non_design);
            }
            let patches = patches(mesh, non_design);
            let lumps = lumps(&borders, &patches, mesh.face_count());
            for (patch, lump) in patches.iter().zip(lumps) {
                let area: f64 = patch.iter().map(|&f| mesh.face_area(f)).sum();
                if area >= (SPECK * typical).max(lump) {
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

/// A border of the design faces.
struct Border {
    /// A design face beside it.
    face: FaceId,
    /// Area inside it, mm².
    area: f64,
}

impl Border {
    fn all(mesh: &HalfEdgeMesh, non_design: &[bool]) -> Vec<Self> {
        let is_design = |h: HalfEdgeId| !non_design[h.face().index()];
        let points = |l: &[HalfEdgeId]| -> Vec<Point3<f64>> {
            l.iter().map(|&h| mesh.position(mesh.origin(h))).collect()
        };
        border_loops(mesh, is_design)
            .iter()
            .map(|l| Self { face: l[0].face(), area: LoopFrame::of(&points(l)).area })
            .collect()
    }
}

/// The area below which each patch is a lump on the part beside it; 0 for those that have more than
/// one border or none, and for the largest patch with any.
fn lumps(borders: &[Border], patches: &[Vec<FaceId>], faces: usize) -> Vec<f64> {
    let mut patch_of_face = vec![0; faces];
    for (p, patch) in patches.iter().enumerate() {
        patch.iter().for_each(|f| patch_of_face[f.index()] = p);
    }
    let mut least = vec![0.0; patches.len()];
    let mut count = vec![0; patches.len()];
    for border in borders {
        let patch = patch_of_face[border.face.index()];
        count[patch] += 1;
        least[patch] = if count[patch] == 1 { LUMP * border.area } else { 0.0 };
    }
    let largest = (0..patches.len()).filter(|&p| count[p] > 0).max_by_key(|&p| patches[p].len());
    largest.into_iter().for_each(|p| least[p] = 0.0);
    least
}

/// The area that divides the sum of the areas inside all borders in half: many small ones of label
/// noise do not shift it.
fn typical_area(borders: &[Border]) -> f64 {
    let mut areas: Vec<f64> = borders.iter().map(|b| b.area).collect();
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
