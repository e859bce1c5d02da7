//! Geometry in few bytes: corners on a grid of 2¹⁶ steps, everything as base64.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use nalgebra::Point3;
use serde::Serialize;

/// Steps of the grid along its longest side.
const STEPS: f64 = 65535.0;

/// A grid of 2¹⁶ steps round the model. One step is a 65,000th of its size: far below a pixel.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Grid {
    /// Corner of the grid, mm.
    origin: [f64; 3],
    /// One step, mm.
    step: f64,
}

impl Grid {
    /// The grid that holds all points.
    pub(super) fn round<'p>(points: impl Iterator<Item = &'p Point3<f64>> + Clone) -> Self {
        let Some(&first) = points.clone().next() else {
            return Self { origin: [0.0; 3], step: 1.0 };
        };
        let (low, high) = points.fold((first, first), |(l, h), p| (l.inf(p), h.sup(p)));
        let step = (high - low).max() / STEPS;
        Self { origin: low.into(), step: if step > 0.0 { step } else { 1.0 } }
    }

    /// Points as base64 of three little-endian 16-bit numbers each.
    pub(super) fn points<'p>(&self, points: impl Iterator<Item = &'p Point3<f64>>) -> String {
        let steps = |p: &Point3<f64>| {
            std::array::from_fn::<u16, 3, _>(|k| {
                ((p[k] - self.origin[k]) / self.step).round().clamp(0.0, STEPS) as u16
            })
        };
        STANDARD.encode(points.flat_map(steps).flat_map(u16::to_le_bytes).collect::<Vec<u8>>())
    }
}

/// Indices as base64: little-endian, 16 bits each where all fit, else 32.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Indices {
    bits: u8,
    base64: String,
}

impl Indices {
    pub(super) fn new(indices: &[u32]) -> Self {
        let narrow: Result<Vec<u16>, _> = indices.iter().map(|&i| u16::try_from(i)).collect();
        match narrow {
            Ok(narrow) => Self { bits: 16, base64: encode(narrow.iter().map(|i| i.to_le_bytes())) },
            Err(_) => Self { bits: 32, base64: encode(indices.iter().map(|i| i.to_le_bytes())) },
        }
    }
}

fn encode<const N: usize>(numbers: impl Iterator<Item = [u8; N]>) -> String {
    STANDARD.encode(numbers.flatten().collect::<Vec<u8>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_come_back_within_half_a_step() {
        let points = [Point3::new(-3.0, 2.0, 1.0), Point3::new(7.0, 2.5, 1.3)];
        let grid = Grid::round(points.iter());
        let bytes = STANDARD.decode(grid.points(points.iter())).unwrap();
        for (i, p) in points.iter().enumerate() {
            for k in 0..3 {
                let at = 2 * (3 * i + k);
                let steps = f64::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]));
                assert!((grid.origin[k] + steps * grid.step - p[k]).abs() <= 0.51 * grid.step);
            }
        }
    }

    #[test]
    fn indices_are_as_wide_as_the_largest_needs() {
        assert_eq!(Indices::new(&[0, 65535]).bits, 16);
        assert_eq!(Indices::new(&[0, 65536]).bits, 32);
    }
}
