//! Which parts of the surface the march has passed.
//!
//! A triangle may be longer than a whole branch, so a claim is not a mark on a triangle: it says
//! that the part of the triangle between two given planes is passed.
//!
//! ```text
//!    ├──┤ claim 3 ──▶ 2 ──▶ 1 ──▶ 0      the side of a long triangle; every claim knows the one
//!       ╰──────── leap ────▶ ╯           before it, some a leap over several and where these lie
//! ```
//!
//! The claims of a triangle form a chain. A box of twelve triangles that is ten thousand times as
//! long as thick has tens of thousands of claims on each, so long chains have leaps: a place that
//! lies beside all claims under a leap passes them in one.

use nalgebra::{Point3, Vector3};

use crate::mesh::HalfEdgeMesh;
use crate::mesh::contour::Plane;
use crate::mesh::id::FaceId;
use crate::skeleton::places::longest_side;

/// A claim of one band on one triangle; claims on a triangle form a chain.
#[derive(Clone, Copy, Debug)]
struct Claim {
    face: u32,
    band: u32,
    next: u32,
    leap: u32,
}

/// A way over a claim and those that follow it, along the longest side of the triangle.
///
/// Leaps are those of a skew-binary list (Myers, *An applicative random-access stack*, 1983): any
/// claim is reached in a number of leaps that grows like the logarithm of the chain.
#[derive(Clone, Copy, Debug)]
struct Leap {
    /// The claim after the leap, or [`NONE`].
    to: u32,
    /// Claims with a leap from this one to the end of the chain.
    rank: u32,
    /// Where the claims passed over lie along the side, mm.
    low: f64,
    high: f64,
}

const NONE: u32 = u32::MAX;

/// Claims a triangle has without leaps. Triangles of usual meshes are in two or three bands.
const SHORT_CHAIN: usize = 16;

/// The bands passed so far.
#[derive(Debug)]
pub(crate) struct Claims<'a> {
    mesh: &'a HalfEdgeMesh,
    bands: Vec<(Plane, Plane)>,
    first: Vec<u32>,
    claims: Vec<Claim>,
    leaps: Vec<Leap>,
}

/// A state of [`Claims`] to return to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    bands: usize,
    claims: usize,
    leaps: usize,
}

impl<'a> Claims<'a> {
    pub(crate) fn new(mesh: &'a HalfEdgeMesh) -> Self {
        let first = vec![NONE; mesh.face_count()];
        Self { mesh, bands: Vec::new(), first, claims: Vec::new(), leaps: Vec::new() }
    }

    /// Claims the part of `faces` above `lower` and below `upper`.
    pub(crate) fn add(&mut self, lower: Plane, upper: Plane, faces: impl Iterator<Item = FaceId>) {
        let band = self.bands.len() as u32;
        self.bands.push((lower, upper));
        for face in faces {
            let next = self.first[face.index()];
            let leap = self.leap_before(face, next, &lower, &upper);
            self.first[face.index()] = self.claims.len() as u32;
            self.claims.push(Claim { face: face.0, band, next, leap });
        }
    }

    /// Whether a point of a triangle lies in a claimed band.
    pub(crate) fn holds(&self, face: FaceId, point: &Point3<f64>) -> bool {
        let mut at = self.first[face.index()];
        let mut along = None;
        while let Some(claim) = self.claims.get(at as usize) {
            if let Some(leap) = self.leaps.get(claim.leap as usize) {
                let along = *along.get_or_insert_with(|| Side::of(self.mesh, face).along(point));
                if along < leap.low || along > leap.high {
                    at = leap.to;
                    continue;
                }
            }
            let (lower, upper) = &self.bands[claim.band as usize];
            if lower.height(point) >= 0.0 && upper.height(point) < 0.0 {
                return true;
            }
            at = claim.next;
        }
        false
    }

    pub(crate) fn mark(&self) -> Mark {
        Mark { bands: self.bands.len(), claims: self.claims.len(), leaps: self.leaps.len() }
    }

    /// Takes back all claims made since `mark`.
    pub(crate) fn take_back(&mut self, mark: Mark) {
        self.bands.truncate(mark.bands);
        while self.claims.len() > mark.claims {
            if let Some(claim) = self.claims.pop() {
                self.first[claim.face as usize] = claim.next;
            }
        }
        self.leaps.truncate(mark.leaps);
    }

    /// The leap of a new claim in front of `next`; [`NONE`] in a short chain.
    fn leap_before(&mut self, face: FaceId, next: u32, lower: &Plane, upper: &Plane) -> u32 {
        let leap_of = |claim: u32| {
            self.claims.get(claim as usize).and_then(|c| self.leaps.get(c.leap as usize))
        };
        let before = leap_of(next);
        if before.is_none() && self.chain_is_short(next) {
            return NONE;
        }
        let (low, high) = Side::of(self.mesh, face).between(lower, upper);
        let mut leap = Leap { to: next, rank: before.map_or(0, |b| b.rank) + 1, low, high };
        if let Some(before) = before
            && let Some(second) = leap_of(before.to)
            && let beyond = leap_of(second.to).map_or(0, |l| l.rank)
            && before.rank - second.rank == second.rank - beyond
        {
            leap.to = second.to;
            leap.low = low.min(before.low).min(second.low);
            leap.high = high.max(before.high).max(second.high);
        }
        self.leaps.push(leap);
        self.leaps.len() as u32 - 1
    }

    fn chain_is_short(&self, mut at: u32) -> bool {
        for _ in 0..SHORT_CHAIN {
            let Some(claim) = self.claims.get(at as usize) else { return true };
            at = claim.next;
        }
        false
    }
}

/// The longest side of a triangle, as a scale for places on it.
struct Side {
    corners: [Point3<f64>; 3],
    origin: Point3<f64>,
    direction: Vector3<f64>,
    /// Far more than the rounding of a place on the triangle, mm.
    slack: f64,
}

/// Rounding of places, relative to their coordinates and to the side; a thousand times what double
/// precision has.
const ROUNDING: f64 = 1e-12;

impl Side {
    fn of(mesh: &HalfEdgeMesh, face: FaceId) -> Self {
        let corners = mesh.corners(face);
        let first = longest_side(&corners);
        let (origin, end) = (corners[first], corners[(first + 1) % 3]);
        let length = (end - origin).norm();
        let direction = (end - origin).try_normalize(0.0).unwrap_or_default();
        let slack = ROUNDING * (origin.coords.amax() + end.coords.amax() + length);
        Self { corners, origin, direction, slack }
    }

    fn along(&self, point: &Point3<f64>) -> f64 {
        (point - self.origin).dot(&self.direction)
    }

    /// The least and greatest place of what two planes cut out of the triangle, or a little more.
    fn between(&self, lower: &Plane, upper: &Plane) -> (f64, f64) {
        let heights =
            self.corners.map(|p| [lower.height(&p) + self.slack, self.slack - upper.height(&p)]);
        let places = self.corners.map(|p| self.along(&p));
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut hold = |at: f64| (low, high) = (low.min(at), high.max(at));
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            if heights[i].iter().all(|h| *h >= 0.0) {
                hold(places[i]);
            }
            for (a, b) in heights[i].into_iter().zip(heights[j]) {
                if (a >= 0.0) != (b >= 0.0) {
                    hold(places[i] + a / (a - b) * (places[j] - places[i]));
                }
            }
        }
        (low - self.slack, high + self.slack)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LabelParams, Surface, prepare};
    use beamwright_formats::{Polygons, RawMesh};
    use nalgebra::Unit;

    /// A needle with one corner at x = 1000 over a triangle about the origin.
    fn needle() -> Surface {
        let positions =
            vec![[0.0, 1.0, 0.0], [0.0, -0.5, 0.8], [0.0, -0.5, -0.8], [1000.0, 0.0, 0.0]];
        let mut faces = Polygons::default();
        [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]].iter().for_each(|f| faces.push(*f));
        let raw = RawMesh { positions, faces, ..RawMesh::default() };
        prepare(&raw, &LabelParams::default()).expect("a closed mesh")
    }

    /// A plane across the needle at a place, leaning one way or the other.
    fn plane(x: f64, lean: f64) -> Plane {
        Plane::new(Point3::new(x, 0.0, 0.0), Unit::new_normalize(Vector3::new(1.0, lean, 0.2)))
    }

    #[test]
    fn thousands_of_claims_on_one_triangle_hold_what_each_of_them_holds() {
        let surface = needle();
        let mesh = &surface.mesh;
        let faces: Vec<FaceId> = mesh.faces().collect();
        let mut claims = Claims::new(mesh);
        let mut bands = Vec::new();
        // Every second band, in an order that comes back; what is taken back leaves no trace.
        for k in 0..2000u32 {
            let x = f64::from(k * 7 % 2000) * 0.5;
            let lean = f64::from(k % 5) * 0.3 - 0.6;
            let band = (plane(x, lean), plane(x + 0.25, lean));
            let mark = claims.mark();
            claims.add(plane(0.0, 0.0), plane(900.0, 0.0), faces.iter().copied());
            claims.take_back(mark);
            claims.add(band.0, band.1, faces.iter().copied());
            bands.push(band);
        }
        for face in faces {
            let [a, b, c] = mesh.corners(face);
            for k in 0..3000 {
                let (s, t) = (f64::from(k) / 3000.0, f64::from(k % 7) / 7.0);
                let p = a + (b - a) * (s * (1.0 - t)) + (c - a) * (s * t);
                let held = bands.iter().any(|(l, u)| l.height(&p) >= 0.0 && u.height(&p) < 0.0);
                assert_eq!(claims.holds(face, &p), held, "{face:?} {p}");
            }
        }
    }
}
