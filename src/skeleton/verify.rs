//! Holds a skeleton against what always has to hold: inside the object, same topology.

use nalgebra::Point3;

use super::error::{SkeletonError, keep_on};
use super::graph::{PointKind, Skeleton};
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
    let places = skeleton.points.iter().map(|p| {
        let is_outside = !surface.tree.contains(&p.position);
        is_outside.then_some(p.position)
    });
    let lie = ["skeletal point lies outside the object", "skeletal points lie outside the object"];
    outside(places, lie, observer)
}

fn segments_outside(
    surface: &Surface,
    skeleton: &Skeleton,
    observer: &mut impl Observer,
) -> Result<Option<Finding>, SkeletonError> {
    let places = skeleton.segments().map(|segment| {
        let [a, b] = segment.map(|p| skeleton.position(p));
        surface.tree.is_crossed_by(&a, &b).then(|| nalgebra::center(&a, &b))
    });
    let leave =
        ["segment of the skeleton leaves the object", "segments of the skeleton leave the object"];
    outside(places, leave, observer)
}

/// A breach with the place of the first of those that lie outside; `words` for one and for many.
fn outside(
    places: impl Iterator<Item = Option<Point3<f64>>>,
    words: [&str; 2],
    observer: &mut impl Observer,
) -> Result<Option<Finding>, SkeletonError> {
    let (mut first, mut count) = (None, 0);
    for place in places {
        keep_on(observer)?;
        if let Some(place) = place {
            first.get_or_insert(place);
            count += 1;
        }
    }
    let text = counted(count, words[0], words[1]);
    Ok(first.map(|_| Finding::breach(FindingKind::Outside, first, text)))
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
