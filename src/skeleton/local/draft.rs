//! The graph of the skeleton before its points are placed: hubs and the runs between them.
//!
//! Every piece of the cut surface becomes a hub, every tube a run; interface sections become hubs
//! of their own. A piece between two tubes only is no junction (thesis §3.4.3.5): the tubes become
//! one run.

use nalgebra::{Point3, Unit, Vector3};

use super::axis::{Axis, axis_at_start};
use super::junction::meeting_point;
use super::patch::CutSide;
use super::search::Found;
use super::way::Tube;
use crate::mesh::id::HalfEdgeId;
use crate::mesh::{InterfaceKind, Surface};
use crate::skeleton::inside::end_in;

/// One section on the way of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Station {
    pub(crate) centroid: Point3<f64>,
    /// Across the section, along the run.
    pub(crate) direction: Unit<Vector3<f64>>,
    /// Radius of the disc of equal area, mm.
    pub(crate) radius: f64,
    /// Largest distance of the contour from the centroid, mm.
    pub(crate) reach: f64,
    /// A side the contour crosses.
    pub(crate) side: HalfEdgeId,
}

/// What a run ends in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HubKind {
    /// A piece of surface with several ends.
    Joint,
    /// An interface section.
    Interface(usize),
    /// A free end.
    Tip,
    /// A sharp bend of one branch.
    Knee,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Hub {
    pub(crate) kind: HubKind,
    pub(crate) position: Point3<f64>,
    /// A place the hub must keep.
    pub(crate) pinned: Option<Point3<f64>>,
    /// A joint in the middle of the material, not where the axes of its runs meet.
    pub(crate) is_centred: bool,
}

impl Hub {
    fn new(kind: HubKind, position: Point3<f64>) -> Self {
        Self { kind, position, pinned: None, is_centred: false }
    }
}

/// A branch to be: sections between two hubs.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub(crate) hubs: [usize; 2],
    pub(crate) stations: Vec<Station>,
}

impl Run {
    /// Median radius of the sections, mm; 0 without any.
    pub(crate) fn radius(&self) -> f64 {
        let mut radii: Vec<f64> = self.stations.iter().map(|s| s.radius).collect();
        if radii.is_empty() {
            return 0.0;
        }
        let middle = radii.len() / 2;
        *radii.select_nth_unstable_by(middle, f64::total_cmp).1
    }

    /// The section nearest to one of its ends.
    pub(crate) fn nearest_to(&self, end: usize) -> Option<&Station> {
        if end == 0 { self.stations.first() } else { self.stations.last() }
    }

    /// Whether it begins and ends in one hub.
    pub(crate) fn is_loop(&self) -> bool {
        self.hubs[0] == self.hubs[1]
    }

    /// Way along the centroids of the sections, mm.
    pub(crate) fn length(&self) -> f64 {
        self.stations.windows(2).map(|w| (w[1].centroid - w[0].centroid).norm()).sum()
    }

    /// The sections seen from end `end` (0: as they are, 1: backwards), directions turned along.
    pub(crate) fn seen_from(&self, end: usize) -> Vec<Station> {
        if end == 0 { self.stations.clone() } else { reversed(&self.stations) }
    }
}

pub(crate) fn reversed(stations: &[Station]) -> Vec<Station> {
    stations.iter().rev().map(|s| Station { direction: -s.direction, ..*s }).collect()
}

/// Hubs and runs; removed runs leave no trace, removed hubs stay without runs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Draft {
    pub(crate) hubs: Vec<Hub>,
    pub(crate) runs: Vec<Run>,
    /// Interface sections with a lump that no branch leaves.
    pub(crate) idle_interfaces: Vec<usize>,
    /// Closed bodies without any tube: a place on each.
    pub(crate) blobs: usize,
}

impl Draft {
    /// Joins the pieces and tubes of the cut surface.
    pub(crate) fn new(found: &Found, surface: &Surface) -> Self {
        let interfaces = &surface.interfaces;
        let mut draft = Self::default();
        let mut ends: Vec<[Option<usize>; 2]> = vec![[None; 2]; found.tubes.len()];
        draft.hubs.extend(
            interfaces
                .iter()
                .enumerate()
                .map(|(i, section)| Hub::new(HubKind::Interface(i), end_in(surface, section))),
        );
        for patch in &found.patches.all {
            let sections: Vec<usize> = patch
                .interfaces
                .iter()
                .copied()
                .filter(|&i| interfaces[i].kind == InterfaceKind::Section)
                .collect();
            let hub = match (patch.cuts.len(), sections.as_slice()) {
                (0, []) => {
                    draft.blobs += 1;
                    continue;
                }
                (0, &[i]) => {
                    draft.idle_interfaces.push(i);
                    continue;
                }
                (0, &[i, j]) => {
                    draft.runs.push(Run { hubs: [i, j], stations: Vec::new() });
                    continue;
                }
                (1, &[i]) => i,
                (1, []) => draft.add_hub(HubKind::Tip),
                _ => {
                    let joint = draft.add_hub(HubKind::Joint);
                    for &i in &sections {
                        draft.runs.push(Run { hubs: [joint, i], stations: Vec::new() });
                    }
                    joint
                }
            };
            for &(tube, side) in &patch.cuts {
                ends[tube][usize::from(side == CutSide::Above)] = Some(hub);
            }
        }
        for (tube, ends) in found.tubes.iter().zip(&ends) {
            if let [Some(a), Some(b)] = *ends {
                draft.runs.push(Run { hubs: [a, b], stations: stations_of(tube) });
            }
        }
        draft.place_roughly();
        draft
    }

    pub(crate) fn add_hub(&mut self, kind: HubKind) -> usize {
        self.hubs.push(Hub::new(kind, Point3::origin()));
        self.hubs.len() - 1
    }

    /// For each hub the runs that end there, with the end.
    pub(crate) fn incidences(&self) -> Vec<Vec<(usize, usize)>> {
        let mut at = vec![Vec::new(); self.hubs.len()];
        for (r, run) in self.runs.iter().enumerate() {
            at[run.hubs[0]].push((r, 0));
            at[run.hubs[1]].push((r, 1));
        }
        at
    }

    /// Puts joints in the middle of the sections next to them, tips on the last section.
    pub(crate) fn place_roughly(&mut self) {
        let at = self.incidences();
        for (hub, runs) in at.iter().enumerate() {
            if matches!(self.hubs[hub].kind, HubKind::Interface(_) | HubKind::Knee) {
                continue;
            }
            let near: Vec<Point3<f64>> = runs
                .iter()
                .map(|&(r, end)| {
                    let run = &self.runs[r];
                    let station = run.nearest_to(end);
                    station.map_or(self.hubs[run.hubs[1 - end]].position, |s| s.centroid)
                })
                .collect();
            if !near.is_empty() {
                let sum: Vector3<f64> = near.iter().map(|p| p.coords).sum();
                self.hubs[hub].position = Point3::from(sum / near.len() as f64);
            }
        }
    }

    /// Makes one run of the two at every joint that has only two (thesis §3.4.3.5), or a knee of
    /// the joint where their axes meet at an angle.
    pub(crate) fn remove_false_joints(&mut self, surface: &Surface) {
        let mut at = self.incidences();
        for hub in 0..self.hubs.len() {
            let &[(r, end), (s, other_end)] = at[hub].as_slice() else { continue };
            if self.hubs[hub].kind != HubKind::Joint || r == s {
                continue;
            }
            let legs = [self.runs[r].seen_from(end), self.runs[s].seen_from(other_end)];
            if let Some(place) = knee(&legs).filter(|p| surface.tree.contains(p)) {
                self.hubs[hub].kind = HubKind::Knee;
                self.hubs[hub].position = place;
                continue;
            }
            // … → hub → …, oriented so that the first run ends and the second begins here.
            let (from, to) = (self.runs[r].hubs[1 - end], self.runs[s].hubs[1 - other_end]);
            let [first, second] = legs;
            self.runs[r] = Run { hubs: [from, to], stations: [reversed(&first), second].concat() };
            self.runs[s].stations.clear();
            self.runs[s].hubs = [usize::MAX; 2];
            at[hub].clear();
            replace(&mut at[from], (r, 1 - end), (r, 0));
            replace(&mut at[to], (s, 1 - other_end), (r, 1));
        }
        self.runs.retain(|r| r.hubs[0] != usize::MAX);
    }
}

/// A bend of less than this is smoothed by the points along it: 20°.
const STRAIGHT_ON: f64 = 0.94;

/// Axes of a knee pass each other by no more than this part of their radius.
const KNEE_MISSES: f64 = 0.5;

/// A knee lies no farther than this many radii beyond where its legs part, r / tan(θ/2) from it.
const KNEE_REACH: f64 = 3.0;

/// Where the straight axes of two legs, each seen from their common end, meet at an angle.
fn knee(legs: &[Vec<Station>; 2]) -> Option<Point3<f64>> {
    let [a, b] = [axis_at_start(&legs[0])?, axis_at_start(&legs[1])?];
    let cosine = a.direction.dot(&b.direction);
    if !(-STRAIGHT_ON..STRAIGHT_ON).contains(&cosine) {
        return None;
    }
    let meeting =
        meeting_point(&[a, b], &nalgebra::center(&legs[0][0].centroid, &legs[1][0].centroid));
    // 1 / tan(θ/2), in radii.
    let parting = ((1.0 + cosine) / (1.0 - cosine)).sqrt();
    let fits = |axis: &Axis, leg: &[Station]| {
        let ahead = (leg[0].centroid - meeting).dot(&axis.direction);
        axis.distance(&meeting) <= 0.5 * KNEE_MISSES * axis.radius
            && ahead <= (KNEE_REACH + parting) * axis.radius
            && ahead >= -axis.radius
    };
    (fits(&a, &legs[0]) && fits(&b, &legs[1])).then_some(meeting)
}

fn replace(list: &mut [(usize, usize)], old: (usize, usize), new: (usize, usize)) {
    if let Some(entry) = list.iter_mut().find(|e| **e == old) {
        *entry = new;
    }
}

pub(crate) fn stations_of(tube: &Tube) -> Vec<Station> {
    tube.fronts
        .iter()
        .map(|f| Station {
            centroid: f.extent.centroid,
            direction: f.plane.normal,
            radius: f.extent.radius(),
            reach: f.extent.reach,
            side: f.contour.half_edges[0],
        })
        .collect()
}
