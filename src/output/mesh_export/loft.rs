//! A loft as triangles: rings of corners, sides between them, caps over the ends.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Point2, Point3, Vector2, Vector3};

use super::{ROUND, Triangles};
use crate::output::cap::{Ring, cap};
use crate::output::step::{ClosedSpline, EndCut, Loft};
use crate::section::contours::signed_area;
use crate::section::outline::{Outline, Path, Segment, arc_centre};

/// A cut may shorten a beam by this part of the way to the next station; beyond, the end is turned
/// instead.
const SHORTEN: f64 = 0.9;

/// The triangles of a loft; `None` if its stations do not fit each other or an outline is empty.
/// Such a loft is no solid, and the STEP writer refuses it with words.
pub(super) fn triangulate(loft: &Loft) -> Option<Triangles> {
    let corners = Corners::of(loft);
    let stations: Vec<Vec<Ring>> = loft
        .stations
        .iter()
        .map(|s| {
            let holes = s.holes.iter().map(|h| reversed(ring(h, &corners)));
            std::iter::once(ring(&s.outer, &corners)).chain(holes).collect()
        })
        .collect();
    let [first, .., last] = stations.as_slice() else { return None };
    let counts = |rings: &[Ring]| rings.iter().map(Vec::len).collect::<Vec<_>>();
    let alike = stations.iter().all(|rings| counts(rings) == counts(first));
    if !alike || first.iter().any(|r| r.len() < 3) {
        return None;
    }
    let mut levels: Vec<Vec<Point3<f64>>> = loft
        .stations
        .iter()
        .zip(&stations)
        .map(|(s, rings)| rings.iter().flatten().map(|p| Point3::new(p.x, p.y, s.z)).collect())
        .collect();
    let (start, end) = (end_cap(first, &loft.start)?, end_cap(last, &loft.end)?);
    cut_ends(loft, &mut levels);
    let count = levels[0].len() as u32;
    let top = (levels.len() as u32 - 1) * count;
    let mut triangles: Vec<[u32; 3]> = start.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let mut offset = 0;
    for ring in first {
        sides(offset, ring.len() as u32, count, levels.len() as u32, &mut triangles);
        offset += ring.len() as u32;
    }
    triangles.extend(end.iter().map(|t| t.map(|i| i + top)));
    Some((levels.concat(), triangles))
}

/// Two triangles between neighbouring corners of one ring on two neighbouring levels.
fn sides(offset: u32, corners: u32, per_level: u32, levels: u32, triangles: &mut Vec<[u32; 3]>) {
    for level in 0..levels - 1 {
        let at = |level: u32, i: u32| level * per_level + offset + i % corners;
        for i in 0..corners {
            let [a, b] = [at(level, i), at(level, i + 1)];
            let [c, d] = [at(level + 1, i + 1), at(level + 1, i)];
            triangles.push([a, b, c]);
            triangles.push([a, c, d]);
        }
    }
}

/// Angle within which two corners of a circle are one, rad: a tip between them is blunt by less than
/// a thousandth of the radius.
const SAME_CORNER: f64 = 1e-3;

/// The corners of circles, about their middle.
///
/// The edge of a fish mouth has a tip at either side of its member, a quarter of a turn from it. Even
/// corners that begin along the member of one end have its tips among them; those of the other end
/// are put between.
struct Corners {
    /// Angle of the first, rad.
    start: f64,
    /// Angles from there, ascending from 0, rad.
    beyond: Vec<f64>,
}

impl Corners {
    fn of(loft: &Loft) -> Self {
        let members: Vec<f64> = [loft.start, loft.end]
            .into_iter()
            .filter_map(|cut| match cut {
                EndCut::Saddle(saddle) => Some(saddle.along().y.atan2(saddle.along().x)),
                _ => None,
            })
            .collect();
        let start = members.first().copied().unwrap_or(0.0);
        let mut beyond: Vec<f64> = (0..ROUND).map(|i| TAU * i as f64 / ROUND as f64).collect();
        for along in members.iter().skip(1) {
            let tips = [FRAC_PI_2, -FRAC_PI_2].map(|side| (along + side - start).rem_euclid(TAU));
            let is_new = |tip: &f64| {
                let off = beyond.iter().map(|corner| (tip - corner).abs());
                off.map(|off| off.min(TAU - off)).fold(TAU, f64::min) > SAME_CORNER
            };
            let new: Vec<f64> = tips.into_iter().filter(is_new).collect();
            beyond.extend(new);
        }
        beyond.sort_by(f64::total_cmp);
        Self { start, beyond }
    }

    /// On an ellipse whose first half axis points in the direction of `turn`.
    fn on(&self, centre: Point2<f64>, half_axes: [f64; 2], turn: f64) -> Ring {
        let (sin, cos) = turn.sin_cos();
        let p = Vector2::new(cos, sin) * half_axes[0];
        let q = Vector2::new(-sin, cos) * half_axes[1];
        let corner = |angle: &f64| {
            let (sin, cos) = angle.sin_cos();
            centre + p * cos + q * sin
        };
        self.beyond.iter().map(corner).collect()
    }
}

/// Size along the member of the outline whose triangles a saddle has.
const FLAT: f64 = 0.05;

/// Triangles over the outlines of an end. Those of a saddle run along its member, where its surface
/// is straight: they are those of the outline made flat in that direction.
fn end_cap(rings: &[Ring], cut: &EndCut) -> Option<Vec<[u32; 3]>> {
    let EndCut::Saddle(saddle) = cut else { return cap(rings) };
    let along = saddle.along();
    let flat = |p: &Point2<f64>| p - along * ((1.0 - FLAT) * along.dot(&p.coords));
    cap(&rings.iter().map(|ring| ring.iter().map(flat).collect()).collect::<Vec<Ring>>())
}

/// Corners on an outline, counter-clockwise; `round`: those of a circle.
fn ring(outline: &Outline, round: &Corners) -> Ring {
    let corners: Ring = match outline {
        Outline::Circle { centre, radius } => round.on(*centre, [*radius; 2], round.start),
        Outline::Ellipse { centre, half_axes, turn } => round.on(*centre, *half_axes, *turn),
        Outline::Path(path) => along(path),
        Outline::Freeform(curve) => {
            let count = (2 * curve.points().len()).max(ROUND);
            let on = |curve: ClosedSpline| {
                (0..count).map(|i| curve.point(i as f64 / count as f64)).collect()
            };
            ClosedSpline::through(curve.points()).map_or_else(|_| Ring::new(), on)
        }
    };
    if signed_area(&corners) < 0.0 { reversed(corners) } else { corners }
}

/// Corners along lines and arcs; an arc gets as many as its part of a circle.
fn along(path: &Path) -> Ring {
    let mut corners = Vec::new();
    let mut from = path.start;
    for segment in &path.segments {
        match *segment {
            Segment::Line { to } => {
                corners.push(from);
                from = to;
            }
            Segment::Arc { to, sweep } => {
                let centre = arc_centre(from, to, sweep);
                let steps = ((sweep.abs() / TAU * ROUND as f64).ceil() as usize).max(1);
                corners.extend((0..steps).map(|i| {
                    let angle = sweep * i as f64 / steps as f64;
                    centre + nalgebra::Rotation2::new(angle) * (from - centre)
                }));
                from = to;
            }
        }
    }
    if from != path.start {
        corners.push(from);
    }
    corners
}

/// The ring run backwards from the same start.
fn reversed(mut corners: Ring) -> Ring {
    if let Some(rest) = corners.get_mut(1..) {
        rest.reverse();
    }
    corners
}

/// Moves the corners of the end levels along their rulings into the cutting planes, or onto round
/// members.
fn cut_ends(loft: &Loft, levels: &mut [Vec<Point3<f64>>]) {
    let last = levels.len() - 1;
    for (cut, end, beside) in [(loft.start, 0, 1), (loft.end, last, last - 1)] {
        let z = loft.stations[end].z;
        let corners = levels[end].iter().zip(&levels[beside]);
        levels[end] = match cut {
            EndCut::Square => continue,
            EndCut::Plane { normal } => {
                let through = Point3::new(0.0, 0.0, z);
                corners.map(|(p, q)| into_plane(*p, q - p, &through, &normal)).collect()
            }
            EndCut::Saddle(saddle) => {
                corners.map(|(p, _)| Point3::new(p.x, p.y, z + saddle.rise(&p.xy()))).collect()
            }
        };
    }
}

fn into_plane(
    p: Point3<f64>,
    ruling: Vector3<f64>,
    through: &Point3<f64>,
    normal: &Vector3<f64>,
) -> Point3<f64> {
    let height = (through - p).dot(normal);
    let along = height / ruling.dot(normal);
    if along.is_finite() && along < SHORTEN {
        return p + ruling * along;
    }
    // Straight along the axis: the outline seen along it stays what it is.
    let up = height / normal.z;
    if up.is_finite() { p + Vector3::z() * up } else { p }
}
