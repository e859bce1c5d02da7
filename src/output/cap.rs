//! Triangles over a flat outline and its holes.

use nalgebra::{Point2, Vector2};
use spade::{ConstrainedDelaunayTriangulation, Triangulation};

/// Corners on one outline.
pub(super) type Ring = Vec<Point2<f64>>;

/// Triangles over an outline and its holes, counter-clockwise, by the numbers of the corners.
pub(super) fn cap(rings: &[Ring]) -> Option<Vec<[u32; 3]>> {
    type Cdt = ConstrainedDelaunayTriangulation<Corner>;
    let mut cdt = Cdt::new();
    let mut number = 0;
    for ring in rings {
        let mut handles = Vec::with_capacity(ring.len());
        for at in ring {
            handles.push(cdt.insert(Corner { at: *at, number }).ok()?);
            number += 1;
        }
        for (i, &from) in handles.iter().enumerate() {
            let to = handles[(i + 1) % handles.len()];
            if from == to || !cdt.can_add_constraint(from, to) {
                return None;
            }
            cdt.add_constraint(from, to);
        }
    }
    let inside = |t: &[Corner; 3]| {
        let middle = Point2::from(t.iter().map(|c| c.at.coords).sum::<Vector2<f64>>() / 3.0);
        !rings.iter().map(|r| crossings(r, &middle)).sum::<usize>().is_multiple_of(2)
    };
    let faces = cdt.inner_faces().map(|f| f.vertices().map(|v| *v.data()));
    let triangles: Vec<_> = faces.filter(inside).map(|t| t.map(|c| c.number)).collect();
    (cdt.num_vertices() == number as usize).then_some(triangles)
}

/// A corner that remembers which one it is.
#[derive(Clone, Copy, Debug)]
struct Corner {
    at: Point2<f64>,
    number: u32,
}

impl spade::HasPosition for Corner {
    type Scalar = f64;
    fn position(&self) -> spade::Point2<f64> {
        spade::Point2::new(self.at.x, self.at.y)
    }
}

/// How often a ray from a point along x crosses a ring.
fn crossings(ring: &[Point2<f64>], p: &Point2<f64>) -> usize {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y))
        .filter(|(a, b)| a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x)
        .count()
}
