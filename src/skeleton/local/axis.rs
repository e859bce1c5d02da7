//! The straight axis of a run near one of its ends.

use nalgebra::{Matrix3, Point3, SymmetricEigen, Unit, Vector3};

use super::draft::Station;

/// A line fitted to section centroids.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    pub(crate) point: Point3<f64>,
    /// Away from the end the axis was asked for.
    pub(crate) direction: Unit<Vector3<f64>>,
    /// Length of the fitted part, mm.
    pub(crate) length: f64,
    /// Mean radius of the sections used, mm.
    pub(crate) radius: f64,
}

impl Axis {
    /// Distance of a point from the line, mm.
    pub(crate) fn distance(&self, p: &Point3<f64>) -> f64 {
        self.direction.cross(&(p - self.point)).norm()
    }
}

/// Whether all axes pass a place within a part of their radius.
pub(crate) fn all_pass(axes: &[Axis], place: &Point3<f64>, within: f64) -> bool {
    axes.iter().all(|axis| axis.distance(place) <= within * axis.radius)
}

/// A branch is straight while no centroid is farther from the line than this part of the radius.
/// The wave of y_form (0.2) is straight, the bends of easy arcs (0.5 over ten radii) are not.
const STRAIGHT: f64 = 0.3;

/// A bent branch is never judged by less than this many radii from its end.
const SHORTEST: f64 = 3.0;

/// Relative departure from the trend of the radius that halves the weight of a section: fillets at
/// junctions swell the section by tenths, voxel steps by hundredths.
const SWELLING: f64 = 0.05;

/// Fits the axis of a run next to its first station; `None` with fewer than two stations.
pub(crate) fn axis_at_start(stations: &[Station]) -> Option<Axis> {
    let weights = weights(stations);
    let mut count = stations.len();
    loop {
        let axis = fit(&stations[..count], &weights[..count])?;
        let enough = axis.length <= SHORTEST * axis.radius || count <= 4;
        let bent = || {
            stations[..count]
                .iter()
                .zip(&weights)
                .any(|(s, w)| *w > 0.5 && axis.distance(&s.centroid) > STRAIGHT * axis.radius)
        };
        if enough || !bent() {
            return Some(axis);
        }
        count = (count * 2 / 3).max(4);
    }
}

/// Weights of sections: low where the radius leaves its own linear trend.
pub(crate) fn weights(stations: &[Station]) -> Vec<f64> {
    let n = stations.len();
    if n < 4 {
        return vec![1.0; n];
    }
    let mut weights = vec![1.0; n];
    // Three rounds of reweighted least squares: r ≈ p + q i.
    for _ in 0..3 {
        let (mut s0, mut s1, mut s2, mut t0, mut t1) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (i, (s, w)) in stations.iter().zip(&weights).enumerate() {
            let x = i as f64 / n as f64 - 0.5;
            s0 += w;
            s1 += w * x;
            s2 += w * x * x;
            t0 += w * s.radius;
            t1 += w * x * s.radius;
        }
        let det = s0 * s2 - s1 * s1;
        let q = if det > 1e-9 * s0 * s0 { (s0 * t1 - s1 * t0) / det } else { 0.0 };
        let p = (t0 - q * s1) / s0;
        for (i, (s, w)) in stations.iter().zip(&mut weights).enumerate() {
            let trend = p + q * (i as f64 / n as f64 - 0.5);
            let off = (s.radius - trend) / (SWELLING * trend.abs().max(0.1 * s.radius));
            *w = 1.0 / (1.0 + off * off);
        }
    }
    weights
}

fn fit(stations: &[Station], weights: &[f64]) -> Option<Axis> {
    if stations.len() < 2 {
        return None;
    }
    let total: f64 = weights.iter().sum();
    let mean: Vector3<f64> =
        stations.iter().zip(weights).map(|(s, w)| s.centroid.coords * *w).sum::<Vector3<f64>>()
            / total;
    let spread: Matrix3<f64> = stations
        .iter()
        .zip(weights)
        .map(|(s, w)| {
            let d = s.centroid.coords - mean;
            d * d.transpose() * *w
        })
        .sum();
    let eigen = SymmetricEigen::new(spread);
    let column = eigen.eigenvalues.imax();
    let along = eigen.eigenvectors.column(column).into_owned();
    let first = stations[0].centroid;
    let last = stations[stations.len() - 1].centroid;
    let direction =
        Unit::try_new(if along.dot(&(last - first)) < 0.0 { -along } else { along }, 0.5)?;
    let radius = stations.iter().zip(weights).map(|(s, w)| s.radius * w).sum::<f64>() / total;
    Some(Axis {
        point: Point3::from(mean),
        direction,
        length: (last - first).dot(&direction),
        radius,
    })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::mesh::id::HalfEdgeId;

    /// A section of a radius.
    pub(crate) fn station(centroid: [f64; 3], radius: f64) -> Station {
        Station {
            centroid: centroid.into(),
            direction: Vector3::x_axis(),
            radius,
            reach: radius,
            side: HalfEdgeId(0),
        }
    }

    /// Sections half a radius apart on a straight rod along x of radius 2.
    pub(crate) fn rod(count: usize) -> Vec<Station> {
        (0..count).map(|i| station([i as f64, 0.0, 0.0], 2.0)).collect()
    }

    #[test]
    fn the_axis_of_a_straight_rod_points_away_from_the_asked_end() {
        let axis = axis_at_start(&rod(12)).expect("an axis");
        assert!((axis.direction.x - 1.0).abs() < 1e-12);
        assert_eq!((axis.length, axis.radius), (11.0, 2.0));
        assert!((axis.distance(&Point3::new(-40.0, 3.0, 4.0)) - 5.0).abs() < 1e-9);
    }

    #[test]
    fn a_swollen_end_hardly_turns_the_axis() {
        let mut stations = rod(12);
        stations[0] = station([0.0, 1.5, 0.0], 3.0);
        stations[1] = station([1.0, 0.8, 0.0], 2.6);
        let axis = axis_at_start(&stations).expect("an axis");
        assert!(axis.direction.x > 0.9999, "{:?}", axis.direction);
    }

    #[test]
    fn the_axis_of_a_bend_is_that_of_its_nearer_part() {
        let arc = |i: usize| {
            let (sin, cos) = (i as f64 / 20.0).sin_cos();
            station([20.0 * sin, 20.0 * (1.0 - cos), 0.0], 2.0)
        };
        let axis = axis_at_start(&(0..30).map(arc).collect::<Vec<_>>()).expect("an axis");
        assert!(axis.length < 12.0, "{}", axis.length);
        assert!(axis.direction.x > 0.95);
    }

    #[test]
    fn one_section_has_no_axis() {
        assert!(axis_at_start(&rod(1)).is_none());
    }
}
