//! The march in the global frame: the thesis as written (chapter 3).
//!
//! ```text
//!     ┌──────┐ x_p              the identifier box stays aligned with x, y and z; it is as long as
//!  ●──┼──●───┼──●  ───►         l_b along the marching direction and as wide as what it holds
//!     └──────┘
//! ```
//!
//! | step | thesis | function |
//! |---|---|---|
//! | marching direction at an interface section | §3.4.2.1 | `Direction::nearest` |
//! | l_b and the first identifier box | §3.4.2.2, eq. (3.1) | `leave_interface` |
//! | dimension adjustment | §3.4.2.3 | `Scanner::pieces` |
//! | skeletal point as barycentre of nodes | §3.4.2.4–5, eq. (3.2) | `skeletal_point` |
//! | junction where the box widens by 1.3 | §3.4.2.6, §3.4.3.2 a | `Marcher::junction_in` |
//! | saving and updating junctions | §3.4.2.7–8, §3.4.3.4 | `Sketch::add_junction`, `update_junction` |
//! | change of direction when the box is vacant | §3.4.2.8, fig. 3.24 | `Marcher::ahead` |
//! | upcoming branches at a junction, six directions | §3.4.3.1 | `investigate` |
//! | update of the junction box | §3.4.3.1, fig. 3.28 | `extend_junction_box` |
//! | known junction: distance, overlap | §3.4.3.2 b, c | `Sketch::junction_at` |
//! | initial cube of 2 l_b | §3.4.3.3, fig. 3.35 | `Marcher::straight_on` |
//! | regeneration check | §3.4.3.3, fig. 3.36 | `Sketch::was_generated` |
//! | removal of false junctions | §3.4.3.5 | `Sketch::finish` |
//!
//! It is kept to be compared with. Where it fails (§5.2.1: struts near the diagonals of the frame,
//! thin struts at thick junctions) its findings say so; the default is [`local`](super::local).
//!
//! # What differs from the thesis
//!
//! * The minimum of eq. (3.1) is taken over the two directions across the march: along it the design
//!   triangles at an interface are one triangle deep, however thick the strut.
//! * Lengths are relative: the negligible 0.1 of §3.4.3.1 is a tenth of l_b.
//! * The box goes on with what hangs together with the last box; struts that merely pass through the
//!   same box are left alone. At a junction each separate piece is asked for a branch.
//! * Without labels a march starts at the outermost places in the six directions.

mod branch;
mod direction;
mod identifier_box;
mod scan;
mod sketch;
#[cfg(test)]
mod test_bars;

use std::ops::ControlFlow;

use self::branch::{End, Marcher, Origin, Start};
use self::direction::Direction;
use self::identifier_box::IdentifierBox;
use self::scan::{MOST_LOOKS, Piece, Scanner};
use self::sketch::Sketch;
use super::Marched;
use super::error::SkeletonError;
use super::graph::{PointKind, SkeletalPoint};
use super::inside::end_in;
use super::params::SkeletonParams;
use crate::mesh::{InterfaceKind, InterfaceSection, Surface};
use crate::observer::{Observer, Stage};

/// Part of l_b by which a piece must stand out of a junction box to be a branch: the 0.1 of
/// §3.4.3.1, made relative.
const NEGLIGIBLE: f64 = 0.1;

/// Boxes by which a junction box may grow along the branch that found it. The thickest junction of
/// the thesis takes two (fig. 3.28).
const LONGEST_JUNCTION: usize = 8;

/// A branch from a junction into nothing with fewer points than this is a bulge of the junction.
const SHORTEST_FREE: usize = 3;

/// Marches the skeleton of a surface in the global frame.
///
/// # Errors
/// Nowhere to start from, or the observer asked to stop.
pub fn skeleton(
    surface: &Surface,
    params: &SkeletonParams,
    observer: &mut impl Observer,
) -> Result<Marched, SkeletonError> {
    let mut run = Run::new(surface, params)?;
    let starts = run.starts(surface);
    for (i, start) in starts.iter().enumerate() {
        check(observer, i, starts.len())?;
        run.branch_from(start.clone());
        run.check_end()?;
    }
    // Junctions found on the way are appended and investigated in their turn (§3.4.3).
    let mut next = 0;
    while next < run.sketch.junctions.len() && next < run.most_junctions {
        check(observer, next, run.sketch.junctions.len())?;
        run.investigate(next);
        run.check_end()?;
        next += 1;
    }
    let skeleton = run.sketch.finish();
    if skeleton.branches.is_empty() {
        return Err(SkeletonError::NoBranch { starts: starts.len() });
    }
    Ok(Marched { skeleton, findings: Vec::new() })
}

fn check(observer: &mut impl Observer, done: usize, total: usize) -> Result<(), SkeletonError> {
    match observer.progress(Stage::Skeleton, done, total) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(SkeletonError::Cancelled),
    }
}

/// One march over a whole surface.
struct Run<'a> {
    marcher: Marcher<'a>,
    sketch: Sketch,
    /// Point of each interface section, once a branch has reached it.
    point_of_interface: Vec<Option<u32>>,
    surface: &'a Surface,
    interfaces: &'a [InterfaceSection],
    /// l_b where no interface section gives one, mm.
    mean_radius: f64,
    /// Every junction has a node of its own at least.
    most_junctions: usize,
}

impl<'a> Run<'a> {
    fn new(surface: &'a Surface, params: &SkeletonParams) -> Result<Self, SkeletonError> {
        let scanner = Scanner::new(surface);
        let near = surface.mesh.positions()[0];
        let nodes = scanner.nodes().iter().map(|&v| scanner.position(v));
        let extent = IdentifierBox::around(nodes).ok_or(SkeletonError::NotBeamLike { near })?;
        let mut interface_of = vec![None; surface.mesh.positions().len()];
        for (i, section) in surface.interfaces.iter().enumerate() {
            if section.kind == InterfaceKind::Section {
                for h in &section.half_edges {
                    interface_of[surface.mesh.origin(*h).index()] = Some(i);
                }
            }
        }
        Ok(Self {
            most_junctions: scanner.nodes().len(),
            marcher: Marcher { scanner, interface_of, width_ratio: params.width_ratio, extent },
            sketch: Sketch::default(),
            point_of_interface: vec![None; surface.interfaces.len()],
            surface,
            interfaces: &surface.interfaces,
            mean_radius: surface.mean_radius(),
        })
    }

    /// An error once the march has looked at the part so often that it will not come to its end.
    fn check_end(&self) -> Result<(), SkeletonError> {
        if self.marcher.scanner.is_spent() {
            let branches = self.sketch.chains();
            return Err(SkeletonError::Endless { looks: MOST_LOOKS, branches });
        }
        Ok(())
    }

    /// Where marches begin: interface sections, or the outermost places.
    fn starts(&mut self, surface: &Surface) -> Vec<Start> {
        let sections: Vec<Start> = self
            .interfaces
            .iter()
            .enumerate()
            .filter(|(_, section)| section.kind == InterfaceKind::Section)
            .filter_map(|(i, section)| leave_interface(surface, i, section))
            .collect();
        if sections.is_empty() { self.outermost() } else { sections }
    }

    /// The pieces that reach farthest in each of the six directions.
    fn outermost(&mut self) -> Vec<Start> {
        let step = self.mean_radius;
        let mut starts = Vec::new();
        for outwards in Direction::ALL {
            let direction = outwards.reversed();
            let mut bounds = self.marcher.extent;
            if outwards.is_positive {
                bounds.low[outwards.axis] = bounds.high[outwards.axis];
            } else {
                bounds.high[outwards.axis] = bounds.low[outwards.axis];
            }
            for piece in self.marcher.scanner.pieces(&bounds.next(direction, step), direction) {
                let bounds = bounds.adjusted(&piece.extent, direction);
                let nodes = piece.nodes.clone();
                let first = Some(piece);
                starts.push(Start {
                    origin: Origin::FreeEnd,
                    direction,
                    bounds,
                    nodes,
                    first,
                    step,
                });
            }
        }
        starts
    }

    /// Marches one branch and saves what it ends in.
    fn branch_from(&mut self, start: Start) {
        let (origin, step) = (start.origin, start.step);
        if matches!(origin, Origin::Interface(i) if self.point_of_interface[i].is_some()) {
            return; // Reached by a branch from elsewhere: marching back would regenerate it.
        }
        let (mut points, end) = self.marcher.march(start, &self.sketch);
        let last = match end {
            End::Regenerated => return,
            End::Widens { bounds, axis, before, direction } => {
                let bounds = self.extend_junction_box(bounds, &before, direction, step);
                let junction = self.sketch.add_junction(bounds, axis, step);
                Some(self.sketch.junctions[junction].point)
            }
            End::Junction { junction, met } => {
                self.sketch.update_junction(junction, &met);
                Some(self.sketch.junctions[junction].point)
            }
            // A branch that left this section came this way.
            End::Interface(i) if self.point_of_interface[i].is_some() => return,
            End::Interface(i) => Some(self.interface_point(i)),
            End::Vacant if points.len() < SHORTEST_FREE => return,
            End::Vacant => None,
        };
        if origin == Origin::FreeEnd
            && let Some(first) = points.first_mut()
        {
            first.kind = PointKind::End;
        }
        if last.is_none()
            && let Some(point) = points.last_mut()
        {
            point.kind = PointKind::End;
        }
        let mut chain: Vec<u32> = match origin {
            Origin::Interface(i) => vec![self.interface_point(i)],
            Origin::Junction(j) => vec![self.sketch.junctions[j].point],
            Origin::FreeEnd => Vec::new(),
        };
        chain.extend(points.into_iter().map(|p| self.sketch.add_point(p)));
        chain.extend(last);
        if chain.len() > 1 {
            self.sketch.add_chain(chain);
        }
    }

    /// The non-design skeletal point of an interface section (§3.4.1.2).
    fn interface_point(&mut self, i: usize) -> u32 {
        let section = &self.interfaces[i];
        let point = SkeletalPoint {
            position: end_in(self.surface, section),
            radius: section.radius(),
            kind: PointKind::Interface,
        };
        let sketch = &mut self.sketch;
        *self.point_of_interface[i].get_or_insert_with(|| sketch.add_point(point))
    }

    /// Adds to a junction box the boxes ahead that are still wider than the branch by the ratio
    /// (§3.4.3.1, fig. 3.28).
    fn extend_junction_box(
        &mut self,
        mut bounds: IdentifierBox,
        before: &IdentifierBox,
        direction: Direction,
        step: f64,
    ) -> IdentifierBox {
        let mut last = bounds;
        for _ in 0..LONGEST_JUNCTION {
            let seed = last.next(direction, step);
            let pieces = self.marcher.scanner.pieces(&seed, direction);
            // Where the box falls apart the branches have left the junction.
            let [piece] = pieces.as_slice() else { break };
            last = seed.adjusted(&piece.extent, direction);
            if last.growth_over(before, direction).0 < self.marcher.width_ratio {
                break;
            }
            bounds = bounds.joined(&last);
        }
        bounds
    }

    /// Looks for upcoming branches in all six directions of a junction (§3.4.3.1).
    fn investigate(&mut self, junction: usize) {
        for direction in Direction::ALL {
            let known = self.sketch.junctions[junction].clone();
            for piece in self.pieces_beyond(&known.bounds, direction, known.widened, known.step) {
                self.branch_from(Start {
                    origin: Origin::Junction(junction),
                    direction,
                    bounds: known.bounds,
                    nodes: piece.nodes.clone(),
                    first: Some(piece),
                    step: known.step,
                });
            }
        }
    }

    /// The pieces one step beyond a junction box that stand out of it.
    fn pieces_beyond(
        &mut self,
        bounds: &IdentifierBox,
        direction: Direction,
        widened: usize,
        step: f64,
    ) -> Vec<Piece> {
        let seed = bounds.next(direction, step);
        let mut pieces = self.marcher.scanner.pieces(&seed, direction);
        if pieces.is_empty() && widened == direction.axis {
            // A vacant box where the branch widened: twice the cube (fig. 3.30).
            let wider = seed.grown_across(direction, 0.5 * step);
            pieces = self.marcher.scanner.pieces(&wider, direction);
        }
        let [face, far] = [bounds.low, bounds.high].map(|p| direction.height(&p));
        let face = face.max(far);
        pieces.retain(|p| {
            let [a, b] = [p.extent.low, p.extent.high].map(|q| direction.height(&q));
            a.max(b) - face >= NEGLIGIBLE * step
        });
        pieces
    }
}

/// The start at an interface section: direction (§3.4.2.1), l_b and box (§3.4.2.2).
fn leave_interface(surface: &Surface, i: usize, section: &InterfaceSection) -> Option<Start> {
    let nodes: Vec<u32> = section.half_edges.iter().map(|h| surface.mesh.origin(*h).0).collect();
    let positions =
        section.half_edges.iter().map(|h| surface.mesh.position(surface.mesh.origin(*h)));
    let mut bounds = IdentifierBox::around(positions)?;
    let direction = Direction::nearest(&section.normal);
    let [a, b] = direction.axes_across();
    let step = 0.5 * f64::min(bounds.width(a), bounds.width(b));
    if step <= 0.0 {
        return None;
    }
    // One side of the box lies on the interface section.
    let axis = direction.axis;
    let plane = section.centroid[axis];
    (bounds.low[axis], bounds.high[axis]) = (plane, plane);
    Some(Start { origin: Origin::Interface(i), direction, bounds, nodes, first: None, step })
}
