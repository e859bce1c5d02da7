//! The section of the strut that a skeletal point belongs to: one outer curve and its holes.

use nalgebra::Vector2;

use super::plane_cut::PlaneCut;

/// The section that holds the skeletal point, or the nearest one.
#[derive(Clone, Debug)]
pub(super) struct LocalSection {
    /// Number of the outer curve.
    pub(super) outer: usize,
    /// Numbers of the curves round its holes.
    pub(super) holes: Vec<usize>,
    /// Area without the holes, mm².
    pub(super) area: f64,
    /// Area centroid; the skeletal point is the origin.
    pub(super) centroid: Vector2<f64>,
    /// Whether the skeletal point lies in the material.
    pub(super) is_inside: bool,
}

impl LocalSection {
    /// Finds the section; `None` when the plane cuts no material.
    ///
    /// Of the outer curves round the point the smallest counts, of those not round it the nearest.
    pub(super) fn of(cut: &PlaneCut) -> Option<Self> {
        let origin = Vector2::zeros();
        let curves = (0..cut.curves.len()).filter(|&c| cut.polygon(c).len() >= 3);
        let measured: Vec<Curve> = curves
            .map(|number| {
                let (area, moment) = area_and_moment(cut.polygon(number));
                Curve { number, area, moment, turns: turns_about(cut.polygon(number), &origin) }
            })
            .collect();
        let outer = || measured.iter().filter(|c| c.area > 0.0);
        let round = outer().filter(|c| c.turns > 0).min_by(|a, b| a.area.total_cmp(&b.area));
        let nearest = || {
            let distance = |c: &&Curve| distance_from_origin(cut.polygon(c.number));
            outer().min_by(|a, b| distance(a).total_cmp(&distance(b)))
        };
        let chosen = round.or_else(nearest)?;
        let holes: Vec<&Curve> =
            measured.iter().filter(|c| chosen.owns(c, &measured, cut)).collect();
        let is_inside = round.is_some() && measured.iter().map(|c| c.turns).sum::<i32>() > 0;
        Some(Self::with_holes(chosen, &holes, is_inside))
    }

    fn with_holes(outer: &Curve, holes: &[&Curve], is_inside: bool) -> Self {
        let mut area = outer.area + holes.iter().map(|h| h.area).sum::<f64>();
        let mut moment = outer.moment + holes.iter().map(|h| h.moment).sum::<Vector2<f64>>();
        if area <= 0.0 {
            (area, moment) = (outer.area, outer.moment);
        }
        Self {
            outer: outer.number,
            holes: holes.iter().map(|h| h.number).collect(),
            area,
            centroid: moment / area,
            is_inside,
        }
    }

    /// The outer curve and the holes.
    pub(super) fn polygons<'a>(
        &'a self,
        cut: &'a PlaneCut,
    ) -> impl Iterator<Item = &'a [Vector2<f64>]> {
        std::iter::once(self.outer).chain(self.holes.iter().copied()).map(|c| cut.polygon(c))
    }

    /// Distance of the skeletal point from the outer curve and the holes, mm.
    pub(super) fn distance_from_wall(&self, cut: &PlaneCut) -> f64 {
        self.polygons(cut).map(distance_from_origin).fold(f64::INFINITY, f64::min)
    }

    /// Distance of the skeletal point from the centroid over the radius of the disc of equal area.
    pub(super) fn offset(&self) -> f64 {
        self.centroid.norm() / (self.area / std::f64::consts::PI).sqrt()
    }
}

struct Curve {
    number: usize,
    /// Signed area, mm²: negative round a hole.
    area: f64,
    /// Area times centroid, mm³.
    moment: Vector2<f64>,
    /// How often the curve turns about the skeletal point.
    turns: i32,
}

impl Curve {
    /// Whether `hole` is a hole in this curve, and not in a smaller one within it.
    fn owns(&self, hole: &Self, all: &[Self], cut: &PlaneCut) -> bool {
        if hole.area >= 0.0 {
            return false;
        }
        let place = cut.polygon(hole.number)[0];
        let holds = |c: &Self| turns_about(cut.polygon(c.number), &place) > 0;
        holds(self) && !all.iter().any(|c| c.area > 0.0 && c.area < self.area && holds(c))
    }
}

/// Signed area ½ Σ cᵢ × cᵢ₊₁ and its moment ⅙ Σ (cᵢ + cᵢ₊₁) (cᵢ × cᵢ₊₁).
fn area_and_moment(polygon: &[Vector2<f64>]) -> (f64, Vector2<f64>) {
    let mut a = polygon[polygon.len() - 1];
    let (mut doubled, mut moment) = (0.0, Vector2::zeros());
    for &b in polygon {
        let w = a.perp(&b);
        doubled += w;
        moment += (a + b) * w;
        a = b;
    }
    (doubled / 2.0, moment / 6.0)
}

/// How often a polygon turns about a point, counter-clockwise.
///
/// Counts the sides that pass the ray to the right of the point, upwards less downwards.
fn turns_about(polygon: &[Vector2<f64>], point: &Vector2<f64>) -> i32 {
    let mut a = polygon[polygon.len() - 1] - point;
    let mut turns = 0;
    for b in polygon.iter().map(|b| b - point) {
        let left = a.perp(&b);
        if a.y <= 0.0 && b.y > 0.0 && left > 0.0 {
            turns += 1;
        } else if a.y > 0.0 && b.y <= 0.0 && left < 0.0 {
            turns -= 1;
        }
        a = b;
    }
    turns
}

/// Distance of the origin from a polygon, mm.
fn distance_from_origin(polygon: &[Vector2<f64>]) -> f64 {
    let mut a = polygon[polygon.len() - 1];
    let mut least = f64::INFINITY;
    for &b in polygon {
        let d = b - a;
        let length = d.norm_squared();
        let t = if length > 0.0 { (-a.dot(&d) / length).clamp(0.0, 1.0) } else { 0.0 };
        least = least.min((a + d * t).norm_squared());
        a = b;
    }
    least.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(half: f64, x: f64, hole: bool) -> Vec<Vector2<f64>> {
        let mut corners = [[1., 1.], [-1., 1.], [-1., -1.], [1., -1.]]
            .map(|[a, b]: [f64; 2]| Vector2::new(x + half * a, half * b));
        if hole {
            corners.reverse();
        }
        corners.to_vec()
    }

    fn cut(polygons: &[Vec<Vector2<f64>>]) -> PlaneCut {
        let mut cut = PlaneCut::default();
        for polygon in polygons {
            let first = cut.places.len();
            cut.places.extend(polygon);
            cut.curves.push(first..cut.places.len());
        }
        cut
    }

    #[test]
    fn a_hole_moves_the_centroid_away_from_it() {
        let section =
            LocalSection::of(&cut(&[square(2., 0., false), square(1., 0.5, true)])).unwrap();
        assert!((section.area - 12.0).abs() < 1e-12);
        assert!((section.centroid.x + 2.0 / 12.0).abs() < 1e-12);
        assert!(!section.is_inside);
        assert_eq!(section.holes, [1]);
    }

    #[test]
    fn a_rod_in_the_bore_of_a_pipe_is_a_section_of_its_own() {
        let curves = [square(9., 0., false), square(8., 0., true), square(1., 0., false)];
        let section = LocalSection::of(&cut(&curves)).unwrap();
        assert_eq!((section.outer, section.is_inside), (2, true));
        assert!(section.holes.is_empty());
        // Seen from the wall of the pipe, the bore is its hole.
        let moved: Vec<_> =
            curves.iter().map(|c| c.iter().map(|p| p - Vector2::new(8.5, 0.)).collect()).collect();
        let section = LocalSection::of(&cut(&moved)).unwrap();
        assert_eq!((section.outer, section.holes, section.is_inside), (0, vec![1], true));
    }

    #[test]
    fn outside_of_all_sections_the_nearest_counts() {
        let section =
            LocalSection::of(&cut(&[square(1., 9., false), square(1., -4., false)])).unwrap();
        assert_eq!((section.outer, section.is_inside), (1, false));
        assert!((section.offset() - 4.0 / (4.0 / std::f64::consts::PI).sqrt()).abs() < 1e-12);
    }
}
