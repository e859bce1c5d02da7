//! Our own format: points with kind and radius, branches as lists of points.
//!
//! ```json
//! { "format": "beamwright-skeleton", "version": 1, "unit": "mm",
//!   "points": [
//!     { "id": 0, "position": [0.0, 0.0, 0.0], "kind": "interface", "radius": 2.5 }
//!   ],
//!   "branches": [
//!     { "id": 0, "points": [0, 1, 2], "length": 40.2 }
//!   ] }
//! ```
//!
//! The file says its unit itself. On reading, `kind` and `radius` may be missing, `length` is not
//! looked at, and ids may be any numbers.

use std::io::{self, Write};
use std::path::Path;

use beamwright_formats::Unit;
use nalgebra::Point3;
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

use super::Source;
use super::error::{Place, SkeletonFileError};
use super::line_graph::LineGraph;
use super::text::{is_usable, malformed, quote};
use crate::skeleton::graph::{Branch, PointKind, SkeletalPoint, Skeleton};

/// Name of the format.
const FORMAT: &str = "beamwright-skeleton";

/// Version of the format.
const VERSION: u64 = 1;

#[derive(Deserialize)]
struct File {
    format: String,
    version: u64,
    unit: String,
    points: Vec<Point>,
    branches: Vec<Chain>,
}

#[derive(Serialize, Deserialize)]
struct Point {
    id: u64,
    position: [f64; 3],
    kind: Option<Kind>,
    #[serde(default)]
    radius: f64,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Interface,
    Branch,
    Junction,
    End,
}

#[derive(Serialize, Deserialize)]
struct Chain {
    #[serde(default)]
    id: u64,
    points: Vec<u64>,
    #[serde(default)]
    length: f64,
}

impl From<PointKind> for Kind {
    fn from(kind: PointKind) -> Self {
        match kind {
            PointKind::Interface => Self::Interface,
            PointKind::Branch => Self::Branch,
            PointKind::Junction => Self::Junction,
            PointKind::End => Self::End,
        }
    }
}

impl From<Kind> for PointKind {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::Interface => Self::Interface,
            Kind::Branch => Self::Branch,
            Kind::Junction => Self::Junction,
            Kind::End => Self::End,
        }
    }
}

pub(super) fn read(source: &Source<'_>) -> Result<Skeleton, SkeletonFileError> {
    let file: File =
        serde_json::from_slice(source.bytes).map_err(|e| json_error(source.path, &e))?;
    let part = |name: &str| Place::Part(name.to_owned());
    if file.format != FORMAT {
        let expected = format!("`{FORMAT}`");
        let found = file.format.as_bytes();
        return Err(malformed(source.path, part("format"), &expected, found));
    }
    if file.version != VERSION {
        let found = file.version.to_string();
        let expected = format!("version {VERSION} of the format");
        return Err(malformed(source.path, part("version"), &expected, found.as_bytes()));
    }
    let Ok(unit) = file.unit.parse::<Unit>() else {
        let expected = "mm, cm, m or in";
        return Err(malformed(source.path, part("unit"), expected, file.unit.as_bytes()));
    };
    let skeleton = Reader { path: source.path, to_mm: unit.to_mm() }.skeleton(&file)?;
    let all_kinds = file.points.iter().all(|p| p.kind.is_some());
    let as_it_is = all_kinds || skeleton.branches.is_empty();
    Ok(if as_it_is { skeleton } else { LineGraph::of(&skeleton).to_skeleton() })
}

fn json_error(path: &Path, error: &serde_json::Error) -> SkeletonFileError {
    let message = error.to_string();
    let (line, column) = (error.line(), error.column());
    let place = format!(" at line {line} column {column}");
    let message = message.strip_suffix(&place).unwrap_or(&message).to_owned();
    SkeletonFileError::Json { path: path.to_owned(), line, column, message }
}

struct Reader<'a> {
    path: &'a Path,
    to_mm: f64,
}

impl Reader<'_> {
    fn skeleton(&self, file: &File) -> Result<Skeleton, SkeletonFileError> {
        let mut skeleton = Skeleton::default();
        let mut index_of = FxHashMap::default();
        for (i, point) in file.points.iter().enumerate() {
            if index_of.insert(point.id, i as u32).is_some() {
                let place = Place::Part(format!("points[{i}].id"));
                let found = point.id.to_string();
                return Err(malformed(self.path, place, "an id of its own", found.as_bytes()));
            }
            skeleton.points.push(self.point(i, point)?);
        }
        for (i, branch) in file.branches.iter().enumerate() {
            skeleton.branches.push(self.branch(i, branch, &index_of)?);
        }
        Ok(skeleton)
    }

    fn point(&self, i: usize, point: &Point) -> Result<SkeletalPoint, SkeletonFileError> {
        let position = Point3::from(point.position) * self.to_mm;
        let radius = point.radius * self.to_mm;
        if let Some(c) = position.iter().chain([&radius]).find(|c| !is_usable(**c)) {
            let place = Place::Part(format!("points[{i}]"));
            let number = quote(c.to_string().as_bytes());
            return Err(SkeletonFileError::NotUsable { path: self.path.to_owned(), place, number });
        }
        if radius < 0.0 {
            let place = Place::Part(format!("points[{i}].radius"));
            let found = point.radius.to_string();
            return Err(malformed(self.path, place, "no negative radius", found.as_bytes()));
        }
        Ok(SkeletalPoint {
            position,
            radius,
            kind: point.kind.map_or(PointKind::Branch, PointKind::from),
        })
    }

    fn branch(
        &self,
        i: usize,
        branch: &Chain,
        index_of: &FxHashMap<u64, u32>,
    ) -> Result<Branch, SkeletonFileError> {
        if branch.points.len() < 2 {
            let place = Place::Part(format!("branches[{i}].points"));
            let found = branch.points.len().to_string();
            return Err(malformed(self.path, place, "two points or more", found.as_bytes()));
        }
        let index = |(k, id): (usize, &u64)| {
            index_of.get(id).copied().ok_or_else(|| SkeletonFileError::NoSuchPoint {
                path: self.path.to_owned(),
                place: Place::Part(format!("branches[{i}].points[{k}]")),
                index: id.to_string(),
                count: index_of.len(),
            })
        };
        let points = branch.points.iter().enumerate().map(index).collect::<Result<_, _>>()?;
        Ok(Branch { points })
    }
}

pub(super) fn write(skeleton: &Skeleton, out: &mut impl Write) -> io::Result<()> {
    write!(
        out,
        "{{ \"format\": \"{FORMAT}\", \"version\": {VERSION}, \"unit\": \"mm\",\n  \"points\": ["
    )?;
    let points = skeleton.points.iter().enumerate().map(|(i, p)| Point {
        id: i as u64,
        position: p.position.coords.map(|c| c + 0.0).into(),
        kind: Some(p.kind.into()),
        radius: p.radius + 0.0,
    });
    write_rows(points, out)?;
    write!(out, "],\n  \"branches\": [")?;
    let branches = skeleton.branches.iter().enumerate().map(|(i, b)| Chain {
        id: i as u64,
        points: b.points.iter().map(|&p| u64::from(p)).collect(),
        length: skeleton.length(b),
    });
    write_rows(branches, out)?;
    writeln!(out, "] }}")
}

/// One row a line, so that files can be compared line by line.
fn write_rows(rows: impl Iterator<Item = impl Serialize>, out: &mut impl Write) -> io::Result<()> {
    let mut before = "\n    ";
    for row in rows {
        out.write_all(before.as_bytes())?;
        serde_json::to_writer(&mut *out, &row)?;
        before = ",\n    ";
    }
    out.write_all(b"\n  ")
}
