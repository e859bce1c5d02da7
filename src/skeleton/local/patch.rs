//! What the surface falls into when it is cut along one contour of every tube.
//!
//! Each piece, closed over its cuts and its interface sections, is a sphere or a sphere with
//! handles. Where every piece is a sphere, the graph of pieces and tubes has exactly the tunnels of
//! the design part (thesis: the skeleton is homotopic to the object). A piece with a handle hides a
//! tube that has not been found.
//!
//! The pieces are counted exactly: triangles are cut into regions by the chords of the contours,
//! regions are joined over the parts of their sides, and each piece gets its Euler characteristic
//! χ = V − E + F without its border. With b borders its genus is (2 − b − χ) / 2.

use rustc_hash::FxHashMap;

use crate::mesh::contour::Contour;
use crate::mesh::id::{FaceId, HalfEdgeId};
use crate::mesh::{HalfEdgeMesh, InterfaceSection};

/// Which side of a cut: the one the plane's normal points away from, or to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CutSide {
    Below,
    Above,
}

/// A connected piece of the cut surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Patch {
    /// Sides of cuts that border the piece.
    pub(crate) cuts: Vec<(usize, CutSide)>,
    /// Interface sections that border it.
    pub(crate) interfaces: Vec<usize>,
    /// Handles.
    pub(crate) genus: usize,
}

/// The pieces and the piece each face belongs to (a cut face: one of its regions).
#[derive(Clone, Debug)]
pub(crate) struct Patches {
    pub(crate) all: Vec<Patch>,
    /// Piece of each face that is not cut; `None` for cut and non-design faces.
    pub(crate) of_face: Vec<Option<u32>>,
}

/// Cuts the design faces along disjoint contours.
pub(crate) fn patches(
    mesh: &HalfEdgeMesh,
    is_design: impl Fn(FaceId) -> bool,
    cuts: &[&Contour],
    interfaces: &[InterfaceSection],
) -> Patches {
    let cutting = Cutting::new(mesh, cuts);
    let mut joined = Joined::new(cutting.regions);
    for f in mesh.faces().filter(|f| is_design(*f)) {
        let is_whole = cutting.cut_face(f).is_none();
        for h in f.half_edges() {
            let t = mesh.twin(h);
            if h > t || !is_design(t.face()) {
                continue;
            }
            if is_whole {
                joined.join(f.0, cutting.region(t, 0));
                continue;
            }
            for part in 0..cutting.parts(mesh, h) {
                joined.join(cutting.region(h, part), cutting.region_beyond(mesh, h, part));
            }
        }
    }
    let mut tally =
        Tally { of_root: vec![NONE; cutting.regions as usize], all: Vec::new(), euler: Vec::new() };
    let of_face = count_cells(mesh, &is_design, &cutting, &mut joined, &mut tally);
    for (c, contour) in cuts.iter().enumerate() {
        let (above, below) = cutting.sides_of_cut(mesh, contour, c);
        for (region, side) in [(above, CutSide::Above), (below, CutSide::Below)] {
            let piece = tally.piece(&mut joined, region);
            tally.all[piece].cuts.push((c, side));
        }
    }
    for (i, section) in interfaces.iter().enumerate() {
        let region = cutting.region(section.half_edges[0], 0);
        let piece = tally.piece(&mut joined, region);
        tally.all[piece].interfaces.push(i);
    }
    for (patch, euler) in tally.all.iter_mut().zip(&tally.euler) {
        let borders = (patch.cuts.len() + patch.interfaces.len()) as i64;
        patch.genus = ((2 - borders - euler) / 2).max(0) as usize;
    }
    Patches { all: tally.all, of_face }
}

/// Adds V − E + F of the open cells of every piece; the piece of every whole design face.
fn count_cells(
    mesh: &HalfEdgeMesh,
    is_design: &impl Fn(FaceId) -> bool,
    cutting: &Cutting,
    joined: &mut Joined,
    tally: &mut Tally,
) -> Vec<Option<u32>> {
    let mut of_face = vec![None; mesh.face_count()];
    let mut on_border = vec![false; mesh.positions().len()];
    let mut inner_at: Vec<u32> = vec![NONE; mesh.positions().len()];
    for f in mesh.faces().filter(|f| is_design(*f)) {
        // The cells of a whole face are all of one piece; those of a cut one are asked singly.
        let whole = match cutting.cut_face(f) {
            None => {
                let piece = tally.piece(joined, f.0);
                tally.euler[piece] += 1;
                Some(piece)
            }
            Some(cut) => {
                cut.own_regions().for_each(|r| tally.add(joined, r, 1));
                None
            }
        };
        of_face[f.index()] = whole.map(|piece| piece as u32);
        for (h, corner) in f.half_edges().into_iter().zip(mesh.triangles()[f.index()]) {
            inner_at[corner as usize] = h.0;
            let t = mesh.twin(h);
            if !is_design(t.face()) {
                on_border[corner as usize] = true;
                on_border[mesh.target(h).index()] = true;
            } else if h < t {
                match whole {
                    Some(piece) => tally.euler[piece] -= 1,
                    None => (0..cutting.parts(mesh, h))
                        .for_each(|part| tally.add(joined, cutting.region(h, part), -1)),
                }
            }
        }
    }
    for (v, &h) in inner_at.iter().enumerate() {
        if h != NONE && !on_border[v] {
            let h = HalfEdgeId(h);
            match of_face[h.face().index()] {
                Some(piece) => tally.euler[piece as usize] += 1,
                None => tally.add(joined, cutting.region(h, 0), 1),
            }
        }
    }
    of_face
}

/// No number.
const NONE: u32 = u32::MAX;

/// Pieces by the root of their regions.
struct Tally {
    of_root: Vec<u32>,
    all: Vec<Patch>,
    euler: Vec<i64>,
}

impl Tally {
    fn piece(&mut self, joined: &mut Joined, region: u32) -> usize {
        let piece = &mut self.of_root[joined.root(region) as usize];
        if *piece == NONE {
            *piece = self.all.len() as u32;
            self.all.push(Patch::default());
            self.euler.push(0);
        }
        *piece as usize
    }

    fn add(&mut self, joined: &mut Joined, region: u32, count: i64) {
        let piece = self.piece(joined, region);
        self.euler[piece] += count;
    }
}

/// Disjoint sets with path halving.
pub(crate) struct Joined(Vec<u32>);

impl Joined {
    pub(crate) fn new(count: u32) -> Self {
        Self((0..count).collect())
    }

    pub(crate) fn root(&mut self, mut x: u32) -> u32 {
        while self.0[x as usize] != x {
            self.0[x as usize] = self.0[self.0[x as usize] as usize];
            x = self.0[x as usize];
        }
        x
    }

    pub(crate) fn join(&mut self, x: u32, y: u32) {
        let (x, y) = (self.root(x), self.root(y));
        // The smaller index stays the root, so that results do not depend on the order.
        self.0[x.max(y) as usize] = x.min(y);
    }
}

/// Where a contour crosses a side: how far along it, and which point of which contour.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CrossingPoint {
    along: f64,
    cut: u32,
    index: u32,
}

/// The triangles crossed by contours, cut into regions.
struct Cutting {
    /// Crossings by the lower half-edge of each crossed edge, in the order along it.
    sides: FxHashMap<u32, Vec<CrossingPoint>>,
    /// Place in `faces` of each triangle that is crossed.
    of_face: Vec<u32>,
    faces: Vec<CutFace>,
    /// Number of regions; a triangle that is not cut is the region of its own number.
    regions: u32,
}

/// A triangle cut by chords: the region along each part of its sides, going round.
struct CutFace {
    first_part: [usize; 3],
    region_of_part: Vec<u32>,
}

impl CutFace {
    fn own_regions(&self) -> impl Iterator<Item = u32> {
        let mut own = self.region_of_part.clone();
        own.sort_unstable();
        own.dedup();
        own.into_iter()
    }
}

impl Cutting {
    fn new(mesh: &HalfEdgeMesh, cuts: &[&Contour]) -> Self {
        let mut cutting = Self {
            sides: FxHashMap::default(),
            of_face: vec![NONE; mesh.face_count()],
            faces: Vec::new(),
            regions: mesh.face_count() as u32,
        };
        let mut chords: FxHashMap<u32, Vec<(u32, u32)>> = FxHashMap::default();
        let mut order: Vec<u32> = Vec::new();
        for (c, contour) in cuts.iter().enumerate() {
            for (i, (&h, p)) in contour.half_edges.iter().zip(&contour.points).enumerate() {
                let low = h.min(mesh.twin(h));
                let along = (p - mesh.position(mesh.origin(low))).norm();
                let point = CrossingPoint { along, cut: c as u32, index: i as u32 };
                cutting.sides.entry(low.0).or_default().push(point);
                let face = h.face().0;
                chords.entry(face).or_insert_with(|| {
                    order.push(face);
                    Vec::new()
                });
                chords.entry(face).or_default().push((c as u32, i as u32));
            }
        }
        for points in cutting.sides.values_mut() {
            points.sort_by(|a, b| a.along.total_cmp(&b.along));
        }
        for face in order {
            cutting.add_face(mesh, cuts, FaceId(face), &chords[&face]);
        }
        cutting
    }

    fn add_face(
        &mut self,
        mesh: &HalfEdgeMesh,
        cuts: &[&Contour],
        face: FaceId,
        chords: &[(u32, u32)],
    ) {
        let mut first_part = [0; 3];
        let mut crossings: Vec<(u32, u32, usize)> = Vec::new();
        let mut parts = 0;
        for (s, h) in face.half_edges().into_iter().enumerate() {
            first_part[s] = parts;
            for point in self.along(mesh, h) {
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
        for &(cut, i) in chords {
            let n = cuts[cut as usize].points.len() as u32;
            if let (Some(a), Some(b)) = (before(cut, i), before(cut, (i + 1) % n)) {
                local.join(a + 1, b);
                local.join(a, b + 1);
            }
        }
        let mut names: Vec<(u32, u32)> = Vec::new();
        let region_of_part = (0..parts as u32)
            .map(|p| {
                let root = local.root(p);
                if let Some(&(_, name)) = names.iter().find(|n| n.0 == root) {
                    return name;
                }
                // The first region of a cut triangle keeps the triangle's number.
                let name = if names.is_empty() {
                    face.0
                } else {
                    self.regions += 1;
                    self.regions - 1
                };
                names.push((root, name));
                name
            })
            .collect();
        self.of_face[face.index()] = self.faces.len() as u32;
        self.faces.push(CutFace { first_part, region_of_part });
    }

    /// Crossings of a side in its own direction.
    fn along(&self, mesh: &HalfEdgeMesh, h: HalfEdgeId) -> Vec<CrossingPoint> {
        let twin = mesh.twin(h);
        let mut points = self.sides.get(&h.min(twin).0).cloned().unwrap_or_default();
        if twin < h {
            points.reverse();
        }
        points
    }

    /// How a triangle is cut, if it is.
    fn cut_face(&self, face: FaceId) -> Option<&CutFace> {
        self.faces.get(self.of_face[face.index()] as usize)
    }

    /// Number of parts a side is cut into.
    fn parts(&self, mesh: &HalfEdgeMesh, h: HalfEdgeId) -> usize {
        if self.of_face[h.face().index()] == NONE {
            return 1;
        }
        1 + self.sides.get(&h.min(mesh.twin(h)).0).map_or(0, Vec::len)
    }

    /// The region along part `part` of side `h`, in the triangle of `h`.
    fn region(&self, h: HalfEdgeId, part: usize) -> u32 {
        match self.cut_face(h.face()) {
            None => h.face().0,
            Some(cut) => cut.region_of_part[cut.first_part[h.index() % 3] + part],
        }
    }

    /// The region beyond part `part` of side `h`.
    fn region_beyond(&self, mesh: &HalfEdgeMesh, h: HalfEdgeId, part: usize) -> u32 {
        self.region(mesh.twin(h), self.parts(mesh, h) - 1 - part)
    }

    /// The regions above and below a cut.
    fn sides_of_cut(&self, mesh: &HalfEdgeMesh, contour: &Contour, cut: usize) -> (u32, u32) {
        let h = contour.half_edges[0];
        let rank = self
            .along(mesh, h)
            .iter()
            .position(|p| p.cut == cut as u32 && p.index == 0)
            .unwrap_or(0);
        (self.region(h, rank), self.region(h, rank + 1))
    }
}
