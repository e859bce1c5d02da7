//! Rolled open shapes: I, C and L with their fillets.

use nalgebra::{Point2, Vector2};

use super::super::error::{SectionError, positive, within};
use super::super::moments::Moments;
use super::super::outline::{Outline, Path, Segment};

/// * `sides`: flange outstands a fillet must fit on, 2 for I and 1 for C.
pub(super) fn check(
    h: f64,
    b: f64,
    t_w: f64,
    t_f: f64,
    r: f64,
    sides: f64,
) -> Result<(), SectionError> {
    positive("the height", h)?;
    positive("the width", b)?;
    positive("the web", t_w)?;
    positive("the flange", t_f)?;
    within("the web", t_w, b)?;
    within("the flange", t_f, 0.5 * h)?;
    within("the fillet", r, ((b - t_w) / sides).min(0.5 * h - t_f))
}

pub(super) fn check_angle(h: f64, b: f64, t: f64, r_1: f64, r_2: f64) -> Result<(), SectionError> {
    positive("the height", h)?;
    positive("the width", b)?;
    positive("the thickness", t)?;
    within("the thickness", t, h.min(b))?;
    within("the toe radius", r_2, t)?;
    within("the fillet and the toe radius together", r_1 + r_2, h.min(b) - t)
}

/// I about its centroid, fillets `r` at the web.
pub(super) fn i_outline(h: f64, b: f64, t_w: f64, t_f: f64, r: f64) -> Outline {
    let (y, z, w, f) = (0.5 * b, 0.5 * h, 0.5 * t_w, 0.5 * h - t_f);
    closed(&[
        (-y, -z, 0.0),
        (y, -z, 0.0),
        (y, -f, 0.0),
        (w, -f, r),
        (w, f, r),
        (y, f, 0.0),
        (y, z, 0.0),
        (-y, z, 0.0),
        (-y, f, 0.0),
        (-w, f, r),
        (-w, -f, r),
        (-y, -f, 0.0),
    ])
}

/// Channel about its centroid, web towards −y.
pub(super) fn c_outline(h: f64, b: f64, t_w: f64, t_f: f64, r: f64) -> Outline {
    let (z, f) = (0.5 * h, 0.5 * h - t_f);
    centred(closed(&[
        (0.0, -z, 0.0),
        (b, -z, 0.0),
        (b, -f, 0.0),
        (t_w, -f, r),
        (t_w, f, r),
        (b, f, 0.0),
        (b, z, 0.0),
        (0.0, z, 0.0),
    ]))
}

/// Angle about its centroid, corner towards −y and −z.
pub(super) fn l_outline(h: f64, b: f64, t: f64, r_1: f64, r_2: f64) -> Outline {
    centred(closed(&[
        (0.0, 0.0, 0.0),
        (b, 0.0, 0.0),
        (b, t, r_2),
        (t, t, r_1),
        (t, h, r_2),
        (0.0, h, 0.0),
    ]))
}

fn closed(corners: &[(f64, f64, f64)]) -> Outline {
    let corners: Vec<_> = corners.iter().map(|&(y, z, r)| (Point2::new(y, z), r)).collect();
    Outline::Path(Path::rounded(&corners))
}

/// The path moved to its centroid.
fn centred(outline: Outline) -> Outline {
    let to_centroid = Moments::of_pieces(&outline.pieces()).centroid().coords;
    let Outline::Path(Path { start, segments }) = outline else { return outline };
    let moved = |segment| match segment {
        Segment::Line { to } => Segment::Line { to: to - to_centroid },
        Segment::Arc { to, sweep } => Segment::Arc { to: to - to_centroid, sweep },
    };
    Outline::Path(Path {
        start: start - Vector2::from(to_centroid),
        segments: segments.into_iter().map(moved).collect(),
    })
}

/// Torsion constant of an I as in the tables to EN 10365 (ArcelorMittal, Sections and Merchant
/// Bars, "Notations and formulae"):
///
/// J = ⅔ (b − 0.63 t_f) t_f³ + ⅓ (h − 2 t_f) t_w³
///     + 2 t_w/t_f (0.145 + 0.1 r/t_f) [((r + t_w/2)² + (r + t_f)² − r²) / (2 r + t_f)]⁴.
pub(super) fn i_torsion(h: f64, b: f64, t_w: f64, t_f: f64, r: f64) -> f64 {
    let d = ((r + 0.5 * t_w).powi(2) + (r + t_f).powi(2) - r * r) / (2.0 * r + t_f);
    2.0 / 3.0 * (b - 0.63 * t_f) * t_f.powi(3)
        + (h - 2.0 * t_f) * t_w.powi(3) / 3.0
        + 2.0 * (t_w / t_f) * (0.145 + 0.1 * r / t_f) * d.powi(4)
}

/// α₃ of a junction at an edge, web w, flange t, fillet r (El Darwish and Johnston, Torsion of
/// Structural Shapes, ASCE J. Struct. Div. 91, 1965).
fn alpha_3(w: f64, t: f64, r: f64) -> f64 {
    let (w, r) = (w / t, r / t);
    -0.0908 + 0.2621 * w + 0.1231 * r - 0.0752 * w * r - 0.0945 * w * w
}

/// Diameter of the circle inscribed in such a junction: 2 [(3 r + w + t) − √(2 (2 r + w)(2 r + t))].
fn d_3(w: f64, t: f64, r: f64) -> f64 {
    2.0 * ((3.0 * r + w + t) - (2.0 * (2.0 * r + w) * (2.0 * r + t)).sqrt())
}

/// Torsion constant of a channel with parallel flanges (El Darwish and Johnston):
///
/// J = ⅔ b t_f³ + ⅓ (h − 2 t_f) t_w³ + 2 α₃ D₃⁴ − 0.420 t_f⁴.
pub(super) fn c_torsion(h: f64, b: f64, t_w: f64, t_f: f64, r: f64) -> f64 {
    2.0 / 3.0 * b * t_f.powi(3)
        + (h - 2.0 * t_f) * t_w.powi(3) / 3.0
        + 2.0 * alpha_3(t_w, t_f, r) * d_3(t_w, t_f, r).powi(4)
        - 0.420 * t_f.powi(4)
}

/// Torsion constant of an angle (El Darwish and Johnston):
///
/// J = ⅓ (h + b − t) t³ + α₃ D₃⁴ − 0.21 t⁴.
pub(super) fn l_torsion(h: f64, b: f64, t: f64, r: f64) -> f64 {
    (h + b - t) * t.powi(3) / 3.0 + alpha_3(t, t, r) * d_3(t, t, r).powi(4) - 0.21 * t.powi(4)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::section::contours::Contours;
    use crate::section::outline::Region;
    use crate::section::torsion::torsion_constant;

    /// ArcelorMittal, Sections and Merchant Bars, tables to EN 10365: I_t of IPE 200 6.98 cm⁴,
    /// HE 200 B 59.28 cm⁴, HE 200 A 20.98 cm⁴.
    #[test]
    fn i_sections_have_the_tabulated_torsion_constant() {
        let table = [
            ([200.0, 100.0, 5.6, 8.5, 12.0], 6.98),
            ([200.0, 200.0, 9.0, 15.0, 18.0], 59.28),
            ([190.0, 200.0, 6.5, 10.0, 18.0], 20.98),
        ];
        for ([h, b, t_w, t_f, r], published) in table {
            let j = i_torsion(h, b, t_w, t_f, r) / 1e4;
            assert!((j / published - 1.0).abs() < 0.002, "{h}x{b}: {j}");
        }
    }

    #[track_caller]
    fn agrees(outline: Outline, formula: f64, tolerance: f64) {
        let j = torsion_constant(&Contours::of_region(&Region::solid(outline), 6)).unwrap();
        assert!((formula / j - 1.0).abs() < tolerance, "{formula} by formula, {j} numerically");
    }

    #[test]
    fn formulas_agree_with_the_stress_function() {
        agrees(
            i_outline(200.0, 100.0, 5.6, 8.5, 12.0),
            i_torsion(200.0, 100.0, 5.6, 8.5, 12.0),
            0.03,
        );
        agrees(
            c_outline(200.0, 80.0, 6.0, 11.0, 13.0),
            c_torsion(200.0, 80.0, 6.0, 11.0, 13.0),
            0.03,
        );
        agrees(l_outline(100.0, 100.0, 10.0, 12.0, 0.0), l_torsion(100.0, 100.0, 10.0, 12.0), 0.02);
    }
}
