//! Rectangular hollow sections.

use std::f64::consts::PI;

use super::super::error::{SectionError, positive, within};

pub(super) fn check(b: f64, h: f64, t: f64, r_o: f64, r_i: f64) -> Result<(), SectionError> {
    positive("the width", b)?;
    positive("the height", h)?;
    positive("the wall", t)?;
    let room = 0.5 * b.min(h);
    within("the wall", t, room * (1.0 - THINNEST_HOLE))?;
    within("the outer corner radius", r_o, room)?;
    within("the inner corner radius", r_i, room - t)
}

/// Part of the half width that a hole must keep, so that it has an area.
const THINNEST_HOLE: f64 = 1e-6;

/// Torsion constant of a hollow section to EN 10210-2:2006 and EN 10219-2:2006, annex A:
///
/// J = t³ h / 3 + 2 K A_h,  K = 2 A_h t / h,  R_c = ½ (r_o + r_i),
/// h = 2 [(B − t) + (H − t)] − 2 R_c (4 − π),  A_h = (B − t)(H − t) − R_c² (4 − π).
pub(super) fn box_torsion(b: f64, h: f64, t: f64, r_o: f64, r_i: f64) -> f64 {
    let r_c = 0.5 * (r_o + r_i);
    let mean_length = 2.0 * ((b - t) + (h - t)) - 2.0 * r_c * (4.0 - PI);
    let a_h = (b - t) * (h - t) - r_c * r_c * (4.0 - PI);
    let k = 2.0 * a_h * t / mean_length;
    t.powi(3) * mean_length / 3.0 + 2.0 * k * a_h
}

#[cfg(test)]
mod tests {
    use super::*;

    /// EN 10210-2:2006, table B.2: 100 × 100 × 5 has I_t = 439 cm⁴; table B.3: 120 × 80 × 5 has
    /// 401 cm⁴; radii 1.5 t and 1.0 t.
    #[test]
    fn hot_finished_sections_have_the_tabulated_torsion_constant() {
        for (b, h, t, published) in [(100.0, 100.0, 5.0, 439.0), (80.0, 120.0, 5.0, 401.0)] {
            let j = box_torsion(b, h, t, 1.5 * t, t) / 1e4;
            assert!((j - published).abs() < 0.5, "{h}x{b}x{t}: {j}");
        }
    }
}
