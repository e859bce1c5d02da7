//! The band of surface between two cutting planes, and whether it is a plain piece of tube.
//!
//! ```text
//!        lower            upper
//!          │   ╭──────────  │            faces are flooded from the lower contour; the flood may
//!   ───────┼───╯  ▒▒▒▒▒▒▒▒▒▒┼─────       leave the band over the lower and the upper contour only.
//!          │▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒│            Any other way out means that the front falls apart here:
//!   ───────┼────────────────┼─────       a junction (thesis §3.4.2.6).
//! ```
//!
//! Every triangle meets the band in a convex piece, so going from triangle to triangle over the
//! parts of their sides that lie in the band floods it exactly, however long the triangles are.

use nalgebra::Point3;

use crate::mesh::HalfEdgeMesh;
use crate::mesh::contour::{Contour, Extent, Plane, follow};
use crate::mesh::id::{FaceId, HalfEdgeId};

/// A closed front: a plane with the one contour that belongs to the branch.
#[derive(Clone, Debug)]
pub(crate) struct Front {
    pub(crate) plane: Plane,
    pub(crate) contour: Contour,
    pub(crate) extent: Extent,
}

/// What a flood between two fronts found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// A plain piece of tube; its faces are in [`Band::faces`].
    Tube,
    /// The surface goes on elsewhere: another front, or one behind.
    Splits,
    /// The two fronts cross each other inside the branch.
    FrontsCross,
    /// A face between them is none of the branch's.
    Foreign,
}

/// A loop of this part of the section's radius in reach is roughness, not a branch: the steps of a
/// voxel surface reach 0.2 radii on struts four elements wide; branches as thin as 0.3 radii exist.
const ROUGHNESS: f64 = 0.22;

/// Flood of the band between two fronts; keeps its work arrays from band to band.
#[derive(Debug)]
pub(crate) struct Band {
    /// Faces of the last flood.
    pub(crate) faces: Vec<FaceId>,
    face_stamp: Vec<u32>,
    side_stamp: Vec<u32>,
    stamp: u32,
    spare: Contour,
}

impl Band {
    pub(crate) fn new(mesh: &HalfEdgeMesh) -> Self {
        Self {
            faces: Vec::new(),
            face_stamp: vec![0; mesh.face_count()],
            side_stamp: vec![0; 3 * mesh.face_count()],
            stamp: 0,
            spare: Contour::default(),
        }
    }

    /// Floods from `lower` (whose plane's normal points to `upper`) up to `upper`, over own faces.
    pub(crate) fn flood(
        &mut self,
        mesh: &HalfEdgeMesh,
        lower: &Front,
        upper: &Front,
        is_own: impl Fn(FaceId) -> bool,
    ) -> Verdict {
        if upper.contour.points.iter().any(|p| lower.plane.height(p) < 0.0)
            || lower.contour.points.iter().any(|p| upper.plane.height(p) >= 0.0)
        {
            return Verdict::FrontsCross;
        }
        self.begin();
        let (on_lower, on_upper) = (self.stamp, self.stamp + 1);
        self.stamp += 1;
        lower.contour.half_edges.iter().for_each(|h| self.side_stamp[h.index()] = on_lower);
        upper.contour.half_edges.iter().for_each(|h| self.side_stamp[h.index()] = on_upper);
        lower.contour.half_edges.iter().for_each(|h| self.reach(h.face()));
        let rough = ROUGHNESS * lower.extent.radius().min(upper.extent.radius());
        let mut next = 0;
        while let Some(&face) = self.faces.get(next) {
            next += 1;
            if !is_own(face) {
                return Verdict::Foreign;
            }
            let heights = heights(mesh, face, &lower.plane, &upper.plane);
            if heights.iter().all(|[lower, upper]| *lower >= 0.0 && *upper < 0.0) {
                // Most triangles of fine meshes lie in the band as a whole.
                face.half_edges().into_iter().for_each(|h| self.reach(mesh.neighbour(h)));
                continue;
            }
            for side in sides(mesh, face, heights) {
                for (over_upper, key) in side.ways_out().into_iter().flatten() {
                    if self.side_stamp[key.index()] >= on_lower {
                        continue;
                    }
                    let (plane, passed) = if over_upper {
                        (&upper.plane, on_upper)
                    } else {
                        (&lower.plane, on_lower)
                    };
                    if !self.cap_roughness(mesh, plane, over_upper, key, rough, passed) {
                        return Verdict::Splits;
                    }
                }
                if side.lies_in_band() {
                    self.reach(side.twin.face());
                }
            }
        }
        Verdict::Tube
    }

    fn begin(&mut self) {
        if self.stamp > u32::MAX - 4 {
            self.face_stamp.fill(0);
            self.side_stamp.fill(0);
            self.stamp = 0;
        }
        self.stamp += 1;
        self.faces.clear();
    }

    fn reach(&mut self, face: FaceId) {
        let seen = &mut self.face_stamp[face.index()];
        if *seen < self.stamp {
            *seen = self.stamp;
            self.faces.push(face);
        }
    }

    /// Whether the loop over `key` is the foot of a small bump that closes beyond the plane; if so
    /// the loop is marked as passed.
    fn cap_roughness(
        &mut self,
        mesh: &HalfEdgeMesh,
        plane: &Plane,
        beyond_is_above: bool,
        key: HalfEdgeId,
        rough: f64,
        passed: u32,
    ) -> bool {
        let mut contour = std::mem::take(&mut self.spare);
        let start = mesh.position(mesh.origin(key));
        let mut first = None;
        let is_small = follow(mesh, plane, key, &mut contour, |p| {
            (p - *first.get_or_insert(*p)).norm() <= 2.0 * rough
        });
        let closes = is_small && bump_closes(mesh, plane, beyond_is_above, &contour, &start, rough);
        if closes {
            contour.half_edges.iter().for_each(|h| self.side_stamp[h.index()] = passed);
        }
        self.spare = contour;
        closes
    }
}

/// Whether the surface beyond a small loop is a cap that stays within a few sizes of the loop.
fn bump_closes(
    mesh: &HalfEdgeMesh,
    plane: &Plane,
    beyond_is_above: bool,
    contour: &Contour,
    near: &Point3<f64>,
    rough: f64,
) -> bool {
    let is_beyond =
        |h: HalfEdgeId| (plane.height(&mesh.position(mesh.origin(h))) >= 0.0) == beyond_is_above;
    let mut faces: Vec<FaceId> = contour.half_edges.iter().map(|h| h.face()).collect();
    let mut next = 0;
    while let Some(&face) = faces.get(next) {
        next += 1;
        for h in face.half_edges() {
            if !is_beyond(h) {
                continue;
            }
            if (mesh.position(mesh.origin(h)) - near).norm() > 6.0 * rough {
                return false;
            }
            for g in [mesh.neighbour(h), mesh.neighbour(h.previous())] {
                if !faces.contains(&g) {
                    faces.push(g);
                }
            }
        }
        if faces.len() > 400 {
            return false;
        }
    }
    true
}

/// One side of a triangle against the two planes of a band.
struct Side {
    half_edge: HalfEdgeId,
    twin: HalfEdgeId,
    /// Heights of origin and target over the lower plane.
    lower: [f64; 2],
    /// Heights over the upper plane.
    upper: [f64; 2],
}

/// Heights of the corners of a triangle over the lower and the upper plane of a band.
fn heights(mesh: &HalfEdgeMesh, face: FaceId, lower: &Plane, upper: &Plane) -> [[f64; 2]; 3] {
    let [a, b, c] = mesh.corners(face);
    let over = |p: &Point3<f64>| [lower.height(p), upper.height(p)];
    [over(&a), over(&b), over(&c)]
}

/// The sides of a triangle, given the heights of its corners.
fn sides(mesh: &HalfEdgeMesh, face: FaceId, heights: [[f64; 2]; 3]) -> [Side; 3] {
    let half_edges = face.half_edges();
    let side = |from: usize, to: usize| {
        let ([a, c], [b, d]) = (heights[from], heights[to]);
        let half_edge = half_edges[from];
        Side { half_edge, twin: mesh.twin(half_edge), lower: [a, b], upper: [c, d] }
    };
    [side(0, 1), side(1, 2), side(2, 0)]
}

impl Side {
    /// Whether some of the side is above the lower and below the upper plane.
    fn lies_in_band(&self) -> bool {
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for [a, b] in [self.lower, self.upper.map(|x| -x)] {
            // Keep the part where a + t (b − a) is not negative.
            if a < 0.0 && b < 0.0 {
                return false;
            }
            if a < 0.0 {
                from = from.max(a / (a - b));
            } else if b < 0.0 {
                to = to.min(a / (a - b));
            }
        }
        from < to
    }

    /// Where the side leaves the band: over the upper (true) or the lower plane, and the crossed
    /// side from above to below that names the crossing.
    fn ways_out(&self) -> [Option<(bool, HalfEdgeId)>; 2] {
        let crosses = |[a, b]: [f64; 2]| (a >= 0.0) != (b >= 0.0);
        let at_zero_of = |[a, b]: [f64; 2], [c, d]: [f64; 2]| c + a / (a - b) * (d - c);
        let key = |[a, _]: [f64; 2]| if a >= 0.0 { self.half_edge } else { self.twin };
        let over_upper = crosses(self.upper) && at_zero_of(self.upper, self.lower) >= 0.0;
        let over_lower = crosses(self.lower) && at_zero_of(self.lower, self.upper) < 0.0;
        [over_upper.then(|| (true, key(self.upper))), over_lower.then(|| (false, key(self.lower)))]
    }
}
