//! Groups of things that are nearly equal.

use std::collections::HashSet;

/// Groups of which any two members lie within `farthest` of each other.
///
/// The nearest two are joined first, as long as the nearest of both groups lie within `gap`. No
/// chain of small differences joins what differs much, and the groups do not depend on the order
/// of the things but for exact ties.
///
/// * `distance`: of two of `count` things, the first the earlier; `None` where they are no equals.
///
/// Groups and their members are in ascending order.
pub(crate) fn groups(
    count: usize,
    distance: impl Fn(usize, usize) -> Option<f64>,
    farthest: f64,
    gap: f64,
) -> Vec<Vec<usize>> {
    let mut pairs = Vec::new();
    for a in 0..count {
        for b in a + 1..count {
            if let Some(apart) = distance(a, b).filter(|d| *d <= farthest) {
                pairs.push((apart, a, b));
            }
        }
    }
    pairs.sort_by(|p, q| p.0.total_cmp(&q.0).then((p.1, p.2).cmp(&(q.1, q.2))));
    let near: HashSet<(usize, usize)> = pairs.iter().map(|&(_, a, b)| (a, b)).collect();
    let agree = |i: usize, j: usize| near.contains(&(i.min(j), i.max(j)));
    let mut members: Vec<Vec<usize>> = (0..count).map(|i| vec![i]).collect();
    let mut group: Vec<usize> = (0..count).collect();
    for (_, a, b) in pairs.into_iter().take_while(|p| p.0 <= gap) {
        let (g, h) = (group[a].min(group[b]), group[a].max(group[b]));
        if g != h && members[g].iter().all(|&i| members[h].iter().all(|&j| agree(i, j))) {
            let joined = std::mem::take(&mut members[h]);
            joined.iter().for_each(|&i| group[i] = g);
            members[g].extend(joined);
        }
    }
    members.retain(|m| !m.is_empty());
    members.iter_mut().for_each(|m| m.sort_unstable());
    members
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_a_line(at: &[f64], farthest: f64, gap: f64) -> Vec<Vec<usize>> {
        groups(at.len(), |a, b| Some((at[a] - at[b]).abs()), farthest, gap)
    }

    #[test]
    fn a_gap_parts_what_would_fit_into_one_group() {
        let at = [10.0, 10.01, 10.08, 10.09];
        assert_eq!(on_a_line(&at, 0.1, 0.1), [vec![0, 1, 2, 3]]);
        assert_eq!(on_a_line(&at, 0.1, 0.05), [vec![0, 1], vec![2, 3]]);
    }

    #[test]
    fn a_chain_of_small_steps_is_cut() {
        let at: Vec<f64> = (0..30).map(|i| f64::from(i) * 0.04).collect();
        for group in on_a_line(&at, 0.1, 0.05) {
            assert!(at[group[group.len() - 1]] - at[group[0]] <= 0.1);
        }
    }

    #[test]
    fn what_is_no_equal_is_left_alone() {
        assert_eq!(groups(3, |_, _| None, 1.0, 1.0), [[0], [1], [2]]);
    }
}
