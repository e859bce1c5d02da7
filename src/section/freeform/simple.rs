//! Whether a closed curve crosses itself.

use nalgebra::Point2;

use super::Freeform;

/// Sides of the polygon along one span that is tested. The spans of a mean outline turn by a few
/// degrees each.
const SIDES_PER_SPAN: usize = 4;

impl Freeform {
    /// Whether the curve bounds one region: no part of it meets another.
    pub fn is_simple(&self) -> bool {
        let corners: Vec<Point2<f64>> = self
            .spans()
            .iter()
            .flat_map(|span| {
                (0..SIDES_PER_SPAN).map(|i| {
                    super::super::piece::cubic_at(span, i as f64 / SIDES_PER_SPAN as f64).0
                })
            })
            .collect();
        let n = corners.len();
        let side = |i: usize| [corners[i], corners[(i + 1) % n]];
        let reach = |i: usize| {
            let [a, b] = side(i);
            [a.x.min(b.x), a.x.max(b.x)]
        };
        // From left to right a side can only meet those that begin before it ends.
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&i, &j| reach(i)[0].total_cmp(&reach(j)[0]));
        let are_neighbours = |i: usize, j: usize| (i + 1) % n == j || (j + 1) % n == i;
        order.iter().enumerate().all(|(k, &i)| {
            let beside = order[k + 1..].iter().take_while(|&&j| reach(j)[0] <= reach(i)[1]);
            beside.filter(|&&j| !are_neighbours(i, j)).all(|&j| !meet(&side(i), &side(j)))
        })
    }
}

fn meet([a, b]: &[Point2<f64>; 2], [c, d]: &[Point2<f64>; 2]) -> bool {
    let turn = |a: &Point2<f64>, b: &Point2<f64>, c: &Point2<f64>| (b - a).perp(&(c - a));
    let overlap = |i: usize| a[i].min(b[i]) <= c[i].max(d[i]) && c[i].min(d[i]) <= a[i].max(b[i]);
    overlap(0)
        && overlap(1)
        && turn(a, b, c) * turn(a, b, d) <= 0.0
        && turn(c, d, a) * turn(c, d, b) <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn through(points: &[(f64, f64)]) -> Freeform {
        Freeform::through(points.iter().map(|&(x, y)| Point2::new(x, y)).collect()).unwrap()
    }

    #[test]
    fn a_figure_of_eight_is_not_simple_and_an_egg_is() {
        let eight = [(0.0, 0.0), (4.0, 3.0), (4.0, 0.0), (0.0, 3.0)];
        assert!(!through(&eight).is_simple());
        let egg = [(0.0, 0.0), (4.0, 0.0), (5.0, 2.0), (3.0, 4.0), (0.0, 3.0)];
        assert!(through(&egg).is_simple());
    }
}
