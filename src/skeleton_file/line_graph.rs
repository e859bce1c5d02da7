//! Points joined by segments: what a skeleton file of any program comes down to.
//!
//! ```text
//!   file:   polylines, each with its own copy       graph:  one point a place, one segment a pair
//!           of the point where they meet
//!
//!      1───2───3   3'───4                              1───2───3───4
//!                  3"───5                                       ╲──5
//! ```
//!
//! Branches are found again as the chains between the points where the graph ends, forks or meets
//! an interface section.

use nalgebra::Point3;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::skeleton::graph::{Branch, PointKind, SkeletalPoint, Skeleton};

/// Points nearer to each other than this part of the diagonal of the bounding box are one point.
/// Numbers written with nine digits agree within it; no skeleton has steps so short.
const SAME_PLACE: f64 = 1e-9;

/// Points joined by segments.
///
/// Invariants: places are finite and differ; a segment joins two points, no two segments the same
/// two; every point has a segment.
#[derive(Clone, Debug, Default)]
pub struct LineGraph {
    points: Vec<SkeletalPoint>,
    segments: Vec<[u32; 2]>,
    /// Where the entries of each point begin in `neighbours`; one more than there are points.
    starts: Vec<u32>,
    /// For each point its neighbours, with the segment that leads there.
    neighbours: Vec<Neighbour>,
}

/// The other end of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Neighbour {
    /// The point there.
    pub point: u32,
    /// The segment that leads there.
    pub segment: u32,
}

impl LineGraph {
    /// Builds the graph: joins points at the same place; drops points that are not finite or have
    /// no segment, segments without length, and repeated segments.
    ///
    /// # Panics
    /// If a segment names a point that is not there.
    pub fn new(points: Vec<SkeletalPoint>, segments: Vec<[u32; 2]>) -> Self {
        let first_at = first_at_same_place(&points);
        let mut seen = FxHashSet::default();
        let joined: Vec<[u32; 2]> = segments
            .into_iter()
            .filter_map(|[a, b]| Some([first_at[a as usize]?, first_at[b as usize]?]))
            .filter(|&[a, b]| a != b && seen.insert([a.min(b), a.max(b)]))
            .collect();
        Self::without_lone_points(points, &first_at, joined)
    }

    fn without_lone_points(
        mut points: Vec<SkeletalPoint>,
        first_at: &[Option<u32>],
        mut segments: Vec<[u32; 2]>,
    ) -> Self {
        for (i, first) in first_at.iter().enumerate() {
            if let Some(first) = first.map(|f| f as usize).filter(|&f| f != i)
                && points[i].kind == PointKind::Interface
            {
                points[first].kind = PointKind::Interface;
            }
        }
        let mut new_index = vec![u32::MAX; points.len()];
        segments.iter().flatten().for_each(|&p| new_index[p as usize] = 0);
        for (kept, index) in (0..).zip(new_index.iter_mut().filter(|i| **i == 0)) {
            *index = kept;
        }
        let mut at = new_index.iter();
        points.retain(|_| at.next() != Some(&u32::MAX));
        segments.iter_mut().flatten().for_each(|p| *p = new_index[*p as usize]);
        Self::with_neighbours(points, segments)
    }

    fn with_neighbours(points: Vec<SkeletalPoint>, segments: Vec<[u32; 2]>) -> Self {
        let mut starts = vec![0; points.len() + 1];
        segments.iter().flatten().for_each(|&p| starts[p as usize + 1] += 1);
        for p in 1..starts.len() {
            starts[p] += starts[p - 1];
        }
        let mut free = starts.clone();
        let mut neighbours = vec![Neighbour { point: 0, segment: 0 }; 2 * segments.len()];
        for (s, &[a, b]) in segments.iter().enumerate() {
            for (from, to) in [(a, b), (b, a)] {
                let slot = &mut free[from as usize];
                neighbours[*slot as usize] = Neighbour { point: to, segment: s as u32 };
                *slot += 1;
            }
        }
        for range in starts.windows(2) {
            neighbours[range[0] as usize..range[1] as usize].sort_unstable();
        }
        Self { points, segments, starts, neighbours }
    }

    /// The graph of a skeleton.
    pub fn of(skeleton: &Skeleton) -> Self {
        Self::new(skeleton.points.clone(), skeleton.segments().collect())
    }

    /// All points.
    pub fn points(&self) -> &[SkeletalPoint] {
        &self.points
    }

    /// Pairs of points joined by a segment.
    pub fn segments(&self) -> &[[u32; 2]] {
        &self.segments
    }

    /// Place of a point, mm.
    pub fn position(&self, point: u32) -> Point3<f64> {
        self.points[point as usize].position
    }

    /// The ends of a segment, mm.
    pub fn ends(&self, segment: [u32; 2]) -> [Point3<f64>; 2] {
        segment.map(|p| self.position(p))
    }

    /// The points joined to a point, in ascending order.
    pub fn neighbours(&self, point: u32) -> &[Neighbour] {
        let [from, to] = [0, 1].map(|k| self.starts[point as usize + k] as usize);
        &self.neighbours[from..to]
    }

    /// Number of segments at a point.
    pub fn degree(&self, point: u32) -> usize {
        self.neighbours(point).len()
    }

    /// All point numbers.
    pub fn indices(&self) -> std::ops::Range<u32> {
        0..self.points.len() as u32
    }

    /// Whether a point is the centre of an interface section.
    pub fn is_interface(&self, point: u32) -> bool {
        self.points[point as usize].kind == PointKind::Interface
    }

    /// Marks a point as the centre of an interface section.
    pub fn mark_interface(&mut self, point: u32) {
        self.points[point as usize].kind = PointKind::Interface;
    }

    /// Length of all segments, mm.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(|&s| self.ends(s)).map(|[a, b]| (b - a).norm()).sum()
    }

    /// The component of each point and their number.
    pub fn components(&self) -> (Vec<u32>, usize) {
        let mut of_point = vec![u32::MAX; self.points.len()];
        let mut count = 0;
        for seed in self.indices() {
            if of_point[seed as usize] != u32::MAX {
                continue;
            }
            of_point[seed as usize] = count;
            let mut stack = vec![seed];
            while let Some(p) = stack.pop() {
                for n in self.neighbours(p) {
                    if of_point[n.point as usize] == u32::MAX {
                        of_point[n.point as usize] = count;
                        stack.push(n.point);
                    }
                }
            }
            count += 1;
        }
        (of_point, count as usize)
    }

    /// Chains of points between ends, junctions and interface sections; a ring without any of
    /// these begins and ends in its first point.
    pub fn chains(&self) -> Vec<Vec<u32>> {
        let is_end = |p: u32| self.degree(p) != 2 || self.is_interface(p);
        let mut used = vec![false; self.segments.len()];
        let mut chains = Vec::new();
        let (ends, inner): (Vec<u32>, Vec<u32>) = self.indices().partition(|&p| is_end(p));
        for from in ends.into_iter().chain(inner) {
            for &first in self.neighbours(from) {
                if !used[first.segment as usize] {
                    chains.push(self.follow(from, first, &is_end, &mut used));
                }
            }
        }
        chains
    }

    fn follow(
        &self,
        from: u32,
        first: Neighbour,
        is_end: &impl Fn(u32) -> bool,
        used: &mut [bool],
    ) -> Vec<u32> {
        let mut chain = vec![from];
        let mut next = Some(first);
        while let Some(n) = next {
            used[n.segment as usize] = true;
            chain.push(n.point);
            if is_end(n.point) || n.point == from {
                break;
            }
            next = self.neighbours(n.point).iter().copied().find(|n| !used[n.segment as usize]);
        }
        chain
    }

    /// The places along a chain, mm.
    pub fn polyline(&self, chain: &[u32]) -> Vec<Point3<f64>> {
        chain.iter().map(|&p| self.position(p)).collect()
    }

    /// The skeleton: chains become branches; points that are no interface section are named by
    /// their number of segments.
    pub fn to_skeleton(&self) -> Skeleton {
        let named = |p: u32| {
            let point = self.points[p as usize];
            let kind = match (point.kind, self.degree(p)) {
                (PointKind::Interface, _) => PointKind::Interface,
                (_, 1) => PointKind::End,
                (_, 2) => PointKind::Branch,
                _ => PointKind::Junction,
            };
            SkeletalPoint { kind, ..point }
        };
        Skeleton {
            points: self.indices().map(named).collect(),
            branches: self.chains().into_iter().map(|points| Branch { points }).collect(),
        }
    }
}

/// For each point the first one at the same place; `None` for a point that is not finite.
///
/// Points are sorted into cells; one that lies at the border of its cell is looked for on the other
/// side as well.
fn first_at_same_place(points: &[SkeletalPoint]) -> Vec<Option<u32>> {
    let is_finite = |p: &SkeletalPoint| p.position.iter().all(|c| c.is_finite());
    let mut places = points.iter().filter(|p| is_finite(p)).map(|p| p.position);
    let Some(first) = places.next() else { return vec![None; points.len()] };
    let (low, high) = places.fold((first, first), |(l, h), p| (l.inf(&p), h.sup(&p)));
    let border = SAME_PLACE * (high - low).norm();
    let width = (4.0 * border).max(f64::MIN_POSITIVE);
    let mut seen: FxHashMap<[i64; 3], u32> = FxHashMap::default();
    let mut first_at = |i: usize, p: &SkeletalPoint| {
        let at = p.position - low;
        let cell = |shift: f64| at.map(|c| ((c + shift) / width).floor() as i64);
        let near = cells(cell(-border).into(), cell(border).into());
        let known = near.into_iter().find_map(|c| seen.get(&c).copied());
        *seen.entry(cell(0.0).into()).or_insert(known.unwrap_or(i as u32))
    };
    points.iter().enumerate().map(|(i, p)| is_finite(p).then(|| first_at(i, p))).collect()
}

/// All cells from `low` to `high`: one, or two across each border that is near.
fn cells(low: [i64; 3], high: [i64; 3]) -> Vec<[i64; 3]> {
    let range = |k: usize| low[k]..=high[k];
    range(0).flat_map(|x| range(1).flat_map(move |y| range(2).map(move |z| [x, y, z]))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64) -> SkeletalPoint {
        SkeletalPoint { position: Point3::new(x, y, 0.0), radius: 0.0, kind: PointKind::Branch }
    }

    #[test]
    fn copies_of_a_meeting_point_become_one_junction() {
        let points = [(0., 0.), (1., 0.), (1., 0.), (2., 0.), (1. + 1e-12, 0.), (1., 1.)];
        let graph = LineGraph::new(
            points.iter().map(|&(x, y)| point(x, y)).collect(),
            vec![[0, 1], [2, 3], [4, 5], [5, 4]],
        );
        assert_eq!(graph.points().len(), 4);
        assert_eq!(graph.segments(), [[0, 1], [1, 2], [1, 3]]);
        assert_eq!(graph.chains(), [vec![0, 1], vec![1, 2], vec![1, 3]]);
        assert_eq!(graph.to_skeleton().count(PointKind::Junction), 1);
    }

    #[test]
    fn a_point_that_is_not_finite_goes_with_its_segments() {
        let points = vec![point(0., 0.), point(f64::NAN, 0.), point(1., 0.), point(2., 0.)];
        let graph = LineGraph::new(points, vec![[0, 1], [0, 2]]);
        assert_eq!(graph.points().len(), 2);
        assert_eq!(graph.segments(), [[0, 1]]);
    }

    #[test]
    fn a_ring_is_one_chain_that_ends_where_it_began() {
        let points = vec![point(0., 0.), point(1., 0.), point(0., 1.)];
        let graph = LineGraph::new(points, vec![[0, 1], [1, 2], [2, 0]]);
        assert_eq!(graph.chains(), [vec![0, 1, 2, 0]]);
        assert_eq!(graph.components().1, 1);
    }

    #[test]
    fn a_chain_ends_at_an_interface_section() {
        let mut points = vec![point(0., 0.), point(1., 0.), point(2., 0.)];
        points[1].kind = PointKind::Interface;
        let graph = LineGraph::new(points, vec![[0, 1], [1, 2]]);
        assert_eq!(graph.chains(), [vec![0, 1], vec![1, 2]]);
    }
}
