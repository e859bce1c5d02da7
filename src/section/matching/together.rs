//! What several beams need together.
//!
//! For `not-weaker` that is the largest of each property; else the section whose logarithms of I_1
//! and I_2 are their geometric median, weighted by length (Weiszfeld, Tôhoku Math. J. 43, 1937), with
//! the weighted mean logarithms of A and J.

use super::{MatchMode, MatchTarget, Requirement};

/// Steps of the geometric median: it is found to a thousandth of the spread of its points.
const MEDIAN_STEPS: usize = 50;

/// The target of one profile for all beams.
pub(super) fn together(beams: &[&Requirement], mode: MatchMode) -> MatchTarget {
    let [area, i_1, i_2, j] = if mode == MatchMode::NotWeaker {
        let largest =
            |of: fn(&MatchTarget) -> f64| beams.iter().map(|b| of(&b.target)).fold(0.0, f64::max);
        [largest(|t| t.area), largest(|t| t.i_1), largest(|t| t.i_2), largest(|t| t.j)]
    } else {
        let [i_1, i_2] = median(beams);
        let total: f64 = beams.iter().map(|b| b.length).sum();
        let mean = |of: fn(&MatchTarget) -> f64| {
            let sum: f64 = beams.iter().map(|b| b.length * of(&b.target).ln()).sum();
            (sum / total).exp()
        };
        [mean(|t| t.area), i_1, i_2, mean(|t| t.j)]
    };
    MatchTarget {
        area,
        i_1,
        i_2,
        j,
        principal_angle: 0.0,
        contours: None,
        facets: None,
        worn: None,
    }
}

/// I_1 and I_2 from which the logarithms of the beams' are least far away in all, by length.
fn median(beams: &[&Requirement]) -> [f64; 2] {
    let points: Vec<([f64; 2], f64)> =
        beams.iter().map(|b| ([b.target.i_1.ln(), b.target.i_2.ln()], b.length)).collect();
    let mean = |weights: &dyn Fn(&[f64; 2]) -> f64| {
        let (mut sum, mut total) = ([0.0; 2], 0.0);
        for (p, length) in &points {
            let weight = length * weights(p);
            total += weight;
            sum = [sum[0] + weight * p[0], sum[1] + weight * p[1]];
        }
        sum.map(|x| x / total)
    };
    let away = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let mut at = mean(&|_| 1.0);
    let spread = points.iter().map(|(p, _)| away(p, &at)).fold(0.0, f64::max);
    if spread > 0.0 {
        // A point it comes to lie on has a weight, but no infinite one.
        let nearest = 1e-9 * spread;
        for _ in 0..MEDIAN_STEPS {
            let from = at;
            at = mean(&|p| 1.0 / away(p, &from).max(nearest));
        }
    }
    at.map(f64::exp)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::section::profile::{Profile, Shape};

    #[test]
    fn the_geometric_median_is_nearer_in_all_than_points_about_it() {
        let flat = |(b, h, length): (f64, f64, f64)| {
            let flat = Profile::new(Shape::Rectangle { b, h }).unwrap();
            let target = MatchTarget::of_properties(&flat.properties().unwrap());
            Requirement { target, length }
        };
        let beams = [(5.0, 9.0, 10.0), (8.0, 8.0, 20.0), (6.0, 20.0, 15.0)].map(flat);
        let all: Vec<&Requirement> = beams.iter().collect();
        let way = |i_1: f64, i_2: f64| -> f64 {
            let off = |b: &&Requirement| (i_1 / b.target.i_1).ln().hypot((i_2 / b.target.i_2).ln());
            all.iter().map(|b| b.length * off(b)).sum()
        };
        let [i_1, i_2] = median(&all);
        for (f, g) in [(1.01, 1.0), (0.99, 1.0), (1.0, 1.01), (1.0, 0.99)] {
            assert!(way(i_1, i_2) <= way(f * i_1, g * i_2) * (1.0 + 1e-6));
        }
    }
}
