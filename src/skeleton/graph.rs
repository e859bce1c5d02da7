//! The curve skeleton: points joined to branches.

use nalgebra::Point3;

/// What a skeletal point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointKind {
    /// Centre of an interface section (non-design skeletal point, thesis §3.4.1).
    Interface,
    /// Centre of a section of one branch.
    Branch,
    /// Where three or more branches meet.
    Junction,
    /// Where the object ends freely.
    End,
}

/// A point of the skeleton.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkeletalPoint {
    /// Place, mm.
    pub position: Point3<f64>,
    /// Radius of the disc with the area of the section here, mm.
    pub radius: f64,
    /// What it is.
    pub kind: PointKind,
}

/// A chain of skeletal points between two ends.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Branch {
    /// Indices of its points from one end to the other, ends included; a ring ends where it began.
    pub points: Vec<u32>,
}

/// A curve skeleton.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skeleton {
    /// All points.
    pub points: Vec<SkeletalPoint>,
    /// All branches.
    pub branches: Vec<Branch>,
}

impl Skeleton {
    /// Position of point `index`, mm.
    pub fn position(&self, index: u32) -> Point3<f64> {
        self.points[index as usize].position
    }

    /// The polyline of a branch, mm.
    pub fn polyline(&self, branch: &Branch) -> Vec<Point3<f64>> {
        branch.points.iter().map(|&p| self.position(p)).collect()
    }

    /// Length of a branch along its points, mm.
    pub fn length(&self, branch: &Branch) -> f64 {
        branch.points.windows(2).map(|w| (self.position(w[1]) - self.position(w[0])).norm()).sum()
    }

    /// All segments as pairs of point indices.
    pub fn segments(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.branches.iter().flat_map(|b| b.points.windows(2).map(|w| [w[0], w[1]]))
    }

    /// Number of segments at each point.
    pub fn degrees(&self) -> Vec<u32> {
        let mut degrees = vec![0; self.points.len()];
        self.segments().flatten().for_each(|p| degrees[p as usize] += 1);
        degrees
    }

    /// Number of connected parts.
    pub fn components(&self) -> usize {
        let mut parent: Vec<u32> = (0..self.points.len() as u32).collect();
        let mut count = self.points.len();
        for [a, b] in self.segments() {
            let (a, b) = (root(&mut parent, a), root(&mut parent, b));
            if a != b {
                parent[a.max(b) as usize] = a.min(b);
                count -= 1;
            }
        }
        count
    }

    /// Number of independent cycles: segments − points + components.
    pub fn cycle_rank(&self) -> usize {
        self.segments().count() + self.components() - self.points.len()
    }

    /// Number of points of a kind.
    pub fn count(&self, kind: PointKind) -> usize {
        self.points.iter().filter(|p| p.kind == kind).count()
    }
}

fn root(parent: &mut [u32], mut x: u32) -> u32 {
    while parent[x as usize] != x {
        parent[x as usize] = parent[parent[x as usize] as usize];
        x = parent[x as usize];
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_with_a_tail_has_one_cycle_and_one_component() {
        let point = |x: f64, y: f64| SkeletalPoint {
            position: Point3::new(x, y, 0.0),
            radius: 0.1,
            kind: PointKind::Branch,
        };
        let skeleton = Skeleton {
            points: vec![point(0.0, 0.0), point(1.0, 0.0), point(0.0, 1.0), point(-1.0, 0.0)],
            branches: vec![Branch { points: vec![0, 1, 2, 0] }, Branch { points: vec![0, 3] }],
        };
        assert_eq!((skeleton.cycle_rank(), skeleton.components()), (1, 1));
        assert_eq!(skeleton.degrees(), [3, 2, 2, 1]);
    }
}
