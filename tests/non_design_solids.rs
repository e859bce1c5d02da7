//! Non-design parts of whole meshes: pads closed over where the design part touched them, walls of
//! holes left out, what has too many faces beside the STEP file.

mod common;

use beamwright::finding::FindingKind;
use beamwright::output::non_design::{FACE_BUDGET, NonDesign, non_design};
use common::TestMesh;
use common::frame::bar;
use common::zero_surface::surface_of;

fn parts(mesh: &TestMesh) -> NonDesign {
    non_design(&mesh.surface(), 7850.0)
}

fn volume(points: &[nalgebra::Point3<f64>], triangles: &[[u32; 3]]) -> f64 {
    let part = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| points[v as usize].coords);
        a.dot(&b.cross(&c)) / 6.0
    };
    triangles.iter().map(part).sum()
}

#[test]
fn pads_are_closed_over_where_the_bar_stood() {
    let found = parts(&bar().mesh(1.0));
    assert_eq!((found.parts.len(), found.meshes.len()), (2, 0), "{:?}", found.findings);
    for part in &found.parts {
        // A cube of 12 mm, its edges cut by the grid.
        let volume = part.body.check().expect("a closed solid");
        assert!((volume / 1728.0 - 1.0).abs() < 0.03, "{volume} mm³");
    }
}

#[test]
fn the_wall_of_a_hole_is_no_part_and_told() {
    let radius = |p: [f64; 3]| p[0].hypot(p[1]);
    let plate = |p: [f64; 3]| {
        let outside = (p[0].abs() - 20.0).max(p[1].abs() - 20.0).max(p[2].abs() - 6.0);
        outside.max(9.0 - radius(p))
    };
    let mesh = surface_of(plate, [-22.4, -22.4, -8.4], [22.4, 22.4, 8.4], 1.3)
        .labelled(|middle| radius(middle) < 9.3);
    let found = parts(&mesh);
    assert!(found.parts.is_empty() && found.meshes.is_empty());
    let [finding] = found.findings.as_slice() else { panic!("{:?}", found.findings) };
    assert_eq!(finding.kind, FindingKind::NonDesign);
    assert!(finding.text.contains("encloses no material"), "{}", finding.text);
}

#[test]
fn a_part_of_too_many_faces_goes_beside_with_a_finding() {
    let ball = |p: [f64; 3], x: f64| ((p[0] - x).powi(2) + p[1] * p[1] + p[2] * p[2]).sqrt() - 10.0;
    let bar = |p: [f64; 3]| (p[1].hypot(p[2]) - 3.0).max(-p[0]).max(p[0] - 60.0);
    let solid = |p: [f64; 3]| ball(p, 0.0).min(ball(p, 60.0)).min(bar(p));
    let mesh = surface_of(solid, [-12.3, -12.3, -12.3], [72.3, 12.3, 12.3], 0.6)
        .labelled(|middle| ball(middle, 0.0).min(ball(middle, 60.0)) < 0.2);
    let found = parts(&mesh);
    assert!(found.parts.is_empty());
    let told = found.findings.iter().filter(|f| f.kind == FindingKind::NonDesign).count();
    assert_eq!((found.meshes.len(), told), (2, 2), "{:?}", found.findings);
    for part in &found.meshes {
        assert!(part.triangles.len() > FACE_BUDGET / 2);
        let exact = 4.0 / 3.0 * std::f64::consts::PI * 1000.0;
        let volume = volume(&part.points, &part.triangles);
        assert!((volume / exact - 1.0).abs() < 0.02, "{volume} mm³");
    }
}
