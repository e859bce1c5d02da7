//! Places the skeletal points of a run: evenly between its hubs, each on the centroid of its own
//! section (thesis §5.2.5).
//!
//! Next to a joint there is no section of one's own: the plane cuts the other branches as well. How
//! much larger the section is than the trend of the branch says how far it is the branch's own.
//! Where it is not, no point is placed: the branch runs straight to its joint.

use std::f64::consts::PI;

use nalgebra::{Point3, Unit, Vector3};

use super::curve::{Polyline, SWOLLEN, base_curve, is_bend, spaced};
use super::draft::{Hub, HubKind, Run};
use super::section_near::{Stations, section_round};
use super::stocky::middle_of;
use super::trend::Trend;
use crate::mesh::Surface;
use crate::mesh::contour::{Contour, Extent, Plane};
use crate::observer::Observer;
use crate::skeleton::error::SkeletonError;
use crate::skeleton::inside::middle_of_wall;
use crate::skeleton::watch::Watch;

/// A placed point of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) position: Point3<f64>,
    pub(crate) radius: f64,
}

/// Rounds of cutting and moving. The first brings points of the march from its lagging planes to
/// planes across the curve, the others settle; after four nothing moves by a hundredth of a radius.
const ROUNDS: usize = 4;

/// How much larger than the trend of its branch a section may be.
///
/// Up to `follow` a point moves to the centroid of its section, from `leave` on it does not;
/// between, in part, so that no step of the area makes a step of the skeleton.
#[derive(Clone, Copy)]
struct Growth {
    follow: f64,
    leave: f64,
}

/// Next to a joint a larger section holds parts of other branches, whose weight would draw the
/// point off the axis: a fillet adds a tenth, a brace of the same thickness doubles it. Followed
/// further (2.5), the axes of a truss turn by 0.2°; left earlier (1.4), points at the wide joints of
/// monster_lite lie half as well in the middle.
const AT_JOINT: Growth = Growth { follow: SWOLLEN, leave: 2.0 };

/// Where joints lie in the middle of the material, the whole section is taken for the branch's own
/// until it is another branch's as well.
const AT_CENTRED_JOINT: Growth = Growth { follow: 2.0, leave: 2.0 };

/// Next to an interface section or a free end the whole section is the branch's own, flared or not.
const AT_END: Growth = Growth { follow: 2.5, leave: 3.5 };

/// A point is placed where the section is the branch's own by at least this share.
const OWN: f64 = 0.5;

/// The points of a run on the centroids of their sections, its hubs included.
pub(crate) struct Moved {
    pub(crate) points: Vec<Point3<f64>>,
    radii: Vec<f64>,
    /// How far each section is the branch's own, 0..1.
    shares: Vec<f64>,
    /// The way before any point was moved.
    curve: Vec<Point3<f64>>,
}

/// A section that was cut across a run, kept for planes that hardly differ.
struct Cut {
    plane: Plane,
    /// The section of the branch; `None` where there is none of its own.
    section: Option<Extent>,
}

/// What is known of a run whose hubs move a little.
#[derive(Default)]
pub(crate) struct Known {
    /// Sections cut last, by point.
    cuts: Vec<Option<Cut>>,
    /// From which stations the straight way to the next stays inside.
    straight: Vec<bool>,
    /// Whether just the points next to the hubs are wanted.
    ends_only: bool,
    /// The contour cut last.
    contour: Contour,
}

impl Known {
    /// Nothing yet of a run of which just the points next to the hubs are wanted.
    pub(crate) fn of_ends() -> Self {
        Self { ends_only: true, ..Self::default() }
    }
}

/// A plane hardly differs while it has moved by less than this part of the radius and turned by less
/// than this sine. The centroid is carried along the normal: that of a branch which leans by a fifth,
/// as lumpy ones do, is off by a fifth of that. At 0.005 a point of the cantilever of 1.4 mm, whose
/// plane slices a joint, comes out a twentieth worse.
const HARDLY: f64 = 0.001;

/// Points about `step` apart between two hubs, moved to the centroids of their sections.
pub(crate) fn moved(
    surface: &Surface,
    run: &Run,
    trend: &Trend,
    hubs: [&Hub; 2],
    step: f64,
    Known { cuts, straight, ends_only, contour }: &mut Known,
    watch: &mut Watch<'_, impl Observer>,
) -> Result<Moved, SkeletonError> {
    let curve = base_curve(surface, run, trend, hubs, straight, watch)?;
    let mut points = spaced(&curve, step, least_between(run) + 1);
    let last = points.len() - 1;
    if cuts.len() != points.len() {
        cuts.clear();
        cuts.resize_with(points.len(), || None);
    }
    let mut radii: Vec<f64> = (0..=last).map(|i| trend.at(i as f64 / last as f64)).collect();
    let mut shares = vec![0.0; last + 1];
    let stations = Stations::of(run);
    for left in (0..ROUNDS).rev() {
        // The same number of points at equal distances.
        let old = Polyline::through(&points).spaced(last);
        for i in 1..last {
            watch.keep_on()?;
            // In every round that is left a point moves those beside it, and is spaced anew.
            if *ends_only && i.min(last - i) > 1 + 2 * left {
                points[i] = old[i];
                continue;
            }
            let Some(normal) = Unit::try_new(old[i + 1] - old[i - 1], 0.0) else { continue };
            let part = i as f64 / last as f64;
            let wanted = trend.at(part);
            let growth = Growth::beside(hubs[usize::from(part > 0.5)]);
            let plane = Plane::new(old[i], normal);
            let cut = cuts[i].take().filter(|cut| cut.hardly_differs(&plane, wanted));
            let cut = cut.unwrap_or_else(|| Cut {
                plane,
                section: section_round(surface, &stations, &plane, part, contour),
            });
            let own = cut.carried_to(&plane).filter(|s| (s.centroid - old[i]).norm() <= s.radius());
            cuts[i] = Some(cut);
            shares[i] = own.map_or(0.0, |s| growth.share(s.area / (PI * wanted * wanted)));
            points[i] = old[i];
            if let Some(section) = own {
                points[i] += (section.centroid - old[i]) * shares[i];
                radii[i] = wanted + (section.radius() - wanted) * shares[i];
            }
        }
    }
    Ok(Moved { points, radii, shares, curve })
}

impl Cut {
    fn hardly_differs(&self, plane: &Plane, radius: f64) -> bool {
        (plane.point - self.plane.point).norm() < HARDLY * radius
            && plane.normal.cross(&self.plane.normal).norm() < HARDLY
    }

    /// The section as a plane sees it that hardly differs.
    fn carried_to(&self, plane: &Plane) -> Option<Extent> {
        let along = |s: Extent| *plane.normal * -plane.height(&s.centroid);
        self.section.map(|s| Extent { centroid: s.centroid + along(s), ..s })
    }
}

/// Points between two hubs, both left out, about `step` apart.
pub(crate) fn samples(
    surface: &Surface,
    run: &Run,
    hubs: [&Hub; 2],
    step: f64,
    watch: &mut Watch<'_, impl Observer>,
) -> Result<Vec<Sample>, SkeletonError> {
    let Some(trend) = Trend::of(run) else {
        return Ok(middle_of(surface, hubs).into_iter().collect());
    };
    let Moved { points, radii, mut shares, curve } =
        moved(surface, run, &trend, hubs, step, &mut Known::default(), watch)?;
    let last = points.len() - 1;
    let strays = [0, 1].map(|end| {
        let beside = |i: usize| {
            let reach = BESIDE * trend.at(i as f64 / last as f64);
            is_bend(hubs[end].kind) && (points[i] - hubs[end].position).norm() < reach
        };
        strays(&shares, end, beside)
    });
    strays.into_iter().flatten().for_each(|i| shares[i] = 0.0);
    for i in 1..last {
        let Some(along) = Unit::try_new(points[i + 1] - points[i - 1], 0.0) else { continue };
        let radius = trend.at(i as f64 / last as f64);
        if hubs.iter().any(|hub| leaves_through(surface, hub, &points[i], along, radius)) {
            shares[i] = 0.0;
        }
    }
    let curve = Polyline::through(&curve);
    let at = |i: usize| {
        let position = kept_inside(surface, points[i], || curve.point(i, last));
        Sample { position, radius: radii[i] }
    };
    Ok(placed(&shares, least_between(run)).map(at).collect())
}

/// Within so many radii of a joint a point is placed only next to another one. Legs that part at a
/// few degrees begin as one section hardly larger than their own, between them.
const BESIDE: f64 = 2.0;

/// Next to a slanted interface section the plane across the branch runs out of the design part beside
/// it. Nearer than so many radii to its middle, what lies there is taken for the branch's own by
/// eq. (2.2): a section seen within the box of the widest interface section reaches 1.6 radii on
/// y_form. No point is needed there: the branch runs straight to its end.
const BESIDE_SLANT: f64 = 2.0;

/// Whether the plane across the branch at a place meets that of the interface section within reach
/// of its middle.
fn leaves_through(
    surface: &Surface,
    hub: &Hub,
    place: &Point3<f64>,
    along: Unit<Vector3<f64>>,
    radius: f64,
) -> bool {
    let HubKind::Interface(section) = hub.kind else { return false };
    let slant = along.cross(&surface.interfaces[section].normal).norm();
    (place - hub.position).dot(&along).abs() < slant * BESIDE_SLANT * radius
}

/// Points beside the joint at one end, up to the last one without a placed neighbour on the far
/// side.
fn strays(shares: &[f64], end: usize, beside: impl Fn(usize) -> bool) -> Vec<usize> {
    let last = shares.len() - 1;
    let from_end = |k: usize| if end == 0 { k } else { last - k };
    let count = (1..last).take_while(|&k| beside(from_end(k))).count();
    let stray = (1..=count).rev().find(|&k| k + 1 < last && shares[from_end(k + 1)] < OWN);
    (1..=stray.unwrap_or(0)).map(from_end).collect()
}

/// Points a run has between its hubs at least: one, so that two branches between the same joints stay
/// apart, or two, so that a branch that ends where it begins is a loop.
fn least_between(run: &Run) -> usize {
    1 + usize::from(run.is_loop())
}

/// The points whose section is the branch's own, and the `least` nearest to that.
fn placed(shares: &[f64], least: usize) -> impl Iterator<Item = usize> {
    let last = shares.len() - 1;
    let mut best: Vec<usize> = (1..last).collect();
    // Of equals that farthest from the joints.
    let off = |i: usize| (2 * i).abs_diff(last);
    best.sort_by(|&a, &b| shares[b].total_cmp(&shares[a]).then(off(a).cmp(&off(b))));
    let mut is_placed: Vec<bool> = shares.iter().map(|s| *s >= OWN).collect();
    best.iter().take(least).for_each(|&i| is_placed[i] = true);
    (1..last).filter(move |&i| is_placed[i])
}

impl Growth {
    /// What holds next to a hub.
    fn beside(hub: &Hub) -> Self {
        match hub.kind {
            HubKind::Joint if hub.is_centred => AT_CENTRED_JOINT,
            HubKind::Joint | HubKind::Knee => AT_JOINT,
            HubKind::Interface(_) | HubKind::Tip => AT_END,
        }
    }

    /// How far towards the centroid a point goes whose section has `growth` times the trend's area.
    fn share(self, growth: f64) -> f64 {
        if growth <= self.follow {
            return 1.0;
        }
        ((self.leave - growth) / (self.leave - self.follow)).clamp(0.0, 1.0)
    }
}

/// The point if it is inside, else the place on the curve, else the middle of the nearest wall.
fn kept_inside(
    surface: &Surface,
    point: Point3<f64>,
    on_curve: impl FnOnce() -> Point3<f64>,
) -> Point3<f64> {
    if surface.tree.contains(&point) {
        return point;
    }
    let on_curve = on_curve();
    if surface.tree.contains(&on_curve) {
        return on_curve;
    }
    middle_of_wall(&surface.mesh, &surface.tree, &point).unwrap_or(point)
}
