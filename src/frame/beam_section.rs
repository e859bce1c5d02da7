//! What the sections along one straight beam say: mean and end values, taken away from junctions.

use nalgebra::{Point2, Point3, Unit, Vector3};

use super::section_at::Section;

/// The axes of a beam: x along it, y and z across.
///
/// ```text
///        z ▲  ╱ x  from the first node to the second
///          │ ╱
///          ●────► y
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamAxes {
    /// Along the beam.
    pub x: Unit<Vector3<f64>>,
    /// Across.
    pub y: Unit<Vector3<f64>>,
    /// Across; x × y.
    pub z: Unit<Vector3<f64>>,
}

impl BeamAxes {
    /// Axes along `x`, with `y` turned to nothing in particular.
    pub fn along(x: Unit<Vector3<f64>>) -> Self {
        let mut across = Vector3::zeros();
        across[x.iamin()] = 1.0;
        let y = Unit::new_normalize(x.cross(&across));
        Self { x, y, z: Unit::new_normalize(x.cross(&y)) }
    }

    /// The axes turned about x by `angle`, rad.
    pub fn rolled(&self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self {
            x: self.x,
            y: Unit::new_normalize(*self.y * cos + *self.z * sin),
            z: Unit::new_normalize(*self.z * cos - *self.y * sin),
        }
    }

    /// Coordinates y, z of a vector.
    pub fn across(&self, v: &Vector3<f64>) -> Point2<f64> {
        Point2::new(v.dot(&self.y), v.dot(&self.z))
    }
}

/// Area and second moments of a section in the axes of its beam, about its own centroid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// ∫ dA, mm².
    pub area: f64,
    /// ∫ z² dA, mm⁴.
    pub i_yy: f64,
    /// ∫ y² dA, mm⁴.
    pub i_zz: f64,
    /// ∫ y z dA, mm⁴.
    pub i_yz: f64,
}

impl Moments {
    /// Moments of a polygon about its centroid (Green's theorem); counter-clockwise is positive.
    pub fn of_polygon(polygon: &[Point2<f64>]) -> Self {
        let mut m = Self::default();
        let (mut s_y, mut s_z) = (0.0, 0.0);
        for (i, p) in polygon.iter().enumerate() {
            let q = polygon[(i + 1) % polygon.len()];
            let w = p.x * q.y - q.x * p.y;
            m.area += w / 2.0;
            s_y += w * (p.x + q.x) / 6.0;
            s_z += w * (p.y + q.y) / 6.0;
            m.i_yy += w * (p.y * p.y + p.y * q.y + q.y * q.y) / 12.0;
            m.i_zz += w * (p.x * p.x + p.x * q.x + q.x * q.x) / 12.0;
            m.i_yz += w * (p.x * q.y + 2.0 * (p.x * p.y + q.x * q.y) + q.x * p.y) / 24.0;
        }
        if m.area != 0.0 {
            m.i_yy -= s_z * s_z / m.area;
            m.i_zz -= s_y * s_y / m.area;
            m.i_yz -= s_y * s_z / m.area;
        }
        m
    }

    /// Σ of parts, each times its factor; a mean where the factors add up to 1.
    pub(crate) fn mean(parts: impl Iterator<Item = (f64, Self)>) -> Self {
        parts.fold(Self::default(), |s, (f, m)| Self {
            area: s.area + f * m.area,
            i_yy: s.i_yy + f * m.i_yy,
            i_zz: s.i_zz + f * m.i_zz,
            i_yz: s.i_yz + f * m.i_yz,
        })
    }

    /// Radius of the disc of equal area, mm.
    pub fn radius(&self) -> f64 {
        (self.area.max(0.0) / std::f64::consts::PI).sqrt()
    }

    /// Largest and smallest second moment I₁ ≥ I₂, mm⁴, and the angle from y to the axis about
    /// which it is largest, rad in (−π/2, π/2].
    pub fn principal(&self) -> (f64, f64, f64) {
        let mean = 0.5 * (self.i_yy + self.i_zz);
        let half = 0.5 * (self.i_yy - self.i_zz);
        let spread = half.hypot(self.i_yz);
        // I(φ) = mean + half cos 2φ − I_yz sin 2φ is largest there.
        (mean + spread, mean - spread, 0.5 * (-self.i_yz).atan2(half))
    }
}

/// A section of the mesh seen along a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct BeamStation {
    /// The skeletal point it was measured at.
    pub point: u32,
    /// Part 0..1 of the beam's length.
    pub at: f64,
    /// Contour in y, z about its centroid, mm.
    pub contour: Vec<Point2<f64>>,
    /// Its moments.
    pub moments: Moments,
    /// Distance of the centroid from the axis, mm.
    pub off_axis: f64,
    /// 1 for a section like its neighbours, towards 0 for one swollen by a junction.
    pub weight: f64,
}

impl BeamStation {
    /// Whether it is so much larger or smaller than its neighbours that it hardly counts.
    pub fn is_outlier(&self) -> bool {
        self.weight < 0.5
    }
}

/// Sections along a beam and what they say together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BeamSection {
    /// Sections from the first node to the second.
    pub stations: Vec<BeamStation>,
    /// Weighted means.
    pub mean: Moments,
    /// Values at both ends, from straight lines through the weighted sections.
    pub ends: [Moments; 2],
}

/// Departure of the area from its straight line that halves the weight of a section: some times
/// the median departure, within bounds. Fillets add tenths to a clean strut, the steps of voxel
/// surfaces some hundredths to all of one.
const SPREAD: f64 = 3.0;
const SWELLING: [f64; 2] = [0.02, 0.12];

/// Part of the length by which a section may lie beyond the ends of its beam; farther, it belongs
/// to the neighbour.
const BEYOND: f64 = 0.05;

impl BeamSection {
    /// Gathers the sections between two nodes.
    pub fn new(sections: &[&Section], start: Point3<f64>, length: f64, axes: &BeamAxes) -> Self {
        let mut stations: Vec<BeamStation> = sections
            .iter()
            .map(|s| {
                let to = s.centroid - start;
                let contour: Vec<Point2<f64>> =
                    s.contour.iter().map(|p| axes.across(&(p - s.centroid))).collect();
                let moments = Moments::of_polygon(&contour);
                let off_axis = axes.across(&to).coords.norm();
                BeamStation {
                    point: s.point,
                    at: to.dot(&axes.x) / length,
                    contour,
                    moments,
                    off_axis,
                    weight: 1.0,
                }
            })
            .filter(|s| s.moments.area > 0.0)
            .collect();
        let own = |s: &BeamStation| (-BEYOND..=1.0 + BEYOND).contains(&s.at);
        if stations.iter().any(own) {
            stations.retain(own);
        }
        weigh(&mut stations);
        let mean = mean(&stations);
        let ends = if stations.is_empty() { [mean; 2] } else { ends(&stations, &mean) };
        Self { stations, mean, ends }
    }

    /// Number of sections that are much larger or smaller than their neighbours.
    pub fn outliers(&self) -> usize {
        self.stations.iter().filter(|s| s.is_outlier()).count()
    }
}

/// Iteratively reweighted straight lines through the areas and the largest second moments.
fn weigh(stations: &mut [BeamStation]) {
    if stations.len() < 4 {
        return;
    }
    // Begin from the medians: one swollen end must not tilt the first lines.
    let sizes = [size_of_area, size_of_moment];
    let medians = sizes.map(|size| median(stations.iter().map(|s| size(&s.moments)).collect()));
    let off = |s: &BeamStation, expected: [f64; 2]| {
        let part = |k: usize| (sizes[k](&s.moments) / expected[k] - 1.0).abs();
        part(0).max(part(1))
    };
    let mut offs: Vec<f64> = stations.iter().map(|s| off(s, medians)).collect();
    weigh_by(stations, &offs, 0.05);
    for _ in 0..4 {
        let lines = sizes.map(|size| line(stations, size));
        let expected = |s: &BeamStation| {
            [0, 1].map(|k| {
                let [at_start, at_end] = lines[k];
                (at_start + (at_end - at_start) * s.at).max(0.1 * medians[k])
            })
        };
        offs = stations.iter().map(|s| off(s, expected(s))).collect();
        weigh_by(stations, &offs, 0.0);
    }
}

fn size_of_area(m: &Moments) -> f64 {
    m.area
}

/// √I_1, which grows with a section as its area does.
fn size_of_moment(m: &Moments) -> f64 {
    m.principal().0.max(0.0).sqrt()
}

fn weigh_by(stations: &mut [BeamStation], offs: &[f64], least: f64) {
    let [low, high] = SWELLING;
    let scale = (SPREAD * median(offs.to_vec())).clamp(low, high);
    for (s, off) in stations.iter_mut().zip(offs) {
        s.weight = (1.0 / (1.0 + (off / scale).powi(2))).max(least);
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn mean(stations: &[BeamStation]) -> Moments {
    let total: f64 = stations.iter().map(|s| s.weight).sum();
    Moments::mean(stations.iter().map(|s| (s.weight / total, s.moments)))
}

/// End values by straight lines; never below a tenth of the mean.
fn ends(stations: &[BeamStation], mean: &Moments) -> [Moments; 2] {
    let area = line(stations, size_of_area);
    let yy = line(stations, |m| m.i_yy);
    let zz = line(stations, |m| m.i_zz);
    let yz = line(stations, |m| m.i_yz);
    [0, 1].map(|e| Moments {
        area: area[e].max(0.1 * mean.area),
        i_yy: yy[e].max(0.01 * mean.i_yy),
        i_zz: zz[e].max(0.01 * mean.i_zz),
        i_yz: yz[e],
    })
}

/// Values at 0 and 1 of the weighted straight line through a measure of the sections.
fn line(stations: &[BeamStation], measure: impl Fn(&Moments) -> f64) -> [f64; 2] {
    let (mut s0, mut s1, mut s2, mut t0, mut t1) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for s in stations {
        let (w, x, y) = (s.weight, s.at - 0.5, measure(&s.moments));
        (s0, s1, s2) = (s0 + w, s1 + w * x, s2 + w * x * x);
        (t0, t1) = (t0 + w * y, t1 + w * x * y);
    }
    let det = s0 * s2 - s1 * s1;
    let slope = if det > 1e-6 * s0 * s0 { (s0 * t1 - s1 * t0) / det } else { 0.0 };
    let middle = (t0 - slope * s1) / s0;
    [middle - 0.5 * slope, middle + 0.5 * slope]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(b: f64, h: f64, turn: f64) -> Vec<Point2<f64>> {
        let (sin, cos) = turn.sin_cos();
        [(-b, -h), (b, -h), (b, h), (-b, h)]
            .map(|(y, z)| Point2::new((y * cos - z * sin) / 2.0, (y * sin + z * cos) / 2.0))
            .to_vec()
    }

    #[test]
    fn rectangle_has_b_h_cubed_over_12() {
        let m = Moments::of_polygon(&rectangle(6.0, 10.0, 0.0));
        assert!((m.area - 60.0).abs() < 1e-9);
        assert!((m.i_yy - 6.0 * 1000.0 / 12.0).abs() < 1e-9);
        assert!((m.i_zz - 10.0 * 216.0 / 12.0).abs() < 1e-9);
    }

    #[test]
    fn the_principal_angle_turns_with_the_section() {
        for turn in [-1.2, -0.3, 0.0, 0.4, 1.5] {
            let (i_1, i_2, angle) = Moments::of_polygon(&rectangle(6.0, 10.0, turn)).principal();
            assert!((i_1 - 500.0).abs() < 1e-9 && (i_2 - 180.0).abs() < 1e-9);
            assert!((angle - turn).sin().abs() < 1e-12, "{turn}: {angle}");
        }
    }

    #[test]
    fn swollen_ends_do_not_change_the_mean() {
        let station = |at: f64, radius: f64| BeamStation {
            point: 0,
            at,
            contour: Vec::new(),
            moments: Moments { area: std::f64::consts::PI * radius * radius, ..Moments::default() },
            off_axis: 0.0,
            weight: 1.0,
        };
        let mut stations: Vec<_> = (0..11)
            .map(|i| station(f64::from(i) / 10.0, if i % 10 == 0 { 3.0 } else { 2.0 }))
            .collect();
        weigh(&mut stations);
        assert!((mean(&stations).radius() - 2.0).abs() < 0.02);
    }
}
