//! The measuring instrument: how well a curve skeleton lies in its object.
//!
//! A skeleton is judged by numbers that do not depend on who made it. The first is the criterion of
//! the thesis: in the normal plane of every skeletal point 36 rays run to the surface; in a centred
//! skeleton the two rays of each of the 18 opposite pairs are of equal length.
//!
//! ```text
//!        ╭───────────────╮               m points, r radius of the bounding sphere
//!       ╱        │ d₂     ╲                           m
//!      │         │         │             E_center = 1  Σ   max  |dⱼ − dⱼ₊₁₈| / m         (2.2)
//!      │   d₁₉   │    d₁   │                        ─ ᵢ₌₁ ₁≤ⱼ≤₁₈
//!      ├─────────•─────────┤                        r
//!       ╲       d₂₀       ╱
//!        ╰───────────────╯               smaller is better
//! ```
//!
//! That number rewards few points in easy places, and its neighbourhood cube mixes struts that are
//! near to each other. So there are others beside it:
//!
//! | figure | what | module |
//! |---|---|---|
//! | `raw.e_center` | eq. (2.2) as in §4.4: crossings in a cube, polar interpolation | `rays`, `plane_cut` |
//! | `resampled.*` | the same figures with points at equal spacing | `resample` |
//! | `*.e_true` | rays cast against the section the point really belongs to | `section`, `rays` |
//! | `*_shaft` | without the zones about junctions and ends | `centeredness` |
//! | `offset` | distance from the area centroid of the section | `section` |
//! | `hu_degree` | degree of centeredness by Hu et al. (§2.4.2.2) | `point` |
//! | `points_outside`, `outside` | points and length outside of the object | `outside` |
//! | `topology` | components, cycles, free ends, against those of the mesh | `topology` |
//! | `coverage` | surface that no branch runs under | `coverage` |
//! | [`compare()`] | D₁₂ and Hausdorff distance of two skeletons (§2.4.2.2, eq. 2.1) | `compare` |
//!
//! Skeletons of other programs are read by [`skeleton_file`](crate::skeleton_file) and made
//! comparable by [`Evaluator::post_process`] (§4.3.1.3).
//!
//! # What does not hold
//!
//! * The cube is aligned with the axes and the first ray goes to the first crossing in the order of
//!   the mesh, both as in the thesis: `e_center` changes a little when the part is turned. The
//!   figures with true rays change only by the 10° between rays.
//! * Cavities and floating islands are no part of the surface (see [`prepare`](crate::mesh::prepare())),
//!   so they do not count here either.
//!
//! # Where the thesis leaves a choice
//!
//! * Whether m counts the points that are left out: `e_center` divides by the evaluated ones,
//!   `e_center_over_all_points` by all.
//! * Which edges are "in the corresponding neighbourhood": those of which the crossing or an end
//!   lies in the cube.
//! * Which sphere bounds the shape: the smallest one; [`BoundingSphere::BoxCentred`] is the other
//!   common choice.
//!
//! # Examples
//! ```
//! use beamwright::evaluate::{EvaluateOptions, evaluate};
//! use beamwright::mesh::{LabelParams, prepare};
//! use beamwright::skeleton_file;
//! use beamwright_formats::{Format, ReadOptions, Unit, read_bytes};
//!
//! // A square bar of 2 × 2 × 20 mm, and a line beside its axis.
//! let bar = b"v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 20\nv 2 0 20\nv 2 2 20\nv 0 2 20\n\
//!     f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
//! let line = b"v 1.25 1 5\nv 1.25 1 10\nv 1.25 1 15\nl 1 2 3\n";
//!
//! let mesh = read_bytes(bar, Format::Obj, &ReadOptions::default())?;
//! let surface = prepare(&mesh, &LabelParams::default())?;
//! let skeleton = skeleton_file::read_bytes(line, skeleton_file::Format::Obj, Unit::Mm)?;
//! let evaluation = evaluate(&surface, &skeleton, &EvaluateOptions::default())?;
//!
//! // 0.25 mm from the centroid of a section of 4 mm².
//! let offset = evaluation.raw.offset.mean.unwrap();
//! assert!((offset - 0.25 / (4.0 / std::f64::consts::PI).sqrt()).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod ball;
mod centeredness;
mod compare;
mod coverage;
mod curve_tree;
mod error;
mod evaluator;
mod interfaces;
mod options;
mod outside;
mod plane_cut;
mod point;
mod post_process;
mod rays;
mod report;
mod resample;
mod section;
mod topology;

use serde::Serialize;

pub use ball::Ball;
pub use centeredness::{Centeredness, Excluded, Offset};
pub use compare::{Comparison, compare, distance_field};
pub use coverage::Coverage;
pub use error::EvaluateError;
pub use evaluator::{CubeSource, Evaluator, MeshFacts};
pub use options::{BoundingSphere, EvaluateOptions};
pub use outside::Outside;
pub use point::PointMeasure;
pub use post_process::{Link, PostProcessing};
pub use report::{Compared, Evaluated, Report};
pub use resample::resample;
pub use topology::{MeshTopology, Topology};

use crate::mesh::Surface;
use crate::skeleton::graph::Skeleton;

/// All figures of one skeleton. Lengths are in mm; E figures and fractions are pure numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Evaluation {
    /// What the figures are relative to.
    pub mesh: MeshFacts,
    /// Centeredness of the points as they are.
    pub raw: Centeredness,
    /// Centeredness with points at equal spacing.
    pub resampled: Centeredness,
    /// That spacing, mm.
    pub resample_step: f64,
    /// Length outside of the object.
    pub outside: Outside,
    /// Components, cycles, ends.
    pub topology: Topology,
    /// Surface without a branch.
    pub coverage: Coverage,
}

/// Measures one skeleton; for several of one mesh make an [`Evaluator`].
///
/// # Errors
/// If an option is outside its range, or the skeleton is millions of strut radii long.
pub fn evaluate(
    surface: &Surface,
    skeleton: &Skeleton,
    options: &EvaluateOptions,
) -> Result<Evaluation, EvaluateError> {
    Evaluator::new(surface, options)?.evaluate(skeleton)
}

/// Removes the skeleton inside non-design parts, joins the interface centres, prunes the ends
/// (thesis §4.3.1.3); for several skeletons of one mesh make an [`Evaluator`].
pub fn post_process(surface: &Surface, skeleton: &Skeleton, link: Link) -> Skeleton {
    match Evaluator::new(surface, &EvaluateOptions::default()) {
        Ok(evaluator) => evaluator.post_process(skeleton, link).0,
        // The defaults are in range.
        Err(_) => skeleton.clone(),
    }
}
