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
use crate::mesh::id::{FaceId, HalfEdgeId, VertexId};

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
    /// A plain piece of tube of [`Band::faces`].
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
    /// Faces of the last flood, by the sides over which they were reached.
    reached: Vec<Reached>,
    face_stamp: Vec<u32>,
    side_stamp: Vec<u32>,
    stamp: u32,
    spare: Contour,
}

/// A side over which a triangle was reached, and the levels of its ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reached {
    side: HalfEdgeId,
    levels: [u8; 2],
}

impl Band {
    pub(crate) fn new(mesh: &HalfEdgeMesh) -> Self {
        Self {
            reached: Vec::new(),
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
        let fronts = [lower, upper].into_iter().flat_map(|front| &front.contour.half_edges);
        fronts.for_each(|h| self.side_stamp[h.index()] = self.stamp);
        let limits = Limits {
            mesh,
            lower: &lower.plane,
            upper: &upper.plane,
            rough: ROUGHNESS * lower.extent.radius().min(upper.extent.radius()),
        };
        for &h in &lower.contour.half_edges {
            self.reach(h, limits.levels(h));
        }
        let mut next = 0;
        while let Some(&Reached { side, levels: [from, to] }) = self.reached.get(next) {
            next += 1;
            if !is_own(side.face()) {
                return Verdict::Foreign;
            }
            let (after, before) = (side.next(), side.previous());
            let apex = limits.level(mesh.origin(before));
            if !self.go_over(&limits, after, [to, apex])
                || !self.go_over(&limits, before, [apex, from])
            {
                return Verdict::Splits;
            }
        }
        Verdict::Tube
    }

    /// The faces of the last flood.
    pub(crate) fn faces(&self) -> impl Iterator<Item = FaceId> {
        self.reached.iter().map(|r| r.side.face())
    }

    /// Takes the faces of the last flood out.
    pub(crate) fn take(&mut self) -> Vec<Reached> {
        std::mem::take(&mut self.reached)
    }

    /// Puts back what was taken out.
    pub(crate) fn put(&mut self, reached: Vec<Reached>) {
        self.reached = reached;
    }

    fn begin(&mut self) {
        if self.stamp == u32::MAX {
            self.face_stamp.fill(0);
            self.side_stamp.fill(0);
            self.stamp = 0;
        }
        self.stamp += 1;
        self.reached.clear();
    }

    /// Floods the triangle of a side, given the levels of its ends.
    fn reach(&mut self, side: HalfEdgeId, levels: [u8; 2]) {
        let face = side.face();
        let seen = &mut self.face_stamp[face.index()];
        if *seen != self.stamp {
            *seen = self.stamp;
            self.reached.push(Reached { side, levels });
        }
    }

    /// Goes on over a side with ends at two levels, if it has a part in the band; false where the
    /// surface leaves the band but along the fronts.
    #[inline(always)]
    fn go_over(&mut self, limits: &Limits<'_>, side: HalfEdgeId, [from, to]: [u8; 2]) -> bool {
        let twin = limits.mesh.twin(side);
        let is_plain = match from | to {
            BELOW | ABOVE => return true,
            BETWEEN => true,
            OVER_UPPER => self.passes(limits, Over::Upper, if from == ABOVE { side } else { twin }),
            OVER_LOWER => self.passes(limits, Over::Lower, if from == BELOW { twin } else { side }),
            _ => return self.go_over_any(limits, side, [from, to]),
        };
        if is_plain {
            self.reach(twin, [to, from]);
        }
        is_plain
    }

    /// Goes on over any side, by the part of it that lies between the planes; long sides need it, and
    /// few others.
    #[cold]
    fn go_over_any(&mut self, limits: &Limits<'_>, side: HalfEdgeId, [from, to]: [u8; 2]) -> bool {
        let mesh = limits.mesh;
        let ends = [mesh.origin(side), mesh.target(side)].map(|v| mesh.position(v));
        let lower = ends.map(|p| limits.lower.height(&p));
        let upper = ends.map(|p| limits.upper.height(&p));
        let crosses = |[a, b]: [f64; 2]| (a >= 0.0) != (b >= 0.0);
        let at_zero_of = |[a, b]: [f64; 2], [c, d]: [f64; 2]| c + a / (a - b) * (d - c);
        let from_above = |[a, _]: [f64; 2]| if a >= 0.0 { side } else { mesh.twin(side) };
        let over_upper = crosses(upper) && at_zero_of(upper, lower) >= 0.0;
        let over_lower = crosses(lower) && at_zero_of(lower, upper) < 0.0;
        let is_plain = (!over_upper || self.passes(limits, Over::Upper, from_above(upper)))
            && (!over_lower || self.passes(limits, Over::Lower, from_above(lower)));
        if is_plain && lies_between(lower, upper) {
            self.reach(mesh.twin(side), [to, from]);
        }
        is_plain
    }

    /// Whether the surface may leave the band over a side, from above a plane to below it: along a
    /// front, or into a small bump.
    fn passes(&mut self, limits: &Limits<'_>, over: Over, side: HalfEdgeId) -> bool {
        self.side_stamp[side.index()] == self.stamp || self.cap_roughness(limits, over, side)
    }

    /// Whether the loop over a crossed side is the foot of a small bump that closes beyond the plane;
    /// if so the loop is marked as passed.
    #[cold]
    fn cap_roughness(&mut self, limits: &Limits<'_>, over: Over, side: HalfEdgeId) -> bool {
        let Limits { mesh, lower, upper, rough } = *limits;
        let plane = if over == Over::Upper { upper } else { lower };
        let mut contour = std::mem::take(&mut self.spare);
        let start = mesh.position(mesh.origin(side));
        let mut first = None;
        let is_small = follow(mesh, plane, side, &mut contour, |p| {
            (p - *first.get_or_insert(*p)).norm() <= 2.0 * rough
        });
        let closes = is_small && bump_closes(mesh, plane, over, &contour, &start, rough);
        if closes {
            contour.half_edges.iter().for_each(|h| self.side_stamp[h.index()] = self.stamp);
        }
        self.spare = contour;
        closes
    }
}

/// Whether the surface beyond a small loop is a cap that stays within a few sizes of the loop.
fn bump_closes(
    mesh: &HalfEdgeMesh,
    plane: &Plane,
    over: Over,
    contour: &Contour,
    near: &Point3<f64>,
    rough: f64,
) -> bool {
    let is_beyond = |h: HalfEdgeId| {
        let is_above = plane.height(&mesh.position(mesh.origin(h))) >= 0.0;
        is_above == (over == Over::Upper)
    };
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

/// Where a corner lies, a bit each, so that the levels of both ends of a side are one number.
const BELOW: u8 = 1;
const BETWEEN: u8 = 2;
const ABOVE: u8 = 4;
/// On a plane, or beyond the line in which the planes meet.
const ODD: u8 = 8;

/// Sides with one end in the band.
const OVER_LOWER: u8 = BELOW | BETWEEN;
const OVER_UPPER: u8 = BETWEEN | ABOVE;

/// The planes that a flood may not pass but along its fronts.
struct Limits<'a> {
    mesh: &'a HalfEdgeMesh,
    lower: &'a Plane,
    upper: &'a Plane,
    /// A loop that reaches no farther is roughness, mm.
    rough: f64,
}

/// Over which plane the surface leaves a band.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Over {
    Lower,
    Upper,
}

impl Limits<'_> {
    fn level(&self, vertex: VertexId) -> u8 {
        let p = self.mesh.position(vertex);
        let (lower, upper) = (self.lower.height(&p), self.upper.height(&p));
        if lower == 0.0 || upper == 0.0 || (lower < 0.0 && upper > 0.0) {
            return ODD;
        }
        let planes_below = u8::from(lower > 0.0) + u8::from(upper > 0.0);
        BELOW << planes_below
    }

    /// The levels of the ends of a side.
    fn levels(&self, side: HalfEdgeId) -> [u8; 2] {
        [self.level(self.mesh.origin(side)), self.level(self.mesh.target(side))]
    }
}

/// Whether some of a side lies above the lower and below the upper plane, by the heights of its ends.
fn lies_between(lower: [f64; 2], upper: [f64; 2]) -> bool {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for [a, b] in [lower, upper.map(|x| -x)] {
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
