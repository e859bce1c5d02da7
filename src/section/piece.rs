//! Smooth pieces of an outline and integrals over the region they bound.
//!
//! Integrals over the region are turned into integrals along its boundary (Green):
//!
//! ```text
//! ∬ g dA = ∮ G dy   with   ∂G/∂x = g
//! ```
//!
//! and done piece by piece with Gauss points. For lines and cubics the rule is exact, for arcs of
//! a quarter turn it is exact to 1e-14.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Point2, Vector2};

/// One smooth piece of an outline, run over t from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Piece {
    /// A straight line.
    Line { from: Point2<f64>, to: Point2<f64> },
    /// c + p cos θ + q sin θ for θ from 0 to `sweep`, at most a quarter turn.
    Arc { centre: Point2<f64>, p: Vector2<f64>, q: Vector2<f64>, sweep: f64 },
    /// A cubic in Bézier form.
    Cubic([Point2<f64>; 4]),
}

/// Gauss–Legendre rule of ten points: half of its nodes and weights on [−1, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_2, 0.295_524_224_714_752_9),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_3),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_1),
];

/// Parts of a piece in which roots are looked for and lengths are summed; a quarter turn and a span
/// of a section outline turn back at most once in a coordinate, so that 8 part the roots.
const ROOT_PARTS: usize = 8;

impl Piece {
    /// The four quarters of a full ellipse with the half-axes `p` and `q`.
    pub(crate) fn ellipse(centre: Point2<f64>, p: Vector2<f64>, q: Vector2<f64>) -> Vec<Self> {
        [(p, q), (q, -p), (-p, -q), (-q, p)]
            .into_iter()
            .map(|(p, q)| Self::Arc { centre, p, q, sweep: FRAC_PI_2 })
            .collect()
    }

    /// Point and derivative by t.
    pub(crate) fn at(&self, t: f64) -> (Point2<f64>, Vector2<f64>) {
        match self {
            Self::Line { from, to } => (from + (to - from) * t, to - from),
            Self::Arc { centre, p, q, sweep } => {
                let (sin, cos) = (sweep * t).sin_cos();
                (centre + p * cos + q * sin, (q * cos - p * sin) * *sweep)
            }
            Self::Cubic(b) => cubic_at(b, t),
        }
    }

    /// The same piece run backwards.
    pub(crate) fn reversed(&self) -> Self {
        match *self {
            Self::Line { from, to } => Self::Line { from: to, to: from },
            Self::Arc { centre, p, q, sweep } => {
                let (sin, cos) = sweep.sin_cos();
                Self::Arc { centre, p: p * cos + q * sin, q: p * sin - q * cos, sweep }
            }
            Self::Cubic([a, b, c, d]) => Self::Cubic([d, c, b, a]),
        }
    }

    /// Calls `f(point, derivative, weight)` at the Gauss points of t in [`from`, `to`].
    pub(crate) fn visit(
        &self,
        [from, to]: [f64; 2],
        mut f: impl FnMut(Point2<f64>, Vector2<f64>, f64),
    ) {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        for (node, weight) in GAUSS {
            for t in [middle - half * node, middle + half * node] {
                let (p, d) = self.at(t);
                f(p, d, half * weight);
            }
        }
    }

    /// ∫ f(point, derivative) dt over t in [`from`, `to`].
    pub(crate) fn integrate(
        &self,
        range: [f64; 2],
        f: impl Fn(Point2<f64>, Vector2<f64>) -> f64,
    ) -> f64 {
        let mut sum = 0.0;
        self.visit(range, |p, d, weight| sum += weight * f(p, d));
        sum
    }

    /// Enclosed area ½ ∮ (x dy − y dx), mm²; positive if counter-clockwise.
    pub(crate) fn area(pieces: &[Self]) -> f64 {
        sum_over(pieces, |p, d| 0.5 * (p.x * d.y - p.y * d.x))
    }

    /// Length of the chain, mm.
    pub(crate) fn length(pieces: &[Self]) -> f64 {
        pieces.iter().map(Self::own_length).sum()
    }

    fn own_length(&self) -> f64 {
        match self {
            Self::Line { from, to } => (to - from).norm(),
            Self::Arc { p, q, sweep, .. } if p.norm() == q.norm() && p.dot(q) == 0.0 => {
                p.norm() * sweep
            }
            _ => (0..ROOT_PARTS).map(|i| self.integrate(part(i), |_, d| d.norm())).sum(),
        }
    }

    /// Parameters where a function of the point changes sign, ascending, within (0, 1).
    pub(crate) fn roots(&self, f: impl Fn(Point2<f64>, Vector2<f64>) -> f64) -> Vec<f64> {
        let value = |t: f64| {
            let (p, d) = self.at(t);
            f(p, d)
        };
        let mut roots = Vec::new();
        let mut was_negative = value(part(0)[0]) < 0.0;
        for i in 0..ROOT_PARTS {
            let is_negative = value(part(i)[1]) < 0.0;
            if is_negative != was_negative {
                roots.push(bisect(part(i), value));
            }
            was_negative = is_negative;
        }
        roots
    }
}

/// The range of t of one part of a piece.
fn part(i: usize) -> [f64; 2] {
    [i, i + 1].map(|k| k as f64 / ROOT_PARTS as f64)
}

/// ∮ f dt over all pieces.
fn sum_over(pieces: &[Piece], f: impl Fn(Point2<f64>, Vector2<f64>) -> f64) -> f64 {
    pieces.iter().map(|piece| piece.integrate([0.0, 1.0], &f)).sum()
}

/// The centre of the circular arc from one point to another that turns by `sweep`, rad.
///
/// It lies off the middle of the chord c by ½|c| / tan(sweep/2).
pub(crate) fn arc_centre(from: Point2<f64>, to: Point2<f64>, sweep: f64) -> Point2<f64> {
    let chord = to - from;
    let off = Vector2::new(-chord.y, chord.x) * (0.5 / (0.5 * sweep).tan());
    from + chord * 0.5 + off
}

/// The pieces of the circular arc from one point to another that turns by `sweep`, rad.
pub(crate) fn arc_between(from: Point2<f64>, to: Point2<f64>, sweep: f64) -> Vec<Piece> {
    let centre = arc_centre(from, to, sweep);
    let parts = (sweep.abs() / FRAC_PI_2 - 1e-9).ceil().max(1.0);
    let part = sweep.abs() / parts;
    let (p, side) = (from - centre, sweep.signum());
    (0..parts as usize)
        .map(|i| {
            let (sin, cos) = (part * i as f64 * side).sin_cos();
            let p = Vector2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y);
            Piece::Arc { centre, p, q: Vector2::new(-p.y, p.x) * side, sweep: part }
        })
        .collect()
}

/// Point and derivative of a cubic in Bézier form.
pub(crate) fn cubic_at(b: &[Point2<f64>; 4], t: f64) -> (Point2<f64>, Vector2<f64>) {
    let s = 1.0 - t;
    let mix = |w: [f64; 4]| {
        b[0].coords * w[0] + b[1].coords * w[1] + b[2].coords * w[2] + b[3].coords * w[3]
    };
    let point = mix([s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]);
    let slope = mix([-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t]);
    (point.into(), slope)
}

/// Halvings that bring a bracket of (0, 1) down to the rounding of the numbers.
const HALVINGS: usize = 60;

/// A root of `f` between two ends of opposite sign.
pub(crate) fn bisect([mut a, mut b]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    let below = f(a) < 0.0;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (a + b);
        if (f(middle) < 0.0) == below { a = middle } else { b = middle }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn quarter_arcs_integrate_a_fourth_power_exactly() {
        let circle = Piece::ellipse(Point2::origin(), Vector2::x() * 2.0, Vector2::y() * 2.0);
        let i_xx = sum_over(&circle, |p, d| p.x * p.y * p.y * d.y);
        assert!((i_xx - PI * 4.0).abs() < 1e-13, "{i_xx}");
        assert!((Piece::length(&circle) - 4.0 * PI).abs() < 1e-13);
    }

    #[test]
    fn reversed_piece_runs_the_same_way_back() {
        let arc = arc_between(Point2::new(1.0, 0.0), Point2::new(0.0, 1.0), FRAC_PI_2)[0];
        for t in [0.0, 0.3, 1.0] {
            assert!((arc.at(t).0 - arc.reversed().at(1.0 - t).0).norm() < 1e-15);
            assert!((arc.at(t).1 + arc.reversed().at(1.0 - t).1).norm() < 1e-15);
        }
    }

    #[test]
    fn derivative_of_a_cubic_agrees_with_differences() {
        let b = [(0.0, 0.0), (1.0, 2.0), (3.0, -1.0), (4.0, 1.0)].map(|(x, y)| Point2::new(x, y));
        let piece = Piece::Cubic(b);
        let h = 1e-6;
        let difference = (piece.at(0.4 + h).0 - piece.at(0.4 - h).0) / (2.0 * h);
        assert!((difference - piece.at(0.4).1).norm() < 1e-8);
    }
}
