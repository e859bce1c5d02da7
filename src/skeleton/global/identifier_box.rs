//! The identifier box aligned with the global axes (thesis §3.4.2.2).

use nalgebra::Point3;

use super::direction::Direction;

/// A box by its smallest and largest coordinates; the thesis's "information" of a junction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct IdentifierBox {
    pub(crate) low: Point3<f64>,
    pub(crate) high: Point3<f64>,
}

impl IdentifierBox {
    /// The smallest box around points; `None` without any.
    pub(crate) fn around(points: impl IntoIterator<Item = Point3<f64>>) -> Option<Self> {
        let around = |b: Self, p: Point3<f64>| Self { low: b.low.inf(&p), high: b.high.sup(&p) };
        let mut points = points.into_iter();
        let first = points.next()?;
        Some(points.fold(Self { low: first, high: first }, around))
    }

    /// A cube about its centre.
    #[cfg(test)]
    pub(crate) fn cube(centre: Point3<f64>, edge: f64) -> Self {
        let half = nalgebra::Vector3::repeat(0.5 * edge);
        Self { low: centre - half, high: centre + half }
    }

    pub(crate) fn centre(&self) -> Point3<f64> {
        nalgebra::center(&self.low, &self.high)
    }

    /// Edge length along an axis, mm.
    pub(crate) fn width(&self, axis: usize) -> f64 {
        self.high[axis] - self.low[axis]
    }

    /// The smallest box around both.
    pub(crate) fn joined(&self, other: &Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// Grown by a length on every side across a direction.
    pub(crate) fn grown_across(&self, direction: Direction, by: f64) -> Self {
        let mut grown = *self;
        for axis in direction.axes_across() {
            grown.low[axis] -= by;
            grown.high[axis] += by;
        }
        grown
    }

    /// The box of a length `step` that begins where this one ends in a direction (§3.4.2.5).
    pub(crate) fn next(&self, direction: Direction, step: f64) -> Self {
        let mut next = *self;
        let axis = direction.axis;
        if direction.is_positive {
            (next.low[axis], next.high[axis]) = (self.high[axis], self.high[axis] + step);
        } else {
            (next.low[axis], next.high[axis]) = (self.low[axis] - step, self.low[axis]);
        }
        next
    }

    /// This box with the extent of another across a direction.
    pub(crate) fn adjusted(&self, to: &Self, direction: Direction) -> Self {
        let mut adjusted = *self;
        for axis in direction.axes_across() {
            (adjusted.low[axis], adjusted.high[axis]) = (to.low[axis], to.high[axis]);
        }
        adjusted
    }

    pub(crate) fn contains(&self, point: &Point3<f64>) -> bool {
        (0..3).all(|k| self.low[k] <= point[k] && point[k] <= self.high[k])
    }

    /// Whether both share more than a face (§3.4.3.2 c, fig. 3.34).
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        (0..3).all(|k| self.low[k] < other.high[k] && other.low[k] < self.high[k])
    }

    /// The largest growth of the width across a direction, against a box before it (§3.4.2.6), and
    /// the axis it grows along.
    pub(crate) fn growth_over(&self, before: &Self, direction: Direction) -> (f64, usize) {
        let growth = |axis: usize| self.width(axis) / before.width(axis).max(f64::MIN_POSITIVE);
        let [a, b] = direction.axes_across();
        if growth(a) >= growth(b) { (growth(a), a) } else { (growth(b), b) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit() -> IdentifierBox {
        IdentifierBox::cube(Point3::new(0.5, 0.5, 0.5), 1.0)
    }

    #[test]
    fn the_next_box_begins_where_the_last_one_ends() {
        let next = unit().next(Direction::ALL[0], 2.0);
        assert_eq!((next.low.x, next.high.x, next.low.y), (-2.0, 0.0, 0.0));
        assert!(!next.overlaps(&unit()), "a shared face is no overlap");
    }

    #[test]
    fn growth_names_the_axis_it_grows_along() {
        let mut wide = unit();
        wide.high.z = 2.0;
        assert_eq!(wide.growth_over(&unit(), Direction::ALL[1]), (2.0, 2));
        assert_eq!(wide.growth_over(&unit(), Direction::ALL[5]).0, 1.0);
    }
}
