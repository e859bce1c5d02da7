//! The shadow of a surface: tells quickly of many points whether they are inside.
//!
//! A tree of boxes is asked anew for every point where its ray goes. Here all triangles are laid once
//! along the ray into a plane, and into the cells of a grid there:
//!
//! ```text
//!      ╲ △ ╲    rays, all in one direction
//!       ╲   ╲ △
//!    ┬───╲┬──╲┬───┬    a point asks the triangles of its cell only
//! ```
//!
//! The answers are those of [`TriangleTree::contains`], to the last bit.

use nalgebra::{Point2, Point3, Vector3};

use super::ray::{DIRECTIONS, Hit, Ray};
use super::triangle_tree::TriangleTree;

/// Entries of the grid for each triangle, at most: large triangles lie in many cells.
const MOST_ENTRIES: usize = 8;

/// By how much the shadow of a triangle is widened, in parts of that of the surface: far above the
/// rounding of the ray's own test, far below the size of a cell.
const WIDENED: f64 = 1e-9;

/// The triangles of a surface in the cells of a grid across a direction.
pub(crate) struct Shadow<'t> {
    tree: &'t TriangleTree,
    direction: Vector3<f64>,
    grid: Grid,
    /// Where the faces of each cell begin in `faces`, and where the last ends.
    starts: Vec<u32>,
    faces: Vec<u32>,
}

/// Square cells over a rectangle.
struct Grid {
    low: Point2<f64>,
    cells: [usize; 2],
    /// Cells to a millimetre.
    scale: f64,
}

/// A rectangle, by its lowest and highest corner.
type Rectangle = [Point2<f64>; 2];

impl<'t> Shadow<'t> {
    /// Lays the triangles of a tree into the grid; `O(n)`.
    pub(crate) fn new(tree: &'t TriangleTree) -> Self {
        let direction = Vector3::from(DIRECTIONS[0]);
        let ray = Ray::new(&Point3::origin(), &direction);
        let shadows: Vec<Rectangle> = tree.corners().iter().map(|t| shadow(&ray, t)).collect();
        let all = shadows.iter().copied().reduce(|a, b| [a[0].inf(&b[0]), a[1].sup(&b[1])]);
        let all = all.unwrap_or_default();
        let slack = WIDENED * (all[1] - all[0]).norm();
        let mut count = shadows.len();
        let (grid, total) = loop {
            let grid = Grid::new(&all, count);
            let total: usize = shadows.iter().map(|s| grid.covered(s, slack).count()).sum();
            if count <= 1 || total <= MOST_ENTRIES * shadows.len() {
                break (grid, total);
            }
            count /= 4;
        };
        let mut starts = vec![0_u32; grid.cells[0] * grid.cells[1] + 1];
        for s in &shadows {
            grid.covered(s, slack).for_each(|cell| starts[cell] += 1);
        }
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        let mut faces = vec![0; total];
        for (face, s) in shadows.iter().enumerate().rev() {
            for cell in grid.covered(s, slack) {
                starts[cell] -= 1;
                faces[starts[cell] as usize] = face as u32;
            }
        }
        Self { tree, direction, grid, starts, faces }
    }

    /// Whether a point lies inside the surface.
    pub(crate) fn contains(&self, point: &Point3<f64>) -> bool {
        let ray = Ray::new(point, &self.direction);
        let Some(cell) = self.grid.cell(&ray.flat(&point.coords)) else { return false };
        let [first, last] = [cell, cell + 1].map(|c| self.starts[c] as usize);
        let mut sum = 0;
        for &face in &self.faces[first..last] {
            match ray.cross(&self.tree.corners()[face as usize]) {
                Hit::At(_, sign) => sum += sign,
                Hit::Edge => return self.tree.contains(point),
                Hit::Miss => {}
            }
        }
        sum > 0
    }
}

/// The rectangle round a triangle seen along a ray.
fn shadow(ray: &Ray, corners: &[Point3<f64>; 3]) -> Rectangle {
    let [a, b, c] = corners.map(|p| ray.flat(&p.coords));
    [a.inf(&b).inf(&c), a.sup(&b).sup(&c)]
}

impl Grid {
    /// About `count` cells over a rectangle.
    fn new([low, high]: &Rectangle, count: usize) -> Self {
        let size = high - low;
        let scale = (count.max(1) as f64 / (size.x * size.y)).sqrt();
        let scale = if scale.is_finite() { scale } else { 0.0 };
        let most = count.max(1) as f64;
        let cells = [size.x, size.y].map(|s| (s * scale).min(most) as usize + 1);
        Self { low: *low, cells, scale }
    }

    /// Column or row of a coordinate, the first and the last one for those beyond.
    fn place(&self, p: &Point2<f64>, k: usize) -> usize {
        (((p[k] - self.low[k]) * self.scale) as usize).min(self.cells[k] - 1)
    }

    /// The cell of a point; `None` for one that is no number.
    fn cell(&self, p: &Point2<f64>) -> Option<usize> {
        let is_finite = p.x.is_finite() && p.y.is_finite();
        is_finite.then(|| self.place(p, 1) * self.cells[0] + self.place(p, 0))
    }

    /// The cells under a rectangle widened by `slack`.
    fn covered(&self, [low, high]: &Rectangle, slack: f64) -> impl Iterator<Item = usize> + use<> {
        let (low, high) = (low.map(|x| x - slack), high.map(|x| x + slack));
        let columns = self.place(&low, 0)..=self.place(&high, 0);
        let width = self.cells[0];
        (self.place(&low, 1)..=self.place(&high, 1))
            .flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_box;
    use super::*;

    /// A flat box, a needle beside it and one across both, from a sequence that is spread evenly.
    #[test]
    fn points_are_inside_the_shadow_where_the_tree_has_them_inside() {
        let boxes = [
            test_box::triangles([0.0; 3], [8.0, 7.0, 0.5]),
            test_box::triangles([0.0, 0.0, 3.0], [0.01, 0.01, 12.0]),
            test_box::triangles([2.0, -1.0, -1.0], [3.0, 8.0, 5.0]),
        ];
        let tree = TriangleTree::new(boxes.concat());
        let shadow = Shadow::new(&tree);
        let mut inside = 0;
        for k in 0..4096 {
            let part = |step: f64| (step * f64::from(k)).fract();
            let at = [0.819_172_5, 0.671_043_6, 0.549_700_4].map(part);
            let at = Point3::new(9.0 * at[0] - 0.5, 9.0 * at[1] - 0.5, 12.0 * at[2] - 0.5);
            assert_eq!(shadow.contains(&at), tree.contains(&at), "{at}");
            inside += usize::from(shadow.contains(&at));
        }
        assert!((200..2000).contains(&inside), "{inside}");
    }

    #[test]
    fn nothing_is_inside_of_no_surface() {
        let tree = TriangleTree::new(Vec::new());
        assert!(!Shadow::new(&tree).contains(&Point3::new(1.0, 2.0, 3.0)));
    }
}
