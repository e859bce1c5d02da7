//! Holds a skeleton against what always has to hold: inside the object, same topology.

use super::error::{SkeletonError, keep_on};
use super::graph::{PointKind, SkeletalPoint, Skeleton};
use super::local::patch::patches;
use crate::finding::{Finding, FindingKind};
use crate::mesh::{InterfaceKind, Surface};
use crate::observer::Observer;
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
///
/// # Errors
/// The observer asked to stop.
pub fn verify(
    surface: &Surface,
    skeleton: &Skeleton,
    observer: &mut impl Observer,
) -> Result<Vec<Finding>, SkeletonError> {
    let mut findings = Vec::new();
    findings.extend(points_outside(surface, skeleton, observer)?);
    findings.extend(segments_outside(surface, skeleton, observer)?);
    findings.extend(topology(surface, skeleton));
    findings.extend(interface_ends(surface, skeleton));
    Ok(findings)
}

fn points_outside(
    surface: &Surface,
    skeleton: &Skeleton,
    observer: &mut impl Observer,
) -> Result<Option<Finding>, SkeletonError> {
    let (mut first, mut count) = (None, 0);
    for SkeletalPoint { position, .. } in &skeleton.points {
        keep_on(observer)?;
        if !surface.tree.contains(position) {
            first.get_or_insert(*position);
            count += 1;
        }
    }
    Ok(first.map(|first| {
        let lie = counted(count, "skeletal point lies", "skeletal points lie");
        Finding::breach(FindingKind::Outside, Some(first), format!("{lie} outside the object"))
    }))
}

fn segments_outside(
    surface: &Surface,
    skeleton: &Skeleton,
    observer: &mut impl Observer,
) -> Result<Option<Finding>, SkeletonError> {
    let (mut first, mut count) = (None, 0);
    for segment in skeleton.segments() {
        keep_on(observer)?;
        let [a, b] = segment.map(|p| skeleton.position(p));
        if surface.tree.is_crossed_by(&a, &b) {
            first.get_or_insert(nalgebra::center(&a, &b));
            count += 1;
        }
    }
    Ok(first.map(|first| {
        let leave = ["segment of the skeleton leaves", "segments of the skeleton leave"];
        let leave = counted(count, leave[0], leave[1]);
        Finding::breach(FindingKind::Outside, Some(first), format!("{leave} the object"))
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
