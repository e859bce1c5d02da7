//! Shapes of facets: sides between neighbours cancel, loops round all of them are left.
//!
//! ```text
//!   ┌───┬───┐      ┌───────┐
//!   │ ╱ │ ╱ │  →   │       │
//!   └───┴───┘      └───────┘
//! ```
//!
//! Facets that look to the viewer all turn the same way round. Where k of them lie over each other
//! the winding number is k, and a side that two of them run along in opposite directions adds
//! nothing to it: filled by the nonzero rule, the loops cover what the facets cover, and no more.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use nalgebra::{Point2, Point3};

use crate::segment::bends;

/// A corner, tenths of a pixel right and down.
type Corner = [i32; 2];

/// Farthest a corner that is left out may lie from the loop, tenths of a pixel.
const TOLERANCE: f64 = 1.5;

/// Loops that hold less are left out, square tenths of a pixel: a fifth of a pixel.
const LEAST_AREA: i64 = 20;

/// A union of facets.
#[derive(Default)]
pub(super) struct Outline {
    /// How often each side is run along.
    sides: BTreeMap<(Corner, Corner), u32>,
}

impl Outline {
    /// Adds a facet; corners in pixels.
    pub(super) fn add(&mut self, corners: &[Point3<f64>; 3]) {
        let [a, b, c] = corners.each_ref().map(|p| [p.x, p.y].map(|x| (10.0 * x).round() as i32));
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if from != to && !self.cancel((to, from)) {
                *self.sides.entry((from, to)).or_default() += 1;
            }
        }
    }

    /// Takes away a side; false where there is none.
    fn cancel(&mut self, side: (Corner, Corner)) -> bool {
        let Some(count) = self.sides.get_mut(&side) else { return false };
        *count -= 1;
        if *count == 0 {
            self.sides.remove(&side);
        }
        true
    }

    /// The loops as path data in tenths of a pixel; empty for nothing to see.
    pub(super) fn path(self) -> String {
        let mut path = String::new();
        for corners in self.loops() {
            let corners = simplified(&corners);
            if doubled_area(&corners).abs() >= 2 * LEAST_AREA {
                write_loop(&mut path, &corners);
            }
        }
        path
    }

    /// Chains the sides. As many begin in a corner as end there, so every chain closes.
    fn loops(self) -> Vec<Vec<Corner>> {
        let mut onward: BTreeMap<Corner, Vec<Corner>> = BTreeMap::new();
        for ((from, to), count) in self.sides {
            onward.entry(from).or_default().extend((0..count).map(|_| to));
        }
        let mut loops = Vec::new();
        while let Some((&start, _)) = onward.first_key_value() {
            let (mut corners, mut at) = (Vec::new(), start);
            while let Some(next) = onward.get_mut(&at).and_then(Vec::pop) {
                corners.push(at);
                if onward[&at].is_empty() {
                    onward.remove(&at);
                }
                at = next;
            }
            loops.push(corners);
        }
        loops
    }
}

/// A loop without the corners that hardly bend it.
fn simplified(corners: &[Corner]) -> Vec<Corner> {
    let Some(&first) = corners.first() else { return Vec::new() };
    let away = |c: &Corner| distance_squared(*c, first);
    let far = (0..corners.len()).max_by_key(|&i| away(&corners[i])).unwrap_or(0);
    let point = |[x, y]: &Corner| Point2::new(f64::from(*x), f64::from(*y));
    let chain: Vec<Point2<f64>> = corners.iter().chain([&first]).map(point).collect();
    let mut kept = vec![0];
    bends(&chain, 0, far, TOLERANCE, &mut kept);
    bends(&chain, far, corners.len(), TOLERANCE, &mut kept);
    kept.pop();
    kept.into_iter().map(|i| corners[i]).collect()
}

fn distance_squared([x, y]: Corner, [u, v]: Corner) -> i64 {
    let [x, y] = [i64::from(x) - i64::from(u), i64::from(y) - i64::from(v)];
    x * x + y * y
}

fn doubled_area(corners: &[Corner]) -> i64 {
    let next = corners.iter().cycle().skip(1);
    let cross = |([x, y], [u, v]): (&Corner, &Corner)| {
        i64::from(*x) * i64::from(*v) - i64::from(*u) * i64::from(*y)
    };
    corners.iter().zip(next).map(cross).sum()
}

/// `M12 34l5-6 7 8z`: from corner to corner by their differences.
fn write_loop(path: &mut String, corners: &[Corner]) {
    let [x, y] = corners[0];
    let _ = write!(path, "M{x} {y}l");
    let steps =
        corners.windows(2).flat_map(|pair| [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]]);
    for (i, step) in steps.enumerate() {
        // A minus parts two numbers as well as a space does.
        let space = if step < 0 || i == 0 { "" } else { " " };
        let _ = write!(path, "{space}{step}");
    }
    path.push('z');
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn facet(corners: [[f64; 2]; 3]) -> [Point3<f64>; 3] {
        corners.map(|[x, y]| Point3::new(x, y, 0.0))
    }

    #[test]
    fn two_halves_of_a_square_are_one_loop() {
        let mut outline = Outline::default();
        outline.add(&facet([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]]));
        outline.add(&facet([[0.0, 0.0], [10.0, 10.0], [0.0, 10.0]]));
        assert_eq!(outline.path(), "M0 0l100 0 0 100-100 0z");
    }

    #[test]
    fn a_row_of_facets_keeps_its_four_corners_only() {
        let mut outline = Outline::default();
        for i in 0..20 {
            let (x, u) = (f64::from(i), f64::from(i + 1));
            outline.add(&facet([[x, 0.0], [u, 0.0], [u, 5.0]]));
            outline.add(&facet([[x, 0.0], [u, 5.0], [x, 5.0]]));
        }
        assert_eq!(outline.path(), "M0 0l200 0 0 50-200 0z");
    }

    #[test]
    fn facets_too_small_to_see_leave_nothing() {
        let mut outline = Outline::default();
        outline.add(&facet([[0.0, 0.0], [0.3, 0.0], [0.3, 0.3]]));
        outline.add(&facet([[5.0, 5.0], [5.01, 5.0], [5.0, 5.01]]));
        assert_eq!(outline.path(), "");
    }

    proptest! {
        /// The loops hold the area of the facets, each counted.
        #[test]
        fn loops_hold_the_area_of_all_facets(
            facets in prop::collection::vec(prop::array::uniform3(prop::array::uniform2(-300..300i32)), 1..40),
        ) {
            let (mut outline, mut area) = (Outline::default(), 0);
            for corners in facets {
                let doubled = doubled_area(&corners);
                let turned = if doubled < 0 { [corners[0], corners[2], corners[1]] } else { corners };
                area += doubled.abs();
                outline.add(&facet(turned.map(|c| c.map(|x| f64::from(x) / 10.0))));
            }
            let loops = outline.loops();
            prop_assert_eq!(loops.iter().map(|l| doubled_area(l)).sum::<i64>(), area);
        }
    }
}
