//! Which parts of the surface the march has passed.
//!
//! A triangle may be longer than a whole branch, so a claim is not a mark on a triangle: it says
//! that the part of the triangle between two given planes is passed.

use nalgebra::Point3;

use crate::mesh::contour::Plane;
use crate::mesh::id::FaceId;

/// A claim of one band on one triangle; claims on a triangle form a chain.
#[derive(Clone, Copy, Debug)]
struct Claim {
    face: u32,
    band: u32,
    next: u32,
}

const NONE: u32 = u32::MAX;

/// The bands passed so far.
#[derive(Debug)]
pub(crate) struct Claims {
    bands: Vec<(Plane, Plane)>,
    first: Vec<u32>,
    claims: Vec<Claim>,
}

/// A state of [`Claims`] to return to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    bands: usize,
    claims: usize,
}

impl Claims {
    pub(crate) fn new(faces: usize) -> Self {
        Self { bands: Vec::new(), first: vec![NONE; faces], claims: Vec::new() }
    }

    /// Claims the part of `faces` above `lower` and below `upper`.
    pub(crate) fn add(&mut self, lower: Plane, upper: Plane, faces: &[FaceId]) {
        let band = self.bands.len() as u32;
        self.bands.push((lower, upper));
        for face in faces {
            let first = &mut self.first[face.index()];
            self.claims.push(Claim { face: face.0, band, next: *first });
            *first = self.claims.len() as u32 - 1;
        }
    }

    /// Whether a point of a triangle lies in a claimed band.
    pub(crate) fn holds(&self, face: FaceId, point: &Point3<f64>) -> bool {
        let mut at = self.first[face.index()];
        while at != NONE {
            let claim = self.claims[at as usize];
            let (lower, upper) = &self.bands[claim.band as usize];
            if lower.height(point) >= 0.0 && upper.height(point) < 0.0 {
                return true;
            }
            at = claim.next;
        }
        false
    }

    pub(crate) fn mark(&self) -> Mark {
        Mark { bands: self.bands.len(), claims: self.claims.len() }
    }

    /// Takes back all claims made since `mark`.
    pub(crate) fn take_back(&mut self, mark: Mark) {
        self.bands.truncate(mark.bands);
        while self.claims.len() > mark.claims {
            if let Some(claim) = self.claims.pop() {
                self.first[claim.face as usize] = claim.next;
            }
        }
    }
}
