//! Node and connectivity text files (thesis §4.3.2.3), as the Laplacian method leaves them.
//!
//! ```text
//! part_nodes.txt            part_connectivity.txt
//! 0.0  0.0 0.0              2             row 1: node 1 is joined to node 2
//! 10.0 0.0 0.0              1 4           row 2: node 2 to nodes 1 and 4
//! NaN  NaN NaN                            row 3: node 3 was removed and is joined to none
//! 10.0 5.0 0.0              2
//! ```
//!
//! The node file is the one that is given; the connectivity file lies beside it and has the same
//! name with the word `nodes` (or `node`) replaced by `connectivity`, in any case of letters.
//!
//! Row and node have the same number, from 1. A row may be filled up with 0 or NaN to the width of
//! the longest, and may begin with its own number. Numbers are separated by blanks, commas or
//! semicolons.

use std::path::{Path, PathBuf};

use super::error::SkeletonFileError;
use super::text::{Line, as_integer, lines, malformed, parse};
use super::{Parts, Source, point_at};
use crate::skeleton::graph::SkeletalPoint;

/// The connectivity file that belongs to a node file.
pub(super) fn partner_of(nodes: &Path) -> Option<PathBuf> {
    let name = nodes.file_name()?.to_str()?;
    let lower = name.to_ascii_lowercase();
    let (at, word) = ["nodes", "node"].iter().find_map(|w| Some((lower.rfind(w)?, *w)))?;
    let found = &name[at..at + word.len()];
    let connectivity = if found.chars().all(char::is_uppercase) {
        "CONNECTIVITY"
    } else if found.starts_with(char::is_uppercase) {
        "Connectivity"
    } else {
        "connectivity"
    };
    Some(nodes.with_file_name(format!("{}{connectivity}{}", &name[..at], &name[at + word.len()..])))
}

/// Reads the two files; `nodes` and `connectivity` have the same unit.
pub(super) fn read(
    nodes: &Source<'_>,
    connectivity: &Source<'_>,
) -> Result<Parts, SkeletonFileError> {
    let mut parts = Parts { points: read_nodes(nodes)?, ..Parts::default() };
    let mut rows = 0;
    for line in lines(connectivity.path, connectivity.bytes) {
        rows += 1;
        if rows > parts.points.len() && !line.text.trim_ascii().is_empty() {
            let expected = format!("no more rows than the {} nodes", parts.points.len());
            return Err(line.malformed(&expected, line.text));
        }
        row(&line, rows as u32 - 1, &mut parts)?;
    }
    // Rows without a segment at the end of the file may be missing.
    Ok(parts)
}

fn read_nodes(source: &Source<'_>) -> Result<Vec<SkeletalPoint>, SkeletonFileError> {
    let mut points = Vec::new();
    for line in lines(source.path, source.bytes) {
        if line.text.trim_ascii().is_empty() {
            continue;
        }
        if line.words().take(3).any(is_nan) {
            points.push(point_at([f64::NAN; 3].into()));
            continue;
        }
        let mut words = line.words();
        points.push(point_at(words.position(source.to_mm)?));
        if let Some(more) = words.next() {
            return Err(line.malformed("three coordinates and no more", more));
        }
    }
    Ok(points)
}

fn is_nan(word: &[u8]) -> bool {
    parse::<f64>(word).is_some_and(f64::is_nan)
}

fn row(line: &Line<'_>, node: u32, parts: &mut Parts) -> Result<(), SkeletonFileError> {
    for word in line.words().filter(|w| !is_nan(w)) {
        let number = as_integer(word).ok_or_else(|| line.malformed("numbers of nodes", word))?;
        if number == 0 || number == i64::from(node) + 1 {
            continue;
        }
        let count = parts.points.len();
        let other = usize::try_from(number - 1).ok().filter(|&n| n < count);
        let Some(other) = other else { return Err(line.no_such_point(number, count)) };
        for n in [node as usize, other] {
            if parts.points[n].position.x.is_nan() {
                let expected = format!("no segment to node {}, which is NaN", n + 1);
                return Err(malformed(line.path, line.place(), &expected, line.text));
            }
        }
        parts.segments.push([node, other as u32]);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_connectivity_file_has_the_name_of_the_node_file() {
        for (nodes, connectivity) in [
            ("d/part_nodes.txt", "d/part_connectivity.txt"),
            ("Nodes.txt", "Connectivity.txt"),
            ("NODE.TXT", "CONNECTIVITY.TXT"),
            ("nodes_of_node7.txt", "connectivity_of_node7.txt"),
        ] {
            assert_eq!(partner_of(Path::new(nodes)), Some(connectivity.into()));
        }
        assert_eq!(partner_of(Path::new("skeleton.txt")), None);
    }
}
