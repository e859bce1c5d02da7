//! How well skeletons are centred, and what that means for each beam.

use crate::evaluate::{EvaluateError, EvaluateOptions, Evaluated, Evaluator, Link};
use crate::frame::Frame;
use crate::mesh::Surface;
use crate::segment;
use crate::skeleton::Skeleton;

/// A skeleton of another program.
pub struct Peer {
    /// Its name, for instance that of its file.
    pub name: String,
    /// The skeleton.
    pub skeleton: Skeleton,
}

/// Figures of our skeleton and those of others.
pub struct Measures {
    /// Ours first.
    pub(super) evaluated: Vec<Evaluated>,
    /// The others, made comparable.
    pub(super) peers: Vec<Peer>,
    /// Distance of each of our points from the centroid of its section, in section radii.
    pub(super) offsets: Vec<Option<f64>>,
}

impl Measures {
    /// Measures our skeleton and others, which are first made comparable as thesis §4.3.1.3 says.
    ///
    /// # Errors
    /// A skeleton that is millions of strut radii long: its unit is not that of the mesh.
    pub fn new(
        surface: &Surface,
        skeleton: &Skeleton,
        peers: Vec<Peer>,
    ) -> Result<Self, EvaluateError> {
        let evaluator = Evaluator::new(surface, &EvaluateOptions::default())?;
        let mut evaluated = vec![Evaluated {
            name: "beamwright".into(),
            post_processing: None,
            evaluation: evaluator.evaluate(skeleton)?,
        }];
        let mut comparable = Vec::new();
        for peer in peers {
            let (skeleton, done) = evaluator.post_process(&peer.skeleton, Link::default());
            let evaluation = evaluator.evaluate(&skeleton)?;
            let name = peer.name.clone();
            evaluated.push(Evaluated { name, post_processing: Some(done), evaluation });
            comparable.push(Peer { skeleton, ..peer });
        }
        let measured = evaluator.point_measures(skeleton);
        let offsets = measured.into_iter().map(|(_, m)| m.and_then(|m| m.offset)).collect();
        Ok(Self { evaluated, peers: comparable, offsets })
    }
}

/// What the skeletal points near a beam say of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Along {
    /// Farthest a point of its branch lies from its axis, mm.
    pub(super) deviation: f64,
    /// Mean of the offsets, in section radii; `None` where none was measured.
    pub(super) offset: Option<f64>,
}

/// For each beam what the points of its branches say that are nearer to it than to others.
pub(super) fn along(frame: &Frame, skeleton: &Skeleton, offsets: &[Option<f64>]) -> Vec<Along> {
    let mut all = vec![Along::default(); frame.beams.len()];
    let mut sums = vec![(0.0, 0u32); frame.beams.len()];
    for (b, branch) in skeleton.branches.iter().enumerate() {
        let beams: Vec<usize> = (0..frame.beams.len())
            .filter(|&i| frame.beams[i].spans().any(|(_, of)| of as usize == b))
            .collect();
        for &p in &branch.points {
            let position = skeleton.position(p);
            let distance = |&i: &usize| {
                let [a, b] = frame.axis(&frame.beams[i]);
                segment::distance(&position, &a, &b)
            };
            let nearest =
                beams.iter().map(|i| (distance(i), *i)).min_by(|x, y| x.0.total_cmp(&y.0));
            let Some((distance, i)) = nearest else { continue };
            all[i].deviation = all[i].deviation.max(distance);
            if let Some(offset) = offsets.get(p as usize).copied().flatten() {
                sums[i] = (sums[i].0 + offset, sums[i].1 + 1);
            }
        }
    }
    for (along, (sum, count)) in all.iter_mut().zip(sums) {
        along.offset = (count > 0).then(|| sum / f64::from(count));
    }
    all
}
