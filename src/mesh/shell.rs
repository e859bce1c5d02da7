//! The separate closed surfaces of a mesh: bodies, cavities, floating islands.

use nalgebra::{Point3, Vector3};

use super::half_edge::HalfEdgeMesh;
use super::id::FaceId;
use super::triangle_tree::TriangleTree;

/// One connected closed surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shell {
    /// Number of triangles.
    pub faces: usize,
    /// Area, mm².
    pub area: f64,
    /// Enclosed volume, mm³; negative where the surface is turned inside out.
    pub volume: f64,
    /// A point of the surface, for messages.
    pub place: Point3<f64>,
    /// How many other shells enclose this one; odd: a cavity.
    pub depth: usize,
}

impl Shell {
    /// Whether the shell bounds a hollow inside a body.
    pub fn is_cavity(&self) -> bool {
        self.depth % 2 == 1
    }
}

/// The shells of a mesh and, for each triangle, its shell.
#[derive(Clone, Debug, Default)]
pub struct Shells {
    /// All shells, in order of their first triangle.
    pub all: Vec<Shell>,
    /// Index into `all` for each triangle.
    pub of_face: Vec<u32>,
}

impl Shells {
    /// Finds the shells and how they enclose each other.
    pub fn new(mesh: &HalfEdgeMesh) -> Self {
        let mut shells = Self { all: Vec::new(), of_face: vec![u32::MAX; mesh.face_count()] };
        for face in mesh.faces() {
            if shells.of_face[face.index()] == u32::MAX {
                shells.add(mesh, face);
            }
        }
        if shells.all.len() > 1 {
            shells.measure_depths(mesh);
        }
        shells
    }

    fn add(&mut self, mesh: &HalfEdgeMesh, seed: FaceId) {
        let id = self.all.len() as u32;
        let place = mesh.corners(seed)[0];
        let mut shell = Shell { faces: 0, area: 0.0, volume: 0.0, place, depth: 0 };
        let mut stack = vec![seed];
        self.of_face[seed.index()] = id;
        while let Some(face) = stack.pop() {
            let [a, b, c] = mesh.corners(face).map(|p| p - place);
            shell.faces += 1;
            shell.area += 0.5 * (b - a).cross(&(c - a)).norm();
            shell.volume += a.dot(&b.cross(&c)) / 6.0;
            for h in face.half_edges() {
                let next = mesh.neighbour(h);
                if self.of_face[next.index()] == u32::MAX {
                    self.of_face[next.index()] = id;
                    stack.push(next);
                }
            }
        }
        self.all.push(shell);
    }

    /// Counts for each shell the others it lies in, by the parity of their crossings on one ray.
    fn measure_depths(&mut self, mesh: &HalfEdgeMesh) {
        let tree = TriangleTree::new(mesh.faces().map(|f| mesh.corners(f)).collect());
        // Any direction will do that is not along the faces of CAD models.
        let direction = Vector3::new(0.482_9, 0.341_1, 0.806_5);
        let mut parity = vec![false; self.all.len()];
        for s in 0..self.all.len() {
            parity.fill(false);
            tree.visit_crossings(&self.all[s].place, &direction, |c| {
                let other = self.of_face[c.face as usize] as usize;
                parity[other] = !parity[other];
            });
            self.all[s].depth = (0..parity.len()).filter(|&o| o != s && parity[o]).count();
        }
    }
}
