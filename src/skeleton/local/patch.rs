//! What the surface falls into when it is cut along one contour of every tube.
//!
//! Each piece, closed over its cuts and its interface sections, is a sphere or a sphere with
//! handles. Where every piece is a sphere, the graph of pieces and tubes has exactly the tunnels of
//! the design part (thesis: the skeleton is homotopic to the object). A piece with a handle hides a
//! tube that has not been found.
//!
//! The pieces are counted exactly: triangles are cut into regions by the chords of the contours;
//! what is left whole is flooded, regions are joined over the parts of their sides, and each piece
//! gets its Euler characteristic χ = V − E + F without its border. With b borders its genus is
//! (2 − b − χ) / 2.

use super::cutting::{Cutting, Joined};
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

/// The pieces, in the order of their first triangles, and which triangles they have.
#[derive(Clone, Debug)]
pub(crate) struct Patches {
    pub(crate) all: Vec<Patch>,
    of_face: Vec<Of>,
    /// The piece of each region.
    of_region: Vec<usize>,
}

/// What a triangle belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Of {
    /// Not the design part.
    Outside,
    /// The regions of this cut triangle.
    Cut(u32),
    /// This region.
    Whole(u32),
    /// A region not known yet.
    Open,
}

impl Patches {
    /// Handles of all pieces.
    pub(crate) fn genus(&self) -> usize {
        self.all.iter().map(|piece| piece.genus).sum()
    }

    /// The piece a triangle belongs to; `None` for cut and non-design triangles.
    pub(crate) fn of_face(&self, face: FaceId) -> Option<usize> {
        match self.of_face[face.index()] {
            Of::Whole(region) => Some(self.of_region[region as usize]),
            _ => None,
        }
    }

    /// The piece along the first part of a side.
    fn along(&self, cutting: &Cutting, side: HalfEdgeId) -> Option<usize> {
        match self.of_face[side.face().index()] {
            Of::Cut(i) => Some(self.of_region[cutting.faces[i as usize].along(side)[0] as usize]),
            _ => self.of_face(side.face()),
        }
    }
}

/// Cuts the design faces along disjoint contours; `interfaces` are all loops that border them.
pub(crate) fn patches(
    mesh: &HalfEdgeMesh,
    is_design: impl Fn(FaceId) -> bool,
    cuts: &[&Contour],
    interfaces: &[InterfaceSection],
) -> Patches {
    let cutting = Cutting::new(mesh, cuts);
    let mut regions = Regions::new(mesh, is_design, &cutting, interfaces);
    mesh.faces().for_each(|seed| regions.flood(seed));
    regions.join_cut_faces();
    let (mut patches, euler) = regions.gathered();
    for (c, contour) in cuts.iter().enumerate() {
        let sides = cutting.sides_of_cut(mesh, contour, c);
        for (region, side) in sides.into_iter().flatten().zip([CutSide::Above, CutSide::Below]) {
            patches.all[patches.of_region[region as usize]].cuts.push((c, side));
        }
    }
    for (i, section) in interfaces.iter().enumerate() {
        if let Some(piece) = patches.along(&cutting, section.half_edges[0]) {
            patches.all[piece].interfaces.push(i);
        }
    }
    for (patch, euler) in patches.all.iter_mut().zip(euler) {
        let borders = (patch.cuts.len() + patch.interfaces.len()) as i64;
        patch.genus = ((2 - borders - euler) / 2).max(0) as usize;
    }
    patches
}

/// The regions of the design part: those of the cut triangles, and one for every piece of what is
/// left whole.
struct Regions<'a> {
    mesh: &'a HalfEdgeMesh,
    cutting: &'a Cutting,
    of_face: Vec<Of>,
    joined: Joined,
    /// The first triangle of each region.
    first: Vec<FaceId>,
    /// V − E + F of each region without its border.
    euler: Vec<i64>,
    /// Corners that are counted, or on a border.
    is_counted: Vec<bool>,
}

impl<'a> Regions<'a> {
    fn new(
        mesh: &'a HalfEdgeMesh,
        is_design: impl Fn(FaceId) -> bool,
        cutting: &'a Cutting,
        interfaces: &[InterfaceSection],
    ) -> Self {
        let mut of_face: Vec<Of> =
            mesh.faces().map(|f| if is_design(f) { Of::Open } else { Of::Outside }).collect();
        let mut first = Vec::new();
        for (i, cut) in (0..).zip(&cutting.faces) {
            of_face[cut.face.index()] = Of::Cut(i);
            first.resize(cut.regions.end as usize, cut.face);
        }
        let euler = vec![1; first.len()];
        let mut is_counted = vec![false; mesh.positions().len()];
        for h in interfaces.iter().flat_map(|section| &section.half_edges) {
            is_counted[mesh.origin(*h).index()] = true;
        }
        Self { mesh, cutting, of_face, joined: Joined::default(), first, euler, is_counted }
    }

    /// Makes a region of a triangle and all that is whole round it, if it has none yet.
    fn flood(&mut self, seed: FaceId) {
        if self.of_face[seed.index()] != Of::Open {
            return;
        }
        let whole = Of::Whole(self.first.len() as u32);
        self.of_face[seed.index()] = whole;
        let mut euler = 0;
        let mut due = vec![seed];
        while let Some(face) = due.pop() {
            euler += 1;
            for h in face.half_edges() {
                euler += self.count_corner(h);
                let twin = self.mesh.twin(h);
                let beyond = &mut self.of_face[twin.face().index()];
                // Every edge is met from both sides, that of a cut triangle from this one.
                match beyond {
                    Of::Outside => {}
                    Of::Cut(_) => euler -= 1,
                    Of::Whole(_) => euler -= i64::from(h < twin),
                    Of::Open => {
                        euler -= i64::from(h < twin);
                        *beyond = whole;
                        due.push(twin.face());
                    }
                }
            }
        }
        self.first.push(seed);
        self.euler.push(euler);
    }

    /// 1 for the origin of a side if it is met for the first time.
    fn count_corner(&mut self, side: HalfEdgeId) -> i64 {
        let is_counted = &mut self.is_counted[self.mesh.origin(side).index()];
        i64::from(!std::mem::replace(is_counted, true))
    }

    /// Joins the regions of cut triangles to what lies beyond their sides.
    fn join_cut_faces(&mut self) {
        self.joined = Joined::new(self.first.len() as u32);
        let cutting = self.cutting;
        for cut in &cutting.faces {
            for h in cut.face.half_edges() {
                let regions = cut.along(h);
                self.euler[regions[0] as usize] += self.count_corner(h);
                let twin = self.mesh.twin(h);
                match self.of_face[twin.face().index()] {
                    Of::Whole(region) => self.joined.join(regions[0], region),
                    Of::Cut(other) if h < twin => {
                        let beyond = cutting.faces[other as usize].along(twin);
                        for (&region, &beyond) in regions.iter().zip(beyond.iter().rev()) {
                            self.joined.join(region, beyond);
                            self.euler[region as usize] -= 1;
                        }
                    }
                    _ => {}
                }
            }
        }
    }

    /// The pieces that the regions make, and V − E + F of each.
    fn gathered(&mut self) -> (Patches, Vec<i64>) {
        let mut order: Vec<u32> = (0..self.first.len() as u32).collect();
        order.sort_unstable_by_key(|&region| (self.first[region as usize], region));
        let mut all = Vec::new();
        let mut euler = Vec::new();
        let mut of_root = vec![None; order.len()];
        let mut of_region = vec![0; order.len()];
        for region in order {
            let piece = *of_root[self.joined.root(region) as usize].get_or_insert_with(|| {
                all.push(Patch::default());
                euler.push(0);
                all.len() - 1
            });
            of_region[region as usize] = piece;
            euler[piece] += self.euler[region as usize];
        }
        let of_face = std::mem::take(&mut self.of_face);
        (Patches { all, of_face, of_region }, euler)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::contour::{Plane, entry, follow};
    use crate::mesh::{LabelParams, Surface, prepare};
    use beamwright_formats::{Polygons, RawMesh};
    use nalgebra::{Point3, Vector3};

    /// A square ring about the z axis: arms from 1 to 2, a thickness of 1.
    fn ring() -> Surface {
        let corner = |i: usize| [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]][i % 4];
        let mut positions = Vec::new();
        for (half_width, z) in [(2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 0.0)] {
            positions
                .extend((0..4).map(|i| corner(i).map(|x| x * half_width)).map(|[x, y]| [x, y, z]));
        }
        let mut faces = Polygons::default();
        for row in 0..4 {
            for i in 0..4 {
                let at = |row: usize, i: usize| (4 * (row % 4) + i % 4) as u32;
                faces.push([at(row, i), at(row, i + 1), at(row + 1, i + 1), at(row + 1, i)]);
            }
        }
        let raw = RawMesh { positions, faces, ..RawMesh::default() };
        prepare(&raw, &LabelParams::default()).expect("a closed mesh")
    }

    /// The contour across the arm on one side of the plane x = 0.
    fn across(surface: &Surface, side: f64) -> Contour {
        let plane = Plane::new(Point3::new(0.1, 0.0, 0.0), Vector3::x_axis());
        let is_on_side = |f: &FaceId| surface.mesh.corners(*f).iter().all(|p| p.y * side > 0.0);
        let mut faces = surface.mesh.faces().filter(is_on_side);
        let start = faces.find_map(|f| entry(&surface.mesh, &plane, f)).expect("a cut triangle");
        let mut contour = Contour::default();
        assert!(follow(&surface.mesh, &plane, start, &mut contour, |_| true));
        contour
    }

    fn pieces(surface: &Surface, cuts: &[&Contour]) -> Vec<Patch> {
        patches(&surface.mesh, |_| true, cuts, &[]).all
    }

    #[test]
    fn an_uncut_ring_is_one_piece_with_a_handle() {
        let found = pieces(&ring(), &[]);
        assert_eq!(found, [Patch { genus: 1, ..Patch::default() }]);
    }

    #[test]
    fn a_ring_cut_once_is_one_piece_without_a_handle() {
        let surface = ring();
        let found = pieces(&surface, &[&across(&surface, 1.0)]);
        let [Patch { cuts, genus: 0, .. }] = found.as_slice() else { panic!("{found:?}") };
        assert_eq!(cuts, &[(0, CutSide::Above), (0, CutSide::Below)]);
    }

    #[test]
    fn a_ring_cut_twice_falls_into_two_pieces() {
        let surface = ring();
        let found = pieces(&surface, &[&across(&surface, 1.0), &across(&surface, -1.0)]);
        assert_eq!(found.len(), 2);
        for piece in &found {
            let [(0, side), (1, other)] = piece.cuts[..] else { panic!("{piece:?}") };
            assert_eq!((side, piece.genus), (other, 0));
        }
    }
}
