//! Square bars along x, for the tests of this march.

use beamwright_formats::{Polygons, RawMesh};

use crate::mesh::{LabelParams, Surface, prepare};

/// Length of the bars, mm; they have a ring of four nodes at every millimetre.
pub(super) const LENGTH: usize = 10;

/// Bars of 1 mm × 1 mm, one at each distance along y.
pub(super) fn bars(at: &[f64]) -> Surface {
    let mut raw = RawMesh { faces: Polygons::default(), ..RawMesh::default() };
    for &y in at {
        let first = raw.positions.len() as u32;
        for x in 0..=LENGTH {
            let x = x as f64;
            raw.positions.extend([[x, y, 0.], [x, y + 1., 0.], [x, y + 1., 1.], [x, y, 1.]]);
        }
        let ring = |k: u32| [0, 1, 2, 3].map(|i| first + 4 * k + i);
        let last = LENGTH as u32;
        let mut start = ring(0);
        start.reverse();
        raw.faces.push(start);
        raw.faces.push(ring(last));
        for k in 0..last {
            let (a, b) = (ring(k), ring(k + 1));
            for i in 0..4 {
                let j = (i + 1) % 4;
                raw.faces.push([a[i], a[j], b[j], b[i]]);
            }
        }
    }
    prepare(&raw, &LabelParams::default()).expect("closed bars")
}
