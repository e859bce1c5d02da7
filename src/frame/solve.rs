//! Solves all nodes together so that the axes run through the middle of the material.
//!
//! Every section centroid c at the part t of a beam between the nodes a and b pulls at both, and
//! every node is held, faintly at first, where the skeleton has it:
//!
//! ```text
//!   Σ w |(I − d dᵀ)((1 − t) a + t b − c)|²_M  +  Σ hold |x − x₀|²  →  min
//! ```
//!
//! with d the direction of the beam, w the volume the centroid stands for and M what an offset
//! weighs by its direction, more across the thin side of a section. Nodes of interface
//! sections may slide in their plane only; a node that a through-going member passes is tied to its
//! axis. The directions are taken anew after each solution. The normal equations are sparse and
//! positive definite: conjugate gradients.

use nalgebra::{Matrix3, Point3, Unit, Vector3};

use crate::segment::part;

/// A centroid that pulls at a beam.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pull {
    /// Its nodes.
    pub(crate) ends: [usize; 2],
    pub(crate) centroid: Point3<f64>,
    /// Volume it stands for, mm³.
    pub(crate) weight: f64,
    /// Weight of an offset by its direction, against that of a round section: more across the
    /// thin side of a flat one, where the beam would stick out of the material first.
    pub(crate) metric: Matrix3<f64>,
}

/// Where a node is held.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Anchor {
    /// Its place in the skeleton.
    pub(crate) place: Point3<f64>,
    /// Normal of the plane it may slide in, into the design part.
    pub(crate) normal: Option<Unit<Vector3<f64>>>,
    /// Radius of the section there, mm.
    pub(crate) radius: f64,
    /// How far it may be from there, mm.
    pub(crate) slide: f64,
    /// Whether it ends in a plane of its own along that of its interface section.
    pub(crate) is_free: bool,
    /// How firmly it is held, against the sum of the pulls at it.
    pub(crate) hold: f64,
}

/// A node that lies on the axis between two others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tie {
    pub(crate) ends: [usize; 2],
    pub(crate) node: usize,
}

/// Times the directions are taken anew: nodes move by less than a thousandth of a radius after.
const ROUNDS: usize = 3;

/// The faintest hold. It decides only along directions in which the sections say nothing.
pub(crate) const FAINT: f64 = 1e-4;

/// Stiffness of the planes of interface sections and of ties, against the pulls at a node.
const STIFF: f64 = 1e3;

/// Moves the nodes to where the pulls want them.
pub(crate) fn solve_nodes(
    nodes: &mut [Point3<f64>],
    anchors: &[Anchor],
    pulls: &[Pull],
    ties: &[Tie],
) {
    let strength = strengths(nodes.len(), pulls);
    if pulls.is_empty() || strength.iter().all(|s| *s <= 0.0) {
        return;
    }
    for _ in 0..ROUNDS {
        let mut system = System::held(nodes, anchors, &strength);
        pulls.iter().for_each(|pull| system.add_pull(nodes, pull));
        ties.iter().for_each(|tie| system.add_tie(nodes, tie, strength[tie.node]));
        for (node, step) in nodes.iter_mut().zip(system.solve()) {
            *node += step;
        }
    }
    for tie in ties {
        let [a, b] = tie.ends.map(|n| nodes[n]);
        nodes[tie.node] = a + (b - a) * part(&nodes[tie.node], &a, &b);
    }
}

/// Sum of the pulls at each node; their mean where there are none.
fn strengths(count: usize, pulls: &[Pull]) -> Vec<f64> {
    let mut sums = vec![0.0; count];
    for pull in pulls {
        pull.ends.iter().for_each(|&n| sums[n] += pull.weight);
    }
    let mean = sums.iter().sum::<f64>() / count.max(1) as f64;
    sums.into_iter().map(|s| if s > 0.0 { s } else { mean }).collect()
}

/// Most steps of conjugate gradients: a tower of a thousand nodes, one above the other, takes as many
/// times six of them; a net of more nodes is as quickly solved as its longest chain.
const MOST_STEPS: usize = 6000;

/// The normal equations, kept as the small blocks they are a sum of.
struct System {
    /// Blocks on the diagonal.
    own: Vec<Matrix3<f64>>,
    /// Blocks between the ends of pulls: ends, weight of the coupling.
    coupled: Vec<([usize; 2], Matrix3<f64>)>,
    right: Vec<Vector3<f64>>,
}

impl System {
    /// Nodes held where they belong and nothing else.
    fn held(nodes: &[Point3<f64>], anchors: &[Anchor], strength: &[f64]) -> Self {
        let mut system = Self {
            own: vec![Matrix3::zeros(); nodes.len()],
            coupled: Vec::new(),
            right: vec![Vector3::zeros(); nodes.len()],
        };
        for (i, anchor) in anchors.iter().enumerate() {
            let mut block = Matrix3::identity() * (anchor.hold * strength[i]);
            if let Some(n) = anchor.normal {
                block += n.into_inner() * n.transpose() * (STIFF * strength[i]);
            }
            system.own[i] = block;
            system.right[i] = block * (anchor.place - nodes[i]);
        }
        system
    }

    fn add_pull(&mut self, nodes: &[Point3<f64>], pull: &Pull) {
        let [a, b] = pull.ends;
        let Some(free) = across(&nodes[a], &nodes[b], 1.0) else { return };
        let across = free * pull.metric * free * pull.weight;
        let t = part(&pull.centroid, &nodes[a], &nodes[b]);
        let off = across * (pull.centroid - (nodes[a] + (nodes[b] - nodes[a]) * t));
        for (n, share) in [(a, 1.0 - t), (b, t)] {
            self.own[n] += across * (share * share);
            self.right[n] += off * share;
        }
        self.couple([a, b], across * (t * (1.0 - t)));
    }

    /// The node n on the axis a b: |across ((1 − t) a + t b − n)|² with a stiff weight.
    fn add_tie(&mut self, nodes: &[Point3<f64>], tie: &Tie, strength: f64) {
        let [a, b] = tie.ends;
        let n = tie.node;
        let Some(across) = across(&nodes[a], &nodes[b], STIFF * strength) else { return };
        let t = part(&nodes[n], &nodes[a], &nodes[b]);
        let off = across * (nodes[n] - (nodes[a] + (nodes[b] - nodes[a]) * t));
        let shares = [(a, 1.0 - t), (b, t), (n, -1.0)];
        for (i, (node, share)) in shares.into_iter().enumerate() {
            self.own[node] += across * (share * share);
            self.right[node] += off * share;
            for (other, its) in shares.into_iter().skip(i + 1) {
                self.couple([node, other], across * (share * its));
            }
        }
    }

    fn couple(&mut self, ends: [usize; 2], block: Matrix3<f64>) {
        match self.coupled.last_mut() {
            Some((last, sum)) if *last == ends => *sum += block,
            _ => self.coupled.push((ends, block)),
        }
    }

    fn times(&self, x: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let mut y: Vec<Vector3<f64>> = self.own.iter().zip(x).map(|(m, x)| m * x).collect();
        for ([a, b], m) in &self.coupled {
            y[*a] += m * x[*b];
            y[*b] += m * x[*a];
        }
        y
    }

    /// Conjugate gradients, preconditioned with the inverse of the diagonal blocks.
    fn solve(&self) -> Vec<Vector3<f64>> {
        let n = self.own.len();
        let inverse: Vec<Matrix3<f64>> =
            self.own.iter().map(|m| m.try_inverse().unwrap_or_else(Matrix3::zeros)).collect();
        let precondition =
            |r: &[Vector3<f64>]| r.iter().zip(&inverse).map(|(r, m)| m * r).collect::<Vec<_>>();
        let dot = |a: &[Vector3<f64>], b: &[Vector3<f64>]| {
            a.iter().zip(b).map(|(a, b)| a.dot(b)).sum::<f64>()
        };
        let mut x = vec![Vector3::zeros(); n];
        let mut r = self.right.clone();
        let mut z = precondition(&r);
        let mut p = z.clone();
        let mut rz = dot(&r, &z);
        let goal = 1e-24 * rz;
        // In exact arithmetic 3 n steps are enough; twice as many bound the rest.
        for _ in 0..MOST_STEPS.min(6 * n) {
            if rz <= goal {
                break;
            }
            let q = self.times(&p);
            // What is left is rounding once the next step has no stiffness against it.
            let stiffness = dot(&p, &q);
            if stiffness.is_nan() || stiffness <= 0.0 {
                break;
            }
            let alpha = rz / stiffness;
            for i in 0..n {
                x[i] += p[i] * alpha;
                r[i] -= q[i] * alpha;
            }
            z = precondition(&r);
            let next = dot(&r, &z);
            let beta = next / rz;
            rz = next;
            for i in 0..n {
                p[i] = z[i] + p[i] * beta;
            }
        }
        x
    }
}

/// The projection across the axis a b, weighted; `None` where they coincide.
fn across(a: &Point3<f64>, b: &Point3<f64>, weight: f64) -> Option<Matrix3<f64>> {
    let along = b - a;
    let squared = along.norm_squared();
    let projection = Matrix3::identity() - along * along.transpose() / squared;
    (squared > 0.0).then(|| projection * weight)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_of_a_bent_frame_move_to_where_its_axes_meet() {
        let truth = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 8.0, 0.0]].map(Point3::from);
        let pulls: Vec<Pull> = [[0, 1], [1, 2]]
            .into_iter()
            .flat_map(|ends: [usize; 2]| {
                (2..=8).map(move |k| Pull {
                    ends,
                    centroid: truth[ends[0]]
                        + (truth[ends[1]] - truth[ends[0]]) * (f64::from(k) / 10.0),
                    weight: 2.0,
                    metric: Matrix3::identity(),
                })
            })
            .collect();
        let mut nodes = truth;
        nodes[1] += Vector3::new(-0.8, 0.5, 0.3);
        nodes[0] += Vector3::new(0.0, 0.2, -0.4);
        let anchors = anchors(&nodes, &[Some(Vector3::x_axis()), None, None]);
        solve_nodes(&mut nodes, &anchors, &pulls, &[]);
        assert!((nodes[1] - truth[1]).norm() < 1e-2, "{}", nodes[1]);
        assert!((nodes[0] - truth[0]).norm() < 1e-2, "{}", nodes[0]);
    }

    fn anchors(nodes: &[Point3<f64>], normals: &[Option<Unit<Vector3<f64>>>]) -> Vec<Anchor> {
        let anchor = |(&place, &normal)| Anchor {
            place,
            normal,
            radius: 1.0,
            slide: 1.0,
            is_free: false,
            hold: FAINT,
        };
        nodes.iter().zip(normals).map(anchor).collect()
    }

    #[test]
    fn a_tied_node_lies_on_the_axis_of_the_member_that_passes_it() {
        let mut nodes = [[0.0, 0.0, 0.0], [20.0, 0.0, 0.0], [11.0, 0.7, 0.2], [11.0, 9.0, 0.0]]
            .map(Point3::from);
        let pull = |ends, x: f64, y: f64| Pull {
            ends,
            centroid: Point3::new(x, y, 0.0),
            weight: 1.0,
            metric: Matrix3::identity(),
        };
        let pulls = [
            pull([0, 1], 4.0, 0.1),
            pull([0, 1], 16.0, 0.1),
            pull([2, 3], 11.0, 3.0),
            pull([2, 3], 11.0, 6.0),
        ];
        let anchors = anchors(&nodes, &[None; 4]);
        solve_nodes(&mut nodes, &anchors, &pulls, &[Tie { ends: [0, 1], node: 2 }]);
        assert!((nodes[2] - Point3::new(11.0, 0.1, 0.0)).norm() < 0.02, "{}", nodes[2]);
        let off = (nodes[2] - nodes[0]).cross(&(nodes[1] - nodes[0])).norm();
        assert!(off < 1e-9, "{off}");
    }
}
