//! Several beams that meet: the thickest goes through, the others stop at its side.

use nalgebra::{Unit, UnitVector3, Vector3};

use super::{End, EndCut};
use crate::saddle::Saddle;

/// Beams that go on within this angle of the through member are parts of it: 10°. The through
/// chord of a truss bends by less at its nodes; the flattest brace leaves it by 15°.
const STRAIGHT_ON: f64 = 10.0 * std::f64::consts::PI / 180.0;

/// The cuts of all ends at a node.
pub(super) fn cuts(at: &[End]) -> Vec<Option<EndCut>> {
    let Some(through) = through_member(at) else { return Vec::new() };
    let goes_on = |end: &End| {
        let between = end.away.angle(&through.away);
        between.min(std::f64::consts::PI - between) < STRAIGHT_ON
    };
    let is_as_thick = |end: &End| end.bar.zip(through.bar).is_some_and(|(a, b)| a >= AS_WIDE * b);
    let parts = at.iter().filter(|end| goes_on(end) && is_as_thick(end)).count();
    let is_through = !through.ends() || parts > 1;
    at.iter()
        .map(|end| {
            if goes_on(end) {
                return None;
            }
            let saddle = if is_through { saddle(end, through) } else { None };
            saddle.or_else(|| against(end, through))
        })
        .collect()
}

/// Part of the radius of the through member from which on what goes on beyond the node is part of
/// it: that of [`AS_THICK`].
const AS_WIDE: f64 = 0.97;

/// The end along the side of a round through member, for a round bar or tube that is no thicker.
fn saddle(end: &End, through: &End) -> Option<EndCut> {
    let radius = side(end.bar?, through.bar?)?;
    let normal = Unit::try_new(*end.away - *through.away * through.away.dot(&end.away), 1e-6)?;
    let setback = radius / normal.dot(&end.away);
    let [x, y, z] = [end.axes.y, end.axes.z, end.axes.x].map(|a| a.dot(&through.away));
    let axis = UnitVector3::new_normalize(Vector3::new(x, y, z));
    let saddle = Saddle { axis, radius, above: end.side == Some(1) };
    let plane = EndCut::in_plane(setback, normal, &end.away);
    Some(EndCut { normal: None, saddle: Some(saddle), ..plane })
}

/// The radius of the side that a bar is cut to; `None` where it is thicker than its member.
///
/// Members of equal size are measured to a percent or so. A bar that is as thick as its member within
/// [`AS_WIDE`] is cut as if it were so exactly: as a fish mouth, which is what one cuts, and the same
/// for all bars of that size. It is off the member by the difference of the radii.
fn side(own: f64, member: f64) -> Option<f64> {
    let is_equal = own.min(member) >= AS_WIDE * own.max(member);
    if is_equal { Some(own) } else { (own < member).then_some(member) }
}

/// Part of the largest area from which on a beam is as thick: areas of equal beams are measured to
/// 2 % or so, and profiles that are sold differ by 10 %.
const AS_THICK: f64 = 0.95;

/// What passes the node, and failing that the thickest beam; of several as thick, the one the
/// others lie most opposite to. It is the same at mirrored nodes.
fn through_member(at: &[End]) -> Option<&End> {
    let has_passing = at.iter().any(|end| !end.ends());
    let may_be = |end: &&End| !has_passing || !end.ends();
    let thickest = at.iter().filter(may_be).map(|end| end.area).fold(0.0, f64::max);
    let all: Vector3<f64> = at.iter().map(|end| end.away.into_inner()).sum();
    let along = |end: &&End| end.away.dot(&all);
    at.iter()
        .filter(may_be)
        .filter(|end| end.area >= AS_THICK * thickest)
        .min_by(|a, b| along(a).total_cmp(&along(b)))
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
