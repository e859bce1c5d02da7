//! SWC, the format of traced nerve cells; many skeleton programs write it.
//!
//! ```text
//! # comment
//! 1 6 0.0 0.0 0.0 2.5 -1      number, type, x, y, z, radius, number of the parent (-1: none)
//! 2 0 5.0 0.0 0.0 2.5 1
//! ```
//!
//! Every point has one parent, so the format knows no cycles. A cycle is written cut open: the point
//! that closes it is written twice, at the same place; reading joins the two again.
//!
//! The types written are those of the first description of the format (Cannon, Turner, Pyapali,
//! Wheal: *An on-line archive of reconstructed hippocampal neurons*, J. Neurosci. Methods 84, 1998):
//! 5 for a fork, 6 for an end, and the first free one, 7, for the centre of an interface section.
//! Types are only taken from files that begin as ours do; elsewhere they name parts of a cell.

use std::io::{self, Write};

use rustc_hash::FxHashMap;

use super::error::SkeletonFileError;
use super::line_graph::LineGraph;
use super::number::Shortest;
use super::text::{Line, content, radius_or_unknown};
use super::{Parts, Source, point_at};
use crate::skeleton::graph::{PointKind, SkeletalPoint, Skeleton};

/// First line of the files written here.
const SIGNATURE: &str = "# beamwright-skeleton, mm";

/// Type of the centre of an interface section.
const INTERFACE: i64 = 7;

pub(super) fn read(source: &Source<'_>) -> Result<Parts, SkeletonFileError> {
    let is_ours = source.bytes.starts_with(SIGNATURE.as_bytes());
    let mut parts = Parts::default();
    let mut index_of: FxHashMap<i64, u32> = FxHashMap::default();
    let mut parents: Vec<(Line<'_>, i64)> = Vec::new();
    for line in content(source.path, source.bytes) {
        let mut words = line.words();
        let id = words.integer("the number of the point")?;
        let kind = words.integer("the type of the point")?;
        let mut point = point_at(words.position(source.to_mm)?);
        point.radius = radius_or_unknown(source.to_mm * words.any_number("the radius")?);
        if is_ours && kind == INTERFACE {
            point.kind = PointKind::Interface;
        }
        parents.push((line, words.integer("the number of the parent")?));
        if index_of.insert(id, parts.points.len() as u32).is_some() {
            return Err(line.malformed("a new number for each point", line.text));
        }
        parts.points.push(point);
    }
    for (i, (line, parent)) in parents.into_iter().enumerate().filter(|(_, (_, p))| *p >= 0) {
        let Some(&parent) = index_of.get(&parent) else {
            return Err(line.no_such_point(parent, parts.points.len()));
        };
        parts.segments.push([parent, i as u32]);
    }
    Ok(parts)
}

pub(super) fn write(skeleton: &Skeleton, out: &mut impl Write) -> io::Result<()> {
    let graph = LineGraph::of(skeleton);
    writeln!(out, "{SIGNATURE}\n# number type x y z radius parent")?;
    let mut tree = Tree { graph: &graph, number: vec![0; graph.points().len()], written: 0 };
    let mut used = vec![false; graph.segments().len()];
    let (ends, others): (Vec<u32>, Vec<u32>) = graph.indices().partition(|&p| graph.degree(p) == 1);
    for root in ends.into_iter().chain(others) {
        if tree.number[root as usize] == 0 {
            tree.write_from(root, &mut used, out)?;
        }
    }
    Ok(())
}

/// A component as a tree, written from its root.
struct Tree<'a> {
    graph: &'a LineGraph,
    /// Number under which each point was written; 0 before.
    number: Vec<usize>,
    written: usize,
}

impl Tree<'_> {
    fn write_from(&mut self, root: u32, used: &mut [bool], out: &mut impl Write) -> io::Result<()> {
        self.write_point(root, None, out)?;
        let mut stack = vec![root];
        while let Some(&p) = stack.last() {
            let next = self.graph.neighbours(p).iter().find(|n| !used[n.segment as usize]);
            let Some(n) = next else {
                stack.pop();
                continue;
            };
            used[n.segment as usize] = true;
            let is_new = self.number[n.point as usize] == 0;
            self.write_point(n.point, Some(self.number[p as usize]), out)?;
            if is_new {
                stack.push(n.point);
            }
        }
        Ok(())
    }

    fn write_point(
        &mut self,
        p: u32,
        parent: Option<usize>,
        out: &mut impl Write,
    ) -> io::Result<()> {
        self.written += 1;
        let number = &mut self.number[p as usize];
        if *number == 0 {
            *number = self.written;
        }
        let SkeletalPoint { position, radius, kind } = self.graph.points()[p as usize];
        let [x, y, z] = position.coords.map(Shortest).into();
        write!(
            out,
            "{} {} {x} {y} {z} {} ",
            self.written,
            self.type_of(p, kind),
            Shortest(radius)
        )?;
        match parent {
            Some(parent) => writeln!(out, "{parent}"),
            None => writeln!(out, "-1"),
        }
    }

    fn type_of(&self, p: u32, kind: PointKind) -> i64 {
        match (kind, self.graph.degree(p)) {
            (PointKind::Interface, _) => INTERFACE,
            (_, 1) => 6,
            (_, 2) => 0,
            _ => 5,
        }
    }
}
