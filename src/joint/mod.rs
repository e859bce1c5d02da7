//! How beams end where they meet: spheres, mitres, ends trimmed against a through member.
//!
//! ```text
//!   none            sphere             mitre              trim
//!  ═════○═════     ════(●)════        ═══════╲           ═════════════   thickest goes through
//!       ║              ║                     ╲║                 ║        others stop at its side
//!       ║              ║                      ║                 ║
//! ```
//!
//! | joint | ends | module |
//! |---|---|---|
//! | [`JointKind::None`] | square at the nodes | – |
//! | [`JointKind::Sphere`] | square, set back so that their corners lie on a ball at the node | `sphere` |
//! | [`JointKind::Mitre`] | where two beams meet, both in the plane that halves their angle | `mitre` |
//! | [`JointKind::Trim`] | the same; where more meet, along the side of the thickest: saddle or plane | `trim` |
//!
//! Ends in an interface section lie in its plane with every joint but `none`. A round bar or tube of
//! constant section that is trimmed against a round member as thick or thicker, which goes on to both
//! sides, ends in a saddle: a piece of the side of the member. Everything else is cut in planes, as by
//! a saw; on a round through member such an end enters the member just so far that its edges touch.
//!
//! Beams that are cut [`Alike`] are one piece: one line of the cut list and one product of the STEP
//! file.
//!
//! A joint that cannot be made (too oblique, or longer than the beam) leaves its ends as they are
//! with a finding.

mod alike;
mod cut;
mod end;
mod mitre;
mod sphere;
mod trim;

use nalgebra::{Point3, Unit};

pub use alike::{Alike, SAME_PIECE};
pub use cut::{CutBeam, EndCut};
use end::{End, Members};
pub use sphere::Ball;

use crate::finding::{Finding, FindingKind};
use crate::frame::{Beam, Frame, NodeId, NodeKind};
use crate::mesh::InterfaceSection;

/// How beams are joined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JointKind {
    /// Beams run from node to node and overlap there.
    #[default]
    None,
    /// A ball at every node where beams meet.
    Sphere,
    /// Mitred where two beams meet.
    Mitre,
    /// Mitred where two beams meet, trimmed against the thickest where more do.
    Trim,
}

/// The ends of all beams, and what is put between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joints {
    /// How the beams are joined.
    pub kind: JointKind,
    /// The beams as they are cut, in the order of the frame.
    pub beams: Vec<CutBeam>,
    /// Which beams are one piece, in the order of the frame.
    pub alike: Vec<Alike>,
    /// Balls at nodes.
    pub balls: Vec<Ball>,
}

/// Largest angle between a cut and a square one: 70°. A band saw goes to 60°, and at 70° the cut
/// is already three times as long as the beam is thick.
const MOST_OBLIQUE: f64 = 70.0 * std::f64::consts::PI / 180.0;

/// Makes the joints of a frame.
///
/// * `interfaces`: planes in which the beams of interface nodes end.
pub fn joints(
    frame: &Frame,
    interfaces: &[InterfaceSection],
    kind: JointKind,
) -> (Joints, Vec<Finding>) {
    let members = Members::new(frame);
    let mut ends = vec![[EndCut::SQUARE; 2]; frame.beams.len()];
    let mut balls = Vec::new();
    let mut findings = Vec::new();
    for (n, at) in members.at_node.iter().enumerate() {
        let node = NodeId::new(n);
        let cuts = match (kind, frame.node(node).kind) {
            (JointKind::None, _) => continue,
            (_, NodeKind::Interface) => {
                let section = frame.node(node).interface.and_then(|i| interfaces.get(i as usize));
                at_interface(section, at)
            }
            (JointKind::Sphere, _) => {
                let Some((ball, cuts)) = sphere::ball(node, at) else { continue };
                balls.push(ball);
                cuts
            }
            (JointKind::Mitre | JointKind::Trim, _)
                if at.len() == 2 && at.iter().all(End::ends) =>
            {
                mitre::cuts(at)
            }
            (JointKind::Mitre, _) => continue,
            (JointKind::Trim, _) => trim::cuts(at),
        };
        for (end, cut) in at.iter().zip(cuts) {
            match (cut, end.side) {
                (Some(cut), Some(side)) if cut.angle <= MOST_OBLIQUE => ends[end.beam][side] = cut,
                (Some(_), Some(_)) => findings.push(too_oblique(frame, node)),
                _ => {}
            }
        }
    }
    let beams: Vec<CutBeam> = frame
        .beams
        .iter()
        .zip(ends)
        .map(|(beam, ends)| {
            CutBeam::new(beam, ends).unwrap_or_else(|| {
                findings.push(too_short(frame, beam));
                CutBeam::square(beam)
            })
        })
        .collect();
    let alike = alike::alike(frame, &beams);
    (Joints { kind, beams, alike, balls }, findings)
}

/// Ends in a plane along that of an interface section.
fn at_interface(section: Option<&InterfaceSection>, at: &[End]) -> Vec<Option<EndCut>> {
    let normal = section.and_then(|i| Unit::try_new(i.normal, 0.0));
    let cut = |end: &End| normal.map(|n| EndCut::in_plane(0.0, n, &end.away));
    at.iter().map(cut).collect()
}

fn too_oblique(frame: &Frame, node: NodeId) -> Finding {
    let place = Some(frame.node(node).position);
    let text = format!(
        "a beam meets its joint at more than {:.0}° from a square cut; its end was left square",
        MOST_OBLIQUE.to_degrees()
    );
    Finding::note(FindingKind::Joint, place, text)
}

fn too_short(frame: &Frame, beam: &Beam) -> Finding {
    let [a, b] = frame.axis(beam);
    let place: Point3<f64> = nalgebra::center(&a, &b);
    let text = format!(
        "a beam of {:.1} mm is too short for the joints at its ends; they were left square",
        beam.length
    );
    Finding::note(FindingKind::Joint, Some(place), text)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

    use nalgebra::{Point2, Vector3};

    use super::*;
    use crate::frame::shape::BeamShape;
    use crate::frame::{BeamAxes, BeamSection, Node};

    /// Round bars of radius `radius` between nodes, none of them at an interface section.
    fn frame(nodes: &[[f64; 3]], bars: &[([u32; 2], f64)]) -> Frame {
        let node = |p: &[f64; 3]| Node {
            position: Point3::from(*p),
            kind: NodeKind::Junction,
            interface: None,
        };
        let nodes: Vec<Node> = nodes.iter().map(node).collect();
        let beams = bars
            .iter()
            .map(|&(ends, radius)| {
                let [a, b] = ends.map(|n| nodes[n as usize].position);
                let area = PI * radius * radius;
                Beam {
                    ends: ends.map(NodeId),
                    passes: Vec::new(),
                    branch: 0,
                    axes: BeamAxes::along(Unit::new_normalize(b - a)),
                    length: (b - a).norm(),
                    cut_length: (b - a).norm(),
                    section: BeamSection::default(),
                    measured: None,
                    assumed_area: area,
                    shape: BeamShape::unmatched(area),
                }
            })
            .collect();
        Frame { nodes, beams }
    }

    fn elbow() -> Frame {
        frame(&[[0.0; 3], [50.0, 0.0, 0.0], [50.0, 40.0, 0.0]], &[([0, 1], 3.0), ([1, 2], 3.0)])
    }

    #[test]
    fn two_bars_at_a_right_angle_are_mitred_at_45_degrees() {
        let (joints, findings) = joints(&elbow(), &[], JointKind::Mitre);
        assert!(findings.is_empty());
        let [first, second] = [&joints.beams[0], &joints.beams[1]];
        assert_eq!(first.ends[0], EndCut::SQUARE);
        assert!((first.ends[1].angle - FRAC_PI_4).abs() < 1e-12);
        assert!((second.ends[0].angle - FRAC_PI_4).abs() < 1e-12);
        // The long side is longer than the axis by the radius.
        assert!((first.axis_length - 50.0).abs() < 1e-9);
        assert!((first.length - 53.0).abs() < 1e-2, "{}", first.length);
    }

    #[test]
    fn mitres_of_a_frame_corner_lean_towards_each_other() {
        let u = frame(
            &[[0.0, 30.0, 0.0], [0.0; 3], [50.0, 0.0, 0.0], [50.0, 30.0, 0.0]],
            &[([0, 1], 2.0), ([1, 2], 2.0), ([2, 3], 2.0)],
        );
        let (joints, _) = joints(&u, &[], JointKind::Trim);
        assert!((joints.beams[1].twist - PI).abs() < 1e-9, "a trapezium");
        let z = frame(
            &[[0.0, 30.0, 0.0], [0.0; 3], [50.0, 0.0, 0.0], [50.0, -30.0, 0.0]],
            &[([0, 1], 2.0), ([1, 2], 2.0), ([2, 3], 2.0)],
        );
        let (joints, _) = super::joints(&z, &[], JointKind::Trim);
        assert!(joints.beams[1].twist.abs() < 1e-9, "a parallelogram");
    }

    #[test]
    fn a_thin_bar_is_cut_at_the_side_of_a_thick_one() {
        let tee = frame(
            &[[-40.0, 0.0, 0.0], [0.0; 3], [40.0, 0.0, 0.0], [0.0, 30.0, 0.0]],
            &[([0, 1], 5.0), ([1, 2], 5.0), ([1, 3], 3.0)],
        );
        let (joints, findings) = joints(&tee, &[], JointKind::Trim);
        assert!(findings.is_empty());
        assert_eq!(joints.beams[0].ends, [EndCut::SQUARE; 2]);
        // Its edges touch the thick bar: √(5² − 3²) from the axis.
        let cut = joints.beams[2].ends[0];
        let saddle = cut.saddle.expect("round on round");
        assert_eq!((cut.setback, saddle.radius, saddle.above), (5.0, 5.0, false));
        // Its sides reach down to √(5² − 3²) from the axis.
        assert!((joints.beams[2].length - 26.0).abs() < 1e-2, "{}", joints.beams[2].length);
    }

    #[test]
    fn the_edge_of_a_saddle_lies_on_the_side_of_its_member() {
        // A leg on a chord that goes on to the right, bent by 0, 3 and 9° there.
        for bend in [0.0, 3.0, 9.0_f64].map(f64::to_radians) {
            for (own, gap) in [(3.0, 0.0), (4.9, 0.1), (5.0, 0.0)] {
                let beyond = [40.0 * bend.cos(), 40.0 * bend.sin(), 0.0];
                let nodes = [[12.0, 25.0, 30.0], [0.0; 3], [-60.0, 0.0, 0.0], beyond];
                let bars = [([0, 1], own), ([1, 2], 5.0), ([1, 3], 5.0)];
                let frame = frame(&nodes, &bars);
                let (joints, findings) = super::joints(&frame, &[], JointKind::Trim);
                assert!(findings.is_empty());
                let (beam, cut) = (&frame.beams[0], &joints.beams[0]);
                let from_axis = |p: &Point3<f64>, end: [f64; 3]| {
                    p.coords.cross(&Vector3::from(end).normalize()).norm()
                };
                for i in 0..48 {
                    let (sin, cos) = (2.0 * PI * f64::from(i) / 48.0).sin_cos();
                    let across = Point2::new(own * cos, own * sin);
                    let along = cut.axis_length + cut::rise(beam, &cut.ends[1], &across);
                    let BeamAxes { x, y, z } = beam.axes.rolled(beam.shape.roll);
                    let p = Point3::from(nodes[0]) + *x * along + *y * across.x + *z * across.y;
                    // One of the two members it is held against is followed exactly, the other
                    // as far as it leans away over the width of the edge.
                    let off = [nodes[2], beyond].map(|end| (from_axis(&p, end) - 5.0).abs());
                    let reach = p.coords.norm() * bend.sin();
                    assert!(off[0].min(off[1]) < gap + 1e-9, "{own}, {bend}: {off:?}");
                    assert!(off[0].max(off[1]) < gap + reach + 1e-9, "{own}, {bend}: {off:?}");
                }
            }
        }
    }

    #[test]
    fn a_saddle_takes_a_thicker_member_that_goes_on() {
        let end_of = |nodes: &[[f64; 3]], bars: &[([u32; 2], f64)]| {
            super::joints(&frame(nodes, bars), &[], JointKind::Trim).0.beams[0].ends[1]
        };
        let nodes =
            [[0.0, 30.0, 20.0], [0.0; 3], [40.0, 0.0, 0.0], [-40.0, 0.0, 0.0], [9.0, -30.0, 0.0]];
        let [own, there, back] = [[0, 1], [1, 2], [1, 3]];
        let slim = end_of(&nodes, &[(own, 3.0), (there, 5.0), (back, 5.0)]);
        assert!(slim.saddle.is_some_and(|s| s.above) && slim.normal.is_none());
        for plane in [
            // It is thicker than the member that passes.
            end_of(&nodes, &[(own, 5.2), (there, 5.0), (back, 5.0)]),
            // The member ends at the node, or goes on thinner.
            end_of(&nodes, &[(own, 3.0), (there, 5.0), ([1, 4], 3.0)]),
            end_of(&nodes, &[(own, 3.0), (there, 5.0), (back, 4.0)]),
        ] {
            assert_eq!(plane.saddle, None);
        }
    }

    #[test]
    fn bars_as_thick_as_their_member_are_cut_as_if_they_were_equal() {
        let nodes = [[0.0, 0.0, 30.0], [0.0; 3], [40.0, 0.0, 0.0], [-40.0, 0.0, 0.0]];
        for own in [4.9, 5.0, 5.1] {
            let bars = [([0, 1], own), ([1, 2], 5.0), ([1, 3], 5.0)];
            let (joints, findings) = super::joints(&frame(&nodes, &bars), &[], JointKind::Trim);
            assert!(findings.is_empty());
            let beam = &joints.beams[0];
            assert_eq!(beam.ends[1].saddle.map(|s| s.radius), Some(own));
            // Its tips reach to the axis of the member.
            assert!((beam.length - 30.0).abs() < 1e-9, "{}", beam.length);
            assert!((beam.axis_length - (30.0 - own)).abs() < 1e-9);
        }
    }

    #[test]
    fn corners_of_the_beams_lie_on_the_ball() {
        let (joints, _) = joints(&elbow(), &[], JointKind::Sphere);
        let ball = joints.balls.iter().find(|b| b.node == NodeId(1)).unwrap();
        // At a right angle bars of radius 3 are clear of each other 3 √2 from the node.
        assert!((ball.radius - 3.0 / (0.5 * FRAC_PI_2).sin()).abs() < 1e-2);
        let setback = joints.beams[0].ends[1].setback;
        assert!((setback.hypot(3.0) - ball.radius).abs() < 1e-2);
        assert_eq!(joints.balls.len(), 1, "a single bar needs no ball");
    }

    #[test]
    fn a_bar_shorter_than_its_joints_stays_as_it_is() {
        let short = frame(
            &[[0.0; 3], [4.0, 0.0, 0.0], [4.0, 30.0, 0.0], [0.0, 30.0, 0.0]],
            &[([0, 1], 3.0), ([1, 2], 3.0), ([0, 3], 3.0)],
        );
        let (joints, findings) = joints(&short, &[], JointKind::Sphere);
        assert_eq!(joints.beams[0].ends, [EndCut::SQUARE; 2]);
        assert_eq!(findings.len(), 1);
        assert!(findings[0].text.contains("4.0 mm is too short"));
    }
}
