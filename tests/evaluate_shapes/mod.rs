//! Surfaces and skeletons with figures that can be worked out by hand.
#![allow(dead_code)] // each test file uses its own part

use std::f64::consts::TAU;
use std::fmt::Write;

use beamwright::evaluate::{EvaluateOptions, Evaluation, evaluate};
use beamwright::mesh::{LabelParams, Surface, prepare};
use beamwright::skeleton::graph::Skeleton;
use beamwright::skeleton_file;
use beamwright_formats::{Format, ReadOptions, Unit, read_bytes};
use nalgebra::{Isometry3, Point3};

/// Points and triangles; those marked are non-design.
#[derive(Clone, Default)]
pub(crate) struct Shape {
    pub(crate) points: Vec<Point3<f64>>,
    pub(crate) triangles: Vec<([usize; 3], bool)>,
}

impl Shape {
    fn point(&mut self, x: f64, y: f64, z: f64) -> usize {
        self.points.push(Point3::new(x, y, z));
        self.points.len() - 1
    }

    fn quad(&mut self, [a, b, c, d]: [usize; 4], non_design: bool) {
        self.triangles.extend([([a, b, c], non_design), ([a, c, d], non_design)]);
    }

    pub(crate) fn moved(&self, by: &Isometry3<f64>, scale: f64) -> Self {
        let points = self.points.iter().map(|p| by * (p * scale)).collect();
        Self { points, triangles: self.triangles.clone() }
    }

    pub(crate) fn surface(&self) -> Surface {
        let mut obj = String::new();
        for p in &self.points {
            writeln!(obj, "v {:?} {:?} {:?}", p.x, p.y, p.z).unwrap();
        }
        for (group, non_design) in [("design", false), ("non_design", true)] {
            writeln!(obj, "g {group}").unwrap();
            for (t, _) in self.triangles.iter().filter(|t| t.1 == non_design) {
                writeln!(obj, "f {} {} {}", t[0] + 1, t[1] + 1, t[2] + 1).unwrap();
            }
        }
        let raw = read_bytes(obj.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
        prepare(&raw, &LabelParams::default()).unwrap()
    }
}

/// Rod of `n` sides and radius 1 along x from 0 to `length`, in slices of 0.25; the first and last
/// `pad` slices are non-design.
pub(crate) fn rod(length: f64, n: usize, pad: usize) -> Shape {
    let slices = (length / 0.25).round() as usize;
    let mut shape = Shape::default();
    for k in 0..=slices {
        for j in 0..n {
            let (s, c) = (TAU * j as f64 / n as f64).sin_cos();
            shape.point(0.25 * k as f64, c, s);
        }
    }
    for k in 0..slices {
        for j in 0..n {
            let (p, q) = (k * n + j, k * n + (j + 1) % n);
            shape.quad([p, q, q + n, p + n], k < pad || k >= slices - pad);
        }
    }
    let [front, back] = [shape.point(0.0, 0.0, 0.0), shape.point(length, 0.0, 0.0)];
    for j in 0..n {
        let (p, q) = (j, (j + 1) % n);
        shape.triangles.push(([front, q, p], pad > 0));
        shape.triangles.push(([back, slices * n + p, slices * n + q], pad > 0));
    }
    shape
}

/// Ring about z: radius 4 to the axis, 1 of the section.
pub(crate) fn ring() -> Shape {
    let (n, m) = (96, 36);
    let mut shape = Shape::default();
    for i in 0..n {
        let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
        for j in 0..m {
            let (s, c) = (TAU * j as f64 / m as f64).sin_cos();
            shape.point((4.0 + c) * cos, (4.0 + c) * sin, s);
        }
    }
    for i in 0..n {
        for j in 0..m {
            let at = |i: usize, j: usize| (i % n) * m + j % m;
            shape.quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], false);
        }
    }
    shape
}

/// Three arms of 2 × 2 mm section in the plane z = 0, at 120° from each other, 12 mm from the middle
/// to their tips.
pub(crate) fn y_form() -> Shape {
    let mut shape = Shape::default();
    let turned = |k: usize, x: f64, y: f64| {
        let (s, c) = (TAU * k as f64 / 3.0).sin_cos();
        (c * x - s * y, s * x + c * y)
    };
    // Where the sides of two arms meet, and along each arm pairs of corners every millimetre.
    let crotch = 1.0 / 3f64.sqrt();
    let level = |shape: &mut Shape, z: f64| {
        let mut corners = Vec::new();
        for k in 0..3 {
            let arm: Vec<[usize; 2]> = (0..=12)
                .map(|i| crotch + (12.0 - crotch) * f64::from(i) / 12.0)
                .map(|x| {
                    [-1.0, 1.0].map(|y| {
                        let (x, y) = turned(k, x, y);
                        shape.point(x, y, z)
                    })
                })
                .collect();
            corners.push(arm);
        }
        corners
    };
    let bottom = level(&mut shape, -1.0);
    let top = level(&mut shape, 1.0);
    for k in 0..3 {
        for i in 0..12 {
            let [a, b] = [&bottom[k][i], &bottom[k][i + 1]];
            let [c, d] = [&top[k][i], &top[k][i + 1]];
            shape.quad([a[0], a[1], b[1], b[0]], false);
            shape.quad([c[0], d[0], d[1], c[1]], false);
            shape.quad([a[0], b[0], d[0], c[0]], false);
            shape.quad([a[1], c[1], d[1], b[1]], false);
        }
        let (b, t) = (bottom[k][12], top[k][12]);
        shape.quad([b[0], b[1], t[1], t[0]], false);
    }
    let hub = [0, 1, 2].map(|k| (bottom[k][0], top[k][0]));
    shape.triangles.push(([hub[0].0[0], hub[2].0[0], hub[1].0[0]], false));
    shape.triangles.push(([hub[0].1[0], hub[1].1[0], hub[2].1[0]], false));
    shape
}

/// A skeleton of polylines; points at the same place are one.
pub(crate) fn lines(polylines: &[Vec<Point3<f64>>]) -> Skeleton {
    let mut obj = String::new();
    for line in polylines {
        for p in line {
            writeln!(obj, "v {:?} {:?} {:?}", p.x, p.y, p.z).unwrap();
        }
        obj.push('l');
        (0..line.len()).for_each(|k| write!(obj, " {}", k as i64 - line.len() as i64).unwrap());
        obj.push('\n');
    }
    skeleton_file::read_bytes(obj.as_bytes(), skeleton_file::Format::Obj, Unit::Mm).unwrap()
}

/// Points at equal steps from `a` to `b`.
pub(crate) fn line(a: [f64; 3], b: [f64; 3], steps: usize) -> Vec<Point3<f64>> {
    let (a, b) = (Point3::from(a), Point3::from(b));
    (0..=steps).map(|k| a + (b - a) * (k as f64 / steps as f64)).collect()
}

/// The same skeleton elsewhere.
pub(crate) fn moved(skeleton: &Skeleton, by: &Isometry3<f64>, scale: f64) -> Skeleton {
    let mut moved = skeleton.clone();
    moved.points.iter_mut().for_each(|p| p.position = by * (p.position * scale));
    moved
}

/// Evaluation with a cube that holds the section of a rod of radius 1.
pub(crate) fn measured(shape: &Shape, skeleton: &Skeleton) -> Evaluation {
    let options = EvaluateOptions { cube_half: Some(1.75), ..EvaluateOptions::default() };
    evaluate(&shape.surface(), skeleton, &options).unwrap()
}
