//! Beams that are meant to be equal get equal profiles.

use super::MatchTarget;
use crate::cluster;

/// Sections and lengths that agree within this part are meant to be equal. The two halves of a
/// mirrored voxel part agree within half of it, struts that were designed to differ do not.
pub const MEANT_EQUAL: f64 = 0.02;

/// Which beams are equal, and what stands for each group.
#[derive(Clone, Debug, PartialEq)]
pub struct Equalized {
    /// Group of each beam; groups are numbered by their first beam.
    pub group_of: Vec<usize>,
    /// For each group: the mean section, with the contour and axes of its representative.
    pub targets: Vec<MatchTarget>,
    /// For each group: mean length, mm.
    pub lengths: Vec<f64>,
    /// For each group: the beam nearest to the mean.
    pub representatives: Vec<usize>,
}

/// Groups beams whose A, I_1, I_2, J and length all agree within a relative tolerance.
///
/// * `beams`: section and length in mm of each beam.
/// * `tolerance`: largest relative difference between any two beams of a group, such as [`MEANT_EQUAL`].
///   Second moments and J grow with the fourth power of a size, so that of them twice as much is
///   allowed as of area and length.
///
/// Groups are complete: any two beams of one agree, not only neighbours in a chain. Pairs are
/// joined from the nearest on, which makes the groups independent of the order of the beams but
/// for exact ties.
pub fn equalize(beams: &[(MatchTarget, f64)], tolerance: f64) -> Equalized {
    let rows: Vec<[f64; 5]> =
        beams.iter().map(|(t, length)| row([t.area, t.i_1, t.i_2, t.j], *length)).collect();
    let limit = tolerance.max(0.0).ln_1p();
    let distance = |a: usize, b: usize| Some(difference(&rows[a], &rows[b]));
    summary(beams, &rows, &cluster::groups(rows.len(), distance, limit, limit))
}

/// Logarithms of area, I_1, I_2, J and length, halved for the fourth powers.
fn row([area, i_1, i_2, j]: [f64; 4], length: f64) -> [f64; 5] {
    let moments = [i_1, i_2, j].map(|i| 0.5 * i.ln());
    [area.ln(), moments[0], moments[1], moments[2], length.ln()]
}

fn difference(a: &[f64; 5], b: &[f64; 5]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

fn summary(beams: &[(MatchTarget, f64)], rows: &[[f64; 5]], members: &[Vec<usize>]) -> Equalized {
    let mut all = Equalized {
        group_of: vec![0; beams.len()],
        targets: Vec::new(),
        lengths: Vec::new(),
        representatives: Vec::new(),
    };
    for group in members {
        let mean = |of: &dyn Fn(&(MatchTarget, f64)) -> f64| {
            group.iter().map(|&i| of(&beams[i])).sum::<f64>() / group.len() as f64
        };
        let length = mean(&|beam| beam.1);
        let [area, i_1] = [mean(&|beam| beam.0.area), mean(&|beam| beam.0.i_1)];
        let [i_2, j] = [mean(&|beam| beam.0.i_2), mean(&|beam| beam.0.j)];
        let middle = row([area, i_1, i_2, j], length);
        let off = |&&i: &&usize| difference(&rows[i], &middle);
        let nearest = group.iter().min_by(|a, b| off(a).total_cmp(&off(b))).copied();
        let nearest = nearest.unwrap_or(group[0]);
        let target = MatchTarget { area, i_1, i_2, j, ..beams[nearest].0.clone() };
        group.iter().for_each(|&i| all.group_of[i] = all.targets.len());
        all.targets.push(target);
        all.lengths.push(length);
        all.representatives.push(nearest);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::section::profile::{Profile, Shape};

    fn bar(d: f64, length: f64) -> (MatchTarget, f64) {
        let bar = Profile::new(Shape::Round { d }).unwrap();
        (MatchTarget::of_properties(&bar.properties().unwrap()), length)
    }

    #[test]
    fn legs_of_a_table_are_one_group() {
        let beams = [
            bar(10.0, 50.0),
            bar(6.4, 96.0),
            bar(10.1, 50.2),
            bar(9.95, 49.9),
            bar(6.4, 61.0),
            bar(10.05, 50.0),
        ];
        let all = equalize(&beams, 0.05);
        assert_eq!(all.group_of, [0, 1, 0, 0, 2, 0]);
        assert_eq!(all.targets.len(), 3);
        assert!((all.lengths[0] - 50.025).abs() < 1e-9);
    }

    #[test]
    fn chain_of_small_steps_is_cut() {
        let beams: Vec<_> = (0..20).map(|i| bar(10.0 * 1.01f64.powi(i), 50.0)).collect();
        let all = equalize(&beams, 0.05);
        for (i, a) in all.group_of.iter().enumerate() {
            for (j, b) in all.group_of.iter().enumerate() {
                if a == b {
                    assert!(beams[i].0.area / beams[j].0.area < 1.05 + 1e-9);
                }
            }
        }
        assert!(all.targets.len() <= 10);
    }

    #[test]
    fn order_of_the_beams_does_not_matter() {
        let beams: Vec<_> = (0..12).map(|i| bar(10.0 + f64::from(i * i % 7), 50.0)).collect();
        let there = equalize(&beams, 0.1).group_of;
        let back = equalize(&beams.iter().rev().cloned().collect::<Vec<_>>(), 0.1).group_of;
        for i in 0..12 {
            for j in 0..12 {
                assert_eq!(there[i] == there[j], back[11 - i] == back[11 - j]);
            }
        }
    }

    #[test]
    fn no_beams_make_no_groups() {
        assert!(equalize(&[], 0.05).targets.is_empty());
    }
}
