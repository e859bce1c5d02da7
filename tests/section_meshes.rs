//! Sections of real meshes with known beams: properties, families and directions.
//!
//! The frames were meshed from signed distances on a grid, so that corners are cut and walls wavy
//! as in results of an optimization. One is among the samples; with the environment variable
//! `BEAMWRIGHT_CASES` naming a folder of more (`*/truth.json` beside `*/*.obj`), all are measured.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use beamwright::section::freeform::average_outline;
use beamwright::section::matching::{MatchMode, MatchTarget, ProfileChoice, match_profile};
use beamwright::section::{Catalogue, Contours, Outline, SectionProperties};
use nalgebra::{Point2, Point3, Vector3};
use serde_json::Value;

struct Mesh {
    points: Vec<Point3<f64>>,
    triangles: Vec<[usize; 3]>,
}

fn read_obj(path: &Path) -> Mesh {
    let text = std::fs::read_to_string(path).unwrap();
    let mut mesh = Mesh { points: Vec::new(), triangles: Vec::new() };
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let x: Vec<f64> = words.map(|w| w.parse().unwrap()).collect();
                mesh.points.push(Point3::new(x[0], x[1], x[2]));
            }
            Some("f") => {
                let corner = |w: &str| w.split('/').next().unwrap().parse::<usize>().unwrap() - 1;
                let c: Vec<usize> = words.map(corner).collect();
                mesh.triangles.extend((2..c.len()).map(|i| [c[0], c[i - 1], c[i]]));
            }
            _ => {}
        }
    }
    mesh
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::new(value[0].as_f64().unwrap(), value[1].as_f64().unwrap(), value[2].as_f64().unwrap())
}

/// The contour around `at` of the plane with the axes `y` and `z`, in coordinates along them.
fn contour(mesh: &Mesh, at: Point3<f64>, y: Vector3<f64>, z: Vector3<f64>) -> Vec<Point2<f64>> {
    let x = y.cross(&z);
    let height: Vec<f64> = mesh.points.iter().map(|p| (p - at).dot(&x)).collect();
    let mut next = HashMap::new();
    let mut place = HashMap::new();
    for t in &mesh.triangles {
        let mut ends = [None, None];
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            if (height[a] >= 0.0) != (height[b] >= 0.0) {
                let key = (a.min(b), a.max(b));
                let s = height[a] / (height[a] - height[b]);
                let p = mesh.points[a] + (mesh.points[b] - mesh.points[a]) * s - at;
                place.insert(key, Point2::new(p.dot(&y), p.dot(&z)));
                ends[usize::from(height[a] >= 0.0)] = Some(key);
            }
        }
        if let [Some(from), Some(to)] = ends {
            next.insert(from, to);
        }
    }
    let near = |key: &(usize, usize)| place[key].coords.norm();
    let first = *place.keys().min_by(|a, b| near(a).total_cmp(&near(b)).then(a.cmp(b))).unwrap();
    let mut loop_ = vec![first];
    while next[loop_.last().unwrap()] != first {
        loop_.push(next[loop_.last().unwrap()]);
    }
    loop_.iter().map(|key| place[key]).collect()
}

/// Plane angle between two directions without sign, rad.
fn apart(a: f64, b: f64) -> f64 {
    let d = (a - b).rem_euclid(std::f64::consts::PI);
    d.min(std::f64::consts::PI - d)
}

fn check_frame(mesh: &Mesh, truth: &Value) -> usize {
    let nodes = truth["nodes"].as_array().unwrap();
    let mut seen = 0;
    for strut in truth["struts"].as_array().unwrap() {
        let ends = [0, 1].map(|k| {
            let node = strut["nodes"][k].as_u64().unwrap() as usize;
            Point3::from(vector(&nodes[node]))
        });
        let (y, z) = (vector(&strut["axis_y"]), vector(&strut["axis_z"]));
        let cuts: Vec<Vec<Point2<f64>>> = (0..9)
            .map(|i| ends[0] + (ends[1] - ends[0]) * (0.4 + 0.025 * f64::from(i)))
            .map(|at| contour(mesh, at, y, z))
            .collect();
        check_strut(strut, &cuts);
        seen += 1;
    }
    seen
}

fn check_strut(strut: &Value, cuts: &[Vec<Point2<f64>>]) {
    let number = |key: &str| strut[key].as_f64().unwrap();
    let mean = average_outline(cuts, 48).unwrap();
    let all: Vec<SectionProperties> = cuts
        .iter()
        .map(|cut| SectionProperties::of_contours(&Contours::solid(cut.clone())).unwrap())
        .collect();
    let of = |f: fn(&SectionProperties) -> f64| all.iter().map(f).sum::<f64>() / all.len() as f64;
    let (i_y, i_z) = (number("Iy"), number("Iz"));
    let place = format!("strut {} {}", strut["nodes"], strut["params"]);
    assert!((of(|p| p.area) / number("area") - 1.0).abs() < 0.02, "{place}: area");
    assert!((of(|p| p.i_xx) / i_y - 1.0).abs() < 0.05, "{place}: I_y {}", of(|p| p.i_xx) / i_y);
    assert!((of(|p| p.i_yy) / i_z - 1.0).abs() < 0.05, "{place}: I_z {}", of(|p| p.i_yy) / i_z);
    assert!((of(|p| p.j) / number("J") - 1.0).abs() < 0.05, "{place}: J {}", of(|p| p.j));

    let outline = Outline::Freeform(mean).to_polygon(3);
    let target = MatchTarget::of_contours(Contours::solid(outline)).unwrap();
    let choice = ProfileChoice::Auto;
    let matched =
        match_profile(&target, &choice, MatchMode::Stiffness, Catalogue::builtin()).unwrap();
    let expected = match strut["shape"].as_str().unwrap() {
        "circle" => "round",
        other => other,
    };
    println!("{place}: {} uncovered {:.3}", matched.profile, matched.uncovered.unwrap());
    assert_eq!(matched.profile.shape.family(), expected, "{place}");
    if i_y.max(i_z) > 1.2 * i_y.min(i_z) {
        let exact = if i_y > i_z { 0.0 } else { std::f64::consts::FRAC_PI_2 };
        assert!(apart(matched.roll, exact) < 2f64.to_radians(), "{place}: {}", matched.roll);
    }
}

#[test]
fn sample_bar_has_the_section_it_was_made_with() {
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    let truth = std::fs::read_to_string(samples.join("single_bar.truth.json")).unwrap();
    let mesh = read_obj(&samples.join("single_bar.obj"));
    assert_eq!(check_frame(&mesh, &serde_json::from_str(&truth).unwrap()), 1);
}

#[test]
fn frames_of_the_cases_have_the_sections_they_were_made_with() {
    let Some(folder) = std::env::var_os("BEAMWRIGHT_CASES").map(PathBuf::from) else { return };
    let mut struts = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let case = entry.unwrap().path();
        let Ok(truth) = std::fs::read_to_string(case.join("truth.json")) else { continue };
        let mesh = case.join(case.file_name().unwrap()).with_extension("obj");
        struts += check_frame(&read_obj(&mesh), &serde_json::from_str(&truth).unwrap());
    }
    assert!(struts > 0);
}
