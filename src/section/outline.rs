//! Outlines of sections as chains of lines, arcs and smooth curves.
//!
//! Coordinates are those of the section plane in mm. An outline may run either way round.
//!
//! | outline    | what it is                              | exact in       |
//! |------------|-----------------------------------------|----------------|
//! | `Circle`   | full circle                             | round, tube    |
//! | `Ellipse`  | full ellipse                            | ellipse        |
//! | `Path`     | lines and circular arcs, closed         | rolled shapes  |
//! | `Freeform` | periodic cubic spline through points    | real contours  |

use nalgebra::{Point2, Vector2};

use super::freeform::Freeform;
pub(crate) use super::piece::arc_centre;
use super::piece::{Piece, arc_between};

/// Corners nearer than this part of their coordinates, where two roundings meet, are one point:
/// a thousand roundings of the numbers.
const SAME_POINT: f64 = 1e-13;

/// A closed curve in the plane of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A circle.
    Circle {
        /// Centre.
        centre: Point2<f64>,
        /// Radius, mm.
        radius: f64,
    },
    /// An ellipse.
    Ellipse {
        /// Centre.
        centre: Point2<f64>,
        /// The two half-axes, mm, in any order.
        half_axes: [f64; 2],
        /// Turn of the first half-axis from the first coordinate, rad.
        turn: f64,
    },
    /// Lines and circular arcs.
    Path(Path),
    /// A smooth curve through points.
    Freeform(Freeform),
}

/// A chain of lines and circular arcs; its end is joined to its start by a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Where the chain begins.
    pub start: Point2<f64>,
    /// The pieces, each from the end of the one before.
    pub segments: Vec<Segment>,
}

/// One piece of a [`Path`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// Straight to a point.
    Line {
        /// End of the piece.
        to: Point2<f64>,
    },
    /// Along a circle to a point.
    Arc {
        /// End of the piece.
        to: Point2<f64>,
        /// Angle of the arc, rad, within ±2π; positive is counter-clockwise.
        sweep: f64,
    },
}

/// A region of the section plane: what is within the outer outline and outside the holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The outer outline.
    pub outer: Outline,
    /// Outlines of the holes.
    pub holes: Vec<Outline>,
}

impl Outline {
    /// A circle about the origin.
    pub fn circle(radius: f64) -> Self {
        Self::Circle { centre: Point2::origin(), radius }
    }

    /// An ellipse about the origin with its half-axes along the coordinates.
    pub fn ellipse(half_y: f64, half_z: f64) -> Self {
        Self::Ellipse { centre: Point2::origin(), half_axes: [half_y, half_z], turn: 0.0 }
    }

    /// A polygon through the given corners.
    pub fn polygon(corners: &[Point2<f64>]) -> Self {
        Self::Path(Path::rounded(&corners.iter().map(|&at| (at, 0.0)).collect::<Vec<_>>()))
    }

    /// The smooth pieces in order, oriented counter-clockwise.
    pub(crate) fn pieces(&self) -> Vec<Piece> {
        let pieces = match self {
            Self::Circle { centre, radius } => {
                Piece::ellipse(*centre, Vector2::new(*radius, 0.0), Vector2::new(0.0, *radius))
            }
            Self::Ellipse { centre, half_axes: [a, b], turn } => {
                let (sin, cos) = turn.sin_cos();
                Piece::ellipse(*centre, Vector2::new(cos, sin) * *a, Vector2::new(-sin, cos) * *b)
            }
            Self::Path(path) => path.pieces(),
            Self::Freeform(curve) => curve.spans().into_iter().map(Piece::Cubic).collect(),
        };
        if Piece::area(&pieces) < 0.0 {
            pieces.iter().rev().map(Piece::reversed).collect()
        } else {
            pieces
        }
    }

    /// The outline turned about the origin by an angle, rad; unchanged by an angle of 0.
    pub fn turned(&self, angle: f64) -> Self {
        if angle == 0.0 {
            return self.clone();
        }
        let rotation = nalgebra::Rotation2::new(angle);
        let about = |p: &Point2<f64>| rotation * p;
        match self {
            Self::Circle { centre, radius } => {
                Self::Circle { centre: about(centre), radius: *radius }
            }
            Self::Ellipse { centre, half_axes, turn } => {
                Self::Ellipse { centre: about(centre), half_axes: *half_axes, turn: turn + angle }
            }
            Self::Path(path) => Self::Path(Path {
                start: about(&path.start),
                segments: path.segments.iter().map(|s| s.mapped(about)).collect(),
            }),
            Self::Freeform(curve) => Self::Freeform(curve.turned(angle)),
        }
    }

    /// A counter-clockwise polygon on the curve.
    ///
    /// * `per_quarter`: corners for each quarter turn of an arc, and for each span of a spline.
    pub fn to_polygon(&self, per_quarter: usize) -> Vec<Point2<f64>> {
        let steps = per_quarter.max(1);
        let mut points = Vec::new();
        for piece in self.pieces() {
            let n = if matches!(piece, Piece::Line { .. }) { 1 } else { steps };
            points.extend((0..n).map(|i| piece.at(i as f64 / n as f64).0));
        }
        points
    }
}

impl Path {
    /// A closed chain through corners, each rounded with its radius (0: sharp).
    pub(crate) fn rounded(corners: &[(Point2<f64>, f64)]) -> Self {
        let n = corners.len();
        let mut segments = Vec::with_capacity(2 * n);
        for (i, &(corner, radius)) in corners.iter().enumerate() {
            let (from, to) = (corners[(i + n - 1) % n].0, corners[(i + 1) % n].0);
            let (u, v) = ((corner - from).normalize(), (to - corner).normalize());
            let sweep = u.perp(&v).atan2(u.dot(&v));
            let cut = radius * (0.5 * sweep.abs()).tan();
            segments.push(Segment::Line { to: corner - u * cut });
            if radius > 0.0 {
                segments.push(Segment::Arc { to: corner + v * cut, sweep });
            }
        }
        let start = segments.last().map_or_else(Point2::origin, Segment::end);
        let mut from = start;
        segments.retain(|segment| {
            let moves = (segment.end() - from).norm() > SAME_POINT * from.coords.amax();
            let keep = moves || matches!(segment, Segment::Arc { .. });
            if keep {
                from = segment.end();
            }
            keep
        });
        Self { start, segments }
    }

    fn pieces(&self) -> Vec<Piece> {
        let mut from = self.start;
        let mut pieces = Vec::with_capacity(self.segments.len() + 1);
        for segment in &self.segments {
            match *segment {
                Segment::Line { to } => pieces.push(Piece::Line { from, to }),
                Segment::Arc { to, sweep } => pieces.extend(arc_between(from, to, sweep)),
            }
            from = segment.end();
        }
        if from != self.start {
            pieces.push(Piece::Line { from, to: self.start });
        }
        pieces
    }
}

impl Segment {
    /// The piece with its end mapped by a rigid motion.
    fn mapped(&self, map: impl Fn(&Point2<f64>) -> Point2<f64>) -> Self {
        match self {
            Self::Line { to } => Self::Line { to: map(to) },
            Self::Arc { to, sweep } => Self::Arc { to: map(to), sweep: *sweep },
        }
    }

    /// Where the piece ends.
    pub fn end(&self) -> Point2<f64> {
        match *self {
            Self::Line { to } | Self::Arc { to, .. } => to,
        }
    }
}

impl Region {
    /// A region without holes.
    pub fn solid(outer: Outline) -> Self {
        Self { outer, holes: Vec::new() }
    }

    /// The region turned about the origin by an angle, rad.
    pub fn turned(&self, angle: f64) -> Self {
        let turned = |outline: &Outline| outline.turned(angle);
        Self { outer: turned(&self.outer), holes: self.holes.iter().map(turned).collect() }
    }

    /// All pieces with the material on their left: counter-clockwise outside, clockwise at holes.
    pub(crate) fn pieces(&self) -> Vec<Piece> {
        let mut pieces = self.outer.pieces();
        for hole in &self.holes {
            pieces.extend(hole.pieces().iter().rev().map(Piece::reversed));
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn rounded_square_lacks_its_four_corners() {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let outline = Outline::Path(Path::rounded(&corners.map(|(x, y)| (Point2::new(x, y), 0.5))));
        let area = Piece::area(&outline.pieces());
        assert!((area - (4.0 - (4.0 - PI) * 0.25)).abs() < 1e-14, "{area}");
    }

    #[test]
    fn corner_radius_of_half_the_width_leaves_no_zero_lines() {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let path = Path::rounded(&corners.map(|(x, y)| (Point2::new(x, y), 1.0)));
        assert_eq!(path.segments.len(), 4);
        assert!((Piece::area(&path.pieces()) - PI).abs() < 1e-14);
    }

    #[test]
    fn polygon_keeps_its_corners_whichever_way_it_runs() {
        let corners = [(0.0, 0.0), (0.0, 3.0), (4.0, 0.0)].map(|(x, y)| Point2::new(x, y));
        let polygon = Outline::polygon(&corners).to_polygon(4);
        assert_eq!(polygon.len(), 3);
        assert!(corners.iter().all(|c| polygon.contains(c)));
    }
}
