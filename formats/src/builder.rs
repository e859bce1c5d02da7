//! The mesh while it is read: keeps the promises of [`RawMesh`] as points and faces come.

use std::path::Path;

use crate::error::ReadError;
use crate::raw_mesh::RawMesh;

/// Most corners of one polygon.
pub(crate) const MOST_CORNERS: u64 = 60_000;

/// Most squared corners of all polygons of more than [`SMALL_POLYGON`] corners.
///
/// Cutting a polygon into triangles takes up to 6 ns for each pair of its corners, if it was made
/// for that; the limit keeps a file from taking more than half a minute. Faces of CAD parts have
/// some thousand corners at most.
const MOST_SQUARED_CORNERS: u64 = 4_000_000_000;

/// Polygons of so few corners take a time in proportion to their size in the file.
const SMALL_POLYGON: usize = 64;

/// Most points, and most corners of all faces together: they are counted in 32 bits.
const MOST_INDICES: usize = u32::MAX as usize;

/// A point left the range of numbers when it was converted to millimetres.
#[derive(Debug)]
pub(crate) struct Overflow;

/// A mesh being read.
#[derive(Debug)]
pub(crate) struct Builder<'a> {
    /// The mesh so far, in millimetres.
    pub(crate) mesh: RawMesh,
    path: &'a Path,
    /// Millimetres in one unit of the file.
    factor: f64,
    squared_corners: u64,
}

impl<'a> Builder<'a> {
    /// An empty mesh, for a file whose unit is `factor` millimetres.
    pub(crate) fn new(path: &'a Path, factor: f64) -> Self {
        Self { mesh: RawMesh::default(), path, factor, squared_corners: 0 }
    }

    /// Adds a point, in the unit of the file.
    #[inline]
    pub(crate) fn point(&mut self, position: [f64; 3]) -> Result<(), Overflow> {
        let position = position.map(|coordinate| coordinate * self.factor);
        if position.iter().all(|coordinate| coordinate.is_finite()) {
            self.mesh.positions.push(position);
            Ok(())
        } else {
            Err(Overflow)
        }
    }

    /// Adds a corner to the face that is being read; the reader has checked, or will, that the
    /// point exists.
    #[inline]
    pub(crate) fn corner(&mut self, point: u32) {
        self.mesh.faces.corners.push(point);
    }

    /// Corners of the face that is being read.
    #[inline]
    pub(crate) fn open_corners(&self) -> usize {
        let faces = &self.mesh.faces;
        faces.corners.len() - faces.starts.last().map_or(0, |&start| start as usize)
    }

    /// Drops the face that is being read.
    pub(crate) fn drop_face(&mut self) {
        let open = self.open_corners();
        let corners = &mut self.mesh.faces.corners;
        corners.truncate(corners.len() - open);
    }

    /// Ends the face that is being read.
    #[inline]
    pub(crate) fn close_face(&mut self) -> Result<(), ReadError> {
        let open = self.open_corners();
        if open > SMALL_POLYGON {
            self.check_corner_count(open as u64)?;
            self.squared_corners += (open * open) as u64;
            if self.squared_corners > MOST_SQUARED_CORNERS {
                return Err(ReadError::LargeFaces { path: self.path.to_owned() });
            }
        }
        let corners = self.mesh.faces.corners.len();
        if corners > MOST_INDICES {
            return Err(self.too_many("corners of faces", MOST_INDICES as u64));
        }
        self.mesh.faces.starts.push(corners as u32);
        Ok(())
    }

    /// The error that there is more than `limit` of something.
    pub(crate) fn too_many(&self, what: &'static str, limit: u64) -> ReadError {
        ReadError::TooMany { path: self.path.to_owned(), what, limit }
    }

    /// Checks how many points there are or will be.
    pub(crate) fn check_point_count(&self, count: u64) -> Result<(), ReadError> {
        if count > MOST_INDICES as u64 {
            return Err(self.too_many("points", MOST_INDICES as u64));
        }
        Ok(())
    }

    /// Checks how many corners a face has or will have.
    #[inline]
    pub(crate) fn check_corner_count(&self, count: u64) -> Result<(), ReadError> {
        if count > MOST_CORNERS {
            return Err(self.too_many("corners of one face", MOST_CORNERS));
        }
        Ok(())
    }

    /// The finished mesh.
    pub(crate) fn finish(mut self, label_source: &'static str) -> Result<RawMesh, ReadError> {
        if self.mesh.faces.is_empty() {
            let points = self.mesh.positions.len();
            return Err(ReadError::NoFaces { path: self.path.to_owned(), points });
        }
        self.check_point_count(self.mesh.positions.len() as u64)?;
        self.mesh.positions.shrink_to_fit();
        self.mesh.faces.corners.shrink_to_fit();
        self.mesh.faces.starts.shrink_to_fit();
        self.mesh.label_source = label_source;
        Ok(self.mesh)
    }
}
