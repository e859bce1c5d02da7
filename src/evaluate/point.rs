//! What is measured at one skeletal point.

use nalgebra::{Unit, Vector2, Vector3};

use super::plane_cut::{Cutter, PlaneCut};
use super::rays::{Hit, Lengths, PAIRS, RAYS, cast, largest_difference, ordered, pairs, polar};
use super::section::LocalSection;
use crate::mesh::contour::Plane;

/// Distances below this part of the size of a section are rounding: the point lies on the wall.
const ON_WALL: f64 = 1e-9;

/// A ray within this part of its end at the cube counts as cut there.
const AT_CUBE: f64 = 1e-9;

/// What is measured at one skeletal point; `None` where its plane cuts nothing to measure.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointMeasure {
    /// max |dⱼ − dⱼ₊₁₈| by polar interpolation on the crossings in the cube, mm (thesis §4.4).
    pub e_center: Option<f64>,
    /// The same with rays cast against the real section and cut at the cube, mm.
    pub e_true: Option<f64>,
    /// The same, not cut, mm.
    pub e_true_uncapped: Option<f64>,
    /// Hu's degree of centeredness: mean of l_min / l_max over the pairs, rays cut at the cube
    /// (thesis §2.4.2.2); pairs cut on both sides are left out.
    pub hu_degree: Option<f64>,
    /// The same, not cut.
    pub hu_degree_uncapped: Option<f64>,
    /// Distance from the area centroid of the section over √(A/π).
    pub offset: Option<f64>,
    /// Area A of the section, holes subtracted, mm².
    pub area: Option<f64>,
    /// Whether crossings of more than one curve lie in the cube: those of other struts, or of a
    /// bore, are mixed into `e_center`.
    pub is_mixed: bool,
    /// Whether the cube cuts off part of the section.
    pub is_cut_off: bool,
}

/// Measures points of one surface.
pub(super) struct Gauge<'a> {
    cutter: Cutter<'a>,
    directions: [Vector2<f64>; RAYS],
    cube_half: f64,
}

impl<'a> Gauge<'a> {
    pub(super) fn new(cutter: Cutter<'a>, cube_half: f64) -> Self {
        Self { cutter, directions: super::rays::directions(), cube_half }
    }

    /// Measures in the plane through a point whose normal is the direction from the previous to
    /// the next point.
    pub(super) fn measure(&mut self, plane: &Plane) -> PointMeasure {
        let cut = self.cutter.cut(plane, self.cube_half);
        let mut measure = PointMeasure { e_center: e_center(cut), ..PointMeasure::default() };
        let curves = 0..cut.curves.len();
        measure.is_mixed = curves.filter(|&c| cut.nearness(c).contains(&true)).count() > 1;
        let Some(section) = LocalSection::of(cut) else { return measure };
        measure.is_cut_off = cut.nearness(section.outer).contains(&false);
        measure.area = Some(section.area);
        measure.offset = Some(section.offset());
        let lengths = true_rays(cut, &section, &self.directions);
        let caps = caps(plane, &self.directions, self.cube_half);
        let capped: Lengths = std::array::from_fn(|j| lengths[j].min(caps[j]));
        measure.e_true = Some(largest_difference(&capped));
        measure.e_true_uncapped = Some(largest_difference(&lengths));
        let reach = |j: usize| caps[j] * (1.0 - AT_CUBE);
        measure.hu_degree = Some(hu_degree(&capped, |j| {
            capped[j] < reach(j) || capped[j + PAIRS] < reach(j + PAIRS)
        }));
        measure.hu_degree_uncapped = Some(hu_degree(&lengths, |_| true));
        measure
    }
}

/// max |dⱼ − dⱼ₊₁₈| as in section 4.4, mm; `None` with fewer than three crossings in the cube.
///
/// The thesis takes "one of" the crossings as the first one: here that of the first edge in the
/// order of the mesh.
fn e_center(cut: &PlaneCut) -> Option<f64> {
    let near = || (0..cut.places.len()).filter(|&i| cut.near[i]);
    if near().count() < 3 {
        return None;
    }
    let crossings: Vec<Vector2<f64>> = near().map(|i| cut.places[i]).collect();
    let (first, _) = near().enumerate().min_by_key(|&(_, i)| cut.rank[i])?;
    Some(largest_difference(&polar(&ordered(&crossings, first))))
}

/// Rays against the section; outside of it, or on its wall, the far wall counts.
fn true_rays(cut: &PlaneCut, section: &LocalSection, directions: &[Vector2<f64>; RAYS]) -> Lengths {
    let size = cut.polygon(section.outer).iter().map(|c| c.amax()).fold(0.0, f64::max);
    let clear = section.is_inside && section.distance_from_wall(cut) > ON_WALL * size;
    let hit = if clear { Hit::Nearest } else { Hit::Farthest };
    let lengths = cast(section.polygons(cut), directions, hit);
    lengths.map(|l| if l < ON_WALL * size { 0.0 } else { l })
}

/// Where each ray leaves the cube, mm.
fn caps(plane: &Plane, directions: &[Vector2<f64>; RAYS], cube_half: f64) -> Lengths {
    let (u, v) = plane.axes();
    std::array::from_fn(|j| cube_half / (u * directions[j].x + v * directions[j].y).amax())
}

/// Mean of l_min / l_max over the pairs that count; 1 when none does.
fn hu_degree(lengths: &Lengths, counts: impl Fn(usize) -> bool) -> f64 {
    let (mut sum, mut number) = (0.0, 0);
    for (_, (d, e)) in pairs(lengths).enumerate().filter(|(j, _)| counts(*j)) {
        let (l_min, l_max) = (d.min(e), d.max(e));
        sum += if l_max > 0.0 { l_min / l_max } else { 0.0 };
        number += 1;
    }
    if number == 0 { 1.0 } else { sum / f64::from(number) }
}

/// The local normal plane of a skeletal point (thesis figure 4.15a).
pub(super) fn normal_plane(
    point: nalgebra::Point3<f64>,
    previous_to_next: &Vector3<f64>,
) -> Option<Plane> {
    Some(Plane::new(point, Unit::try_new(*previous_to_next, 0.0)?))
}
