//! Writes sections and their properties as JSON for `tests/sections/check_properties.py`.
//!
//! With the environment variable `BEAMWRIGHT_SECTION_JSON` naming a file, it is written there;
//! without it, the sections are only computed.

use std::f64::consts::TAU;

use beamwright::section::{Catalogue, Contours, SectionProperties};
use nalgebra::Point2;
use serde_json::{Value, json};

/// A closed contour from a radius by angle.
fn polar(n: usize, radius: impl Fn(f64) -> f64, flat: f64) -> Vec<Point2<f64>> {
    (0..n)
        .map(|i| {
            let t = TAU * (i as f64 + 0.37) / n as f64;
            Point2::new(radius(t) * t.cos(), flat * radius(t) * t.sin())
        })
        .collect()
}

fn polygon(corners: &[(f64, f64)]) -> Contours {
    Contours::solid(corners.iter().map(|&(x, y)| Point2::new(x, y)).collect())
}

fn sections() -> Vec<(String, Contours)> {
    let hollow = Contours {
        outer: polar(60, |t| 20.0 + (3.0 * t).sin(), 0.8),
        holes: vec![
            polar(24, |_| 5.0, 1.0).iter().map(|p| Point2::new(p.x - 8.0, p.y)).collect(),
            polar(24, |_| 4.0, 1.0).iter().map(|p| Point2::new(p.x + 8.0, p.y + 2.0)).collect(),
        ],
    };
    let tee = [
        (0.0, 0.0),
        (3.0, 0.0),
        (3.0, 20.0),
        (12.0, 20.0),
        (12.0, 24.0),
        (-9.0, 24.0),
        (-9.0, 20.0),
        (0.0, 20.0),
    ];
    let mut all = vec![
        ("square".to_owned(), polygon(&[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)])),
        ("plank 1:12".to_owned(), polygon(&[(0.0, 0.0), (48.0, 0.0), (48.0, 4.0), (0.0, 4.0)])),
        ("triangle".to_owned(), polygon(&[(0.0, 0.0), (9.0, 1.0), (2.0, 7.0)])),
        ("tee".to_owned(), polygon(&tee)),
        ("wavy".to_owned(), Contours::solid(polar(64, |t| 10.0 + (5.0 * t).sin(), 0.6))),
        (
            "noisy".to_owned(),
            Contours::solid(polar(
                64,
                |t| 10.0 + 0.4 * (17.0 * t).sin() + 0.3 * (29.0 * t).cos(),
                1.0,
            )),
        ),
        ("star".to_owned(), Contours::solid(polar(80, |t| 10.0 + 4.0 * (5.0 * t).cos(), 1.0))),
        ("two holes".to_owned(), hollow),
    ];
    for name in ["CHS 60.3x4", "SHS 60x60x5", "IPE 200", "HEB 100", "UPE 120", "L 80x80x8", "W8X31"]
    {
        let entry = Catalogue::builtin().find(name).unwrap();
        all.push((name.to_owned(), Contours::of_region(&entry.profile.region(), 8)));
    }
    all
}

fn points(polygon: &[Point2<f64>]) -> Value {
    polygon.iter().map(|p| json!([p.x, p.y])).collect()
}

#[test]
fn sections_are_written_for_the_comparison() {
    let list: Vec<Value> = sections()
        .iter()
        .map(|(name, contours)| {
            let p = SectionProperties::of_contours(contours).unwrap();
            let formula = Catalogue::builtin().find(name).map(|entry| entry.properties.j);
            json!({
                "name": name,
                "outer": points(&contours.outer),
                "holes": contours.holes.iter().map(|hole| points(hole)).collect::<Vec<_>>(),
                "area": p.area, "centroid": [p.centroid.x, p.centroid.y], "perimeter": p.perimeter,
                "i_xx": p.i_xx, "i_yy": p.i_yy, "i_xy": p.i_xy, "i_1": p.i_1, "i_2": p.i_2,
                "j": p.j, "j_of_formula": formula,
            })
        })
        .collect();
    let text = serde_json::to_string(&list).unwrap();
    if let Some(path) = std::env::var_os("BEAMWRIGHT_SECTION_JSON") {
        std::fs::write(path, text).unwrap();
    }
}
