//! The march along one branch: a front is carried along the rod until the rod ends.
//!
//! ```text
//!           ┌──────────────┐          c   centroid of the last front
//!   ╭───────┼──────────────┼───╮      c'  centroid of the next one
//!         c ●───── h ──────┼─► d      d   marching direction
//!   ╰───────┼──────────────┼───╯      h   step
//!           └──────────────┘          w   half-width of the box
//! ```
//!
//! One step: cut the surface ahead inside the identifier box; turn the direction to where the
//! centroids go; cut again across it; flood the band between the fronts to see that it is a plain
//! piece of tube; claim it. The march of a branch ends where
//!
//! * the next front does not fit the box, or its radius differs from that of the front one radius
//!   behind by more than the width ratio (thesis §3.4.2.6),
//! * the surface between the fronts opens into something else,
//! * a non-design part begins, or another branch has passed already,
//! * the surface closes: a free end.

use std::f64::consts::TAU;

use nalgebra::{Unit, Vector3};

use super::band::{Band, Front, Verdict};
use super::claim::Claims;
use super::way::{Tube, Way, behind, length};
use crate::mesh::contour::{Contour, Extent, Plane, entry, follow};
use crate::mesh::id::{FaceId, HalfEdgeId};
use crate::mesh::{HalfEdgeMesh, Surface};
use crate::observer::Observer;
use crate::skeleton::error::{SkeletonError, keep_on};
use crate::skeleton::identifier_box::IdentifierBox;
use crate::skeleton::params::SkeletonParams;

/// Why a march ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stop {
    /// No surface ahead: a free end.
    Ends,
    /// The next front is wider (or narrower) than the width ratio allows.
    Widens,
    /// The surface between the fronts opens into other branches.
    Splits,
    /// The branch bends too sharply for two cuts.
    Bends,
    /// A non-design part begins.
    Interface,
    /// The surface ahead has been passed already.
    Passed,
}

/// Step of the march, in radii of the last front. Halved, the bands between two fronts hold too
/// few triangles of a coarse mesh; doubled, a band may hide a thin branch between its fronts.
const STEP: f64 = 0.5;

/// Shortest step, in the wanted one, with which a march tries to get closer to its end. Eighths:
/// the end of a branch is found to a sixteenth of its radius.
const SHORTEST_STEP: f64 = 0.125;

/// What small steps add at the two ends of a march together, in radii of its seed: seven eighths of a
/// step at each, and more where the march goes on behind a narrow place. A march that is too short
/// by more is given up before its ends are looked for; with one radius a tube of a bracket was.
const ROOM: f64 = 1.25;

/// How far back the direction is taken from, in radii. Shorter and the steps of voxel surfaces
/// turn it (y_form: 20° at one radius); longer and it lags behind in bends.
const BASE_OF_DIRECTION: f64 = 2.0;

/// Largest turn of the front in one step, as a cosine: 25°. Sharper is a knee.
const LARGEST_TURN: f64 = 0.906;

/// A plane that would turn by less than this sine, 0.06°, stays: the centroid of a slant section of a
/// rod lies on its axis, and the area grows by a millionth. The turns of an arc of forty radii are ten
/// times as large.
const SAME_DIRECTION: f64 = 1e-3;

/// Most fronts of one march. At half a radius a step this is a rod of a thousand diameters, longer
/// than any strut; a needle asks for ever more, each smaller than the last.
const MOST_FRONTS: usize = 4096;

/// Bands that all marches together need at most, or one for every triangle if there are more. A wire
/// ten thousand times as long as it is thick takes 35,000 steps of half a radius, the lattices of
/// thousands of struts no more than they have triangles. A needle of a longer way takes longer steps.
const MOST_BANDS: usize = 131_072;

/// The march and the surface it has passed.
#[derive(Debug)]
pub(crate) struct March<'a> {
    pub(crate) surface: &'a Surface,
    pub(crate) params: &'a SkeletonParams,
    pub(crate) claims: Claims<'a>,
    /// Area of design surface that a band passes at least, mm².
    least_band: f64,
    band: Band,
    /// The contour followed last.
    pub(super) contour: Contour,
    /// The best contour at a place.
    pub(super) best: Contour,
}

impl<'a> March<'a> {
    pub(crate) fn new(surface: &'a Surface, params: &'a SkeletonParams) -> Self {
        Self {
            surface,
            params,
            claims: Claims::new(&surface.mesh),
            least_band: surface.design_area() / MOST_BANDS.max(surface.mesh.face_count()) as f64,
            band: Band::new(&surface.mesh),
            contour: Contour::default(),
            best: Contour::default(),
        }
    }

    fn mesh(&self) -> &'a HalfEdgeMesh {
        &self.surface.mesh
    }

    /// Marches both ways from a front and claims what it passes, if it comes `shortest` mm far.
    ///
    /// Unless that is nothing, a whole step has to be possible at once, one way or the other.
    pub(crate) fn both_ways(
        &mut self,
        seed: Front,
        shortest: f64,
        observer: &mut impl Observer,
    ) -> Result<Option<Tube>, SkeletonError> {
        let back = self.reversed(&seed);
        let ahead_first = self.advance(std::slice::from_ref(&seed), 1.0);
        let mut back_first = None;
        if shortest > 0.0 && ahead_first.is_err() {
            let back = back.as_ref().map(std::slice::from_ref);
            back_first = back.and_then(|back| self.advance(back, 1.0).ok());
            if back_first.is_none() {
                return Ok(None);
            }
        }
        let back_band = back_first.is_some().then(|| self.band.take());
        let mark = self.claims.mark();
        let room = ROOM * seed.extent.radius();
        let mut ahead = Way::from(seed);
        self.go_on(&mut ahead, 1.0, Some(ahead_first), observer)?;
        // What was claimed ahead may stand in the way of the step back.
        let first = back_first.filter(|_| ahead.fronts.len() == 1).map(Ok);
        if let Some(band) = back_band {
            self.band.put(band);
        }
        let mut behind = back.map(Way::from).unwrap_or_default();
        self.go_on(&mut behind, 1.0, first, observer)?;
        let reached =
            |ahead: &Way, behind: &Way| length(&ahead.fronts, 1) + length(&behind.fronts, 0);
        let may_reach = reached(&ahead, &behind) + room >= shortest;
        if may_reach {
            self.go_on(&mut ahead, SHORTEST_STEP, None, observer)?;
            self.go_on(&mut behind, SHORTEST_STEP, None, observer)?;
        }
        if !may_reach || reached(&ahead, &behind) < shortest {
            self.claims.take_back(mark);
            return Ok(None);
        }
        let mut fronts: Vec<Front> =
            behind.fronts.iter().skip(1).rev().filter_map(|f| self.reversed(f)).collect();
        fronts.extend(ahead.fronts);
        if let [only] = &fronts[..] {
            self.claim_round(only);
        }
        Ok(Some(Tube { fronts }))
    }

    /// Claims the triangles a front crosses, so that no other contour crosses it.
    pub(super) fn claim_round(&mut self, front: &Front) {
        let Plane { point, normal } = front.plane;
        let faces = front.contour.half_edges.iter().map(|h| h.face());
        let corners = faces.clone().flat_map(|f| self.surface.mesh.corners(f));
        let farthest = corners.map(|p| front.plane.height(&p).abs()).fold(0.0, f64::max);
        let at = |side: f64| Plane::new(point + *normal * (2.0 * side * farthest), normal);
        self.claims.add(at(-1.0), at(1.0), faces);
    }

    /// The same front, looked at from the other side.
    fn reversed(&mut self, front: &Front) -> Option<Front> {
        let plane = Plane::new(front.plane.point, -front.plane.normal);
        // Points on the plane count as above on either side, so the crossed sides may differ.
        let start =
            front.contour.half_edges.iter().find_map(|h| entry(self.mesh(), &plane, h.face()));
        let extent = self.follow(&plane, start?, |_| true)?;
        Some(Front { plane, contour: self.contour.clone(), extent })
    }

    /// Marches on from the last front along its normal until no step of `finest` is possible. The first
    /// step may have been made already.
    fn go_on(
        &mut self,
        Way { fronts, part }: &mut Way,
        finest: f64,
        mut first: Option<Result<Front, Stop>>,
        observer: &mut impl Observer,
    ) -> Result<(), SkeletonError> {
        // Every step advances by at least a sixteenth of a radius and no band is passed twice; the
        // count ends a march towards the tip of a needle, where radii and steps go to nothing.
        while *part >= finest && (1..MOST_FRONTS).contains(&fronts.len()) {
            keep_on(observer)?;
            match first.take().unwrap_or_else(|| self.advance(fronts, *part)) {
                Ok(front) => {
                    let (lower, upper) = (fronts[fronts.len() - 1].plane, front.plane);
                    self.claims.add(lower, upper, self.band.faces());
                    fronts.push(front);
                    *part = f64::min(1.0, 2.0 * *part);
                }
                Err(Stop::Passed) => *part = 0.0,
                Err(_) => *part *= 0.5,
            }
        }
        Ok(())
    }

    /// One step of the march, `part` of the wanted step long.
    fn advance(&mut self, fronts: &[Front], part: f64) -> Result<Front, Stop> {
        let last = &fronts[fronts.len() - 1];
        let radius = last.extent.radius();
        // A band of a rod has no less area than that of a round one.
        let step = part * f64::max(STEP * radius, self.least_band / (TAU * radius));
        let direction = last.plane.normal;
        let (plane, ahead) =
            self.cut_ahead(fronts, last.extent.centroid + *direction * step, direction)?;
        let base = behind(fronts, BASE_OF_DIRECTION * radius);
        let turned = Unit::try_new(ahead.centroid - base.extent.centroid, 1e-9 * radius)
            .unwrap_or(direction);
        let turned = if fronts.len() < 3 { direction } else { turned };
        if turned.dot(&direction) < LARGEST_TURN {
            return Err(Stop::Bends);
        }
        let around = self.box_round(fronts, ahead.centroid, direction);
        let stays = turned.cross(&direction).norm_squared() <= SAME_DIRECTION * SAME_DIRECTION
            && self.contour.points.iter().all(|p| around.spans(p));
        let (plane, extent) =
            if stays { (plane, ahead) } else { self.cut_ahead(fronts, ahead.centroid, turned)? };
        let next = Front { plane, contour: self.contour.clone(), extent };
        self.claim_check(last, &next)?;
        Ok(next)
    }

    /// The identifier box of the step from the last front.
    fn box_round(
        &self,
        fronts: &[Front],
        centre: nalgebra::Point3<f64>,
        direction: Unit<Vector3<f64>>,
    ) -> IdentifierBox {
        let radius = fronts[fronts.len() - 1].extent.radius();
        let half_width = self.params.width_ratio * behind(fronts, radius).extent.reach;
        IdentifierBox::new(centre, direction, half_width, radius)
    }

    /// Cuts the surface across `direction` at `centre`, inside the identifier box; leaves the contour
    /// in `self.contour`.
    fn cut_ahead(
        &mut self,
        fronts: &[Front],
        centre: nalgebra::Point3<f64>,
        direction: Unit<Vector3<f64>>,
    ) -> Result<(Plane, Extent), Stop> {
        let last = &fronts[fronts.len() - 1];
        let one_behind = behind(fronts, last.extent.radius()).extent.radius();
        let ratio = self.params.width_ratio;
        let around = self.box_round(fronts, centre, direction);
        let plane = Plane::new(centre, direction);
        let stride = last.contour.half_edges.len().div_ceil(8).max(1);
        // Sides of contours that do not fit: where one is met again, so is what does not fit.
        let mut unfit: Vec<HalfEdgeId> = Vec::new();
        let mut stop = Stop::Ends;
        for h in last.contour.half_edges.iter().step_by(stride) {
            let Some(start) = climb(self.mesh(), &last.plane, &plane, h.face()) else { continue };
            if unfit.contains(&start) {
                continue;
            }
            if let Some(extent) = self.follow(&plane, start, |p| around.spans(p)) {
                let growth = extent.radius() / one_behind;
                if growth >= 1.0 / ratio && growth <= ratio {
                    return Ok((plane, extent));
                }
            }
            stop = Stop::Widens;
            unfit.extend(&self.contour.half_edges);
        }
        Err(stop)
    }

    /// Whether the band up to `next` is a plain, unpassed piece of the design part.
    fn claim_check(&mut self, last: &Front, next: &Front) -> Result<(), Stop> {
        let (h, p) = (&next.contour.half_edges, &next.contour.points);
        if h.iter().zip(p).any(|(h, p)| self.claims.holds(h.face(), p)) {
            return Err(Stop::Passed);
        }
        let labels = &self.surface.labels;
        match self.band.flood(self.mesh(), last, next, |f| labels.is_design(f)) {
            Verdict::Splits => Err(Stop::Splits),
            Verdict::FrontsCross => Err(Stop::Bends),
            Verdict::Foreign => Err(Stop::Interface),
            Verdict::Tube => Ok(()),
        }
    }

    /// Whether a front lies on unpassed design surface only.
    pub(crate) fn is_free(&self, front: &Front) -> bool {
        front.contour.half_edges.iter().zip(&front.contour.points).all(|(h, p)| {
            self.surface.labels.is_design(h.face()) && !self.claims.holds(h.face(), p)
        })
    }

    /// Follows the contour over the crossed side `start` into `self.contour`; what it encloses, if
    /// that is material and every point passes.
    pub(super) fn follow(
        &mut self,
        plane: &Plane,
        start: HalfEdgeId,
        keep_on: impl FnMut(&nalgebra::Point3<f64>) -> bool,
    ) -> Option<Extent> {
        let (mesh, contour) = (&self.surface.mesh, &mut self.contour);
        if !follow(mesh, plane, start, contour, keep_on) || contour.points.len() < 3 {
            return None;
        }
        let extent = Extent::of(contour, plane);
        (extent.area > 0.0).then_some(extent)
    }
}

/// From a triangle cut by `lower`, climbs over the surface to one cut by `upper`; its entry side.
fn climb(mesh: &HalfEdgeMesh, lower: &Plane, upper: &Plane, face: FaceId) -> Option<HalfEdgeId> {
    let height = |h: HalfEdgeId| lower.height(&mesh.position(mesh.origin(h)));
    let higher = |best: (HalfEdgeId, f64), h: HalfEdgeId| {
        let at = height(h);
        if at > best.1 { (h, at) } else { best }
    };
    let [a, b, c] = face.half_edges();
    let mut top = [b, c].into_iter().fold((a, height(a)), higher);
    loop {
        if upper.height(&mesh.position(mesh.origin(top.0))) >= 0.0 {
            // The triangle of `top` also has the vertex climbed from, which lies below.
            return entry(mesh, upper, top.0.face());
        }
        let next = mesh.fan(top.0).map(HalfEdgeId::next).fold(top, higher);
        if next.0 == top.0 {
            return None;
        }
        top = next;
    }
}
