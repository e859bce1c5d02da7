//! Holds a skeleton against what always has to hold: inside the object, same topology.

use super::graph::{PointKind, Skeleton};
use super::local::patch::patches;
use crate::finding::{Finding, FindingKind};
use crate::mesh::{InterfaceKind, Surface};
use crate::wording::counted;

/// Components and independent cycles the skeleton of a surface must have: those of the design part
/// closed over its interface sections (of the whole mesh, without labels).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Homotopy {
    /// Connected parts.
    pub components: usize,
    /// Tunnels.
    pub cycles: usize,
}

impl Homotopy {
    /// Counts the components and tunnels of the design part.
    pub fn of(surface: &Surface) -> Self {
        let pieces =
            patches(&surface.mesh, |f| surface.labels.is_design(f), &[], &surface.interfaces);
        Self { components: pieces.all.len(), cycles: pieces.all.iter().map(|p| p.genus).sum() }
    }
}

/// All invariants that do not hold, each with the place of the first breach.
pub fn verify(surface: &Surface, skeleton: &Skeleton) -> Vec<Finding> {
    let mut findings = Vec::new();
    findings.extend(points_outside(surface, skeleton));
    findings.extend(segments_outside(surface, skeleton));
    findings.extend(topology(surface, skeleton));
    findings.extend(interface_ends(surface, skeleton));
    findings
}

fn points_outside(surface: &Surface, skeleton: &Skeleton) -> Option<Finding> {
    let mut outside = skeleton.points.iter().filter(|p| !surface.tree.contains(&p.position));
    let first = outside.next()?.position;
    Some(Finding::breach(FindingKind::Outside, Some(first), {
        let lie = ["skeletal point lies", "skeletal points lie"];
        format!("{} outside the object", counted(1 + outside.count(), lie[0], lie[1]))
    }))
}

fn segments_outside(surface: &Surface, skeleton: &Skeleton) -> Option<Finding> {
    let crosses = |[a, b]: &[u32; 2]| {
        surface.tree.is_crossed_by(&skeleton.position(*a), &skeleton.position(*b))
    };
    let mut leaving = skeleton.segments().filter(crosses);
    let [a, b] = leaving.next()?;
    let place = nalgebra::center(&skeleton.position(a), &skeleton.position(b));
    Some(Finding::breach(FindingKind::Outside, Some(place), {
        let leave = ["segment of the skeleton leaves", "segments of the skeleton leave"];
        format!("{} the object", counted(1 + leaving.count(), leave[0], leave[1]))
    }))
}

fn topology(surface: &Surface, skeleton: &Skeleton) -> Option<Finding> {
    let wanted = Homotopy::of(surface);
    let found = Homotopy { components: skeleton.components(), cycles: skeleton.cycle_rank() };
    (wanted != found).then(|| {
        Finding::breach(
            FindingKind::Topology,
            None,
            format!(
                "the skeleton has {} and {}, the design part {} and {}",
                counted(found.components, "component", "components"),
                counted(found.cycles, "cycle", "cycles"),
                wanted.components,
                wanted.cycles
            ),
        )
    })
}

fn interface_ends(surface: &Surface, skeleton: &Skeleton) -> Option<Finding> {
    let wanted = surface.interfaces.iter().filter(|i| i.kind == InterfaceKind::Section).count();
    let found = skeleton.count(PointKind::Interface);
    (found < wanted).then(|| {
        Finding::breach(
            FindingKind::IdleInterface,
            None,
            format!(
                "{found} of {} at the end of a branch",
                counted(wanted, "interface section is", "interface sections are")
            ),
        )
    })
}
