//! Solves all nodes together so that the axes run through the middle of the material.
//!
//! Every section centroid c at the part t of a beam between the nodes a and b pulls at both:
//!
//! ```text
//!   Σ w |(I − d dᵀ)((1 − t) a + t b − c)|²  +  Σ faint |x − x₀|²  →  min
//! ```
//!
//! with d the direction of the beam and w the volume the centroid stands for. Nodes of interface
//! sections may slide in their plane only. The directions are taken anew after each solution.
//! The normal equations are sparse and positive definite: conjugate gradients.

use nalgebra::{Matrix3, Point3, Unit, Vector3};

/// A centroid that pulls at a beam.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pull {
    /// Its nodes.
    pub(crate) ends: [usize; 2],
    pub(crate) centroid: Point3<f64>,
    /// Volume it stands for, mm³.
    pub(crate) weight: f64,
}

/// Times the directions are taken anew: nodes move by less than a thousandth of a radius after.
const ROUNDS: usize = 3;

/// Pull of a node to its first place, against the mean pull of a beam. It decides only along
/// directions in which the sections say nothing.
const FAINT: f64 = 1e-4;

/// Stiffness of the planes of interface sections, against the mean pull of a beam.
const PLANE: f64 = 1e3;

/// Moves the nodes to where the pulls want them; `planes` holds the normal of the plane a node may
/// slide in.
pub(crate) fn solve_nodes(
    nodes: &mut [Point3<f64>],
    planes: &[Option<Unit<Vector3<f64>>>],
    pulls: &[Pull],
) {
    let first: Vec<Point3<f64>> = nodes.to_vec();
    let mean = pulls.iter().map(|p| p.weight).sum::<f64>() / nodes.len().max(1) as f64;
    if pulls.is_empty() || mean <= 0.0 {
        return;
    }
    for _ in 0..ROUNDS {
        let system = System::new(nodes, &first, planes, pulls, mean);
        let steps = system.solve();
        for (node, step) in nodes.iter_mut().zip(steps) {
            *node += step;
        }
    }
}

/// The normal equations, kept as the small blocks they are a sum of.
struct System {
    /// Blocks on the diagonal.
    own: Vec<Matrix3<f64>>,
    /// Blocks between the ends of pulls: ends, weight of the coupling.
    coupled: Vec<([usize; 2], Matrix3<f64>)>,
    right: Vec<Vector3<f64>>,
}

impl System {
    fn new(
        nodes: &[Point3<f64>],
        first: &[Point3<f64>],
        planes: &[Option<Unit<Vector3<f64>>>],
        pulls: &[Pull],
        mean: f64,
    ) -> Self {
        let mut own = vec![Matrix3::identity() * (FAINT * mean); nodes.len()];
        let mut right: Vec<Vector3<f64>> =
            nodes.iter().zip(first).map(|(x, x0)| (x0 - x) * (FAINT * mean)).collect();
        for (i, normal) in planes.iter().enumerate() {
            if let Some(n) = normal {
                let stiff = n.into_inner() * n.transpose() * (PLANE * mean);
                own[i] += stiff;
                right[i] += stiff * (first[i] - nodes[i]);
            }
        }
        let mut coupled: Vec<([usize; 2], Matrix3<f64>)> = Vec::new();
        for pull in pulls {
            let [a, b] = pull.ends;
            let along = nodes[b] - nodes[a];
            let squared = along.norm_squared();
            if squared == 0.0 {
                continue;
            }
            let across = (Matrix3::identity() - along * along.transpose() / squared) * pull.weight;
            let t = ((pull.centroid - nodes[a]).dot(&along) / squared).clamp(0.0, 1.0);
            let off = across * (pull.centroid - (nodes[a] + along * t));
            own[a] += across * ((1.0 - t) * (1.0 - t));
            own[b] += across * (t * t);
            right[a] += off * (1.0 - t);
            right[b] += off * t;
            let block = across * (t * (1.0 - t));
            match coupled.last_mut() {
                Some((ends, sum)) if *ends == pull.ends => *sum += block,
                _ => coupled.push((pull.ends, block)),
            }
        }
        Self { own, coupled, right }
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
        for _ in 0..6 * n {
            if rz <= goal {
                break;
            }
            let q = self.times(&p);
            let alpha = rz / dot(&p, &q);
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
                })
            })
            .collect();
        let mut nodes = truth;
        nodes[1] += Vector3::new(-0.8, 0.5, 0.3);
        nodes[0] += Vector3::new(0.0, 0.2, -0.4);
        solve_nodes(&mut nodes, &[Some(Vector3::x_axis()), None, None], &pulls);
        assert!((nodes[1] - truth[1]).norm() < 1e-2, "{}", nodes[1]);
        assert!((nodes[0] - truth[0]).norm() < 1e-2, "{}", nodes[0]);
    }
}
