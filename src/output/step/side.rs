//! Which surface connects two pieces of neighbouring sections.

use super::piece::Piece;
use super::tolerance::SAME;

/// What surface connects two pieces of neighbouring stations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Plane,
    Cylinder,
    Cone,
    /// A straight prism over an ellipse or a freeform curve.
    Prism,
    Ruled,
}

/// What surface connects two pieces in parallel planes.
pub(super) fn flat_side(a: &Piece, b: &Piece) -> Side {
    match (a, b) {
        (Piece::Line { from: a0, to: a1 }, Piece::Line { from: b0, to: b1 }) => {
            let (a, b) = (a1 - a0, b1 - b0);
            let parallel = a.perp(&b).abs() <= SAME * a.norm() * b.norm() && a.dot(&b) > 0.0;
            if parallel { Side::Plane } else { Side::Ruled }
        }
        (Piece::Arc(c), Piece::Arc(d))
            if is_between(from_ref(a), from_ref(b), from_ref(a), 0.0) =>
        {
            if c.is_circular() && d.is_circular() { Side::Cylinder } else { Side::Prism }
        }
        (Piece::Arc(a), Piece::Arc(b)) => {
            let size = a.p.norm() + b.p.norm();
            let coaxial = (a.centre - b.centre).norm() <= SAME * size;
            let aligned = a.p.perp(&b.p).abs() <= SAME * size * size && a.p.dot(&b.p) > 0.0;
            let round = a.is_circular() && b.is_circular();
            if coaxial && aligned && round { Side::Cone } else { Side::Ruled }
        }
        _ if is_between(from_ref(a), from_ref(b), from_ref(a), 0.0) => Side::Prism,
        _ => Side::Ruled,
    }
}

fn from_ref(piece: &Piece) -> &[Piece] {
    std::slice::from_ref(piece)
}

/// Whether `middle` is `from + t (to − from)`, number by number.
pub(super) fn is_between(from: &[Piece], middle: &[Piece], to: &[Piece], t: f64) -> bool {
    let all = |ring: &[Piece]| ring.iter().flat_map(Piece::numbers).collect::<Vec<f64>>();
    let (from, middle, to) = (all(from), all(middle), all(to));
    let size = from.iter().chain(&to).fold(0.0, |m: f64, x| m.max(x.abs()));
    let mut triples = from.iter().zip(&middle).zip(&to);
    triples.all(|((a, m), b)| (a + (b - a) * t - m).abs() <= SAME * size)
}
