//! Beams that are one piece: alike in section, length and cuts, however they lie.
//!
//! ```text
//!    ╱▔▔▔▔▔▔▔▔▔▏   turned end for end:   ▕▔▔▔▔▔▔▔▔▔╱   one piece of a round bar, two of an angle
//!   ╱▁▁▁▁▁▁▁▁▁▁▏                         ▕▁▁▁▁▁▁▁▁▁▁╲
//! ```
//!
//! A mesh is never quite symmetric, so that equal members of a symmetric part come out a little
//! different. The first beam of a kind is its *model*; others that reach no farther from it than
//! [`SAME_PIECE`] at any corner are made as the model is. A model is laid into a beam by a turn
//! about its axis, and end for end where the section allows it: these are all motions that keep a
//! beam on its axis. A piece and its mirror image are two pieces where no such motion brings one
//! onto the other.

use nalgebra::{Isometry3, Point2, Rotation2, Translation3, UnitQuaternion, Vector2, Vector3};

use super::cut::slopes;
use super::{CutBeam, Joints, PER_QUARTER};
use crate::frame::{Beam, Frame};
use crate::section::outline::{Outline, Region};
use crate::section::properties::Contours;
use crate::segment::distance;

/// Farthest a corner of a beam may lie from that of its model, in section radii. Equal members of
/// parts meshed three elements to a radius differ by half of it at oblique cuts; the gap it may
/// leave at a joint of a bar of 60 mm, 3 mm, is the widest root gap a weld is made with.
pub const SAME_PIECE: f64 = 0.1;

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
}

/// Finds the beams that are one piece.
///
/// Every beam is compared with the models before it only, so that no chain of small differences
/// joins what differs much.
pub fn alike(frame: &Frame, joints: &Joints) -> Vec<Alike> {
    let all: Vec<Member<'_>> =
        frame.beams.iter().zip(&joints.beams).map(|(beam, cut)| Member::new(beam, cut)).collect();
    let mut models: Vec<usize> = Vec::new();
    all.iter()
        .enumerate()
        .map(|(i, own)| {
            let fitting = models.iter().enumerate().find_map(|(kind, &model)| {
                all[model].laid_into(own).map(|motion| Alike { kind, model, motion })
            });
            fitting.unwrap_or_else(|| {
                models.push(i);
                Alike { kind: models.len() - 1, model: i, motion: own.centring() }
            })
        })
        .collect()
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

    /// The motion that lays this piece into a beam, if it fits there.
    fn laid_into(&self, beam: &Member<'_>) -> Option<Isometry3<f64>> {
        let longer = 0.5 * (self.cut.axis_length - beam.cut.axis_length).abs() / self.radius;
        let is_same_bar = self.beam.shape.profile == beam.beam.shape.profile
            && self.beam.shape.stations.len() == beam.beam.shape.stations.len();
        if !is_same_bar || longer > SAME_PIECE {
            return None;
        }
        let (_, turn) = self
            .turns(beam)
            .into_iter()
            .map(|turn| (longer + self.cuts_off(beam, turn), turn))
            .filter(|&(off, turn)| off <= SAME_PIECE && self.has_outlines_of(beam, turn))
            // The first of equals.
            .reduce(|a, b| if b.0 < a.0 { b } else { a })?;
        let own = self.built_middle();
        let swap = if turn.swapped {
            UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
        } else {
            UnitQuaternion::identity()
        };
        let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn.angle) * swap;
        let along = beam.middle() - if turn.swapped { -own } else { own };
        Some(Isometry3::from_parts(Translation3::new(0.0, 0.0, along), turned))
    }

    /// The turns that may bring the section onto itself.
    fn turns(&self, beam: &Member<'_>) -> Vec<Turn> {
        let quarters = (0..4).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2);
        [false, true]
            .into_iter()
            .flat_map(|swapped| {
                if self.is_round() {
                    let angle = self.turn_of_cuts(beam, swapped);
                    vec![Turn { angle, swapped }]
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

    /// How far the cuts are off at the corners after a turn, in section radii.
    fn cuts_off(&self, beam: &Member<'_>, turn: Turn) -> f64 {
        let own = self.turned_slopes(turn);
        own.iter().zip(&beam.slopes).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
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
        let joints = Joints { beams: cuts, ..Joints::default() };
        let all = alike(&frame, &joints);
        for (own, Alike { model, motion, .. }) in all.iter().enumerate() {
            lies_in_place(&frame, &joints, *model, own, motion);
        }
        all
    }

    /// Every corner of the placed model lies on the outline and at the cut of the beam.
    fn lies_in_place(
        frame: &Frame,
        joints: &Joints,
        model: usize,
        own: usize,
        motion: &Isometry3<f64>,
    ) {
        let member = |i: usize| Member::new(&frame.beams[i], &joints.beams[i]);
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
        // A tenth of the radius, at each end: 2 mm of length.
        let lengths = [100.0, 101.9, 103.8, 98.1];
        let beams = lengths.map(|l| beam(&ROUND, l, [[0.0; 2]; 2])).to_vec();
        assert_eq!(kinds(beams), [0, 0, 1, 0]);
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
