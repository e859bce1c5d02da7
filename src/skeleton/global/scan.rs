//! Collects the nodes of the object between two planes across a global axis (thesis §3.4.2.3).
//!
//! ```text
//!        ┆        ┆          the nodes inside the initial box come first; then every design node
//!   ─────●──●──●──●─────     between the two planes that hangs together with them is added, and
//!        ┆┌┈┈┈┈┈┐┆           the box grows to hold them all
//!        ┆┊ box ┊┆
//!   ─────●──●──●──●─────
//!        ┆        ┆
//! ```

use nalgebra::Point3;

use super::direction::Direction;
use super::identifier_box::IdentifierBox;
use crate::mesh::Surface;
use crate::mesh::id::HalfEdgeId;

/// The design nodes that hang together in one identifier box.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    /// Numbers of the nodes, in the order they were reached.
    pub(crate) nodes: Vec<u32>,
    /// Smallest box around them.
    pub(crate) extent: IdentifierBox,
    /// Their barycentre, eq. (3.2).
    pub(crate) barycentre: Point3<f64>,
}

/// The design nodes of a surface, ready to be collected.
pub(crate) struct Scanner<'a> {
    surface: &'a Surface,
    /// Design nodes by coordinate, for each axis.
    sorted: [Vec<u32>; 3],
    /// A design half-edge that leaves each node.
    leaving: Vec<Option<HalfEdgeId>>,
    /// Number of the last collection that reached each node.
    stamps: Vec<u32>,
    stamp: u32,
    /// Nodes that collections may still look at.
    left: usize,
}

/// Times a march may look at every node of the part, on average. The parts of the thesis take up to 7,
/// meshes whose noise crosses itself 40.
pub(crate) const MOST_LOOKS: usize = 1000;

impl<'a> Scanner<'a> {
    pub(crate) fn new(surface: &'a Surface) -> Self {
        let mesh = &surface.mesh;
        let mut leaving = vec![None; mesh.positions().len()];
        for face in mesh.faces().filter(|f| surface.labels.is_design(*f)) {
            for h in face.half_edges() {
                leaving[mesh.origin(h).index()].get_or_insert(h);
            }
        }
        let nodes: Vec<u32> =
            (0..leaving.len() as u32).filter(|&v| leaving[v as usize].is_some()).collect();
        let sorted = [0, 1, 2].map(|axis| {
            let mut by_axis = nodes.clone();
            let at = |v: u32| mesh.positions()[v as usize][axis];
            by_axis.sort_by(|&v, &w| at(v).total_cmp(&at(w)).then(v.cmp(&w)));
            by_axis
        });
        let stamps = vec![0; leaving.len()];
        let left = MOST_LOOKS * nodes.len();
        Self { surface, sorted, leaving, stamps, stamp: 0, left }
    }

    pub(crate) fn position(&self, node: u32) -> Point3<f64> {
        self.surface.mesh.positions()[node as usize]
    }

    /// Design nodes joined to a node by an edge.
    pub(crate) fn neighbours(&self, node: u32) -> impl Iterator<Item = u32> + '_ {
        let (labels, mesh) = (&self.surface.labels, &self.surface.mesh);
        let fan = self.leaving[node as usize].into_iter().flat_map(|h| mesh.fan(h));
        fan.filter(|h| labels.is_design(h.face()))
            .flat_map(|h| [mesh.target(h).0, mesh.target(h.next()).0])
    }

    /// All design nodes, by their first coordinate.
    pub(crate) fn nodes(&self) -> &[u32] {
        &self.sorted[0]
    }

    /// Whether so many nodes have been looked at that the march will not come to its end; from then on
    /// nothing is found.
    pub(crate) fn is_spent(&self) -> bool {
        self.left == 0
    }

    /// Collects the pieces of the object that reach into a box, between its two faces across a
    /// direction; those with most nodes first.
    pub(crate) fn pieces(&mut self, seed: &IdentifierBox, direction: Direction) -> Vec<Piece> {
        let axis = direction.axis;
        let (from, to) = (seed.low[axis], seed.high[axis]);
        self.stamp += 1;
        let sorted = &self.sorted[axis];
        let first = sorted.partition_point(|&v| self.position(v)[axis] < from);
        let slab = &sorted[first..];
        let slab = &slab[..slab.partition_point(|&v| self.position(v)[axis] <= to)];
        let Some(left) = self.left.checked_sub(slab.len()) else {
            self.left = 0;
            return Vec::new();
        };
        let seeds: Vec<u32> =
            slab.iter().copied().filter(|&v| seed.contains(&self.position(v))).collect();
        self.left = left;
        let mut pieces: Vec<Piece> =
            seeds.into_iter().filter_map(|v| self.collect(v, axis, [from, to])).collect();
        pieces.sort_by_key(|p| std::cmp::Reverse(p.nodes.len()));
        pieces
    }

    /// Adds the connected design nodes between two planes.
    fn collect(&mut self, seed: u32, axis: usize, [from, to]: [f64; 2]) -> Option<Piece> {
        if std::mem::replace(&mut self.stamps[seed as usize], self.stamp) == self.stamp {
            return None;
        }
        let (surface, mesh) = (self.surface, &self.surface.mesh);
        let mut nodes = vec![seed];
        let mut next = 0;
        while let Some(&node) = nodes.get(next) {
            next += 1;
            let Some(start) = self.leaving[node as usize] else { continue };
            for h in mesh.fan(start).filter(|h| surface.labels.is_design(h.face())) {
                for reached in [mesh.target(h), mesh.target(h.next())] {
                    let stamp = &mut self.stamps[reached.index()];
                    let at = mesh.position(reached)[axis];
                    if *stamp != self.stamp && from <= at && at <= to {
                        *stamp = self.stamp;
                        nodes.push(reached.0);
                    }
                }
            }
        }
        let sum: nalgebra::Vector3<f64> = nodes.iter().map(|&v| self.position(v).coords).sum();
        let barycentre = Point3::from(sum / nodes.len() as f64);
        let extent = IdentifierBox::around(nodes.iter().map(|&v| self.position(v)))?;
        Some(Piece { nodes, extent, barycentre })
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_bars::bars;
    use super::*;

    const ALONG_X: Direction = Direction { axis: 0, is_positive: true };

    fn between(from: [f64; 3], to: [f64; 3]) -> IdentifierBox {
        IdentifierBox { low: from.into(), high: to.into() }
    }

    #[test]
    fn a_piece_has_the_nodes_between_the_planes_also_beyond_the_initial_box() {
        let surface = bars(&[0.0]);
        let mut scanner = Scanner::new(&surface);
        // Only one edge of the bar lies in the initial box.
        let pieces = scanner.pieces(&between([2.5, -0.1, -0.1], [4.5, 0.1, 0.1]), ALONG_X);
        assert_eq!(pieces.len(), 1);
        assert_eq!(pieces[0].nodes.len(), 8);
        assert_eq!(pieces[0].barycentre, Point3::new(3.5, 0.5, 0.5));
        assert_eq!(pieces[0].extent, between([3.0, 0.0, 0.0], [4.0, 1.0, 1.0]));
    }

    #[test]
    fn what_does_not_hang_together_between_the_planes_is_two_pieces() {
        let surface = bars(&[0.0, 3.0]);
        let mut scanner = Scanner::new(&surface);
        let wide = between([2.5, -1.0, -1.0], [4.5, 5.0, 2.0]);
        let mut middles: Vec<f64> =
            scanner.pieces(&wide, ALONG_X).iter().map(|p| p.barycentre.y).collect();
        middles.sort_by(f64::total_cmp);
        assert_eq!(middles, [0.5, 3.5]);
        // Asked again, a scanner gives the same: it starts a collection of its own.
        assert_eq!(scanner.pieces(&wide, ALONG_X).len(), 2);
    }

    #[test]
    fn a_part_that_was_looked_at_too_often_shows_nothing_more() {
        let surface = bars(&[0.0]);
        let mut scanner = Scanner::new(&surface);
        let whole = between([-1.0; 3], [1e3; 3]);
        let looks = (0..=MOST_LOOKS).take_while(|_| !scanner.pieces(&whole, ALONG_X).is_empty());
        assert_eq!((looks.count(), scanner.is_spent()), (MOST_LOOKS, true));
    }

    #[test]
    fn between_planes_without_nodes_there_is_nothing() {
        let surface = bars(&[0.0]);
        let empty = between([2.2, -1.0, -1.0], [2.8, 2.0, 2.0]);
        assert!(Scanner::new(&surface).pieces(&empty, ALONG_X).is_empty());
    }
}
