//! Frames of round struts with pads, from signed distances.

use super::TestMesh;
use super::zero_surface::surface_of;

/// A frame: its truth.
#[derive(Clone, Debug, Default)]
pub struct TrueFrame {
    pub nodes: Vec<[f64; 3]>,
    /// Two nodes and the radii at both.
    pub struts: Vec<([usize; 2], [f64; 2])>,
    /// Nodes that sit in a cube of non-design.
    pub pads: Vec<usize>,
    /// Half the side of a pad.
    pub pad: f64,
}

impl TrueFrame {
    /// Its mesh on a grid of `step`, with faces on the pads labelled.
    pub fn mesh(&self, step: f64) -> TestMesh {
        self.mesh_of(step, |p| self.distance(p))
    }

    /// The same with a hole along z drilled through it.
    pub fn drilled(&self, [x, y]: [f64; 2], radius: f64, step: f64) -> TestMesh {
        self.mesh_of(step, |p| self.distance(p).max(radius - (p[0] - x).hypot(p[1] - y)))
    }

    fn mesh_of(&self, step: f64, distance: impl Fn([f64; 3]) -> f64) -> TestMesh {
        let thickest = self.struts.iter().flat_map(|s| s.1).fold(0.0, f64::max);
        let margin = self.pad.max(1.2 * thickest) + 2.0 * step;
        let low = [0, 1, 2].map(|k| self.bound(k, f64::min) - margin);
        let high = [0, 1, 2].map(|k| self.bound(k, f64::max) + margin);
        // A grid that no pad face lies on.
        let low = low.map(|x| x - 0.37 * step);
        surface_of(distance, low, high, step)
            .labelled(|middle| self.pad_distance(middle) < 0.35 * step)
    }

    fn bound(&self, axis: usize, pick: fn(f64, f64) -> f64) -> f64 {
        self.nodes.iter().map(|n| n[axis]).reduce(pick).unwrap_or(0.0)
    }

    fn distance(&self, p: [f64; 3]) -> f64 {
        let struts =
            self.struts.iter().map(|&([a, b], r)| round_cone(p, self.nodes[a], self.nodes[b], r));
        struts.fold(f64::INFINITY, f64::min).min(self.pad_distance(p))
    }

    fn pad_distance(&self, p: [f64; 3]) -> f64 {
        self.pads
            .iter()
            .map(|&n| {
                (0..3).map(|k| (p[k] - self.nodes[n][k]).abs() - self.pad).fold(f64::MIN, f64::max)
            })
            .fold(f64::INFINITY, f64::min)
    }
}

/// Distance from a strut whose radius runs straight from one end to the other.
fn round_cone(p: [f64; 3], a: [f64; 3], b: [f64; 3], r: [f64; 2]) -> f64 {
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let sub = |u: [f64; 3], v: [f64; 3]| [0, 1, 2].map(|k| u[k] - v[k]);
    let along = sub(b, a);
    let t = (dot(sub(p, a), along) / dot(along, along)).clamp(0.0, 1.0);
    let foot = [0, 1, 2].map(|k| a[k] + t * along[k]);
    let off = sub(p, foot);
    dot(off, off).sqrt() - (r[0] + t * (r[1] - r[0]))
}

fn equal(r: f64) -> [f64; 2] {
    [r, r]
}

/// One bar between two pads.
pub fn bar() -> TrueFrame {
    TrueFrame {
        nodes: vec![[0.0, 0.0, 0.0], [50.0, 0.0, 0.0]],
        struts: vec![([0, 1], equal(4.0))],
        pads: vec![0, 1],
        pad: 6.0,
    }
}

/// A bar that tapers from 5 to 3.
pub fn taper() -> TrueFrame {
    TrueFrame { struts: vec![([0, 1], [5.0, 3.0])], pad: 7.0, ..bar() }
}

/// Three struts that meet at right angles, all on pads.
pub fn corner() -> TrueFrame {
    TrueFrame {
        nodes: vec![[0.0, 0.0, 0.0], [50.0, 0.0, 0.0], [0.0, 50.0, 0.0], [0.0, 0.0, 50.0]],
        struts: vec![([0, 1], equal(4.0)), ([0, 2], equal(4.0)), ([0, 3], equal(4.0))],
        pads: vec![1, 2, 3],
        pad: 6.0,
    }
}

/// A T: a through member and a thinner stem.
pub fn tee() -> TrueFrame {
    TrueFrame {
        nodes: vec![[-45.0, 0.0, 0.0], [45.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 45.0]],
        struts: vec![([0, 2], equal(4.5)), ([2, 1], equal(4.5)), ([2, 3], equal(3.0))],
        pads: vec![0, 1, 3],
        pad: 6.5,
    }
}

/// Four struts that cross in the plane at 60°.
pub fn cross() -> TrueFrame {
    TrueFrame {
        nodes: vec![
            [0.0, 0.0, 0.0],
            [40.0, 0.0, 0.0],
            [-40.0, 0.0, 0.0],
            [20.0, 34.64, 0.0],
            [-20.0, -34.64, 0.0],
        ],
        struts: (1..5).map(|n| ([0, n], equal(3.5))).collect(),
        pads: vec![1, 2, 3, 4],
        pad: 5.5,
    }
}

/// A square ring of struts with a leg to a pad at each corner: one cycle.
pub fn table() -> TrueFrame {
    let corner = [[0.0, 0.0], [45.0, 0.0], [45.0, 35.0], [0.0, 35.0]];
    let top = corner.map(|[x, y]| [x, y, 30.0]);
    let foot = corner.map(|[x, y]| [x, y, 0.0]);
    TrueFrame {
        nodes: top.iter().chain(&foot).copied().collect(),
        struts: (0..4)
            .map(|i| ([i, (i + 1) % 4], equal(3.0)))
            .chain((0..4).map(|i| ([i, i + 4], equal(3.5))))
            .collect(),
        pads: vec![4, 5, 6, 7],
        pad: 5.5,
    }
}

/// The edges of a cube without pads: five cycles, no labels.
pub fn cube() -> TrueFrame {
    let nodes: Vec<[f64; 3]> = (0..8)
        .map(|k| [f64::from(k & 1) * 40.0, f64::from(k >> 1 & 1) * 40.0, f64::from(k >> 2) * 40.0])
        .collect();
    let struts = (0..8usize)
        .flat_map(|a| [1, 2, 4].map(|bit| (a, a ^ bit)))
        .filter(|(a, b)| a < b)
        .map(|(a, b)| ([a, b], equal(3.5)))
        .collect();
    TrueFrame { nodes, struts, pads: Vec::new(), pad: 0.0 }
}

/// A node that three struts leave to one side, 34° from each other: they fill one lump before they part.
pub fn spike() -> TrueFrame {
    let far = |k: f64| {
        let (sin, cos) = (k * std::f64::consts::TAU / 3.0).sin_cos();
        [60.0, 21.0 * cos, 21.0 * sin]
    };
    TrueFrame {
        nodes: vec![[0.0, 0.0, 0.0], far(0.0), far(1.0), far(2.0)],
        struts: (1..4).map(|n| ([0, n], equal(3.0))).collect(),
        pads: vec![1, 2, 3],
        pad: 5.0,
    }
}

/// Two struts that meet at 44°, and two more from the end of one: the joint there lies behind the
/// interface section of the other.
pub fn turned_back() -> TrueFrame {
    TrueFrame {
        nodes: vec![
            [0.0, 0.0, 0.0],
            [52.0, 21.0, 0.0],
            [43.0, -17.0, 0.0],
            [85.0, -35.0, 0.0],
            [55.0, -57.0, 0.0],
        ],
        struts: vec![
            ([0, 1], equal(2.7)),
            ([0, 2], equal(2.5)),
            ([2, 3], equal(3.2)),
            ([2, 4], equal(3.0)),
        ],
        pads: vec![1, 3, 4],
        pad: 5.5,
    }
}

/// Two junctions one and a half diameters apart.
pub fn close_pair() -> TrueFrame {
    TrueFrame {
        nodes: vec![
            [0.0, 0.0, 0.0],
            [11.0, 0.0, 0.0],
            [-35.0, 27.0, 0.0],
            [-35.0, -27.0, 5.0],
            [46.0, 27.0, 5.0],
            [46.0, -27.0, 0.0],
        ],
        struts: vec![
            ([0, 1], equal(3.8)),
            ([0, 2], equal(3.5)),
            ([0, 3], equal(3.5)),
            ([1, 4], equal(3.5)),
            ([1, 5], equal(3.5)),
        ],
        pads: vec![2, 3, 4, 5],
        pad: 5.5,
    }
}

/// A stem that forks into two legs `angle` degrees apart; its joint is node 1.
pub fn fork(angle: f64) -> TrueFrame {
    let (sin, cos) = (0.5 * angle).to_radians().sin_cos();
    TrueFrame {
        nodes: vec![
            [0.0, 0.0, 0.0],
            [45.0, 0.0, 0.0],
            [45.0 + 60.0 * cos, 60.0 * sin, 0.0],
            [45.0 + 60.0 * cos, -60.0 * sin, 0.0],
        ],
        struts: vec![([0, 1], equal(4.0)), ([1, 2], equal(3.0)), ([1, 3], equal(3.0))],
        pads: vec![0, 2, 3],
        pad: 5.5,
    }
}
