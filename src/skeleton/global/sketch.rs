//! The skeleton while it grows: points, chains between them, junctions with their boxes.

use nalgebra::Point3;

use super::identifier_box::IdentifierBox;
use crate::skeleton::graph::{Branch, PointKind, SkeletalPoint, Skeleton};

/// What is saved of a junction (§3.4.2.7).
#[derive(Clone, Debug)]
pub(crate) struct Junction {
    /// Its point.
    pub(crate) point: u32,
    /// The junction box.
    pub(crate) bounds: IdentifierBox,
    /// Axis along which the identifier box widened.
    pub(crate) widened: usize,
    /// l_b of the branch that found it, mm.
    pub(crate) step: f64,
}

/// Points and chains found so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sketch {
    points: Vec<SkeletalPoint>,
    chains: Vec<Vec<u32>>,
    pub(crate) junctions: Vec<Junction>,
}

impl Sketch {
    /// Number of chains.
    pub(crate) fn chains(&self) -> usize {
        self.chains.len()
    }

    pub(crate) fn add_point(&mut self, point: SkeletalPoint) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    /// Saves a branch; a second one without any point of its own between the same ends is none.
    pub(crate) fn add_chain(&mut self, chain: Vec<u32>) {
        let joins = |c: &Vec<u32>| c.first().into_iter().chain(c.last()).all(|p| chain.contains(p));
        if chain.len() > 2 || !self.chains.iter().any(joins) {
            self.chains.push(chain);
        }
    }

    /// Saves a junction (§3.4.2.7); its number.
    pub(crate) fn add_junction(
        &mut self,
        bounds: IdentifierBox,
        widened: usize,
        step: f64,
    ) -> usize {
        let radius = 0.5 * (0..3).map(|k| bounds.width(k)).fold(f64::INFINITY, f64::min);
        let kind = PointKind::Junction;
        let point = self.add_point(SkeletalPoint { position: bounds.centre(), radius, kind });
        self.junctions.push(Junction { point, bounds, widened, step });
        self.junctions.len() - 1
    }

    /// Updates a known junction with a box that met it (§3.4.2.8, §3.4.3.4).
    pub(crate) fn update_junction(&mut self, junction: usize, met: &IdentifierBox) {
        let junction = &mut self.junctions[junction];
        junction.bounds = junction.bounds.joined(met);
        self.points[junction.point as usize].position = junction.bounds.centre();
    }

    /// The known junction that a point and its box belong to: nearer than l_b, or with a box that
    /// overlaps (§3.4.3.2 b and c).
    pub(crate) fn junction_at(
        &self,
        place: &Point3<f64>,
        bounds: &IdentifierBox,
        except: Option<usize>,
    ) -> Option<usize> {
        (0..self.junctions.len()).filter(|j| Some(*j) != except).find(|&j| {
            let known = &self.junctions[j];
            let position = self.points[known.point as usize].position;
            (place - position).norm() < known.step || bounds.overlaps(&known.bounds)
        })
    }

    /// Whether another branch has a point nearer than l_b: this one was generated before (§3.4.3.3,
    /// fig. 3.36).
    pub(crate) fn was_generated(&self, place: &Point3<f64>, step: f64) -> bool {
        let is_near =
            |p: &SkeletalPoint| p.kind != PointKind::Junction && (p.position - place).norm() < step;
        self.points.iter().any(is_near)
    }

    /// The finished skeleton: false junctions removed (§3.4.3.5).
    pub(crate) fn finish(mut self) -> Skeleton {
        self.remove_false_junctions();
        let degrees = self.degrees();
        for (point, degree) in self.points.iter_mut().zip(&degrees) {
            point.kind = match (point.kind, degree) {
                (PointKind::Junction, 2) => PointKind::Branch,
                (PointKind::Junction, 1) => PointKind::End,
                (kind, _) => kind,
            };
        }
        let mut of_point = vec![u32::MAX; self.points.len()];
        let mut skeleton = Skeleton::default();
        for (old, point) in self.points.iter().enumerate().filter(|(p, _)| degrees[*p] > 0) {
            of_point[old] = skeleton.points.len() as u32;
            skeleton.points.push(*point);
        }
        let renumbered = |c: &Vec<u32>| c.iter().map(|&p| of_point[p as usize]).collect();
        skeleton.branches = self.chains.iter().map(|c| Branch { points: renumbered(c) }).collect();
        skeleton
    }

    /// Joins the two chains at each junction that has only two (§3.4.3.5).
    fn remove_false_junctions(&mut self) {
        for j in 0..self.junctions.len() {
            let point = self.junctions[j].point;
            let is_end = |c: &Vec<u32>| c.first() == Some(&point) || c.last() == Some(&point);
            let at: Vec<usize> =
                (0..self.chains.len()).filter(|&c| is_end(&self.chains[c])).collect();
            let is_ring = |c: usize| self.chains[c].first() == self.chains[c].last();
            let &[a, b] = at.as_slice() else { continue };
            if is_ring(a) || is_ring(b) {
                continue;
            }
            let mut second = self.chains.remove(b);
            let first = &mut self.chains[a];
            if first.first() == Some(&point) {
                first.reverse();
            }
            if second.last() == Some(&point) {
                second.reverse();
            }
            first.extend(second.into_iter().skip(1));
        }
    }

    fn degrees(&self) -> Vec<usize> {
        let mut degrees = vec![0; self.points.len()];
        for pair in self.chains.iter().flat_map(|c| c.windows(2)) {
            pair.iter().for_each(|&p| degrees[p as usize] += 1);
        }
        degrees
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64) -> SkeletalPoint {
        SkeletalPoint { position: Point3::new(x, 0.0, 0.0), radius: 1.0, kind: PointKind::Branch }
    }

    #[test]
    fn a_junction_of_two_branches_is_none() {
        let mut sketch = Sketch::default();
        let (a, b) = (sketch.add_point(point(0.0)), sketch.add_point(point(9.0)));
        let bounds = IdentifierBox::cube(Point3::new(4.0, 0.0, 0.0), 2.0);
        let j = sketch.add_junction(bounds, 1, 1.0);
        let middle = sketch.junctions[j].point;
        sketch.add_chain(vec![a, middle]);
        sketch.add_chain(vec![b, middle]);
        let skeleton = sketch.finish();
        assert_eq!(skeleton.branches, [Branch { points: vec![0, 2, 1] }]);
        assert_eq!(skeleton.count(PointKind::Junction), 0);
    }

    #[test]
    fn a_box_that_overlaps_a_junction_box_has_met_it() {
        let mut sketch = Sketch::default();
        let j = sketch.add_junction(IdentifierBox::cube(Point3::origin(), 4.0), 0, 0.5);
        let far = Point3::new(3.0, 0.0, 0.0);
        assert_eq!(sketch.junction_at(&far, &IdentifierBox::cube(far, 3.0), None), Some(j));
        assert_eq!(sketch.junction_at(&far, &IdentifierBox::cube(far, 1.0), None), None);
        assert_eq!(sketch.junction_at(&far, &IdentifierBox::cube(far, 3.0), Some(j)), None);
    }
}
