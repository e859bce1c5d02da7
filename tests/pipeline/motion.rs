//! A part that is moved, scaled or listed in another order has the same skeleton, moved with it.

use nalgebra::{Isometry3, Point3, Vector3};
use tempfile::tempdir;

use crate::common::TestMesh;
use crate::common::curves::Curves;
use crate::common::program::run;
use crate::objects::labelled;

/// Largest distance between corresponding points, in section radii.
const SAME: f64 = 1e-3;

fn skeleton_of(mesh: &TestMesh) -> Curves {
    let folder = tempdir().expect("a folder");
    std::fs::write(folder.path().join("part.obj"), mesh.obj()).expect("a file");
    run(folder.path(), &["skeleton", "part.obj", "-o", "out.json", "--strict"]).succeeded();
    Curves::read(&folder.path().join("out.json"))
}

/// The skeletons of a mapped mesh and of the mesh itself, mapped, agree.
fn assert_moves_along(map: impl Fn([f64; 3]) -> [f64; 3] + Copy, scale: f64) {
    for (name, mesh) in labelled() {
        let still = skeleton_of(&mesh);
        let radius = still.radii.iter().copied().fold(f64::INFINITY, f64::min) * scale;
        let moved = skeleton_of(&mesh.mapped(map));
        let deviation =
            moved.deviation_from(&still.mapped(map)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(deviation <= SAME * radius, "{name}: {deviation} mm of {radius} mm");
    }
}

fn rigid(turn: [f64; 3], shift: [f64; 3]) -> impl Fn([f64; 3]) -> [f64; 3] + Copy {
    let motion = Isometry3::new(Vector3::from(shift), Vector3::from(turn));
    move |p| (motion * Point3::from(p)).into()
}

#[test]
fn a_turned_and_shifted_part_has_the_turned_and_shifted_skeleton() {
    assert_moves_along(rigid([0.7, -0.4, 1.9], [130.0, -77.0, 12.5]), 1.0);
}

#[test]
fn a_part_far_from_the_origin_has_its_skeleton_there() {
    assert_moves_along(rigid([0.0, 0.1, 0.0], [1e5, -1e5, 1e5]), 1.0);
}

#[test]
fn a_larger_part_has_the_larger_skeleton() {
    assert_moves_along(|p| p.map(|x| 1000.0 * x), 1000.0);
    assert_moves_along(|p| p.map(|x| 0.001 * x), 0.001);
}

#[test]
fn the_order_of_faces_does_not_matter() {
    for (name, mesh) in labelled() {
        assert_same_as(&mesh, &with_faces_shuffled(&mesh), name);
    }
}

#[test]
fn the_order_of_points_and_of_corners_does_not_matter() {
    for (name, mesh) in labelled() {
        assert_same_as(&mesh, &with_points_shuffled(&mesh), name);
    }
}

/// Two meshes of the same surface have the same skeleton.
fn assert_same_as(mesh: &TestMesh, other: &TestMesh, name: &str) {
    let [still, other] = [mesh, other].map(skeleton_of);
    let radius = still.radii.iter().copied().fold(f64::INFINITY, f64::min);
    let deviation = other.deviation_from(&still).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert!(deviation <= SAME * radius, "{name}: {deviation} mm of {radius} mm");
}

/// The same surface with its faces in another order.
fn with_faces_shuffled(mesh: &TestMesh) -> TestMesh {
    let faces = order(mesh.triangles.len());
    TestMesh {
        positions: mesh.positions.clone(),
        triangles: faces.iter().map(|&f| mesh.triangles[f]).collect(),
        non_design: faces.iter().map(|&f| mesh.non_design[f]).collect(),
    }
}

/// The same surface with its points in another order, and faces begun at another corner.
fn with_points_shuffled(mesh: &TestMesh) -> TestMesh {
    let points = order(mesh.positions.len());
    let mut place = vec![0; points.len()];
    points.iter().enumerate().for_each(|(new, &old)| place[old] = new as u32);
    let turned = |(f, t): (usize, &[u32; 3])| {
        let mut t = t.map(|v| place[v as usize]);
        t.rotate_left(f % 3);
        t
    };
    TestMesh {
        positions: points.iter().map(|&i| mesh.positions[i]).collect(),
        triangles: mesh.triangles.iter().enumerate().map(turned).collect(),
        non_design: mesh.non_design.clone(),
    }
}

/// Numbers below `count` in an order without a pattern, the same on every run.
fn order(count: usize) -> Vec<usize> {
    let mut all: Vec<usize> = (0..count).collect();
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    for i in (1..count).rev() {
        // xorshift64, Marsaglia 2003.
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        all.swap(i, (state % (i as u64 + 1)) as usize);
    }
    all
}
