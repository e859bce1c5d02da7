//! Straight lines through the sections of a beam that a few swollen ones do not tilt.

use std::f64::consts::PI;

use super::beam_station::BeamStation;

/// Departure of the area from its straight line that halves the weight of a section: some times
/// the median departure, within bounds. Fillets add tenths to a clean strut, the steps of voxel
/// surfaces some hundredths to all of one.
const SPREAD: f64 = 3.0;
const SWELLING: [f64; 2] = [0.02, 0.12];

/// Weighs sections by how far they are off straight lines through √A and I_1^¼, in turns with the
/// lines (iteratively reweighted least squares).
pub(super) fn weigh(stations: &mut [BeamStation]) {
    if stations.len() < 4 {
        return;
    }
    // Begin from the medians: one swollen end must not tilt the first lines.
    let sizes: [Vec<f64>; 2] =
        [size_of_area, size_of_moment].map(|size| stations.iter().map(size).collect());
    let medians = sizes.each_ref().map(|sizes| median(sizes.clone()));
    // In parts of the area: twice those of a side.
    let off = |i: usize, expected: [f64; 2]| {
        let part = |k: usize| 2.0 * (sizes[k][i] / expected[k] - 1.0).abs();
        part(0).max(part(1))
    };
    let mut offs: Vec<f64> = (0..stations.len()).map(|i| off(i, medians)).collect();
    weigh_by(stations, &offs, 0.05);
    for _ in 0..4 {
        let line_through = |sizes: &Vec<f64>| {
            line_of(stations.iter().zip(sizes).map(|(s, &size)| (s.at, s.weight, size)))
        };
        let lines = sizes.each_ref().map(line_through);
        let expected = |at: f64| {
            [0, 1].map(|k| {
                let [at_start, at_end] = lines[k];
                (at_start + (at_end - at_start) * at).max(0.1 * medians[k])
            })
        };
        offs = stations.iter().enumerate().map(|(i, s)| off(i, expected(s.at))).collect();
        weigh_by(stations, &offs, 0.0);
    }
}

/// √A, which is straight in a taper.
fn size_of_area(s: &BeamStation) -> f64 {
    s.moments.area.sqrt()
}

/// The fourth root of I_1, which grows with a section as √A does.
fn size_of_moment(s: &BeamStation) -> f64 {
    s.moments.principal().0.max(0.0).sqrt().sqrt()
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

/// Values at 0 and 1 of the weighted straight line through a measure of the sections.
pub(super) fn line(stations: &[BeamStation], measure: impl Fn(&BeamStation) -> f64) -> [f64; 2] {
    line_of(stations.iter().map(|s| (s.at, s.weight, measure(s))))
}

/// The same of any places, weights and values.
fn line_of(values: impl Iterator<Item = (f64, f64, f64)>) -> [f64; 2] {
    let (mut s0, mut s1, mut s2, mut t0, mut t1) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (at, w, y) in values {
        let x = at - 0.5;
        (s0, s1, s2) = (s0 + w, s1 + w * x, s2 + w * x * x);
        (t0, t1) = (t0 + w * y, t1 + w * x * y);
    }
    let det = s0 * s2 - s1 * s1;
    let slope = if det > 1e-6 * s0 * s0 { (s0 * t1 - s1 * t0) / det } else { 0.0 };
    let middle = (t0 - slope * s1) / s0;
    [middle - 0.5 * slope, middle + 0.5 * slope]
}

/// Least twist that counts, rad: 9°. Voxel surfaces turn principal axes by a few degrees to and fro.
const LEAST_TWIST: f64 = 0.15;

/// Least I_1/I_2 at which principal axes are sharp enough to follow.
const SHARP: f64 = 1.2;

/// Most scatter of the angles about their line, against the twist.
const MOST_SCATTER: f64 = 0.2;

/// Turn of the principal axes from end to end, rad, by a straight line through the angles; 0 where
/// there is none to speak of.
///
/// An axis has no direction: each angle is taken in the half turn next to the one before, so that
/// the axes never flip.
pub(super) fn twist(stations: &[BeamStation]) -> f64 {
    let mut before: Option<f64> = None;
    let mut angles = Vec::with_capacity(stations.len());
    for s in stations {
        let (i_1, i_2, angle) = s.moments.principal();
        if i_1 < SHARP * i_2 {
            return 0.0;
        }
        let angle = before.map_or(angle, |b: f64| angle - ((angle - b) / PI).round() * PI);
        before = Some(angle);
        angles.push((s.at, s.weight, angle));
    }
    if angles.len() < 4 {
        return 0.0;
    }
    let [start, end] = line_of(angles.iter().copied());
    let twist = end - start;
    let total: f64 = angles.iter().map(|a| a.1).sum();
    let off = |&(at, w, angle): &(f64, f64, f64)| w * (angle - start - twist * at).powi(2) / total;
    let scatter = angles.iter().map(off).sum::<f64>().sqrt();
    let counts = twist.abs() >= LEAST_TWIST && scatter <= MOST_SCATTER * twist.abs();
    if counts { twist } else { 0.0 }
}
