//! Beams that are one piece: alike in section, length and cuts, however they lie.
//!
//! ```text
//!    ╱▔▔▔▔▔▔▔▔▔▏   turned end for end:   ▕▔▔▔▔▔▔▔▔▔╱   one piece of a round bar, two of an angle
//!   ╱▁▁▁▁▁▁▁▁▁▁▏                         ▕▁▁▁▁▁▁▁▁▁▁╲
//! ```
//!
//! A mesh is never quite symmetric, so that equal members of a symmetric part come out a little
//! different. Beams are one kind where no corner of one lies farther from that of another than
//! [`SAME_PIECE`], unless they fall into two kinds with a gap between them. The first beam of a kind
//! is its *model*; the others are made as it is. A model is laid into a beam by a turn about its
//! axis, and end for end where the section allows it: these are all motions that keep a beam on its
//! axis. A piece and its mirror image are two pieces where no such motion brings one onto the other.

use nalgebra::{Isometry3, Point2, Rotation2, Translation3, UnitQuaternion, Vector2, Vector3};

use super::cut::{rise, slopes};
use super::{CutBeam, PER_QUARTER};
use crate::cluster;
use crate::frame::{Beam, Frame};
use crate::section::outline::{Outline, Region};
use crate::section::properties::Contours;
use crate::segment::distance;

/// Farthest a corner of a beam may lie from that of its model, in section radii. Equal members of
/// parts meshed three elements to a radius differ by half of it at oblique cuts; the gap it may
/// leave at a joint of a bar of 60 mm, 3 mm, is the widest root gap a weld is made with.
pub const SAME_PIECE: f64 = 0.1;

/// Beams of one kind follow each other by less than this, in section radii: half of
/// [`SAME_PIECE`]. Members that were drawn to differ by more, with nothing between, stay apart
/// however near their lengths and angles are.
const NEXT_PIECE: f64 = 0.05;

/// Beams nearer than this, in section radii, are compared with the others as one: what a saw can do.
const NO_OTHER: f64 = 0.01;

/// Farthest two outlines may lie from each other, in section radii: a tenth of [`SAME_PIECE`],
/// since they run all along the beam. Outlines compared as polygons are off by a tenth of it.
const SAME_OUTLINE: f64 = 0.01;

/// The piece a beam is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alike {
    /// Number of the kind; kinds are numbered by their first beam.
    pub kind: usize,
    /// The beam the piece is made after: the first of its kind.
    pub model: usize,
    /// From the solid of the model to that of the beam, both in their own coordinates: the first
    /// two across (y and z of the beam turned by its roll), the third along, from the first node.
    pub motion: Isometry3<f64>,
    /// Farthest a corner of the beam lies from that of the model laid into it, mm.
    pub off: f64,
}

/// Finds the beams that are one piece.
pub(super) fn alike(frame: &Frame, cuts: &[CutBeam]) -> Vec<Alike> {
    let all: Vec<Member<'_>> =
        frame.beams.iter().zip(cuts).map(|(beam, cut)| Member::new(beam, cut)).collect();
    let group_of = groups(&all);
    let mut models: Vec<usize> = Vec::new();
    let mut found: Vec<Alike> = Vec::with_capacity(all.len());
    for (i, own) in all.iter().enumerate() {
        let of_group = models.iter().enumerate().filter(|(_, m)| group_of[**m] == group_of[i]);
        let fitting = of_group
            .filter_map(|(kind, &model)| {
                // A beam that stands for another is up to so much nearer to the rest.
                let laid = all[model].laid_into(own, SAME_PIECE + 2.0 * NO_OTHER)?;
                Some(Alike { kind, model, motion: laid.motion, off: laid.off * own.radius })
            })
            .next();
        found.push(fitting.unwrap_or_else(|| {
            models.push(i);
            Alike { kind: models.len() - 1, model: i, motion: own.centring(), off: 0.0 }
        }));
    }
    found
}

/// Number of the group of each member.
///
/// Of members that hardly differ only the first is compared with the rest: a frame has few kinds.
fn groups(all: &[Member<'_>]) -> Vec<usize> {
    let mut leaders: Vec<usize> = Vec::new();
    let mut leader_of = Vec::with_capacity(all.len());
    for (i, own) in all.iter().enumerate() {
        let is_other = |&&l: &&usize| all[l].laid_into(own, NO_OTHER).is_some();
        let leader = leaders.iter().position(|l| is_other(&l)).unwrap_or_else(|| {
            leaders.push(i);
            leaders.len() - 1
        });
        leader_of.push(leader);
    }
    let distance = |a: usize, b: usize| {
        all[leaders[a]].laid_into(&all[leaders[b]], SAME_PIECE).map(|laid| laid.off)
    };
    let groups = cluster::groups(leaders.len(), distance, SAME_PIECE, NEXT_PIECE);
    let mut group_of_leader = vec![0; leaders.len()];
    for (g, group) in groups.iter().enumerate() {
        group.iter().for_each(|&l| group_of_leader[l] = g);
    }
    leader_of.into_iter().map(|l| group_of_leader[l]).collect()
}

/// A beam as it is compared.
struct Member<'a> {
    beam: &'a Beam,
    cut: &'a CutBeam,
    /// Rises of the cuts at both ends along the axis, for each mm across.
    slopes: [Vector2<f64>; 2],
    /// Reach of the section from the axis, mm.
    radius: f64,
}

/// A turn about the axis, after half a turn about the first direction across if `swapped`.
#[derive(Clone, Copy)]
struct Turn {
    angle: f64,
    swapped: bool,
}

/// A piece laid into a beam.
struct Laid {
    motion: Isometry3<f64>,
    /// Farthest a corner is off, in section radii.
    off: f64,
}

impl Turn {
    fn across(&self, v: &Vector2<f64>) -> Vector2<f64> {
        let v = if self.swapped { Vector2::new(v.x, -v.y) } else { *v };
        Rotation2::new(self.angle) * v
    }
}

impl<'a> Member<'a> {
    fn new(beam: &'a Beam, cut: &'a CutBeam) -> Self {
        let slopes = [0, 1].map(|e| Vector2::from(slopes(beam, &cut.ends[e])));
        Self { beam, cut, slopes, radius: beam.shape.properties.reach }
    }

    /// Where the middle of the solid is to lie, from the first node, mm.
    fn middle(&self) -> f64 {
        let [start, end] = [0, 1].map(|e| self.cut.ends[e].setback);
        0.5 * (start + self.beam.length - end)
    }

    /// Where the middle of the solid lies that is built from the first node on, mm.
    fn built_middle(&self) -> f64 {
        self.cut.ends[0].setback + 0.5 * self.cut.axis_length
    }

    /// A beam cut to the length of its like is off by as much at both ends.
    fn centring(&self) -> Isometry3<f64> {
        Isometry3::translation(0.0, 0.0, self.middle() - self.built_middle())
    }

    /// Lays this piece into a beam, if no corner is off by more than `most` section radii there.
    fn laid_into(&self, beam: &Member<'_>, most: f64) -> Option<Laid> {
        let longer = 0.5 * (self.cut.axis_length - beam.cut.axis_length).abs() / self.radius;
        if longer > most || !self.is_bar_of(beam) {
            return None;
        }
        let mut turns: Vec<(f64, Turn)> = self
            .turns(beam)
            .into_iter()
            .map(|turn| (longer + self.cuts_off(beam, turn), turn))
            .filter(|(off, _)| *off <= most)
            .collect();
        // The first of equals.
        turns.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (off, turn) = turns.into_iter().find(|(_, turn)| self.has_outlines_of(beam, *turn))?;
        let own = self.built_middle();
        let swap = if turn.swapped {
            UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
        } else {
            UnitQuaternion::identity()
        };
        let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn.angle) * swap;
        let along = beam.middle() - if turn.swapped { -own } else { own };
        let motion = Isometry3::from_parts(Translation3::new(0.0, 0.0, along), turned);
        Some(Laid { motion, off })
    }

    fn is_bar_of(&self, beam: &Member<'_>) -> bool {
        self.beam.shape.profile == beam.beam.shape.profile
            && self.beam.shape.stations.len() == beam.beam.shape.stations.len()
    }

    /// The turns that may bring the section onto itself.
    fn turns(&self, beam: &Member<'_>) -> Vec<Turn> {
        let quarters = (0..4).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2);
        [false, true]
            .into_iter()
            .flat_map(|swapped| {
                if self.is_round() {
                    let saddles = self.turns_of_saddles(beam, swapped);
                    let angles = std::iter::once(self.turn_of_cuts(beam, swapped)).chain(saddles);
                    angles.map(|angle| Turn { angle, swapped }).collect::<Vec<_>>()
                } else {
                    quarters.clone().map(|angle| Turn { angle, swapped }).collect()
                }
            })
            .collect()
    }

    /// Whether every outline is a circle about the axis.
    fn is_round(&self) -> bool {
        let about_axis = |o: &Outline| matches!(o, Outline::Circle { centre, .. } if *centre == Point2::origin());
        self.beam
            .shape
            .stations
            .iter()
            .all(|s| std::iter::once(&s.region.outer).chain(&s.region.holes).all(about_axis))
    }

    /// The cuts of the piece after a turn, from the first end of the beam to the second.
    fn turned_slopes(&self, turn: Turn) -> [Vector2<f64>; 2] {
        let [start, end] = self.slopes;
        if turn.swapped {
            [-turn.across(&end), -turn.across(&start)]
        } else {
            [turn.across(&start), turn.across(&end)]
        }
    }

    /// The turn about the axis that brings both cuts nearest to those of the beam: the least sum
    /// of squares has a closed form in the plane.
    fn turn_of_cuts(&self, beam: &Member<'_>, swapped: bool) -> f64 {
        let own = self.turned_slopes(Turn { angle: 0.0, swapped });
        let (mut sin, mut cos) = (0.0, 0.0);
        for (a, b) in own.iter().zip(&beam.slopes) {
            sin += a.perp(b);
            cos += a.dot(b);
        }
        f64::atan2(sin, cos)
    }

    /// The turns about the axis that bring the members of saddles onto those of the beam.
    fn turns_of_saddles(&self, beam: &Member<'_>, swapped: bool) -> Vec<f64> {
        let swap = Turn { angle: 0.0, swapped };
        let pairs = (0..2).filter_map(|end| {
            let own = self.cut.ends[if swapped { 1 - end } else { end }].saddle?;
            Some((swap.across(&own.along()), beam.cut.ends[end].saddle?.along()))
        });
        pairs
            .map(|(a, b)| a.perp(&b).atan2(a.dot(&b)))
            .flat_map(|angle| [angle, angle + std::f64::consts::PI])
            .collect()
    }

    /// How far the cuts are off at the corners after a turn, in section radii.
    fn cuts_off(&self, beam: &Member<'_>, turn: Turn) -> f64 {
        let has_saddle = |m: &Member<'_>| m.cut.ends.iter().any(|e| e.saddle.is_some());
        if has_saddle(self) || has_saddle(beam) {
            return self.saddles_off(beam, turn);
        }
        let own = self.turned_slopes(turn);
        own.iter().zip(&beam.slopes).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    }

    /// [`cuts_off`](Self::cuts_off) at places all around.
    fn saddles_off(&self, beam: &Member<'_>, turn: Turn) -> f64 {
        let places = (0..4 * PER_QUARTER).map(|i| {
            let angle = i as f64 * std::f64::consts::FRAC_PI_2 / PER_QUARTER as f64;
            Vector2::new(angle.cos(), angle.sin()) * self.radius
        });
        let off = |place: Vector2<f64>, end: usize| {
            let there = rise(beam.beam, &beam.cut.ends[end], &(turn.across(&place)).into());
            let own = if turn.swapped { 1 - end } else { end };
            let here = rise(self.beam, &self.cut.ends[own], &place.into());
            (if turn.swapped { -here } else { here } - there).abs()
        };
        places.map(|p| off(p, 0).max(off(p, 1))).fold(0.0, f64::max) / self.radius
    }

    fn has_outlines_of(&self, beam: &Member<'_>, turn: Turn) -> bool {
        let (own, others) = (&self.beam.shape.stations, &beam.beam.shape.stations);
        let most = SAME_OUTLINE * self.radius;
        let last = own.len() - 1;
        others.iter().enumerate().all(|(i, there)| {
            let (here, at) = if turn.swapped {
                (&own[last - i], 1.0 - own[last - i].at)
            } else {
                (&own[i], own[i].at)
            };
            (at - there.at).abs() * beam.cut.axis_length <= SAME_PIECE * self.radius
                && is_near(&here.region, &there.region, turn, most)
        })
    }
}

/// Whether a turned region lies on another within `most`, mm.
fn is_near(own: &Region, other: &Region, turn: Turn, most: f64) -> bool {
    let outlines = |r: &Region| -> Vec<Vec<Point2<f64>>> {
        Contours::of_region(r, PER_QUARTER).polygons().cloned().collect()
    };
    if own == other && !turn.swapped && turn.angle == 0.0 {
        return true;
    }
    if let (Outline::Circle { radius: a, .. }, Outline::Circle { radius: b, .. }) =
        (&own.outer, &other.outer)
        && own.holes.is_empty()
        && other.holes.is_empty()
    {
        return (a - b).abs() <= most;
    }
    let (own, other) = (outlines(own), outlines(other));
    own.len() == other.len()
        && own.iter().zip(&other).all(|(a, b)| {
            let turned: Vec<Point2<f64>> =
                a.iter().map(|p| Point2::from(turn.across(&p.coords))).collect();
            lies_on(&turned, b, most) && lies_on(b, &turned, most)
        })
}

/// Whether every corner of a polygon lies on another within `most`, mm.
fn lies_on(corners: &[Point2<f64>], polygon: &[Point2<f64>], most: f64) -> bool {
    let sides = || polygon.iter().zip(polygon.iter().cycle().skip(1));
    corners.iter().all(|p| sides().any(|(a, b)| distance(p, a, b) <= most))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use nalgebra::{Point3, Unit};

    use super::*;
    use crate::frame::shape::BeamShape;
    use crate::frame::{BeamAxes, BeamSection, Node, NodeId, NodeKind};
    use crate::joint::EndCut;
    use crate::saddle::Saddle;
    use crate::section::{Profile, Shape};

    /// A beam of 100 mm or so along z, its section axes those of the model, and its cuts by their
    /// rises across.
    fn beam(shape: &Shape, length: f64, rises: [[f64; 2]; 2]) -> (Beam, CutBeam) {
        let profile = Profile::new(shape.clone()).unwrap();
        let properties = profile.properties().unwrap();
        let [x, y, z] = [Vector3::z(), Vector3::x(), Vector3::y()].map(Unit::new_unchecked);
        let beam = Beam {
            ends: [NodeId(0), NodeId(1)],
            passes: Vec::new(),
            branch: 0,
            axes: BeamAxes { x, y, z },
            length,
            cut_length: length,
            section: BeamSection::default(),
            measured: None,
            assumed_area: properties.area,
            shape: BeamShape::assumed(profile, properties),
        };
        let cut = |[a, b]: [f64; 2]| {
            EndCut::in_plane(
                3.0,
                Unit::new_normalize(Vector3::new(-a, -b, 1.0)),
                &Vector3::z_axis(),
            )
        };
        let cut = CutBeam::new(&beam, rises.map(cut)).unwrap();
        (beam, cut)
    }

    fn found(beams: Vec<(Beam, CutBeam)>) -> Vec<Alike> {
        let at = |z: f64| Node { position: Point3::new(0.0, 0.0, z), kind: NodeKind::End };
        let (beams, cuts): (Vec<Beam>, Vec<CutBeam>) = beams.into_iter().unzip();
        let frame = Frame { nodes: vec![at(0.0), at(100.0)], beams };
        let all = alike(&frame, &cuts);
        for (own, Alike { model, motion, .. }) in all.iter().enumerate() {
            lies_in_place(&frame, &cuts, *model, own, motion);
        }
        all
    }

    /// Every corner of the placed model lies on the outline and at the cut of the beam.
    fn lies_in_place(
        frame: &Frame,
        cuts: &[CutBeam],
        model: usize,
        own: usize,
        motion: &Isometry3<f64>,
    ) {
        let member = |i: usize| Member::new(&frame.beams[i], &cuts[i]);
        let (model, own) = (member(model), member(own));
        let heights = |m: &Member<'_>, p: Vector2<f64>| {
            let start = m.cut.ends[0].setback;
            [start + m.slopes[0].dot(&p), start + m.cut.axis_length + m.slopes[1].dot(&p)]
        };
        let corners = |m: &Member<'_>| {
            Contours::of_region(&m.beam.shape.stations[0].region, PER_QUARTER).outer
        };
        for corner in corners(&model) {
            for z in heights(&model, corner.coords) {
                let at = motion * Point3::new(corner.x, corner.y, z);
                let across = Point2::new(at.x, at.y);
                assert!(lies_on(&[across], &corners(&own), SAME_OUTLINE * own.radius));
                let off = heights(&own, across.coords).map(|z| (z - at.z).abs());
                assert!(off[0].min(off[1]) <= SAME_PIECE * own.radius * 1.001, "{off:?}");
            }
        }
    }

    fn kinds(beams: Vec<(Beam, CutBeam)>) -> Vec<usize> {
        found(beams).iter().map(|a| a.kind).collect()
    }

    const ROUND: Shape = Shape::Round { d: 20.0 };
    const FLAT: Shape = Shape::Rectangle { b: 10.0, h: 20.0 };

    #[test]
    fn round_bars_are_one_piece_however_they_are_turned() {
        let turned = |angle: f64| [angle.cos(), angle.sin()].map(|x| 0.7 * x);
        let one_cut = (0..7).map(|k| beam(&ROUND, 100.0, [turned(f64::from(k)), [0.0; 2]]));
        let swapped = (0..7).map(|k| beam(&ROUND, 100.0, [[0.0; 2], turned(f64::from(k))]));
        assert_eq!(kinds(one_cut.chain(swapped).collect()), [0; 14]);
    }

    #[test]
    fn a_twisted_piece_and_its_mirror_image_are_two() {
        let twisted = |twist: f64, at: f64| {
            let rise = |angle: f64| [angle.cos(), angle.sin()].map(|x| 0.7 * x);
            beam(&ROUND, 100.0, [rise(at), rise(at + twist)])
        };
        let beams =
            vec![twisted(1.0, 0.0), twisted(-1.0, 0.4), twisted(1.0, 2.0), twisted(PI, 0.0)];
        let twists: Vec<f64> = beams.iter().map(|b| b.1.twist).collect();
        assert!((twists[0] - 1.0).abs() < 1e-12 && (twists[1] + 1.0).abs() < 1e-12);
        assert!((twists[3] - PI).abs() < 1e-12);
        assert_eq!(kinds(beams), [0, 1, 0, 2]);
    }

    #[test]
    fn a_twisted_piece_is_itself_end_for_end() {
        let (a, b) = ([0.7, 0.0], [0.1, 0.5]);
        let beams = vec![
            beam(&ROUND, 100.0, [a, b]),
            // Half a turn about y: what was the second end comes first.
            beam(&ROUND, 100.0, [[-b[0], b[1]], [-a[0], a[1]]]),
        ];
        assert_eq!(kinds(beams), [0, 0]);
    }

    #[test]
    fn cuts_of_flats_lean_over_one_pair_of_sides() {
        let beams = vec![
            beam(&FLAT, 100.0, [[0.7, 0.0], [0.0; 2]]),
            beam(&FLAT, 100.0, [[-0.7, 0.0], [0.0; 2]]),
            beam(&FLAT, 100.0, [[0.0; 2], [-0.7, 0.0]]),
            beam(&FLAT, 100.0, [[0.0, 0.7], [0.0; 2]]),
        ];
        assert_eq!(kinds(beams), [0, 0, 0, 1]);
    }

    #[test]
    fn mirror_images_of_a_flat_lean_to_other_sides() {
        let beams = vec![
            beam(&FLAT, 100.0, [[0.5, 0.3], [0.0; 2]]),
            beam(&FLAT, 100.0, [[0.5, -0.3], [0.0; 2]]),
            beam(&FLAT, 100.0, [[0.0; 2], [-0.5, 0.3]]),
        ];
        let leans: Vec<[f64; 2]> = beams.iter().map(|b| b.1.leans).collect();
        let lean = f64::atan2(0.3, 0.5);
        assert!((leans[0][0] - lean).abs() < 1e-12 && (leans[1][0] + lean).abs() < 1e-12);
        assert!((leans[2][1] - lean).abs() < 1e-12);
        assert_eq!(kinds(beams), [0, 1, 0]);
    }

    #[test]
    fn an_angle_is_itself_end_for_end_only_where_its_legs_are_equal() {
        let angle = |h: f64| Shape::L { b: 40.0, h, t: 4.0, r_1: 0.0, r_2: 0.0 };
        let pair = |h: f64| {
            let (shape, square) = (angle(h), [[0.0; 2]; 2]);
            let cut = [[0.5, 0.5], [0.0; 2]];
            let other = [[0.0; 2], [-0.5, -0.5]];
            vec![beam(&shape, 100.0, square), beam(&shape, 100.0, cut), beam(&shape, 100.0, other)]
        };
        assert_eq!(kinds(pair(60.0)), [0, 1, 2]);
        assert_eq!(kinds(pair(40.0)), [0, 1, 1]);
    }

    #[test]
    fn small_differences_are_one_piece_and_do_not_add_up() {
        let of_lengths = |shape: &Shape, lengths: &[f64]| {
            found(lengths.iter().map(|&l| beam(shape, l, [[0.0; 2]; 2])).collect())
        };
        for shape in [ROUND, FLAT] {
            // Up to a tenth of the radius at each end: 2 mm of length.
            let lengths = [100.0, 100.9, 101.8, 102.7, 99.6, 104.0];
            let all = of_lengths(&shape, &lengths);
            for (a, length) in all.iter().zip(lengths) {
                assert!((length - lengths[a.model]).abs() <= 2.0, "{length} is as {}", a.model);
            }
            let kinds = all.iter().map(|a| a.kind).max();
            assert!((1..4).contains(&kinds.unwrap()), "{kinds:?}");
        }
    }

    #[test]
    fn a_gap_parts_two_kinds_that_differ_little() {
        let lengths = [100.0, 101.5, 100.1, 101.4];
        for shape in [ROUND, FLAT] {
            let beams = lengths.map(|l| beam(&shape, l, [[0.0; 2]; 2])).to_vec();
            assert_eq!(kinds(beams), [0, 1, 0, 1]);
            let leaning =
                [0.5, 0.57, 0.503, 0.568].map(|g| beam(&shape, 100.0, [[g, 0.0], [0.0; 2]]));
            assert_eq!(kinds(leaning.to_vec()), [0, 1, 0, 1]);
        }
    }

    #[test]
    fn what_is_off_is_told_in_mm() {
        let all =
            found(vec![beam(&ROUND, 100.0, [[0.0; 2]; 2]), beam(&ROUND, 100.5, [[0.0; 2]; 2])]);
        assert_eq!((all[1].kind, all[0].off), (0, 0.0));
        assert!((all[1].off - 0.25).abs() < 1e-9, "{}", all[1].off);
    }

    #[test]
    fn saddles_are_turned_onto_each_other() {
        let coped = |angle: f64, rise: f64, side: usize| {
            let (beam, mut cut) = beam(&ROUND, 100.0, [[0.0; 2]; 2]);
            let axis = Vector3::new(angle.cos(), angle.sin(), if side == 0 { rise } else { -rise });
            let axis = Unit::new_normalize(axis);
            cut.ends[side].saddle = Some(Saddle { axis, radius: 15.0, above: side == 1 });
            (beam, cut)
        };
        let square = vec![coped(0.0, 0.0, 0), coped(1.0, 0.0, 0), coped(2.5, 0.0, 1)];
        assert_eq!(kinds(square), [0, 0, 0]);
        let leaning =
            vec![coped(0.0, 0.5, 0), coped(2.0, 0.5, 0), coped(0.7, -0.5, 1), coped(0.0, 0.0, 0)];
        assert_eq!(kinds(leaning), [0, 0, 0, 1]);
    }

    #[test]
    fn another_profile_is_another_piece() {
        let shapes = [ROUND, FLAT, Shape::Round { d: 20.5 }];
        let beams = shapes.map(|s| beam(&s, 100.0, [[0.0; 2]; 2])).to_vec();
        assert_eq!(kinds(beams), [0, 1, 2]);
    }

    #[test]
    fn a_beam_alone_stays_where_it_is() {
        let one = found(vec![beam(&FLAT, 100.0, [[0.3, 0.1], [0.0; 2]])]);
        assert_eq!(one[0].motion, Isometry3::identity());
        let turned = found(vec![
            beam(&FLAT, 100.0, [[0.3, 0.0], [0.0; 2]]),
            beam(&FLAT, 100.0, [[0.0; 2], [-0.3, 0.0]]),
        ])[1];
        // End for end: z points back.
        assert!((turned.motion * Vector3::z() + Vector3::z()).norm() < 1e-12);
        assert!((turned.motion * Point3::new(0.0, 0.0, 100.0)).z.abs() < FRAC_PI_2 * 1e-9);
    }
}
