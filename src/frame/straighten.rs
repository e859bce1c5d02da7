//! Breaks a bent branch into straight pieces.
//!
//! A chain of points is one piece when none of them is farther from the chord than the tolerance;
//! else it is broken at the farthest and both parts are looked at again. Pieces too short to be a
//! beam are then given to their neighbours: next to a junction a branch turns into it, which is no
//! bend of the beam.

use nalgebra::Point3;

use crate::segment::{bends, distance};

/// Indices at which a chain is broken, its first and last point included.
///
/// * `tolerance`: farthest a point may be from its piece, mm.
/// * `shortest`: no piece is shorter, mm, unless the whole chain is.
pub(crate) fn breaks(chain: &[Point3<f64>], tolerance: f64, shortest: f64) -> Vec<usize> {
    let last = chain.len() - 1;
    let mut kept = vec![0];
    if chain[0] == chain[last] && last > 2 {
        // A ring has no chord: begin with three parts.
        let thirds = [0, last / 3, 2 * last / 3, last];
        thirds.windows(2).for_each(|w| bends(chain, w[0], w[1], tolerance, &mut kept));
    } else {
        bends(chain, 0, last, tolerance, &mut kept);
    }
    join_short_pieces(chain, shortest, &mut kept);
    kept
}

/// Removes breaks, the one at the shortest piece first, until no piece is too short.
fn join_short_pieces(chain: &[Point3<f64>], shortest: f64, kept: &mut Vec<usize>) {
    let least = if chain[0] == chain[chain.len() - 1] { 4 } else { 2 };
    while kept.len() > least {
        let length = |w: &[usize]| (chain[w[1]] - chain[w[0]]).norm();
        let Some((i, found)) =
            kept.windows(2).map(length).enumerate().min_by(|a, b| a.1.total_cmp(&b.1))
        else {
            return;
        };
        if found >= shortest {
            return;
        }
        // The end of the short piece that is a bend; between two bends, the flatter one.
        let bend = match (i, kept.len() - 2 - i) {
            (0, _) => 1,
            (_, 0) => i,
            _ => {
                let off =
                    |k: usize| distance(&chain[kept[k]], &chain[kept[k - 1]], &chain[kept[k + 1]]);
                if off(i) <= off(i + 1) { i } else { i + 1 }
            }
        };
        kept.remove(bend);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_chain_is_one_piece() {
        let chain: Vec<_> = (0..9).map(|i| Point3::new(f64::from(i), 0.0, 0.0)).collect();
        assert_eq!(breaks(&chain, 0.1, 1.0), [0, 8]);
    }

    #[test]
    fn a_right_angle_is_broken_at_its_corner() {
        let chain: Vec<_> = (0..=4)
            .map(|i| Point3::new(f64::from(i), 0.0, 0.0))
            .chain((1..=4).map(|i| Point3::new(4.0, f64::from(i), 0.0)))
            .collect();
        assert_eq!(breaks(&chain, 0.1, 1.0), [0, 4, 8]);
    }

    #[test]
    fn a_ring_becomes_a_polygon_within_the_tolerance() {
        let chain: Vec<_> = (0..=60)
            .map(|i| std::f64::consts::TAU * f64::from(i % 60) / 60.0)
            .map(|t| Point3::new(10.0 * t.cos(), 10.0 * t.sin(), 0.0))
            .collect();
        let kept = breaks(&chain, 1.0, 1.0);
        assert!(kept.len() >= 6 && kept.len() <= 14, "{kept:?}");
        for w in kept.windows(2) {
            for p in &chain[w[0]..=w[1]] {
                assert!(distance(p, &chain[w[0]], &chain[w[1]]) <= 1.0);
            }
        }
    }
}
