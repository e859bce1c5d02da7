//! Polylines in OBJ files: `v x y z` and `l a b c …`.
//!
//! All other statements are passed over. Points are counted from 1; a negative number counts back
//! from the point before the line. One `l` line a segment is written, as most programs want it.

use std::io::{self, Write};

use super::error::SkeletonFileError;
use super::number::Shortest;
use super::text::{Line, as_integer, content};
use super::{Parts, Source, point_at};
use crate::skeleton::graph::Skeleton;

pub(super) fn read(source: &Source<'_>) -> Result<Parts, SkeletonFileError> {
    let mut parts = Parts::default();
    let mut pieces: Vec<(Line<'_>, [u64; 2])> = Vec::new();
    for line in content(source.path, source.bytes) {
        let mut words = line.words();
        match words.next() {
            Some(b"v") => parts.points.push(point_at(words.position(source.to_mm)?)),
            Some(b"l") => polyline(&line, parts.points.len(), &mut pieces)?,
            Some(b"f") => parts.faces += 1,
            _ => {}
        }
    }
    let count = parts.points.len();
    // Checked last: a line may come before its points.
    for (line, ends) in pieces {
        if let Some(&missing) = ends.iter().find(|&&e| e > count as u64) {
            return Err(line.no_such_point(missing, count));
        }
        parts.segments.push(ends.map(|e| (e - 1) as u32));
    }
    Ok(parts)
}

fn polyline<'a>(
    line: &Line<'a>,
    points: usize,
    pieces: &mut Vec<(Line<'a>, [u64; 2])>,
) -> Result<(), SkeletonFileError> {
    let mut before = None;
    let mut words = 0;
    for word in line.words().skip(1) {
        words += 1;
        let expected = "the numbers of two or more points";
        // What follows a slash is the number of a texture point.
        let number = word.split(|&b| b == b'/').next().unwrap_or_default();
        let number = as_integer(number).ok_or_else(|| line.malformed(expected, word))?;
        let counted = if number < 0 { points as i64 + 1 + number } else { number };
        if counted < 1 {
            return Err(line.no_such_point(number, points));
        }
        if let Some(before) = before.replace(counted as u64) {
            pieces.push((*line, [before, counted as u64]));
        }
    }
    if words < 2 {
        return Err(line.malformed("the numbers of two or more points", b""));
    }
    Ok(())
}

pub(super) fn write(skeleton: &Skeleton, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "# beamwright skeleton, mm")?;
    for p in &skeleton.points {
        let [x, y, z] = p.position.coords.map(Shortest).into();
        writeln!(out, "v {x} {y} {z}")?;
    }
    skeleton.segments().try_for_each(|[a, b]| writeln!(out, "l {} {}", a + 1, b + 1))
}
