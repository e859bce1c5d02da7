//! truck-stepio as a second reader: every solid comes back with its faces,
//! edges and vertices where they were meant to be.

mod step_family;

use beamwright::output::step::{self, Body};
use step_family::Case;
use truck_modeling::{BoundedCurve, EuclideanSpace, InnerSpace, Point3};
use truck_stepio::r#in::Table;
use truck_stepio::r#in::alias::{Curve3D, Surface};
use truck_topology::compress::{CompressedEdge, CompressedShell};

/// All documents but those with a quote in a name: ruststep, which truck-stepio
/// parses with, does not know that it is doubled.
fn cases() -> impl Iterator<Item = Case> {
    step_family::cases().into_iter().filter(|case| case.name != "names")
}

type Shell = CompressedShell<Point3, Curve3D, Surface>;

/// The shells of a document, in the order of the file.
fn shells(case: &Case) -> Vec<Shell> {
    let mut text = Vec::new();
    step::write(&case.document, &mut text).unwrap();
    let table = Table::from_step(&String::from_utf8(text).unwrap())
        .unwrap_or_else(|| panic!("{}: truck-stepio cannot parse the file", case.name));
    let mut shells: Vec<_> = table.shell.iter().collect();
    shells.sort_by_key(|(id, _)| **id);
    shells.into_iter().map(|(_, shell)| table.to_compressed_shell(shell).unwrap()).collect()
}

/// V − E + F of a shell; a face with more than one boundary counts less by one each.
///
/// A seam is an edge of its face twice, and joins its two boundaries to one.
fn euler(shell: &Shell) -> isize {
    let inner: usize = shell.faces.iter().map(|face| face.boundaries.len() - 1).sum();
    shell.vertices.len() as isize - shell.edges.len() as isize + shell.faces.len() as isize
        - inner as isize
}

#[test]
fn shells_come_back_with_the_euler_number_of_their_genus() {
    for case in cases() {
        let bodies: Vec<&Body> =
            case.document.groups.iter().flat_map(|g| &g.parts).map(|p| &p.body).collect();
        let all_lofts = bodies.iter().all(|body| matches!(body, Body::Loft(_)));
        for shell in shells(&case).iter().filter(|shell| !shell.edges.is_empty()) {
            let euler = euler(shell);
            assert!(euler % 2 == 0 && euler <= 2, "{}: {euler}", case.name);
            if all_lofts {
                let holes = isize::from(
                    case.name.contains("tube") || ["box", "eccentric"].contains(&case.name),
                );
                assert_eq!(euler, 2 - 2 * holes, "{}", case.name);
            }
        }
    }
}

#[test]
fn edges_come_back_between_their_vertices() {
    for case in cases() {
        for shell in shells(&case) {
            let size = shell.vertices.iter().map(|v| v.to_vec().magnitude()).fold(0.0, f64::max);
            for edge in &shell.edges {
                let off = ends_off(edge, &shell.vertices);
                assert!(off <= 1e-6 * size, "{}: {off:e}", case.name);
            }
        }
    }
}

/// How far the ends of an edge's curve are from its vertices.
fn ends_off(edge: &CompressedEdge<Curve3D>, vertices: &[Point3]) -> f64 {
    let (from, to) = (vertices[edge.vertices.0], vertices[edge.vertices.1]);
    let (front, back) = (edge.curve.front(), edge.curve.back());
    (front - from).magnitude().max((back - to).magnitude())
}
