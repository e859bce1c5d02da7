//! The sections of a loft, checked and brought to common pieces.

use super::closed_spline::ClosedSpline;
use super::crossing::{encloses, first_crossing};
use super::error::BodyError;
use super::loft::Station;
use super::piece::Piece;
use super::ring::{Ring, reversed, ring};
use super::tolerance::SHORTEST;

/// Checked heights of the stations.
pub(super) fn heights(stations: &[Station]) -> Result<Vec<f64>, BodyError> {
    if stations.len() < 2 {
        return Err(BodyError::TooFewStations { count: stations.len() });
    }
    let heights: Vec<f64> = stations.iter().map(|s| s.z).collect();
    if heights.iter().any(|z| !z.is_finite()) {
        return Err(BodyError::NotFinite { what: "the height of a station" });
    }
    match heights.windows(2).position(|w| w[1] - w[0] < SHORTEST) {
        Some(k) => Err(BodyError::NotAscending { station: k + 1 }),
        None => Ok(heights),
    }
}

/// `rings[r][k]` for all stations: alike piece by piece, holes clear.
pub(super) fn common_rings(stations: &[Station]) -> Result<Vec<Vec<Ring>>, BodyError> {
    let mut by_station: Vec<Vec<Ring>> = Vec::with_capacity(stations.len());
    for (k, station) in stations.iter().enumerate() {
        let same = k > 0 && same_section(station, &stations[k - 1]);
        let rings = if same { by_station[k - 1].clone() } else { clear_rings(k, station)? };
        if k > 0 && rings.len() != by_station[0].len() {
            return Err(BodyError::UnlikeOutlines { station: k });
        }
        by_station.push(rings);
    }
    (0..by_station[0].len())
        .map(|r| {
            let mut ring: Vec<Ring> =
                by_station.iter_mut().map(|s| std::mem::take(&mut s[r])).collect();
            share_breaks(&mut ring);
            let alike = |k: &usize| {
                let pairs = || ring[0].iter().zip(&ring[*k]);
                ring[0].len() == ring[*k].len() && pairs().all(|(a, b)| a.is_like(b))
            };
            match (1..ring.len()).find(|k| !alike(k)) {
                Some(station) => Err(BodyError::UnlikeOutlines { station }),
                None => Ok(ring),
            }
        })
        .collect()
}

fn same_section(a: &Station, b: &Station) -> bool {
    a.outer == b.outer && a.holes == b.holes
}

/// The rings of a station, with its holes inside and apart from each other.
fn clear_rings(station: usize, section: &Station) -> Result<Vec<Ring>, BodyError> {
    let mut rings = vec![ring(&section.outer)?];
    for hole in &section.holes {
        rings.push(reversed(&ring(hole)?));
    }
    for (hole, ring) in rings.iter().enumerate().skip(1) {
        let fault = Err(BodyError::HoleOutside { station, hole: hole - 1 });
        if let ([Piece::Arc(outer)], [Piece::Arc(inner)]) = (&rings[0][..], &ring[..])
            && outer.is_circular()
            && inner.is_circular()
            && rings.len() == 2
        {
            let reach = (inner.centre - outer.centre).norm() + inner.p.norm();
            return if reach < outer.p.norm() { Ok(rings) } else { fault };
        }
        let inside = encloses(&rings[0], &ring[0].start());
        let apart = (1..rings.len())
            .filter(|&other| other != hole)
            .all(|other| !encloses(&rings[other], &ring[0].start()));
        if !inside || !apart {
            return fault;
        }
    }
    if rings.len() > 1 {
        let all: Vec<&[Piece]> = rings.iter().map(Vec::as_slice).collect();
        if let Some([_, (ring, _)]) = first_crossing(&all) {
            return Err(BodyError::HoleOutside { station, hole: ring.saturating_sub(1) });
        }
    }
    Ok(rings)
}

/// Refines freeform outlines to common breaks.
fn share_breaks(ring: &mut [Ring]) {
    let curves: Vec<&ClosedSpline> = ring
        .iter()
        .filter_map(|pieces| match &pieces[..] {
            [Piece::Spline(curve)] => Some(curve),
            _ => None,
        })
        .collect();
    if curves.len() < ring.len() || curves.windows(2).all(|w| w[0].breaks() == w[1].breaks()) {
        return;
    }
    let union = curves[1..].iter().fold(curves[0].clone(), |union, curve| union.refined(curve));
    for pieces in ring {
        if let [Piece::Spline(curve)] = &mut pieces[..] {
            *curve = curve.on_breaks_of(&union);
        }
    }
}
