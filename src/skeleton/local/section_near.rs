//! The section of a run at a point near one of its known sections.

use nalgebra::Point3;

use super::curve::way_to_each;
use super::draft::{Run, Station};
use crate::mesh::contour::{Contour, Extent, Plane, closed_round, entry, first_met};
use crate::mesh::id::HalfEdgeId;
use crate::mesh::{HalfEdgeMesh, Surface};

/// Sections that reach farther than this many times the last one are not the branch's own.
const REACH: f64 = 4.0;

/// The stations of a run with the way to each of them, to find the nearest of thousands.
pub(crate) struct Stations<'a> {
    all: &'a [Station],
    /// Way along the centroids from the first, mm.
    way: Vec<f64>,
}

impl<'a> Stations<'a> {
    pub(crate) fn of(run: &'a Run) -> Self {
        let way = way_to_each(run.stations.iter().map(|s| &s.centroid));
        Self { all: &run.stations, way }
    }

    /// The station nearest to a point, the first of those equally near; `part` 0..1 of the way says
    /// about where it is.
    ///
    /// No station is nearer than the last one looked at by more than the way between them: that many
    /// are passed over.
    fn nearest(&self, point: &Point3<f64>, part: f64) -> Option<&'a Station> {
        let distance = |i: usize| (self.all[i].centroid - point).norm_squared();
        let total = *self.way.last()?;
        let guess = self.way.partition_point(|w| *w < part * total);
        let bound = distance(guess.min(self.all.len().checked_sub(1)?)).sqrt();
        let (mut best, mut least, mut at) = (0, f64::INFINITY, 0);
        while at < self.all.len() {
            let here = distance(at);
            if here < least {
                (best, least) = (at, here);
            }
            let spare = here.sqrt() - bound.min(least.sqrt()) - ROUNDING * (total + bound);
            let beyond = self.way[at] + spare;
            at += 1;
            if spare > 0.0 {
                at += self.way[at..].partition_point(|w| *w < beyond);
            }
        }
        Some(&self.all[best])
    }
}

/// Rounding of a way, relative to its length; far more than that of thousands of additions.
const ROUNDING: f64 = 1e-9;

/// The section of the branch round the point of a plane, of design faces only; `part` 0..1 of the way
/// along the run the point lies about. Its contour is left in `contour`.
pub(crate) fn section_round(
    surface: &Surface,
    stations: &Stations<'_>,
    plane: &Plane,
    part: f64,
    contour: &mut Contour,
) -> Option<Extent> {
    let nearest = stations.nearest(&plane.point, part)?;
    let reach = REACH * nearest.reach;
    let Surface { mesh, tree, .. } = surface;
    let mut is_closed = |start| closed_round(mesh, plane, start, reach, contour);
    if !approach(mesh, plane, nearest.side).is_some_and(&mut is_closed)
        && !first_met(mesh, tree, plane, reach).is_some_and(is_closed)
    {
        return None;
    }
    extent_in_design(surface, contour, plane)
}

/// What a contour encloses, if that is material and only design faces are crossed.
pub(crate) fn extent_in_design(
    surface: &Surface,
    contour: &Contour,
    plane: &Plane,
) -> Option<Extent> {
    if contour.half_edges.iter().any(|h| !surface.labels.is_design(h.face())) {
        return None;
    }
    let extent = Extent::of(contour, plane);
    (extent.area > 0.0).then_some(extent)
}

/// From a side near the plane, walks over the surface to a triangle the plane cuts.
fn approach(mesh: &HalfEdgeMesh, plane: &Plane, from: HalfEdgeId) -> Option<HalfEdgeId> {
    if let Some(start) = entry(mesh, plane, from.face()) {
        return Some(start);
    }
    let height = |h: HalfEdgeId| plane.height(&mesh.position(mesh.origin(h)));
    // All corners lie on one side: walk the other way, down from above or up from below.
    let side = if height(from) >= 0.0 { 1.0 } else { -1.0 };
    let mut at = (from, side * height(from));
    loop {
        let next = mesh.fan(at.0).map(HalfEdgeId::next).fold(at, |best, h| {
            let away = side * height(h);
            if away < best.1 { (h, away) } else { best }
        });
        if next.0 == at.0 {
            return None;
        }
        if let Some(start) = entry(mesh, plane, next.0.face()) {
            return Some(start);
        }
        at = next;
    }
}

#[cfg(test)]
mod tests {
    use super::super::axis::tests::station;
    use super::*;

    #[test]
    fn the_nearest_section_is_found_whatever_is_guessed() {
        // A rod that bends back on itself and has its sections ever closer together.
        let at = |i: i32| {
            let s = f64::from(i) / 400.0;
            station([100.0 * s * s, 30.0 * (6.0 * s).sin(), 0.0], 1.0)
        };
        let run = Run { hubs: [0, 0], stations: (0..400).map(at).collect() };
        let stations = Stations::of(&run);
        for k in 0..200 {
            let point = Point3::new(f64::from(k), f64::from(k % 60 - 30), f64::from(k % 7));
            let far = |s: &Station| (s.centroid - point).norm();
            let least = run.stations.iter().map(far).fold(f64::INFINITY, f64::min);
            for part in [0.0, 0.3, 1.0] {
                let found = stations.nearest(&point, part).expect("a section");
                assert_eq!(far(found), least, "{point} from {part}");
            }
        }
    }
}
