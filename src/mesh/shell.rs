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

    /// Counts for each shell the others it lies in.
    fn measure_depths(&mut self, mesh: &HalfEdgeMesh) {
        let tree = TriangleTree::new(mesh.faces().map(|f| mesh.corners(f)).collect());
        let boxes = self.boxes(mesh);
        let samples = self.samples(mesh);
        for s in 0..self.all.len() {
            let mut round = self.all_round(&tree, &self.all[s].place);
            round.retain(|&o| o != s);
            // Where shells pass through each other, a part of either lies in the other.
            let encloses = |&o: &usize| {
                boxes[o].contains(&boxes[s])
                    && self.all[s].volume.abs() < self.all[o].volume.abs()
                    && samples[s].iter().all(|p| self.all_round(&tree, p).contains(&o))
            };
            self.all[s].depth = round.iter().filter(|o| encloses(o)).count();
        }
    }

    /// The shells round a point, by the parity of their crossings on one ray.
    fn all_round(&self, tree: &TriangleTree, point: &Point3<f64>) -> Vec<usize> {
        // Any direction will do that is not along the faces of CAD models.
        let direction = Vector3::new(0.482_9, 0.341_1, 0.806_5);
        let mut crossed: Vec<usize> = Vec::new();
        tree.visit_crossings(point, &direction, |c| {
            crossed.push(self.of_face[c.face as usize] as usize);
        });
        crossed.sort_unstable();
        crossed.chunk_by(|a, b| a == b).filter(|c| c.len() % 2 == 1).map(|c| c[0]).collect()
    }

    fn boxes(&self, mesh: &HalfEdgeMesh) -> Vec<Bounds> {
        let mut boxes = vec![Bounds::EMPTY; self.all.len()];
        for face in mesh.faces() {
            let shell = self.of_face[face.index()] as usize;
            mesh.corners(face).iter().for_each(|p| boxes[shell].add(p));
        }
        boxes
    }

    /// Corners spread over each shell.
    fn samples(&self, mesh: &HalfEdgeMesh) -> Vec<Vec<Point3<f64>>> {
        let mut met = vec![0_usize; self.all.len()];
        let mut samples = vec![Vec::new(); self.all.len()];
        for face in mesh.faces() {
            let shell = self.of_face[face.index()] as usize;
            if met[shell].is_multiple_of(self.all[shell].faces.div_ceil(SAMPLES)) {
                samples[shell].push(mesh.corners(face)[0]);
            }
            met[shell] += 1;
        }
        samples
    }
}

/// Corners of a shell that are asked whether they lie in another. Of shells that pass through each
/// other a smaller part than one in so many is not told from a hollow.
const SAMPLES: usize = 64;

/// The box round a shell.
#[derive(Clone, Copy)]
struct Bounds {
    least: Point3<f64>,
    most: Point3<f64>,
}

impl Bounds {
    const EMPTY: Self = Self {
        least: Point3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        most: Point3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    fn add(&mut self, p: &Point3<f64>) {
        self.least = self.least.inf(p);
        self.most = self.most.sup(p);
    }

    fn contains(&self, other: &Self) -> bool {
        self.least <= other.least && self.most >= other.most
    }
}

#[cfg(test)]
mod tests {
    use super::super::order::tests::mesh;
    use super::super::test_box::corners_and_triangles;
    use super::*;

    /// Boxes from corner to corner, all turned outwards.
    fn shells(boxes: &[[[f64; 3]; 2]]) -> Shells {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for [a, b] in boxes {
            let first = positions.len() as u32;
            let (corners, faces) = corners_and_triangles(*a, *b);
            positions.extend(corners);
            triangles.extend(faces.into_iter().map(|t| t.map(|v| first + v)));
        }
        Shells::new(&mesh(positions, triangles))
    }

    fn depths(boxes: &[[[f64; 3]; 2]]) -> Vec<usize> {
        shells(boxes).all.iter().map(|s| s.depth).collect()
    }

    #[test]
    fn a_box_in_a_box_is_a_hollow() {
        let found = depths(&[[[0.0; 3], [9.0; 3]], [[3.0; 3], [6.0; 3]]]);
        assert_eq!(found, [0, 1]);
    }

    #[test]
    fn boxes_that_pass_through_each_other_are_no_hollows() {
        let spliced = [[[0.0; 3], [20.0, 1.0, 1.0]], [[15.0, 0.0, 0.0], [35.0, 1.0, 1.0]]];
        assert_eq!(depths(&spliced), [0, 0]);
        let shifted = [[[0.0; 3], [9.0; 3]], [[3.0; 3], [12.0; 3]]];
        assert_eq!(depths(&shifted), [0, 0]);
    }
}
