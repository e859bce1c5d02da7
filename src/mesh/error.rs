//! Why a mesh cannot be used.

use nalgebra::Point3;

use crate::wording::counted;

/// Why a surface cannot be turned into a closed, oriented, 2-manifold mesh.
///
/// Places are model coordinates in mm, ready to be typed into a viewer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// No triangle is left after the degenerate ones were dropped.
    #[error("the mesh has no triangle with an area; export the surface mesh again")]
    NoTriangles,

    /// The surface has openings that are neither small nor flat.
    #[error(
        "the surface is open: {} in {}, the first at {}; close the holes (MeshLab: Filters > Remeshing > \
         Close Holes) and try again",
        counted(*edges, "border edge", "border edges"),
        counted(*loops, "opening", "openings"),
        place(first)
    )]
    Open {
        /// Border edges that remain.
        edges: usize,
        /// Openings that remain.
        loops: usize,
        /// Middle of the first border edge.
        first: Point3<f64>,
    },

    /// Edges with more than two triangles that do not enclose material.
    #[error(
        "{} more than two triangles without enclosing material, the first at {}; remove inner walls \
         (MeshLab: Filters > Cleaning > Repair non Manifold Edges) and try again",
        counted(*edges, "edge joins", "edges join"),
        place(first)
    )]
    NonManifold {
        /// Edges without a sound pairing.
        edges: usize,
        /// Middle of the first one.
        first: Point3<f64>,
    },

    /// The surface has one side only.
    #[error(
        "the surface has no outside: its two sides run into each other at {}; turn or remove the faces there \
         (MeshLab: Filters > Normals > Re-Orient all faces coherently) and try again",
        place(first)
    )]
    OneSided {
        /// Middle of an edge across which the sides change.
        first: Point3<f64>,
    },

    /// The part is so small or large that its second moments are no numbers any more.
    #[error(
        "the part is {width:.1e} mm wide, and only parts from {smallest:e} to {largest:e} mm can be \
         measured; scale it, or remove the points that lie far out",
        smallest = SCALE[0], largest = SCALE[1]
    )]
    OutOfScale {
        /// Largest side of the box round it, mm.
        width: f64,
    },

    /// The surface encloses no volume.
    #[error(
        "the surface encloses no volume; export the closed surface of a solid body, no sheets without thickness"
    )]
    NoVolume,

    /// Every face is labelled non-design.
    #[error("every face is labelled non-design by {by}; leave the optimised faces unlabelled")]
    NoDesign {
        /// The source of the labels, in words.
        by: &'static str,
    },

    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
}

/// Extents of parts that can be measured, mm. Products of two second moments are eighth powers of a
/// length, which are numbers from 1e-38 to 1e38 mm; the beams of a part may be 10⁶ times finer than it.
pub(super) const SCALE: [f64; 2] = [1e-30, 1e30];

fn place(p: &Point3<f64>) -> String {
    format!("({:.2}, {:.2}, {:.2}) mm", p.x, p.y, p.z)
}
