//! A loft made ready: checked, brought to common pieces, and laid into its cuts.
//!
//! Each station becomes a *level*: the plane its outlines lie in at the end,
//! z = height + slope·(x, y).  The levels of square stations are flat.  With
//! oblique cuts, the end levels either trim the rulings of the spans next to
//! them (`trimmed`), or all levels are turned in proportion; the module page of
//! [`loft`](super::loft) says when.

use nalgebra::{Point2, Point3, Vector2, Vector3};

use super::error::BodyError;
use super::loft::{Between, EndCut, Loft};
use super::piece::{Arc, Piece, Sample};
use super::ring::Ring;
use super::sections::{common_rings, heights};
use super::side::{Side, flat_side, is_between};
use super::tolerance::{MOST_OBLIQUE_DEGREES, SAME};

/// The plane z = height + slope·(x, y).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Level {
    pub(super) height: f64,
    pub(super) slope: Vector2<f64>,
}

/// A loft ready to be integrated and built.
#[derive(Clone, Debug)]
pub(super) struct Levels {
    /// `rings[r][k]` is ring r at station k; ring 0 is the outside.
    pub(super) rings: Vec<Vec<Ring>>,
    /// Heights of the stations, before any cut.
    pub(super) heights: Vec<f64>,
    /// Where the stations end up.
    pub(super) planes: Vec<Level>,
    pub(super) smooth: bool,
    pub(super) trimmed: bool,
}

impl Level {
    pub(super) fn lift(&self, p: &Point2<f64>) -> Point3<f64> {
        Point3::new(p.x, p.y, self.height + self.slope.dot(&p.coords))
    }

    pub(super) fn lift_vector(&self, v: &Vector2<f64>) -> Vector3<f64> {
        Vector3::new(v.x, v.y, self.slope.dot(v))
    }

    pub(super) fn is_flat(&self) -> bool {
        self.slope == Vector2::zeros()
    }
}

impl Levels {
    pub(super) fn new(loft: &Loft) -> Result<Self, BodyError> {
        let heights = heights(&loft.stations)?;
        let rings = common_rings(&loft.stations)?;
        let slopes = [slope(&loft.start, "start")?, slope(&loft.end, "end")?];
        let planes = turned(&heights, slopes);
        let smooth = loft.between == Between::Smooth;
        let mut levels = Self { rings, heights, planes, smooth, trimmed: false };
        levels.drop_needless_stations(slopes);
        levels.begin_arcs_where_cuts_cancel();
        if slopes != [Vector2::zeros(); 2] && !levels.try_trim(slopes) && !levels.ascends() {
            return Err(BodyError::CutsCross);
        }
        Ok(levels)
    }

    /// Index of the last station.
    pub(super) fn last(&self) -> usize {
        self.heights.len() - 1
    }

    /// Whether ring `r` is one closed piece, without corners.
    pub(super) fn is_closed(&self, r: usize) -> bool {
        self.rings[r][0][0].is_closed()
    }

    /// Leaves out stations that lie on the straight way between their neighbours.
    fn drop_needless_stations(&mut self, slopes: [Vector2<f64>; 2]) {
        let last = self.last();
        let needless = |from: usize, k: usize, to: usize| {
            let t =
                (self.heights[k] - self.heights[from]) / (self.heights[to] - self.heights[from]);
            self.rings.iter().all(|ring| is_between(&ring[from], &ring[k], &ring[to], t))
        };
        let mut kept = vec![0];
        if self.smooth && !(1..last).all(|k| needless(0, k, last)) {
            return;
        } else if !self.smooth {
            for k in 1..last {
                if !needless(kept[kept.len() - 1], k, k + 1) {
                    kept.push(k);
                }
            }
        }
        kept.push(last);
        self.smooth = false;
        for ring in &mut self.rings {
            *ring = kept.iter().map(|&k| ring[k].clone()).collect();
        }
        self.heights = kept.iter().map(|&k| self.heights[k]).collect();
        self.planes = turned(&self.heights, slopes);
    }

    /// Begins closed arcs where the slopes of the two end cuts are the same.
    ///
    /// OCCT draws the edge of an oblique cut into the parameters of a cylinder
    /// by interpolation, with an error of the volume of up to 1e-6 that depends
    /// on where the edge begins: it is as the difference of the slopes there.
    fn begin_arcs_where_cuts_cancel(&mut self) {
        let last = self.last();
        let slopes = [self.planes[0].slope, self.planes[last].slope];
        for ring in &mut self.rings {
            let (Piece::Arc(first), Piece::Arc(end)) = (&ring[0][0], &ring[last][0]) else {
                continue;
            };
            if !first.is_full() {
                continue;
            }
            let weigh = |arc: &Arc, g: &Vector2<f64>| {
                Vector2::new(g.dot(&arc.p), g.dot(&arc.q)) * arc.p.norm()
            };
            let difference = weigh(end, &slopes[1]) - weigh(first, &slopes[0]);
            let size = difference.norm();
            if size <= SAME * end.p.norm_squared() {
                continue;
            }
            let (cos, sin) = (difference.y / size, -difference.x / size);
            for pieces in ring {
                if let Piece::Arc(arc) = &mut pieces[0] {
                    *arc = arc.begun_at(cos, sin);
                }
            }
        }
    }

    /// Trims the end spans to their cuts, if their sides allow it.
    fn try_trim(&mut self, slopes: [Vector2<f64>; 2]) -> bool {
        let last = self.last();
        let exact = |k: usize| {
            self.rings.iter().all(|ring| {
                let mut pairs = ring[k].iter().zip(&ring[k + 1]);
                pairs.all(|(a, b)| flat_side(a, b) != Side::Ruled)
            })
        };
        let start_fits = slopes[0] == Vector2::zeros() || exact(0);
        let end_fits = slopes[1] == Vector2::zeros() || exact(last - 1);
        if self.smooth || !start_fits || !end_fits {
            return false;
        }
        let mut trimmed = self.clone();
        trimmed.trimmed = true;
        let flat = |&height| Level { height, slope: Vector2::zeros() };
        trimmed.planes = self.heights.iter().map(flat).collect();
        trimmed.planes[0].slope = slopes[0];
        trimmed.planes[last].slope = slopes[1];
        if trimmed.keeps_direction() && trimmed.ascends() {
            *self = trimmed;
            return true;
        }
        false
    }

    /// Whether trimmed outlines run the same way as before, not past an apex.
    fn keeps_direction(&self) -> bool {
        let runs_on = |r: usize, k: usize, j: usize| {
            let flat = self.rings[r][k][j].samples();
            let cut = self.samples(r, k, j);
            flat.iter().zip(&cut).all(|((_, a), (_, b))| a.dot(&b.xy()) > 0.0)
        };
        [0, self.last()].into_iter().all(|k| {
            (0..self.rings.len()).all(|r| (0..self.rings[r][k].len()).all(|j| runs_on(r, k, j)))
        })
    }

    /// Whether every level lies above the one before it, all around.
    fn ascends(&self) -> bool {
        (0..self.rings.len()).all(|r| {
            (0..self.rings[r][0].len()).all(|j| {
                let levels: Vec<_> = (0..=self.last()).map(|k| self.samples(r, k, j)).collect();
                levels.windows(2).all(|w| w[0].iter().zip(&w[1]).all(|(a, b)| a.0.z < b.0.z))
                    && (0..self.last()).all(|k| self.corner(r, k, j).z < self.corner(r, k + 1, j).z)
            })
        })
    }

    /// Where piece `j` of ring `r` begins at station `k`.
    pub(super) fn corner(&self, r: usize, k: usize, j: usize) -> Point3<f64> {
        let start = |k: usize| (self.rings[r][k][j].start(), Vector2::zeros());
        self.on_level(k, start(k), || start(self.neighbour(k))).0
    }

    /// Points and derivatives of piece `j` of ring `r` at station `k`.
    pub(super) fn samples(&self, r: usize, k: usize, j: usize) -> Vec<(Point3<f64>, Vector3<f64>)> {
        let here = self.rings[r][k][j].samples();
        if !self.trims(k) {
            return here.into_iter().map(|s| self.on_level(k, s, || s)).collect();
        }
        let there = self.rings[r][self.neighbour(k)][j].samples();
        here.into_iter().zip(there).map(|(a, b)| self.on_level(k, a, || b)).collect()
    }

    /// Whether station `k` cuts the rulings of the span next to it.
    fn trims(&self, k: usize) -> bool {
        self.trimmed && !self.planes[k].is_flat()
    }

    /// The station at the other end of the span that station `k` trims.
    pub(super) fn neighbour(&self, k: usize) -> usize {
        if k == 0 { 1 } else { k - 1 }
    }

    /// Brings a point of station `k` onto its level: straight up, or along the
    /// ruling to the same point of the neighbouring station.
    fn on_level(
        &self,
        k: usize,
        (a, a_along): Sample,
        neighbour: impl Fn() -> Sample,
    ) -> (Point3<f64>, Vector3<f64>) {
        let plane = &self.planes[k];
        if !self.trims(k) {
            return (plane.lift(&a), plane.lift_vector(&a_along));
        }
        let (b, b_along) = neighbour();
        // The ruling a + w (b − a) meets the plane where
        // z + w h = height + slope·(a + w d), so w = slope·a / (h − slope·d).
        let h = self.heights[self.neighbour(k)] - self.heights[k];
        let (d, d_along) = (b - a, b_along - a_along);
        let g = plane.slope;
        let below = h - g.dot(&d);
        let w = g.dot(&a.coords) / below;
        let w_along = (g.dot(&a_along) + w * g.dot(&d_along)) / below;
        let at = a + d * w;
        let along = a_along + d_along * w + d * w_along;
        let z = self.heights[k] + w * h;
        (Point3::new(at.x, at.y, z), Vector3::new(along.x, along.y, w_along * h))
    }

    /// What surface connects piece `j` of ring `r` from station `k` to the next.
    pub(super) fn side(&self, r: usize, k: usize, j: usize) -> Side {
        let (a, b) = (&self.rings[r][k][j], &self.rings[r][k + 1][j]);
        let flat = self.trimmed || (self.planes[k].is_flat() && self.planes[k + 1].is_flat());
        match flat_side(a, b) {
            Side::Cone if !flat => Side::Ruled,
            Side::Plane if !flat && !self.is_coplanar(r, j, &[k, k + 1]) => Side::Ruled,
            side => side,
        }
    }

    /// Whether the corners before and after piece `j` lie in one plane.
    pub(super) fn is_coplanar(&self, r: usize, j: usize, stations: &[usize]) -> bool {
        let next = (j + 1) % self.rings[r][0].len();
        let corners: Vec<Point3<f64>> = stations
            .iter()
            .flat_map(|&k| [self.corner(r, k, j), self.corner(r, k, next)])
            .collect();
        let [first, second, .., third, _] = corners[..] else { return false };
        let normal = (second - first).cross(&(third - first));
        let size = corners.iter().map(|c| (c - first).norm()).fold(0.0, f64::max);
        corners.iter().all(|c| (c - first).dot(&normal).abs() <= SAME * size * normal.norm())
    }
}

/// Slope of a cut: z rises by slope·(x, y) away from the axis.
pub(super) fn slope(cut: &EndCut, end: &'static str) -> Result<Vector2<f64>, BodyError> {
    let EndCut::Plane { normal } = cut else { return Ok(Vector2::zeros()) };
    let length = normal.norm();
    if !length.is_finite() || length == 0.0 {
        return Err(BodyError::NotFinite { what: "the direction of a cut" });
    }
    let degrees = (normal.xy().norm()).atan2(normal.z.abs()).to_degrees();
    if degrees > MOST_OBLIQUE_DEGREES + 1e-9 {
        return Err(BodyError::TooOblique { end, degrees });
    }
    let slope = normal.xy() / -normal.z;
    Ok(if slope.norm() <= SAME { Vector2::zeros() } else { slope })
}

/// Levels turned from the start cut to the end cut in proportion to height.
fn turned(heights: &[f64], [start, end]: [Vector2<f64>; 2]) -> Vec<Level> {
    let (from, to) = (heights[0], heights[heights.len() - 1]);
    let level = |&height: &f64| {
        let t = (height - from) / (to - from);
        Level { height, slope: start * (1.0 - t) + end * t }
    };
    heights.iter().map(level).collect()
}
