//! Several beams that meet: the thickest goes through, the others stop at its side.

use nalgebra::{Unit, Vector3};

use super::{End, EndCut};

/// Beams that go on within this angle of the through member are parts of it: 10°. The through
/// chord of a truss bends by less at its nodes; the flattest brace leaves it by 15°.
const STRAIGHT_ON: f64 = 10.0 * std::f64::consts::PI / 180.0;

/// The cuts of all ends at a node.
pub(super) fn cuts(at: &[End]) -> Vec<Option<EndCut>> {
    let Some(through) = through_member(at) else { return Vec::new() };
    let axis = through.away;
    at.iter()
        .map(|end| {
            let between = end.away.angle(&axis);
            let goes_on = between.min(std::f64::consts::PI - between) < STRAIGHT_ON;
            if goes_on { None } else { against(end, through) }
        })
        .collect()
}

/// What passes the node, and failing that the thickest beam.
fn through_member(at: &[End]) -> Option<&End> {
    let rank = |end: &&End| (!end.ends(), end.area);
    let larger = |a: &(bool, f64), b: &(bool, f64)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1));
    // The first of equals, so that the order of beams decides.
    at.iter().rev().max_by(|a, b| larger(&rank(a), &rank(b)))
}

/// The cut of an end in a plane along the side of the through member.
///
/// ```text
///      ╲ end ╲           n: across the through member, towards the end
///  ─────╲─────╲─────     the plane stands at the side of the member; on a round one lower, where
///   through member       the edges of the end touch it
///  ─────────────────
/// ```
fn against(end: &End, through: &End) -> Option<EndCut> {
    let axis = through.away;
    let across: Vector3<f64> = *end.away - *axis * axis.dot(&end.away);
    let normal = Unit::try_new(across, 1e-6)?;
    let side = through.support(&normal);
    let height = if through.is_round {
        let half_width = end.support(&axis.cross(&normal));
        (side * side - half_width * half_width).max(0.0).sqrt()
    } else {
        side
    };
    let setback = height / normal.dot(&end.away);
    Some(EndCut::in_plane(setback, normal, &end.away))
}
