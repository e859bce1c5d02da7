//! Curve graphs of Starlab (`.cg`), the program behind method 1 of the thesis (§4.3.1).
//!
//! ```text
//! # D:3 NV:2 NE:1       dimension, points, segments
//! v 0 0 0               one line a point
//! v 10 0 0
//! e 1 2                 one line a segment; points are counted from 1
//! ```
//!
//! Some programs count from 0. A file that names a point 0 is read so.

use std::io::{self, Write};

use super::error::SkeletonFileError;
use super::number::Shortest;
use super::text::{Line, content};
use super::{Parts, Source, point_at};
use crate::skeleton::graph::Skeleton;

pub(super) fn read(source: &Source<'_>) -> Result<Parts, SkeletonFileError> {
    let mut parts = Parts::default();
    let mut edges: Vec<(Line<'_>, [i64; 2])> = Vec::new();
    for line in content(source.path, source.bytes) {
        let mut words = line.words();
        match words.next() {
            Some(b"v") => parts.points.push(point_at(words.position(source.to_mm)?)),
            Some(b"e") => {
                let expected = "the numbers of two points";
                edges.push((line, [words.integer(expected)?, words.integer(expected)?]));
            }
            word => return Err(line.malformed("`v` or `e`", word.unwrap_or_default())),
        }
    }
    let base = if edges.iter().any(|(_, ends)| ends.contains(&0)) { 0 } else { 1 };
    for (line, ends) in edges {
        let count = parts.points.len();
        let index = |e: i64| u32::try_from(e - base).ok().filter(|&i| (i as usize) < count);
        match ends.map(index) {
            [Some(a), Some(b)] => parts.segments.push([a, b]),
            [None, _] => return Err(line.no_such_point(ends[0], count)),
            _ => return Err(line.no_such_point(ends[1], count)),
        }
    }
    Ok(parts)
}

pub(super) fn write(skeleton: &Skeleton, out: &mut impl Write) -> io::Result<()> {
    let segments = skeleton.segments().count();
    writeln!(out, "# D:3 NV:{} NE:{segments}", skeleton.points.len())?;
    for p in &skeleton.points {
        let [x, y, z] = p.position.coords.map(Shortest).into();
        writeln!(out, "v {x} {y} {z}")?;
    }
    skeleton.segments().try_for_each(|[a, b]| writeln!(out, "e {} {}", a + 1, b + 1))
}
