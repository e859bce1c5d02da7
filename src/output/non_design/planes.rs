//! Triangles of one plane made one face, with straight sides.

use nalgebra::{Point3, Vector3};

use super::closed::Closed;
use crate::output::step::{Facet, Facets, Loop};

/// How far corners of one plane may lie off it, relative to the largest coordinate. Rounding to
/// single precision moves them by 1e-7 of it; the STEP writer calls faces flat up to 1e-5.
const FLAT: f64 = 2e-6;

/// The body with a face a plane; `None` where a face has no sound outline.
pub(super) fn merged(body: &Closed) -> Option<Facets> {
    let planes = Planes::new(body, FLAT * body.reach());
    planes.facets()
}

/// The body with a face a triangle.
pub(super) fn unmerged(body: &Closed) -> Facets {
    let face = |t: usize| Facet::Flat {
        normal: body.doubled_area_vector(t),
        outer: Loop::Corners(body.triangles[t].to_vec()),
        inner: Vec::new(),
    };
    let faces = (0..body.triangles.len()).map(face).collect();
    Facets { corners: body.points.clone(), circles: Vec::new(), faces }
}

struct Planes<'a> {
    body: &'a Closed,
    tolerance: f64,
    plane_of: Vec<u32>,
    count: usize,
}

impl<'a> Planes<'a> {
    /// Grows planes from the largest triangles on: small ones have uncertain normals.
    fn new(body: &'a Closed, tolerance: f64) -> Self {
        let mut planes =
            Self { body, tolerance, plane_of: vec![u32::MAX; body.triangles.len()], count: 0 };
        let area = |t: usize| body.doubled_area_vector(t).norm_squared();
        let mut seeds: Vec<usize> = (0..body.triangles.len()).collect();
        seeds.sort_by(|&a, &b| area(b).total_cmp(&area(a)).then(a.cmp(&b)));
        for seed in seeds {
            if planes.plane_of[seed] == u32::MAX {
                planes.grow(seed);
                planes.count += 1;
            }
        }
        planes
    }

    fn grow(&mut self, seed: usize) {
        let normal = self.body.doubled_area_vector(seed).try_normalize(0.0).unwrap_or_default();
        let origin = self.point(self.body.triangles[seed][0]);
        let plane = self.count as u32;
        self.plane_of[seed] = plane;
        let mut stack = vec![seed];
        while let Some(t) = stack.pop() {
            for twin in &self.body.twins[3 * t..3 * t + 3] {
                let next = *twin as usize / 3;
                if self.plane_of[next] == u32::MAX && self.lies_in(next, &origin, &normal) {
                    self.plane_of[next] = plane;
                    stack.push(next);
                }
            }
        }
    }

    /// Whether a triangle lies in a plane, whichever way it faces: a lid made of a fan may be folded
    /// within its plane, and what lies twice over cancels.
    fn lies_in(&self, t: usize, origin: &Point3<f64>, normal: &Vector3<f64>) -> bool {
        let near = |&v: &u32| (self.point(v) - origin).dot(normal).abs() <= self.tolerance;
        self.body.triangles[t].iter().all(near)
    }

    fn point(&self, v: u32) -> Point3<f64> {
        self.body.points[v as usize]
    }

    fn plane(&self, h: usize) -> u32 {
        self.plane_of[h / 3]
    }

    fn is_border(&self, h: usize) -> bool {
        self.plane(h) != self.plane(self.body.twins[h] as usize)
    }

    fn origin(&self, h: usize) -> u32 {
        self.body.triangles[h / 3][h % 3]
    }

    fn facets(&self) -> Option<Facets> {
        let mut normals = vec![Vector3::zeros(); self.count];
        for t in 0..self.body.triangles.len() {
            normals[self.plane_of[t] as usize] += self.body.doubled_area_vector(t);
        }
        let loops = self.loops();
        let kept = self.kept(&loops);
        let mut rings: Vec<Vec<Vec<u32>>> = vec![Vec::new(); self.count];
        for border in &loops {
            let corners = border.iter().map(|&h| self.origin(h)).filter(|&v| kept[v as usize]);
            rings[self.plane(border[0]) as usize].push(corners.collect());
        }
        let faces = rings.into_iter().zip(normals).map(|(rings, n)| self.face(rings, n));
        let faces = faces.collect::<Option<Vec<Facet>>>()?;
        Some(Facets { corners: self.body.points.clone(), circles: Vec::new(), faces })
    }

    /// The outlines of all planes, as sides in order, their own plane on the left.
    fn loops(&self) -> Vec<Vec<usize>> {
        let mut seen = vec![false; self.body.twins.len()];
        let mut loops = Vec::new();
        for start in 0..seen.len() {
            if seen[start] || !self.is_border(start) {
                continue;
            }
            let mut border = Vec::new();
            let mut at = start;
            while !std::mem::replace(&mut seen[at], true) {
                border.push(at);
                at = next(at);
                while !self.is_border(at) {
                    at = next(self.body.twins[at] as usize);
                }
            }
            loops.push(border);
        }
        loops
    }

    /// Which points are corners: not those on a straight side between two planes.
    ///
    /// A side is straight when all points between its hard corners lie on the line from one to
    /// the other; a finely divided circle has no hard corner and keeps all its points.
    fn kept(&self, loops: &[Vec<usize>]) -> Vec<bool> {
        let mut sides_at = vec![0u32; self.body.points.len()];
        loops.iter().flatten().for_each(|&h| sides_at[self.origin(h) as usize] += 1);
        let mut kept = vec![true; self.body.points.len()];
        for border in loops {
            let corners: Vec<u32> = border.iter().map(|&h| self.origin(h)).collect();
            let n = corners.len();
            let is_hard = |i: usize| {
                let (before, after) = (corners[(i + n - 1) % n], corners[(i + 1) % n]);
                sides_at[corners[i] as usize] != 2 || !self.is_on_line(corners[i], before, after)
            };
            let hard: Vec<usize> = (0..n).filter(|&i| is_hard(i)).collect();
            for (k, &from) in hard.iter().enumerate() {
                let to = hard[(k + 1) % hard.len()];
                let between: Vec<u32> =
                    (1..(to + n - from - 1) % n + 1).map(|i| corners[(from + i) % n]).collect();
                if between.iter().all(|&v| self.is_on_line(v, corners[from], corners[to])) {
                    between.iter().for_each(|&v| kept[v as usize] = false);
                }
            }
        }
        kept
    }

    /// Whether a point lies on the line between two others; the same for both ways round.
    fn is_on_line(&self, v: u32, a: u32, b: u32) -> bool {
        let (a, b) = (self.point(a.min(b)), self.point(a.max(b)));
        let p = self.point(v) - a;
        let Some(along) = (b - a).try_normalize(0.0) else { return false };
        (p - along * along.dot(&p)).norm() <= self.tolerance
    }

    /// A face from its outlines: the largest is the outside.
    fn face(&self, rings: Vec<Vec<u32>>, normal: Vector3<f64>) -> Option<Facet> {
        if rings.iter().any(|r| r.len() < 3) {
            return None;
        }
        let normal = normal.try_normalize(0.0)?;
        let outside = (0..rings.len()).max_by(|&a, &b| {
            self.area(&rings[a], &normal).total_cmp(&self.area(&rings[b], &normal))
        })?;
        let mut loops: Vec<Loop> = rings.into_iter().map(Loop::Corners).collect();
        let outer = loops.swap_remove(outside);
        Some(Facet::Flat { normal, outer, inner: loops })
    }

    fn area(&self, ring: &[u32], normal: &Vector3<f64>) -> f64 {
        let origin = self.point(ring[0]);
        let next = ring.iter().cycle().skip(1);
        let parts = ring.iter().zip(next);
        parts
            .map(|(&a, &b)| (self.point(a) - origin).cross(&(self.point(b) - origin)))
            .sum::<Vector3<f64>>()
            .dot(normal)
    }
}

/// The next side of the same triangle.
fn next(h: usize) -> usize {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}
