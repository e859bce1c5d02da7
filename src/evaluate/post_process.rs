//! Makes the skeleton of another program one of the design part (thesis §4.3.1.3 and §4.3.2.3).
//!
//! ```text
//!   as it comes                       removed, joined, pruned
//!
//!  ┌─────┐                           ┌─────┐
//!  │ ●─● │                           │     │
//!  │  ╲  ├───────────────            │     ├───────────────
//!  │   ●─┼─●──●──●──●──●             │     ◎─●──●──●──●──●        ◎ centre of the interface
//!  │     ├──────╲────────            │     ├───────────────
//!  └─────┘       ●                   └─────┘
//! ```
//!
//! 1. Points inside non-design parts are removed with their segments.
//! 2. Every interface centre is joined to the closest skeletal point. With [`Link::Cut`], first every
//!    point at which step 1 cut a branch is joined to the nearest centre: where several struts reach
//!    a part through one interface section, the rule of the thesis keeps one and loses the others.
//! 3. Ends that are no interface centre are removed with their segment, until none is left.

use nalgebra::Point3;
use serde::Serialize;

use super::Evaluator;
use super::interfaces::Interfaces;
use crate::mesh::TriangleTree;
use crate::skeleton::graph::{PointKind, SkeletalPoint, Skeleton};
use crate::skeleton_file::LineGraph;

/// How interface centres are joined to the skeleton.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Link {
    /// Each centre to its closest point, as in the thesis.
    #[default]
    Closest,
    /// Every cut branch to its interface section, then each centre left over to its closest point.
    Cut,
}

/// What the post-processing did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct PostProcessing {
    /// Points removed because they lie inside non-design parts.
    pub removed: usize,
    /// Segments added from interface centres.
    pub joined: usize,
    /// Interface centres that were skeletal points already.
    pub already_there: usize,
    /// Points removed with dangling ends.
    pub pruned: usize,
}

impl Evaluator<'_> {
    /// Removes the skeleton inside non-design parts, joins the interface centres, prunes the ends.
    ///
    /// Without labels the skeleton stays as it is; so does one that already ends in the centres.
    pub fn post_process(&self, skeleton: &Skeleton, link: Link) -> (Skeleton, PostProcessing) {
        let centres: Vec<Point3<f64>> =
            self.interfaces().all.iter().filter(|i| i.is_section).map(|i| i.centre).collect();
        let Some(non_design) = self.non_design().filter(|_| !centres.is_empty()) else {
            return (skeleton.clone(), PostProcessing::default());
        };
        let mut done = PostProcessing::default();
        let graph = LineGraph::of(skeleton);
        let (graph, cuts) = remove_non_design(&graph, non_design, self.interfaces(), &mut done);
        let cuts = if link == Link::Cut { cuts } else { Vec::new() };
        let near = self.interfaces().at_centre();
        let graph = Joining::new(&graph, &centres, near).join(&cuts, &mut done);
        (prune(graph, &mut done).to_skeleton(), done)
    }
}

/// Step 1; also the places where branches were cut.
fn remove_non_design(
    graph: &LineGraph,
    non_design: &TriangleTree,
    interfaces: &Interfaces,
    done: &mut PostProcessing,
) -> (LineGraph, Vec<Point3<f64>>) {
    let is_removed: Vec<bool> = graph
        .points()
        .iter()
        .map(|p| non_design.contains(&p.position) && !interfaces.is_centre(&p.position))
        .collect();
    done.removed = is_removed.iter().filter(|r| **r).count();
    let mut cut: Vec<u32> = Vec::new();
    let mut kept = Vec::new();
    for &[a, b] in graph.segments() {
        match (is_removed[a as usize], is_removed[b as usize]) {
            (false, false) => kept.push([a, b]),
            (true, false) => cut.push(b),
            (false, true) => cut.push(a),
            (true, true) => {}
        }
    }
    cut.sort_unstable();
    cut.dedup();
    let cuts = cut.into_iter().map(|p| graph.position(p)).collect();
    (LineGraph::new(unmarked(graph), kept), cuts)
}

/// The points of a graph, none of them the centre of an interface section.
fn unmarked(graph: &LineGraph) -> Vec<SkeletalPoint> {
    let plain = |p: &SkeletalPoint| match p.kind {
        PointKind::Interface => SkeletalPoint { kind: PointKind::Branch, ..*p },
        _ => *p,
    };
    graph.points().iter().map(plain).collect()
}

/// Step 2.
struct Joining<'a> {
    graph: &'a LineGraph,
    centres: &'a [Point3<f64>],
    /// Distance within which a point is a centre, mm.
    near: f64,
    points: Vec<SkeletalPoint>,
    segments: Vec<[u32; 2]>,
    is_linked: Vec<bool>,
}

impl<'a> Joining<'a> {
    fn new(graph: &'a LineGraph, centres: &'a [Point3<f64>], near: f64) -> Self {
        let mut points = graph.points().to_vec();
        points.extend(centres.iter().map(|&position| SkeletalPoint {
            position,
            radius: 0.0,
            kind: PointKind::Interface,
        }));
        let segments = graph.segments().to_vec();
        Self { graph, centres, near, points, segments, is_linked: vec![false; centres.len()] }
    }

    fn join(mut self, cuts: &[Point3<f64>], done: &mut PostProcessing) -> LineGraph {
        if !self.graph.points().is_empty() {
            for cut in cuts {
                let (point, _) = closest(self.graph.points().iter().map(|p| &p.position), cut);
                let from = &self.graph.points()[point].position;
                let (centre, _) = closest(self.centres.iter(), from);
                self.link(point, centre, done);
            }
            for centre in 0..self.centres.len() {
                if !self.is_linked[centre] {
                    self.link_to_closest(centre, done);
                }
            }
        }
        LineGraph::new(self.points, self.segments)
    }

    fn link(&mut self, point: usize, centre: usize, done: &mut PostProcessing) {
        let new = self.graph.points().len() + centre;
        self.segments.push([point as u32, new as u32]);
        self.is_linked[centre] = true;
        done.joined += 1;
    }

    fn link_to_closest(&mut self, centre: usize, done: &mut PostProcessing) {
        let places = self.graph.points().iter().map(|p| &p.position);
        let (point, distance) = closest(places, &self.centres[centre]);
        if distance < self.near {
            self.points[point].kind = PointKind::Interface;
            done.already_there += 1;
        } else {
            self.link(point, centre, done);
        }
    }
}

/// Number and distance of the place closest to `from`; there is at least one.
fn closest<'a>(places: impl Iterator<Item = &'a Point3<f64>>, from: &Point3<f64>) -> (usize, f64) {
    places
        .map(|p| (p - from).norm())
        .enumerate()
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or((0, f64::INFINITY))
}

/// Step 3.
fn prune(graph: LineGraph, done: &mut PostProcessing) -> LineGraph {
    let mut degree: Vec<usize> = graph.indices().map(|p| graph.degree(p)).collect();
    let mut is_pruned = vec![false; graph.segments().len()];
    let is_dead = |p: u32, degree: &[usize]| degree[p as usize] == 1 && !graph.is_interface(p);
    let mut ends: Vec<u32> = graph.indices().filter(|&p| is_dead(p, &degree)).collect();
    while let Some(end) = ends.pop() {
        let last = graph.neighbours(end).iter().find(|n| !is_pruned[n.segment as usize]);
        let Some(last) = last else { continue };
        is_pruned[last.segment as usize] = true;
        degree[end as usize] -= 1;
        degree[last.point as usize] -= 1;
        if is_dead(last.point, &degree) {
            ends.push(last.point);
        }
    }
    done.pruned = degree.iter().filter(|d| **d == 0).count();
    let kept = graph.segments().iter().zip(&is_pruned).filter(|(_, p)| !**p).map(|(s, _)| *s);
    LineGraph::new(graph.points().to_vec(), kept.collect())
}
