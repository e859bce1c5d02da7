//! Whether outlines cross themselves or each other, tested on fine polygons.

use nalgebra::Point2;

use super::piece::Piece;

/// One side of the polygon along an outline.
struct Side {
    ring: usize,
    piece: usize,
    /// Place in the ring, and number of sides there: neighbours share a corner.
    place: usize,
    count: usize,
    from: Point2<f64>,
    to: Point2<f64>,
}

impl Side {
    fn left(&self) -> f64 {
        self.from.x.min(self.to.x)
    }

    fn right(&self) -> f64 {
        self.from.x.max(self.to.x)
    }

    fn is_neighbour(&self, other: &Self) -> bool {
        let apart = self.place.abs_diff(other.place);
        self.ring == other.ring && (apart == 1 || apart + 1 == self.count)
    }

    fn meets(&self, other: &Self) -> bool {
        let turn = |a: &Point2<f64>, b: &Point2<f64>, c: &Point2<f64>| (b - a).perp(&(c - a));
        let overlap = |i: usize| {
            let (a, b) = (self.from[i].min(self.to[i]), self.from[i].max(self.to[i]));
            let (c, d) = (other.from[i].min(other.to[i]), other.from[i].max(other.to[i]));
            a <= d && c <= b
        };
        let (a, b) = (&self.from, &self.to);
        let (c, d) = (&other.from, &other.to);
        overlap(0)
            && overlap(1)
            && turn(a, b, c) * turn(a, b, d) <= 0.0
            && turn(c, d, a) * turn(c, d, b) <= 0.0
    }
}

/// The first place where rings meet: (ring, piece) of both sides.
///
/// Sides are swept from left to right, so that the cost stays near the number
/// of sides that lie above one another.
pub(super) fn first_crossing(rings: &[&[Piece]]) -> Option<[(usize, usize); 2]> {
    let mut sides: Vec<Side> = rings.iter().enumerate().flat_map(|(r, p)| sides_of(r, p)).collect();
    sides.sort_by(|a, b| a.left().total_cmp(&b.left()));
    let mut open: Vec<usize> = Vec::new();
    for (i, side) in sides.iter().enumerate() {
        open.retain(|&j| sides[j].right() >= side.left());
        for &j in &open {
            let other = &sides[j];
            if !side.is_neighbour(other) && side.meets(other) {
                let (a, b) = ((other.ring, other.piece), (side.ring, side.piece));
                return Some([a.min(b), a.max(b)]);
            }
        }
        open.push(i);
    }
    None
}

fn sides_of(ring: usize, pieces: &[Piece]) -> Vec<Side> {
    let corners: Vec<(usize, Point2<f64>)> = pieces
        .iter()
        .enumerate()
        .flat_map(|(piece, p)| p.polygon().into_iter().map(move |at| (piece, at)))
        .collect();
    let count = corners.len();
    (0..count)
        .map(|place| {
            let (piece, from) = corners[place];
            let to = corners[(place + 1) % count].1;
            Side { ring, piece, place, count, from, to }
        })
        .collect()
}

/// Whether a point lies inside the polygon along a ring (even–odd rule).
pub(super) fn encloses(ring: &[Piece], point: &Point2<f64>) -> bool {
    let sides = sides_of(0, ring);
    let crossed = sides.iter().filter(|s| {
        (s.from.y > point.y) != (s.to.y > point.y)
            && point.x < s.from.x + (point.y - s.from.y) / (s.to.y - s.from.y) * (s.to.x - s.from.x)
    });
    crossed.count() % 2 == 1
}
