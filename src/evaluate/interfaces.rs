//! The interface sections as the criterion sees them: centres, and the size of the cube.

use nalgebra::Point3;

use crate::mesh::id::SetId;
use crate::mesh::{InterfaceKind, Surface};
use crate::skeleton_file::LineGraph;

/// Loops below this part of the median loop area are label noise: they are neither a centre to
/// join nor do they count for the cube.
const SPECK: f64 = 0.02;

/// A skeletal point nearer to the centre of an interface section than this part of the mean radius
/// of the sections is that centre. Two sections are a hundred times as far apart.
pub(super) const AT_CENTRE: f64 = 0.02;

/// One interface section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interface {
    /// Area centroid, mm.
    pub(super) centre: Point3<f64>,
    /// Enclosed area, mm².
    pub(super) area: f64,
    /// Largest distance of a point of the loop from the centre, mm.
    pub(super) reach: f64,
    /// The non-design set beyond.
    pub(super) set: SetId,
    /// Whether material is behind the loop, not the opening of a hole.
    pub(super) is_section: bool,
}

/// The interface sections of a mesh.
#[derive(Clone, Debug, Default)]
pub(super) struct Interfaces {
    pub(super) all: Vec<Interface>,
    /// Loops left out as label noise.
    pub(super) dropped: usize,
}

impl Interfaces {
    pub(super) fn of(surface: &Surface) -> Self {
        let mut areas: Vec<f64> = surface.interfaces.iter().map(|i| i.area).collect();
        areas.sort_by(f64::total_cmp);
        let least = SPECK * median(&areas).unwrap_or(0.0);
        let all: Vec<Interface> = surface
            .interfaces
            .iter()
            .filter(|i| i.half_edges.len() >= 3 && i.area > least)
            .map(|i| {
                let points = i.half_edges.iter().map(|&h| surface.mesh.origin(h));
                let distances = points.map(|v| (surface.mesh.position(v) - i.centroid).norm());
                Interface {
                    centre: i.centroid,
                    area: i.area,
                    reach: distances.fold(0.0, f64::max),
                    set: i.set,
                    is_section: i.kind == InterfaceKind::Section,
                }
            })
            .collect();
        let dropped = surface.interfaces.len() - all.len();
        Self { all, dropped }
    }

    /// Largest distance of a loop point from its centre, mm; `None` without interface sections.
    pub(super) fn largest_reach(&self) -> Option<f64> {
        self.all.iter().map(|i| i.reach).reduce(f64::max).filter(|&r| r > 0.0)
    }

    /// Distance within which a point is a centre, mm.
    pub(super) fn at_centre(&self) -> f64 {
        let mean = self.all.iter().map(|i| i.area).sum::<f64>() / self.all.len().max(1) as f64;
        AT_CENTRE * (mean / std::f64::consts::PI).sqrt()
    }

    /// The interface section whose centre is nearest to a point, with its distance, mm.
    pub(super) fn nearest(&self, p: &Point3<f64>) -> Option<(usize, f64)> {
        let distances = self.all.iter().map(|i| (i.centre - p).norm()).enumerate();
        distances.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Whether a point is the centre of an interface section.
    pub(super) fn is_centre(&self, p: &Point3<f64>) -> bool {
        self.nearest(p).is_some_and(|(_, distance)| distance < self.at_centre())
    }

    /// Marks the skeletal points that are centres of interface sections.
    pub(super) fn mark(&self, graph: &mut LineGraph) {
        for p in graph.indices() {
            if self.is_centre(&graph.position(p)) {
                graph.mark_interface(p);
            }
        }
    }
}

/// The middle value of a sorted list; of an even number of values the mean of the two.
pub(super) fn median(sorted: &[f64]) -> Option<f64> {
    let half = sorted.len() / 2;
    let upper = *sorted.get(half)?;
    Some(if sorted.len() % 2 == 1 { upper } else { (sorted[half - 1] + upper) / 2.0 })
}
