//! Triangles cut into regions by the chords of contours.
//!
//! ```text
//!        w
//!       ╱ ╲         A contour crosses two sides of a triangle; its chord parts the triangle. Every
//!    1 ╱───╲ 1      side is cut into parts, numbered along it. Going round the triangle, parts that
//!     ╱  0  ╲       no chord separates belong to one region.
//!    u───────v
//! ```

use std::ops::Range;

use crate::mesh::HalfEdgeMesh;
use crate::mesh::contour::Contour;
use crate::mesh::id::{FaceId, HalfEdgeId};

/// Disjoint sets with path halving.
#[derive(Default)]
pub(super) struct Joined(Vec<u32>);

impl Joined {
    pub(super) fn new(count: u32) -> Self {
        Self((0..count).collect())
    }

    pub(super) fn root(&mut self, mut x: u32) -> u32 {
        while self.0[x as usize] != x {
            self.0[x as usize] = self.0[self.0[x as usize] as usize];
            x = self.0[x as usize];
        }
        x
    }

    pub(super) fn join(&mut self, x: u32, y: u32) {
        let (x, y) = (self.root(x), self.root(y));
        // The smaller index stays the root, so that results do not depend on the order.
        self.0[x.max(y) as usize] = x.min(y);
    }
}

/// Where a contour crosses an edge: how far along it, and which point of which contour.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CrossingPoint {
    /// The lower half-edge of the edge.
    low: HalfEdgeId,
    /// Way from the origin of that half-edge, mm.
    along: f64,
    cut: u32,
    index: u32,
}

/// A triangle cut by chords.
pub(super) struct CutFace {
    pub(super) face: FaceId,
    /// The first part of each side, going round.
    first_part: [usize; 3],
    region_of_part: Vec<u32>,
    /// All its regions.
    pub(super) regions: Range<u32>,
}

impl CutFace {
    /// The regions along the parts of a side, in its direction.
    pub(super) fn along(&self, side: HalfEdgeId) -> &[u32] {
        let k = side.index() % 3;
        let end = self.first_part.get(k + 1).copied().unwrap_or(self.region_of_part.len());
        &self.region_of_part[self.first_part[k]..end]
    }
}

/// All triangles that contours cross.
pub(super) struct Cutting {
    /// All crossings, by edge and in the order along it.
    crossings: Vec<CrossingPoint>,
    /// The cut triangles, in ascending order.
    pub(super) faces: Vec<CutFace>,
}

/// A chord: from point `index` of contour `cut` to the next, across a triangle.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Chord {
    face: FaceId,
    cut: u32,
    index: u32,
}

impl Cutting {
    pub(super) fn new(mesh: &HalfEdgeMesh, cuts: &[&Contour]) -> Self {
        let mut cutting = Self { crossings: Vec::new(), faces: Vec::new() };
        let mut chords: Vec<Chord> = Vec::new();
        for (cut, contour) in (0..).zip(cuts) {
            for ((index, &h), p) in (0..).zip(&contour.half_edges).zip(&contour.points) {
                let low = h.min(mesh.twin(h));
                let along = (p - mesh.position(mesh.origin(low))).norm();
                cutting.crossings.push(CrossingPoint { low, along, cut, index });
                chords.push(Chord { face: h.face(), cut, index });
            }
        }
        cutting.crossings.sort_by(|a, b| a.low.cmp(&b.low).then(a.along.total_cmp(&b.along)));
        chords.sort_unstable();
        for chords in chords.chunk_by(|a, b| a.face == b.face) {
            cutting.add_face(mesh, cuts, chords);
        }
        cutting
    }

    /// Cuts a triangle by its chords.
    fn add_face(&mut self, mesh: &HalfEdgeMesh, cuts: &[&Contour], chords: &[Chord]) {
        let face = chords[0].face;
        let mut first_part = [0; 3];
        let mut crossings: Vec<(u32, u32, usize)> = Vec::new();
        let mut parts = 0;
        for (s, h) in face.half_edges().into_iter().enumerate() {
            first_part[s] = parts;
            for point in self.crossings(mesh, h) {
                crossings.push((point.cut, point.index, parts));
                parts += 1;
            }
            parts += 1;
        }
        let mut local = Joined::new(parts as u32);
        // A corner does not part the side that ends in it from the one that begins.
        for s in 0..3 {
            let last = if s == 2 { parts - 1 } else { first_part[s + 1] - 1 };
            local.join(last as u32, first_part[(s + 1) % 3] as u32);
        }
        let before = |cut: u32, index: u32| {
            crossings.iter().find(|c| c.0 == cut && c.1 == index).map(|c| c.2 as u32)
        };
        for &Chord { cut, index, .. } in chords {
            let n = cuts[cut as usize].points.len() as u32;
            if let (Some(a), Some(b)) = (before(cut, index), before(cut, (index + 1) % n)) {
                local.join(a + 1, b);
                local.join(a, b + 1);
            }
        }
        let first = self.faces.last().map_or(0, |last| last.regions.end);
        let mut roots: Vec<u32> = Vec::new();
        let region_of_part = (0..parts as u32)
            .map(|part| {
                let root = local.root(part);
                let known = roots.iter().position(|r| *r == root);
                let at = known.unwrap_or_else(|| {
                    roots.push(root);
                    roots.len() - 1
                });
                first + at as u32
            })
            .collect();
        let regions = first..first + roots.len() as u32;
        self.faces.push(CutFace { face, first_part, region_of_part, regions });
    }

    /// Crossings of a side in its own direction.
    fn crossings(
        &self,
        mesh: &HalfEdgeMesh,
        h: HalfEdgeId,
    ) -> impl Iterator<Item = &CrossingPoint> {
        let twin = mesh.twin(h);
        let low = h.min(twin);
        let from = self.crossings.partition_point(|p| p.low < low);
        let count = self.crossings[from..].iter().take_while(|p| p.low == low).count();
        let of_edge = &self.crossings[from..from + count];
        (0..count).map(move |i| &of_edge[if twin < h { count - 1 - i } else { i }])
    }

    /// The regions above and below the first point of a cut.
    pub(super) fn sides_of_cut(
        &self,
        mesh: &HalfEdgeMesh,
        contour: &Contour,
        cut: usize,
    ) -> Option<[u32; 2]> {
        let h = contour.half_edges[0];
        let is_first = |p: &CrossingPoint| p.cut == cut as u32 && p.index == 0;
        let rank = self.crossings(mesh, h).position(is_first)?;
        let at = self.faces.binary_search_by_key(&h.face(), |f| f.face).ok()?;
        let regions = self.faces[at].along(h);
        Some([regions[rank], regions[rank + 1]])
    }
}
