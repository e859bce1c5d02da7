//! The space the beams fill: each alone, together without overlap, and outside of the part.
//!
//! Beams that share a node overlap there, and Σ area × length counts the overlap twice. Here every
//! beam is sampled evenly, and a sample that c beams contain counts 1/c:
//!
//! ```text
//!   V_together = Σ_beams V · mean(1/c)        V_outside = Σ_beams V · mean([not in the part]/c)
//! ```
//!
//! The samples follow an even sequence, not a random one, so that the numbers are the same on every
//! run and true to about a thousandth.

use std::borrow::Cow;

use nalgebra::{Point2, Point3};

use super::beam_axes::BeamAxes;
use super::{Beam, BeamShape, Frame};
use crate::mesh::{Shadow, TriangleTree};
use crate::section::contours::{Contours, signed_area};

/// Volumes of one beam from node to node, mm³.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BeamVolumes {
    /// Its own.
    pub alone: f64,
    /// Its share of the space all beams fill: what c beams overlap in counts 1/c for each.
    pub share: f64,
    /// What of its share lies outside of the part.
    pub outside: f64,
}

impl std::ops::AddAssign for BeamVolumes {
    fn add_assign(&mut self, other: Self) {
        self.alone += other.alone;
        self.share += other.share;
        self.outside += other.outside;
    }
}

/// Samples over the whole frame, and at least for each beam.
const SAMPLES: usize = 16_384;
const LEAST_SAMPLES: usize = 256;

/// Corners for each quarter turn or span of an outline: the polygon takes 0.05 % off a circle.
const CORNERS: usize = 24;

/// Steps of the even sequence in three directions: 1/g, 1/g², 1/g³ with g⁴ = g + 1 (M. Roberts,
/// "The unreasonable effectiveness of quasirandom sequences", 2018).
const STEPS: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3];

/// Places spread evenly along a beam and over the square round its section: the part of the length,
/// and the place across, each coordinate within ±1.
pub(super) fn spread(count: usize) -> impl Iterator<Item = (f64, Point2<f64>)> {
    (0..count).map(|k| {
        let [t, u, v] = STEPS.map(|step| (0.5 + step * k as f64).fract());
        (t, Point2::new(2.0 * u - 1.0, 2.0 * v - 1.0))
    })
}

/// Measures the beams of a frame, in order, against the part they stand for.
pub fn volumes(frame: &Frame, part: &TriangleTree) -> Vec<BeamVolumes> {
    let part = Shadow::new(part);
    let solids: Vec<Solid> = frame.beams.iter().map(|beam| Solid::new(beam, frame)).collect();
    let count = (SAMPLES / solids.len().max(1)).max(LEAST_SAMPLES);
    let measure = |solid: &Solid| {
        let [share, outside] = solid.shares(&solids, &part, count);
        let alone = solid.volume();
        BeamVolumes { alone, share: alone * share, outside: alone * outside }
    };
    solids.iter().map(measure).collect()
}

/// A beam as polygons along its axis.
struct Solid {
    start: Point3<f64>,
    axes: BeamAxes,
    length: f64,
    /// Part of the length and region, ascending.
    stations: Vec<(f64, Contours)>,
    is_constant: bool,
    /// Farthest corner from the axis, mm.
    reach: f64,
    middle: Point3<f64>,
}

impl Solid {
    fn new(beam: &Beam, frame: &Frame) -> Self {
        let [start, end] = frame.axis(beam);
        let stations = stations(&beam.shape);
        let corners = stations.iter().flat_map(|(_, c)| &c.outer);
        Self {
            start,
            axes: beam.axes.rolled(beam.shape.roll),
            length: beam.length,
            reach: corners.map(|p| p.coords.norm()).fold(0.0, f64::max),
            middle: nalgebra::center(&start, &end),
            is_constant: stations.windows(2).all(|w| w[0].1 == w[1].1),
            stations,
        }
    }

    /// ∫ A over the length; A is quadratic between two stations, Simpson's rule exact.
    fn volume(&self) -> f64 {
        let area = |t: f64| {
            let region = self.region(t);
            signed_area(&region.outer).abs()
                - region.holes.iter().map(|h| signed_area(h).abs()).sum::<f64>()
        };
        let parts = self.stations.windows(2).map(|w| {
            let (a, b) = (w[0].0, w[1].0);
            (b - a) / 6.0 * (area(a) + 4.0 * area(0.5 * (a + b)) + area(b))
        });
        parts.sum::<f64>() * self.length
    }

    /// The region at a part of the length: corner by corner between two stations.
    fn region(&self, t: f64) -> Cow<'_, Contours> {
        if self.is_constant {
            return Cow::Borrowed(&self.stations[0].1);
        }
        let next = self.stations.partition_point(|s| s.0 < t).clamp(1, self.stations.len() - 1);
        let ((from, a), (to, b)) = (&self.stations[next - 1], &self.stations[next]);
        let part = ((t - from) / (to - from).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        if a == b || part == 0.0 || a.outer.len() != b.outer.len() {
            return Cow::Borrowed(a);
        }
        let mix = |a: &Vec<Point2<f64>>, b: &Vec<Point2<f64>>| {
            a.iter().zip(b).map(|(p, q)| p + (q - p) * part).collect()
        };
        Cow::Owned(Contours {
            outer: mix(&a.outer, &b.outer),
            holes: a.holes.iter().zip(&b.holes).map(|(a, b)| mix(a, b)).collect(),
        })
    }

    fn contains(&self, p: &Point3<f64>) -> bool {
        let from_start = p - self.start;
        let along = from_start.dot(&self.axes.x);
        let across = self.axes.across(&from_start);
        if !(0.0..=self.length).contains(&along) || across.coords.norm() > self.reach {
            return false;
        }
        fills(&self.region(along / self.length), &across)
    }

    fn may_meet(&self, other: &Self) -> bool {
        let radius = |s: &Self| (0.5 * s.length).hypot(s.reach);
        (self.middle - other.middle).norm() <= radius(self) + radius(other)
    }

    /// Means over the solid of 1/c, and of 1/c where it is outside of the part.
    fn shares(&self, all: &[Self], part: &Shadow<'_>, count: usize) -> [f64; 2] {
        let near: Vec<&Self> =
            all.iter().filter(|s| !std::ptr::eq(*s, self) && s.may_meet(self)).collect();
        let (mut hits, mut together, mut outside) = (0.0, 0.0, 0.0);
        for (t, across) in spread(count) {
            let across = across * self.reach;
            if !fills(&self.region(t), &across) {
                continue;
            }
            let at = self.start
                + *self.axes.x * (t * self.length)
                + *self.axes.y * across.x
                + *self.axes.z * across.y;
            let share = 1.0 / (1 + near.iter().filter(|s| s.contains(&at)).count()) as f64;
            hits += 1.0;
            together += share;
            outside += if part.contains(&at) { 0.0 } else { share };
        }
        if hits > 0.0 { [together / hits, outside / hits] } else { [1.0, 0.0] }
    }
}

fn stations(shape: &BeamShape) -> Vec<(f64, Contours)> {
    shape.stations.iter().map(|s| (s.at, Contours::of_region(&s.region, CORNERS))).collect()
}

/// Whether a point lies in a region.
fn fills(region: &Contours, p: &Point2<f64>) -> bool {
    region.polygons().fold(false, |inside, polygon| inside ^ is_in(polygon, p))
}

/// Even–odd rule.
pub(super) fn is_in(polygon: &[Point2<f64>], p: &Point2<f64>) -> bool {
    let mut inside = false;
    let Some(mut a) = polygon.last() else { return false };
    for b in polygon {
        let crosses = (a.y > p.y) != (b.y > p.y);
        if crosses && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
        a = b;
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::beam_section::BeamSection;
    use crate::frame::{Node, NodeId, NodeKind, direction};
    use crate::section::{Profile, Shape};

    /// Round bars of 10 mm between points.
    fn frame(bars: &[[[f64; 3]; 2]]) -> Frame {
        let mut frame = Frame::default();
        for bar in bars {
            let [a, b] = bar.map(Point3::from);
            let first = frame.nodes.len();
            frame.nodes.extend([a, b].map(|position| Node {
                position,
                kind: NodeKind::End,
                interface: None,
            }));
            let profile = Profile::new(Shape::Round { d: 10.0 }).unwrap();
            let properties = profile.properties().unwrap();
            frame.beams.push(Beam {
                ends: [first, first + 1].map(NodeId::new),
                passes: Vec::new(),
                branch: 0,
                axes: BeamAxes::along(direction(&a, &b)),
                length: (b - a).norm(),
                cut_length: (b - a).norm(),
                section: BeamSection::default(),
                measured: None,
                assumed_area: properties.area,
                shape: BeamShape::assumed(profile, properties),
            });
        }
        frame
    }

    /// Two round bars that cross at right angles share the solid of Steinmetz, 16/3 r³.
    #[test]
    fn crossing_bars_are_counted_once_where_they_overlap() {
        let cross =
            frame(&[[[-30.0, 0.0, 0.0], [30.0, 0.0, 0.0]], [[0.0, -30.0, 0.0], [0.0, 30.0, 0.0]]]);
        let mut found = BeamVolumes::default();
        volumes(&cross, &TriangleTree::new(Vec::new())).into_iter().for_each(|v| found += v);
        let sum = 2.0 * std::f64::consts::PI * 25.0 * 60.0;
        let exact = sum - 16.0 / 3.0 * 125.0;
        assert!((found.alone / sum - 1.0).abs() < 1e-3, "{found:?}");
        assert!((found.share / exact - 1.0).abs() < 1e-2, "{found:?} for {exact}");
        assert!((found.outside / found.share - 1.0).abs() < 1e-9, "{found:?}");
    }
}
