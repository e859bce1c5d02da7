//! Marches one branch in the global frame (thesis §3.4.2.3–3.4.2.6, §3.4.3.2–3.4.3.3).

use rustc_hash::FxHashSet;

use super::direction::Direction;
use super::identifier_box::IdentifierBox;
use super::scan::{Piece, Scanner};
use super::sketch::Sketch;
use crate::skeleton::graph::{PointKind, SkeletalPoint};

/// Where a branch comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    Interface(usize),
    Junction(usize),
    FreeEnd,
}

/// What a branch begins with.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    pub(crate) origin: Origin,
    pub(crate) direction: Direction,
    /// The box the branch leaves.
    pub(crate) bounds: IdentifierBox,
    /// Nodes the branch must hang together with; empty where any will do.
    pub(crate) nodes: Vec<u32>,
    /// The first piece, where it has been found already.
    pub(crate) first: Option<Piece>,
    /// l_b, mm.
    pub(crate) step: f64,
}

/// How a branch ends.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum End {
    /// A new junction: its box, and the axis along which the identifier box widened.
    Widens { bounds: IdentifierBox, axis: usize, before: IdentifierBox, direction: Direction },
    /// A known junction, met by this box.
    Junction { junction: usize, met: IdentifierBox },
    /// An interface section.
    Interface(usize),
    /// Nothing lies ahead in any direction.
    Vacant,
    /// The branch had been generated before.
    Regenerated,
}

/// What all branches are marched with.
pub(crate) struct Marcher<'a> {
    pub(crate) scanner: Scanner<'a>,
    /// Interface section that each node lies on.
    pub(crate) interface_of: Vec<Option<usize>>,
    /// Growth at which a junction begins (§3.4.2.6).
    pub(crate) width_ratio: f64,
    /// Extent of the design part.
    pub(crate) extent: IdentifierBox,
}

/// A box on the way of a branch.
struct Station {
    direction: Direction,
    bounds: IdentifierBox,
    piece: Piece,
}

impl Marcher<'_> {
    /// Marches from a start to the end of the branch; the skeletal points on the way.
    ///
    /// A box that widens is a junction even where it holds nodes of an interface section: a stem across
    /// the march lies in it whole, down to its end.
    pub(crate) fn march(&mut self, start: Start, known: &Sketch) -> (Vec<SkeletalPoint>, End) {
        let Start { origin, mut direction, mut bounds, nodes, mut first, step } = start;
        let mut last: FxHashSet<u32> = nodes.into_iter().collect();
        let left = if let Origin::Junction(j) = origin { Some(j) } else { None };
        let mut points: Vec<SkeletalPoint> = Vec::new();
        for _ in 0..self.most_steps(step) {
            let found = match first.take() {
                Some(piece) => Some(station(&bounds, direction, step, piece)),
                None => self.ahead(&bounds, direction, step, &last, &points),
            };
            let Some(next) = found else { return (points, End::Vacant) };
            direction = next.direction;
            let is_first = points.is_empty();
            let from_interface = matches!(origin, Origin::Interface(_));
            if is_first && !from_interface && known.was_generated(&next.piece.barycentre, step) {
                return (points, End::Regenerated);
            }
            if let Some(end) = self.junction_in(&next, &bounds, left, is_first, known) {
                return (points, end);
            }
            if let Some(i) = self.interface_in(&next.piece, origin) {
                return (points, End::Interface(i));
            }
            points.push(skeletal_point(&next));
            bounds = next.bounds;
            last = next.piece.nodes.into_iter().collect();
        }
        (points, End::Vacant)
    }

    /// A march passes the part a few times at most, whichever way it turns.
    fn most_steps(&self, step: f64) -> usize {
        let along: f64 = (0..3).map(|k| self.extent.width(k) / step).sum();
        4 * along.min(1e6) as usize + 16
    }

    /// The next box: straight on, with an initial cube twice as large (§3.4.3.3, fig. 3.35), or in
    /// another direction (§3.4.2.8, fig. 3.24).
    fn ahead(
        &mut self,
        bounds: &IdentifierBox,
        direction: Direction,
        step: f64,
        last: &FxHashSet<u32>,
        points: &[SkeletalPoint],
    ) -> Option<Station> {
        if let Some(piece) = self.straight_on(bounds, direction, step, last) {
            return Some(station(bounds, direction, step, piece));
        }
        direction.alternatives().find_map(|d| {
            let piece = self.straight_on(bounds, d, step, last)?;
            let was_there = |p: &SkeletalPoint| (p.position - piece.barycentre).norm() < 0.5 * step;
            (!points.iter().any(was_there)).then(|| station(bounds, d, step, piece))
        })
    }

    fn straight_on(
        &mut self,
        bounds: &IdentifierBox,
        direction: Direction,
        step: f64,
        last: &FxHashSet<u32>,
    ) -> Option<Piece> {
        let seed = bounds.next(direction, step);
        for seed in [seed, seed.grown_across(direction, 0.5 * step)] {
            let pieces = self.scanner.pieces(&seed, direction);
            let joined = pieces.iter().position(|p| last.is_empty() || self.hangs_on(p, last));
            if let Some(i) = joined {
                return pieces.into_iter().nth(i);
            }
        }
        None
    }

    /// Whether a piece shares a node or an edge with the nodes of the last box.
    fn hangs_on(&self, piece: &Piece, last: &FxHashSet<u32>) -> bool {
        piece
            .nodes
            .iter()
            .any(|&v| last.contains(&v) || self.scanner.neighbours(v).any(|w| last.contains(&w)))
    }

    fn interface_in(&self, piece: &Piece, origin: Origin) -> Option<usize> {
        let on = piece.nodes.iter().filter_map(|&v| self.interface_of[v as usize]);
        on.filter(|&i| origin != Origin::Interface(i)).min()
    }

    /// The three ways to identify a junction (§3.4.3.2): a known one nearby, one whose box overlaps,
    /// or a box that widens past the ratio.
    fn junction_in(
        &self,
        next: &Station,
        before: &IdentifierBox,
        left: Option<usize>,
        is_first: bool,
        known: &Sketch,
    ) -> Option<End> {
        if let Some(junction) = known.junction_at(&next.piece.barycentre, &next.bounds, left) {
            return Some(End::Junction { junction, met: next.bounds });
        }
        // An interface section, or the box of the junction that is left, is no box to compare with.
        if is_first {
            return None;
        }
        let (growth, axis) = next.bounds.growth_over(before, next.direction);
        (growth > self.width_ratio).then_some(End::Widens {
            bounds: next.bounds,
            axis,
            before: *before,
            direction: next.direction,
        })
    }
}

fn station(bounds: &IdentifierBox, direction: Direction, step: f64, piece: Piece) -> Station {
    let bounds = bounds.next(direction, step).adjusted(&piece.extent, direction);
    Station { direction, bounds, piece }
}

/// The barycentre of the nodes in the box, eq. (3.2).
fn skeletal_point(station: &Station) -> SkeletalPoint {
    let [a, b] = station.direction.axes_across();
    let radius = 0.25 * (station.bounds.width(a) + station.bounds.width(b));
    SkeletalPoint { position: station.piece.barycentre, radius, kind: PointKind::Branch }
}

#[cfg(test)]
mod tests {
    use super::super::test_bars::{LENGTH, bars};
    use super::*;
    use crate::mesh::Surface;
    use nalgebra::Point3;

    fn marcher(surface: &Surface) -> Marcher<'_> {
        let nodes = surface.mesh.positions();
        Marcher {
            scanner: Scanner::new(surface),
            interface_of: vec![None; nodes.len()],
            width_ratio: 1.3,
            extent: IdentifierBox::around(nodes.iter().copied()).expect("nodes"),
        }
    }

    /// From the end of the first bar at x = 0, two rings a step.
    fn start() -> Start {
        let end = [Point3::new(-0.5, 0.0, 0.0), Point3::new(-0.5, 1.0, 1.0)];
        Start {
            origin: Origin::FreeEnd,
            direction: Direction { axis: 0, is_positive: true },
            bounds: IdentifierBox::around(end).expect("two points"),
            nodes: Vec::new(),
            first: None,
            step: 2.0,
        }
    }

    #[test]
    fn a_straight_bar_gives_the_middle_of_every_box_and_ends_with_nothing_ahead() {
        let surface = bars(&[0.0]);
        let (points, end) = marcher(&surface).march(start(), &Sketch::default());
        assert_eq!(end, End::Vacant);
        let x: Vec<f64> = points.iter().map(|p| p.position.x).collect();
        assert_eq!(x, [0.5, 2.5, 4.5, 6.5, 8.5, LENGTH as f64]);
        assert!(points.iter().all(|p| p.position.y == 0.5 && p.position.z == 0.5));
        assert!(points.iter().all(|p| p.radius == 0.5));
    }

    #[test]
    fn a_box_that_meets_a_known_junction_ends_the_branch_there() {
        let surface = bars(&[0.0]);
        let mut known = Sketch::default();
        let bounds = IdentifierBox::cube(Point3::new(7.0, 0.5, 0.5), 1.0);
        let junction = known.add_junction(bounds, 1, 2.0);
        let (points, end) = marcher(&surface).march(start(), &known);
        assert!(matches!(end, End::Junction { junction: j, .. } if j == junction), "{end:?}");
        assert!(points.iter().all(|p| p.position.x < 6.5));
    }

    #[test]
    fn a_box_that_reaches_an_interface_section_ends_the_branch_there() {
        let surface = bars(&[0.0]);
        let mut marcher = marcher(&surface);
        for (v, p) in surface.mesh.positions().iter().enumerate() {
            marcher.interface_of[v] = (p.x == LENGTH as f64).then_some(4);
        }
        let (points, end) = marcher.march(start(), &Sketch::default());
        assert_eq!(end, End::Interface(4));
        assert_eq!(points.len(), 5);
    }
}
