//! How the radius changes along a run.

use super::axis::weights;
use super::draft::Run;

/// Radius along a run: a line through the radii of its sections that swellings do not bend.
pub(crate) struct Trend {
    start: f64,
    end: f64,
}

impl Trend {
    pub(crate) fn of(run: &Run) -> Option<Self> {
        let weights = weights(&run.stations);
        let n = run.stations.len();
        let (mut s0, mut s1, mut s2, mut t0, mut t1) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (i, (s, w)) in run.stations.iter().zip(&weights).enumerate() {
            let x = i as f64 / (n - 1).max(1) as f64;
            (s0, s1, s2) = (s0 + w, s1 + w * x, s2 + w * x * x);
            (t0, t1) = (t0 + w * s.radius, t1 + w * x * s.radius);
        }
        if s0 == 0.0 {
            return None;
        }
        let det = s0 * s2 - s1 * s1;
        let slope = if det > 1e-6 * s0 * s0 { (s0 * t1 - s1 * t0) / det } else { 0.0 };
        let start = (t0 - slope * s1) / s0;
        let least = 0.3 * t0 / s0;
        Some(Self { start: start.max(least), end: (start + slope).max(least) })
    }

    /// Radius at a part 0..1 of the way.
    pub(crate) fn at(&self, part: f64) -> f64 {
        self.start + (self.end - self.start) * part
    }
}
