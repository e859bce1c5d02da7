//! Edges in PLY files, as MeshLab shows them: `element edge` with `vertex1` and `vertex2`.
//!
//! ```text
//! ply
//! format ascii 1.0
//! element vertex 2
//! property double x            also y and z
//! property double quality      radius of the section; 0: unknown
//! element edge 1
//! property int vertex1         points are counted from 0
//! property int vertex2
//! end_header
//! ```
//!
//! ASCII and both binary encodings are read; ASCII is written. Elements and properties that say
//! nothing of a skeleton are passed over. The radius is also found under the name `radius`.

mod header;
mod values;

use std::io::{self, Write};

use self::header::{Element, Header};
use self::values::Values;
use super::error::{Place, SkeletonFileError};
use super::number::Shortest;
use super::text::{is_usable, missing, quote, radius_or_unknown};
use super::{Parts, Source, point_at};
use crate::skeleton::graph::{SkeletalPoint, Skeleton};

pub(super) fn read(source: &Source<'_>) -> Result<Parts, SkeletonFileError> {
    let header = Header::read(source)?;
    let mut values = Values::new(source, &header);
    let mut parts = Parts::default();
    let mut edges: Vec<(Place, [f64; 2])> = Vec::new();
    for element in &header.elements {
        let columns = Columns::of(element, source)?;
        for _ in 0..if element.properties.is_empty() { 0 } else { element.count } {
            values.advance(element)?;
            match element.name.as_str() {
                "vertex" => parts.points.push(point(source, &columns, &values)?),
                "edge" => edges.push((values.place(), columns.pick(values.row()))),
                "face" => parts.faces += 1,
                _ => {}
            }
        }
    }
    let count = parts.points.len();
    for (place, ends) in edges {
        let index = |e: f64| (e.fract() == 0.0 && e >= 0.0 && e < count as f64).then_some(e as u32);
        let [Some(a), Some(b)] = ends.map(index) else {
            let missing = ends.into_iter().find(|&e| index(e).is_none()).unwrap_or(f64::NAN);
            let (path, index) = (source.path.to_owned(), missing.to_string());
            return Err(SkeletonFileError::NoSuchPoint { path, place, index, count });
        };
        parts.segments.push([a, b]);
    }
    Ok(parts)
}

/// Where in a row the values of interest stand.
struct Columns {
    wanted: Vec<usize>,
    radius: Option<usize>,
}

impl Columns {
    fn of(element: &Element, source: &Source<'_>) -> Result<Self, SkeletonFileError> {
        let names: &[&str] = match element.name.as_str() {
            "vertex" => &["x", "y", "z"],
            "edge" => &["vertex1", "vertex2"],
            _ => &[],
        };
        let find = |name: &str| element.properties.iter().position(|p| p.name == name);
        let wanted = names.iter().map(|&name| {
            find(name).ok_or_else(|| {
                let expected = format!("a property {name} of element {}", element.name);
                missing(source.path, Place::Line(element.line), expected, "none")
            })
        });
        let radius = find("radius").or_else(|| find("quality"));
        Ok(Self { wanted: wanted.collect::<Result<_, _>>()?, radius })
    }

    /// The wanted values of a row.
    fn pick<const N: usize>(&self, row: &[f64]) -> [f64; N] {
        std::array::from_fn(|k| self.wanted.get(k).map_or(f64::NAN, |&column| row[column]))
    }
}

fn point(
    source: &Source<'_>,
    columns: &Columns,
    values: &Values<'_>,
) -> Result<SkeletalPoint, SkeletonFileError> {
    let (row, place) = (values.row(), values.place());
    let position = columns.pick::<3>(row).map(|c| c * source.to_mm);
    if let Some(c) = position.iter().find(|c| !is_usable(**c)) {
        let number = quote(c.to_string().as_bytes());
        return Err(SkeletonFileError::NotUsable { path: source.path.to_owned(), place, number });
    }
    let radius = columns.radius.map_or(0.0, |column| row[column] * source.to_mm);
    Ok(SkeletalPoint { radius: radius_or_unknown(radius), ..point_at(position.into()) })
}

pub(super) fn write(skeleton: &Skeleton, out: &mut impl Write) -> io::Result<()> {
    let (points, edges) = (skeleton.points.len(), skeleton.segments().count());
    writeln!(out, "ply\nformat ascii 1.0\ncomment beamwright skeleton, mm; quality: radius")?;
    writeln!(out, "element vertex {points}\nproperty double x\nproperty double y")?;
    writeln!(out, "property double z\nproperty double quality")?;
    writeln!(out, "element edge {edges}\nproperty int vertex1\nproperty int vertex2\nend_header")?;
    for p in &skeleton.points {
        let [x, y, z] = p.position.coords.map(Shortest).into();
        writeln!(out, "{x} {y} {z} {}", Shortest(p.radius))?;
    }
    skeleton.segments().try_for_each(|[a, b]| writeln!(out, "{a} {b}"))
}
