//! What a march may spend: it ends when the user wants it to, and searches so far and no farther.

use nalgebra::Point3;
use rustc_hash::FxHashMap;

use super::error::{SkeletonError, keep_on};
use crate::observer::Observer;

/// Places looked at by all searches for detours of one skeleton, about a second's worth. A detour that
/// is found takes some hundreds; where there is none, a search takes up to a hundred thousand. The
/// bracket simjeb_23 asks for 1,700 in all, the part to_torsion for 370,000, a mesh that crosses itself
/// over and over for millions.
const MOST_PLACES: usize = 500_000;

/// Triangles that these searches ask at most, a second's worth: a place asks some tens, but hundreds on
/// a mesh whose long triangles lie across each other.
const MOST_LOOKS: usize = 40_000_000;

/// A way between two places, if there is one.
type Way = Option<Vec<Point3<f64>>>;

/// The observer of a march and what is left to spend.
pub(crate) struct Watch<'o, O> {
    observer: &'o mut O,
    /// Places that searches for detours may still look at.
    pub(super) places_left: usize,
    /// Triangles that they may still ask.
    pub(super) looks_left: usize,
    /// Detours by their ends: joints that are moved in turns leave most of their branches alone.
    known: FxHashMap<[u64; 6], Way>,
}

impl<'o, O: Observer> Watch<'o, O> {
    pub(crate) fn new(observer: &'o mut O) -> Self {
        Self {
            observer,
            places_left: MOST_PLACES,
            looks_left: MOST_LOOKS,
            known: FxHashMap::default(),
        }
    }

    /// An error as soon as the observer asks to stop.
    pub(crate) fn keep_on(&mut self) -> Result<(), SkeletonError> {
        keep_on(self.observer)
    }

    /// The detour between two places, searched once.
    pub(super) fn detour(
        &mut self,
        ends: [&Point3<f64>; 2],
        search: impl FnOnce(&mut Self) -> Result<Way, SkeletonError>,
    ) -> Result<Way, SkeletonError> {
        let [a, b] = ends.map(|p| [p.x, p.y, p.z].map(f64::to_bits));
        let key = [a[0], a[1], a[2], b[0], b[1], b[2]];
        if let Some(known) = self.known.get(&key) {
            return Ok(known.clone());
        }
        let found = search(self)?;
        self.known.insert(key, found.clone());
        Ok(found)
    }
}
