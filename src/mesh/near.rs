//! Merges the border points of a torn surface that are meant to be one.
//!
//! The points are looked up in cubes as wide as the tolerance: all that are near to one lie in its own
//! cube or in the 26 round it, however many more have one coordinate in common, as those of an end that
//! was cut off along an axis have.

use nalgebra::Point3;
use rustc_hash::FxHashMap;

use super::indexed::IndexedMesh;
use super::label::extent;
use super::orient::{NO_TWIN, Pairing};

/// Border points nearer to each other than this part of the shortest border edge are one point.
/// Rounded coordinates are far nearer, the corners of the smallest triangle just a whole edge away.
const NEAR: f64 = 0.1;

/// Merges border points that lie within [`NEAR`] of each other; the number merged.
pub(super) fn merge_near_border_points(soup: &mut IndexedMesh, pairing: &Pairing) -> usize {
    let at = |v: u32| soup.positions[v as usize];
    let mut on_border: Vec<u32> = Vec::new();
    let mut shortest = f64::INFINITY;
    for h in (0..pairing.twins.len() as u32).filter(|&h| pairing.twins[h as usize] == NO_TWIN) {
        let (a, b) = super::edges::ends(&soup.triangles, h);
        on_border.extend([a, b]);
        shortest = shortest.min((at(a) - at(b)).norm());
    }
    on_border.sort_unstable();
    on_border.dedup();
    on_border.sort_by(|&v, &w| at(v).x.total_cmp(&at(w).x).then(v.cmp(&w)));
    // Rounding to single precision bounds what "near" may mean from below.
    let near = NEAR * shortest.min(1e-4 * extent(&soup.positions));
    if near.is_nan() || near <= 0.0 {
        return 0;
    }
    let places: Vec<Point3<f64>> = on_border.iter().map(|&v| at(v)).collect();
    let mut of_point: Vec<u32> = (0..soup.positions.len() as u32).collect();
    let mut merged = 0;
    for (i, first) in first_of_near(&places, near).into_iter().enumerate() {
        if first != i {
            of_point[on_border[i] as usize] = on_border[first];
            merged += 1;
        }
    }
    if merged > 0 {
        let positions = soup.positions.clone();
        soup.merge_points(&of_point, positions);
    }
    merged
}

/// For each place the first one it is near to that is not itself near to one before; itself if none.
fn first_of_near(places: &[Point3<f64>], near: f64) -> Vec<usize> {
    let cube = |p: &Point3<f64>| [p.x, p.y, p.z].map(|x| (x / near).floor() as i64);
    let mut in_cube: FxHashMap<[i64; 3], Vec<usize>> = FxHashMap::default();
    for (i, place) in places.iter().enumerate() {
        in_cube.entry(cube(place)).or_default().push(i);
    }
    let mut first: Vec<usize> = (0..places.len()).collect();
    for (i, place) in places.iter().enumerate() {
        if first[i] != i {
            continue;
        }
        let own = cube(place);
        for step in 0..27_usize {
            let beside = [step % 3, step / 3 % 3, step / 9];
            let cube = [0, 1, 2].map(|k| own[k].saturating_add(beside[k] as i64 - 1));
            for &other in in_cube.get(&cube).into_iter().flatten() {
                let is_open = other > i && first[other] == other;
                if is_open && (places[other] - place).norm() <= near {
                    first[other] = i;
                }
            }
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_places_are_found_across_the_sides_of_cubes() {
        let places = [[-0.01, 0.0, 0.0], [0.01, -0.01, 0.01], [0.0, 0.0, 1.5], [0.0, 0.9, 1.0]];
        let places = places.map(Point3::from);
        assert_eq!(first_of_near(&places, 1.0), [0, 0, 2, 3]);
        assert_eq!(first_of_near(&places, 1e-3), [0, 1, 2, 3]);
    }

    #[test]
    fn what_is_near_to_a_merged_place_alone_stays() {
        let places = [0.0, 0.8, 1.6, 2.4].map(|x| Point3::new(x, 0.0, 0.0));
        assert_eq!(first_of_near(&places, 1.0), [0, 0, 2, 2]);
    }

    #[test]
    fn every_place_is_asked_as_if_all_were_compared() {
        let at = |k: f64| [0.618, 0.414, 0.732].map(|step| (k * step).fract() * 4.0);
        let mut places: Vec<Point3<f64>> =
            (0..300).map(|k| Point3::from(at(f64::from(k)))).collect();
        places.sort_by(|p, q| p.x.total_cmp(&q.x));
        let mut expected: Vec<usize> = (0..places.len()).collect();
        for i in 0..places.len() {
            for k in i + 1..places.len() {
                let is_open = expected[i] == i && expected[k] == k;
                if is_open && (places[k] - places[i]).norm() <= 0.4 {
                    expected[k] = i;
                }
            }
        }
        assert_eq!(first_of_near(&places, 0.4), expected);
    }
}
