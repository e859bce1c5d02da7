//! Branches round pinholes, which are no beams.

use crate::skeleton::{Branch, PointKind, Skeleton};

/// Whether a branch ends where it begins and goes no farther from there than the thickest branch is
/// thick: the rim of a pinhole in a fillet.
pub(super) fn is_narrow_loop(skeleton: &Skeleton, branch: &Branch) -> bool {
    let [Some(&first), Some(&last)] = [branch.points.first(), branch.points.last()] else {
        return false;
    };
    let node = &skeleton.points[first as usize];
    let is_near = |&p: &u32| (skeleton.position(p) - node.position).norm() <= node.radius;
    first == last && node.kind == PointKind::Junction && branch.points.iter().all(is_near)
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;
    use crate::skeleton::SkeletalPoint;

    #[test]
    fn a_loop_is_narrow_up_to_the_radius_of_its_node() {
        let is_narrow = |side: f64, kind: PointKind, last: u32| {
            let at = [[0.0, 0.0], [side, 0.0], [0.0, side], [0.0, 5.0]];
            let point = |[x, y]: [f64; 2]| SkeletalPoint {
                position: Point3::new(x, y, 0.0),
                radius: 2.0,
                kind,
            };
            let points = at.map(point).to_vec();
            let branch = Branch { points: vec![0, 1, 2, last] };
            is_narrow_loop(&Skeleton { points, branches: Vec::new() }, &branch)
        };
        assert!(is_narrow(1.9, PointKind::Junction, 0));
        assert!(!is_narrow(2.1, PointKind::Junction, 0));
        assert!(!is_narrow(1.9, PointKind::Junction, 3));
        assert!(!is_narrow(1.9, PointKind::Branch, 0), "a ring without a node");
    }
}
