//! Which sections along a piece tell about it: next to a junction they hold parts of other branches.

use super::beam_axes::BeamAxes;
use super::beam_section::BeamSection;
use super::beam_station::BeamStation;
use super::pieces::{Making, Piece};
use super::section_at::Section;
use super::{NodeKind, direction};

/// Radii round a junction within which sections may hold a part of other branches: radii of the piece.
const JUNCTION_REACH: f64 = 3.0;

/// Part of the mean area from which on a section holds more of other branches than is a swelling of its
/// own, as that of a slim brace next to its node on the chord of a truss, which has three times its
/// area: it may lie as far off as the thickest branch reaches. Ties that widen into a junction gain a
/// fifth.
const SWALLOWED: f64 = 1.5;

/// Sections on either side that a piece without any of its own takes from the rest of its branch.
const BORROWED: usize = 2;

impl<'a> Making<'a> {
    /// Sections along a piece.
    pub(super) fn sections_of(&self, piece: &Piece) -> Vec<&'a Section> {
        piece.points.iter().filter_map(|&p| self.sections[p as usize].as_ref()).collect()
    }

    /// Sections along a piece that are the branch's own; where it has none, the nearest two of its
    /// branch on either side.
    pub(super) fn own_sections_of(&self, piece: &Piece) -> Vec<&'a Section> {
        let own = |points: &[u32]| -> Vec<&'a Section> {
            let found = points.iter().filter_map(|&p| self.sections[p as usize].as_ref());
            found.filter(|s| self.is_own(s)).collect()
        };
        let along = own(&piece.points);
        if !along.is_empty() || !piece.passes.is_empty() {
            return along;
        }
        let branch = &self.skeleton.branches[piece.branch].points;
        let place = |p: Option<&u32>| branch.iter().position(|q| Some(q) == p);
        let corner = |end: usize| place(self.corner_points.get(&piece.ends[end]));
        let first = place(piece.points.first());
        let Some(first) = first.or(corner(0).map(|c| c + 1)).or(corner(1)) else { return along };
        let next = place(piece.points.last()).map_or(first, |last| last + 1);
        let (before, after) = (own(&branch[..first]), own(&branch[next..]));
        let before = &before[before.len().saturating_sub(BORROWED)..];
        before.iter().chain(after.iter().take(BORROWED)).copied().collect()
    }

    /// Whether a section is that of the branch alone: not much larger than the trend of the branch,
    /// which the radius of the point follows where other branches swell the section.
    fn is_own(&self, section: &Section) -> bool {
        !is_swallowed(section, self.skeleton.points[section.point as usize].radius)
    }

    /// What the sections of a piece say, in axes turned to nothing in particular.
    pub(super) fn beam_section(&self, piece: &Piece) -> BeamSection {
        self.said_by(&self.sections_of(piece), piece)
    }

    /// What those that are its branch's own say.
    pub(super) fn own_beam_section(&self, piece: &Piece) -> BeamSection {
        self.said_by(&self.own_sections_of(piece), piece)
    }

    fn said_by(&self, sections: &[&Section], piece: &Piece) -> BeamSection {
        let [a, b] = self.axis(piece);
        let axes = BeamAxes::along(direction(&a, &b));
        BeamSection::new(sections, a, (b - a).norm(), &axes)
    }

    /// How far a section is the piece's own, 1 to 0. Swollen next to a junction it holds a part of
    /// other branches; elsewhere it is only thick. `radius` is that of the piece.
    pub(super) fn own(&self, piece: &Piece, radius: f64, station: &BeamStation) -> f64 {
        let Some(section) = &self.sections[station.point as usize] else { return 0.0 };
        let is_swallowed = is_swallowed(section, radius);
        let near_junction = piece.ends.iter().any(|&n| {
            let node = &self.nodes[n];
            let reach = || {
                let thickest = if is_swallowed { self.thickest_at(n) } else { 0.0 };
                JUNCTION_REACH * radius.max(thickest)
            };
            node.kind == NodeKind::Junction && (node.position - section.centroid).norm() < reach()
        });
        if near_junction { station.weight } else { 1.0 }
    }

    /// Largest mean radius of the branches at a node, mm.
    fn thickest_at(&self, node: usize) -> f64 {
        let there = self.pieces.iter().filter(|p| p.ends.contains(&node));
        there.map(|p| self.branch_radius(p)).fold(0.0, f64::max)
    }
}

/// Whether a section is so much larger than a radius tells that it holds more of other branches.
fn is_swallowed(section: &Section, radius: f64) -> bool {
    section.radius() > SWALLOWED.sqrt() * radius
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point3, Vector3};

    use super::*;
    use crate::frame::params::FrameParams;
    use crate::mesh::contour::Plane;
    use crate::skeleton::{Branch, PointKind, SkeletalPoint, Skeleton};

    /// A square section of side `side` across z.
    fn square(point: u32, z: f64, side: f64) -> Option<Section> {
        let at = Point3::new(0.0, 0.0, z);
        let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
        let contour = corners.map(|[x, y]| at + Vector3::new(x, y, 0.0) * side).to_vec();
        let plane = Plane::new(at, Vector3::z_axis());
        Some(Section { point, plane, contour, area: side * side, centroid: at })
    }

    #[test]
    fn a_piece_whose_sections_hold_other_branches_takes_those_of_its_branch() {
        // A branch with a corner at its sixth point; its last section is the slice of a junction.
        let radius = 2.0 / std::f64::consts::PI.sqrt();
        let kind = |i: u32| match i {
            0 => PointKind::End,
            8 => PointKind::Junction,
            _ => PointKind::Branch,
        };
        let at = |i: u32| Point3::new(0.0, 0.0, 2.0 * f64::from(i));
        let points = (0..9).map(|i| SkeletalPoint { position: at(i), radius, kind: kind(i) });
        let branches = vec![Branch { points: (0..9).collect() }];
        let skeleton = Skeleton { points: points.collect(), branches };
        let mut sections = vec![None; 9];
        for i in 1..6 {
            sections[i as usize] = square(i, at(i).z, 2.0);
        }
        sections[7] = square(7, at(7).z, 5.0);
        let mut making = Making::new(&skeleton, &sections, &[], &FrameParams::default());
        making.split(0, 5);
        let of = |piece: usize| -> Vec<u32> {
            making.own_sections_of(&making.pieces[piece]).iter().map(|s| s.point).collect()
        };
        assert_eq!(of(0), [1, 2, 3, 4, 5]);
        assert_eq!(of(1), [4, 5], "of the branch before it");
        // Broken once more, the last piece but one has no point at all.
        making.split(1, 0);
        let of = |piece: usize| -> Vec<u32> {
            making.own_sections_of(&making.pieces[piece]).iter().map(|s| s.point).collect()
        };
        assert_eq!(making.pieces[1].points, [0; 0]);
        assert_eq!(of(1), [4, 5], "of the branch before it");
    }
}
