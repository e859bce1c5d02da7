//! What the sections along one straight beam say: mean and end values, taken away from junctions.

use nalgebra::{Point2, Point3};

use super::beam_axes::BeamAxes;
use super::beam_station::BeamStation;
use super::moments::Moments;
use super::robust::{line, twist, weigh};
use super::section_at::Section;

/// Sections along a beam and what they say together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BeamSection {
    /// Sections from the first node to the second.
    pub stations: Vec<BeamStation>,
    /// Weighted means.
    pub mean: Moments,
    /// Values at both ends, from straight lines through the weighted sections.
    pub ends: [Moments; 2],
    /// Turn of the principal axes from the first end to the second, rad; 0 where there is none to
    /// speak of.
    pub twist: f64,
}

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
        stations.iter_mut().for_each(|s| s.at = s.at.clamp(0.0, 1.0));
        weigh(&mut stations);
        if stations.is_empty() {
            return Self::default();
        }
        let twist = twist(&stations);
        let mean = mean(&stations, twist);
        let ends = ends(&stations, &mean, twist);
        Self { stations, mean, ends, twist }
    }

    /// Turn of the principal axes at a part of the length against those of the mean, rad.
    pub fn turn_at(&self, at: f64) -> f64 {
        turn_at(self.twist, at)
    }

    /// Number of sections that are much larger or smaller than their neighbours.
    pub fn outliers(&self) -> usize {
        self.stations.iter().filter(|s| s.is_outlier()).count()
    }
}

fn turn_at(twist: f64, at: f64) -> f64 {
    twist * (at - 0.5)
}

/// Weighted means, in the axes that turn along with a twisted beam.
fn mean(stations: &[BeamStation], twist: f64) -> Moments {
    let total: f64 = stations.iter().map(|s| s.weight).sum();
    let untwisted = |s: &BeamStation| s.moments.turned(-turn_at(twist, s.at));
    Moments::mean(stations.iter().map(|s| (s.weight / total, untwisted(s))))
}

/// End values by straight lines through √A, which is straight in a taper, and the moments in
/// squares of the area; no principal one below a tenth of the mean's least.
fn ends(stations: &[BeamStation], mean: &Moments, twist: f64) -> [Moments; 2] {
    let side = line(stations, |s| s.moments.area.sqrt());
    let part = |of: fn(&Moments) -> f64| {
        line(stations, move |s| {
            of(&s.moments.turned(-turn_at(twist, s.at))) / s.moments.area.powi(2)
        })
    };
    let (yy, zz, yz) = (part(|m| m.i_yy), part(|m| m.i_zz), part(|m| m.i_yz));
    [0, 1].map(|e| {
        let area = side[e].max(0.0).powi(2).max(0.1 * mean.area);
        let squared = area * area;
        let least = 0.1 * squared / mean.area.powi(2);
        let i_yy = (yy[e] * squared).max(least * mean.i_yy);
        let i_zz = (zz[e] * squared).max(least * mean.i_zz);
        // I₂ ≥ m exactly where I_yz² ≤ (I_yy − m)(I_zz − m).
        let least_principal = least * mean.principal().1;
        let most = ((i_yy - least_principal) * (i_zz - least_principal)).max(0.0).sqrt();
        Moments { area, i_yy, i_zz, i_yz: (yz[e] * squared).clamp(-most, most) }
            .turned(turn_at(twist, e as f64))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_of_a_cone_are_those_of_its_radii() {
        let mut stations: Vec<_> = (1..10)
            .map(|i| {
                let at = f64::from(i) / 10.0;
                let r = 7.0 - 3.0 * at;
                let i = std::f64::consts::PI * r.powi(4) / 4.0;
                let area = std::f64::consts::PI * r * r;
                station(at, Moments { area, i_yy: i, i_zz: i, i_yz: 0.0 })
            })
            .collect();
        weigh(&mut stations);
        let ends = ends(&stations, &mean(&stations, 0.0), 0.0);
        for (end, radius) in ends.iter().zip([7.0, 4.0]) {
            assert!((end.radius() - radius).abs() < 1e-6, "{}", end.radius());
            assert!((end.i_yy - std::f64::consts::PI * f64::powi(radius, 4) / 4.0).abs() < 1e-3);
        }
    }

    #[test]
    fn ends_that_run_away_stay_those_of_a_section() {
        let turning =
            |i: i32| Moments { area: 60.0, i_yy: 340.0, i_zz: 340.0, i_yz: f64::from(70 * i) };
        let mut stations: Vec<_> =
            (0..5).map(|i| station(0.3 + 0.1 * f64::from(i), turning(i - 2))).collect();
        weigh(&mut stations);
        let mean = mean(&stations, 0.0);
        let least = 0.1 * mean.principal().1;
        for end in ends(&stations, &mean, 0.0) {
            assert!(end.principal().1 >= least * (1.0 - 1e-9), "{end:?}");
        }
    }

    #[test]
    fn the_mean_of_a_twisted_bar_is_that_of_its_section() {
        let flat = Moments { area: 60.0, i_yy: 500.0, i_zz: 180.0, i_yz: 0.0 };
        for total in [-1.8, 0.5, 2.5] {
            let mut stations: Vec<_> = (0..21)
                .map(|i| f64::from(i) / 20.0)
                .map(|at| station(at, flat.turned(0.3 + total * (at - 0.5))))
                .collect();
            weigh(&mut stations);
            let found = twist(&stations);
            assert!((found - total).abs() < 1e-9, "{found} for {total}");
            let (i_1, i_2, angle) = mean(&stations, found).principal();
            assert!((i_1 - 500.0).abs() < 1e-6 && (i_2 - 180.0).abs() < 1e-6);
            assert!((angle - 0.3).abs() < 1e-9, "{angle}");
        }
    }

    fn station(at: f64, moments: Moments) -> BeamStation {
        BeamStation { point: 0, at, contour: Vec::new(), moments, off_axis: 0.0, weight: 1.0 }
    }

    #[test]
    fn swollen_ends_do_not_change_the_mean() {
        let disc = |radius: f64| {
            let i = std::f64::consts::PI * radius.powi(4) / 4.0;
            let area = std::f64::consts::PI * radius * radius;
            Moments { area, i_yy: i, i_zz: i, i_yz: 0.0 }
        };
        let mut stations: Vec<_> = (0..11)
            .map(|i| station(f64::from(i) / 10.0, disc(if i % 10 == 0 { 3.0 } else { 2.0 })))
            .collect();
        weigh(&mut stations);
        assert!((mean(&stations, 0.0).radius() - 2.0).abs() < 0.02);
    }
}
