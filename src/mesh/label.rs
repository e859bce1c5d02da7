//! Which faces the optimiser could shape and which it had to keep.
//!
//! A face is [`Label::Design`] or belongs to a non-design set. What says so, in order of
//! precedence (the first source that marks some faces, but not all, wins alone; all are counted):
//!
//! | source | marks a face when |
//! |---|---|
//! | second mesh | it lies on or in a mesh given as non-design part (thesis §3.2: two models) |
//! | box | all of it lies in a given box |
//! | face property | an integer property made for this (PLY `non_design`) is not 0 |
//! | selection flags | bit 32 of the PLY property `flags` is set (MeshLab's selection) |
//! | face quality | quality ≥ 0.5 |
//! | face colour | the colour is red |
//! | vertex colour | all three corners are red |
//! | name | the group, object, material, solid or node matches a pattern |

use beamwright_formats::{LabelCarriers, RawMesh};
use nalgebra::Point3;

use super::id::SetId;
use super::indexed::IndexedMesh;
use super::triangle_tree::TriangleTree;

/// Whether the optimiser could shape a face or had to keep it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Label {
    /// Shaped by the optimiser.
    Design,
    /// Kept: part of this non-design set.
    NonDesign(SetId),
}

impl Label {
    /// Whether the face could be shaped.
    pub fn is_design(self) -> bool {
        self == Self::Design
    }
}

/// Where labels can come from, in order of precedence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LabelSource {
    /// A second closed mesh that is the non-design part.
    SecondMesh,
    /// An axis-aligned box.
    Box,
    /// An integer face property named for the purpose.
    FaceProperty,
    /// MeshLab's selection flags.
    Selection,
    /// Face quality of at least one half.
    Quality,
    /// Red faces.
    FaceColour,
    /// Faces between three red points.
    VertexColour,
    /// Names of groups, objects, materials, solids, nodes.
    Name,
}

impl LabelSource {
    /// Every source, the strongest first.
    pub const ALL: [Self; 8] = [
        Self::SecondMesh,
        Self::Box,
        Self::FaceProperty,
        Self::Selection,
        Self::Quality,
        Self::FaceColour,
        Self::VertexColour,
        Self::Name,
    ];

    /// The source in words, as shown to the user.
    pub fn describe(self) -> &'static str {
        match self {
            Self::SecondMesh => "second mesh",
            Self::Box => "box",
            Self::FaceProperty => "face property",
            Self::Selection => "selection flags",
            Self::Quality => "face quality",
            Self::FaceColour => "face colour",
            Self::VertexColour => "vertex colour",
            Self::Name => "name",
        }
    }
}

/// What the user says about the non-design part, besides the file.
#[derive(Clone, Debug)]
pub struct LabelParams {
    /// Closed meshes that are non-design parts.
    pub second_meshes: Vec<IndexedMesh>,
    /// Corners `[x0, y0, z0, x1, y1, z1]` of boxes, mm.
    pub boxes: Vec<[f64; 6]>,
    /// Names that mean non-design; `*` stands for anything, case and `-`, `_`, blank do not count.
    pub names: Vec<String>,
}

/// Names that mean non-design when the user gives none.
pub const DEFAULT_NAMES: [&str; 4] = ["*non_design*", "*nondesign*", "fixed*", "keep*"];

impl Default for LabelParams {
    fn default() -> Self {
        Self {
            second_meshes: Vec::new(),
            boxes: Vec::new(),
            names: DEFAULT_NAMES.map(String::from).to_vec(),
        }
    }
}

/// How many faces each source marks, and which source was followed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LabelCounts {
    /// Faces marked by each source that is present, in order of precedence.
    pub marked: Vec<(LabelSource, usize)>,
    /// The source that was followed; `None`: no labels.
    pub used: Option<LabelSource>,
}

/// For each triangle whether it is non-design, by the strongest source that tells faces apart.
pub(super) fn non_design_faces(
    mesh: &IndexedMesh,
    raw: &RawMesh,
    params: &LabelParams,
) -> (Vec<bool>, LabelCounts) {
    let mut counts = LabelCounts::default();
    let mut result = vec![false; mesh.triangles.len()];
    for source in LabelSource::ALL {
        let Some(marks) = marks_of(source, mesh, raw, params) else { continue };
        let marked = marks.iter().filter(|m| **m).count();
        counts.marked.push((source, marked));
        if counts.used.is_none() && marked > 0 && marked < marks.len() {
            counts.used = Some(source);
            result = marks;
        }
    }
    (result, counts)
}

fn marks_of(
    source: LabelSource,
    mesh: &IndexedMesh,
    raw: &RawMesh,
    params: &LabelParams,
) -> Option<Vec<bool>> {
    let carriers = &raw.carriers;
    let by_polygon = |is_marked: &dyn Fn(usize) -> bool| {
        mesh.sources.iter().map(|&p| p != u32::MAX && is_marked(p as usize)).collect::<Vec<bool>>()
    };
    match source {
        LabelSource::SecondMesh => (!params.second_meshes.is_empty())
            .then(|| on_or_in_second_meshes(mesh, &params.second_meshes)),
        LabelSource::Box => (!params.boxes.is_empty()).then(|| in_boxes(mesh, &params.boxes)),
        LabelSource::FaceProperty => (!carriers.face_property.is_empty())
            .then(|| by_polygon(&|p| carriers.face_property[p] != 0)),
        LabelSource::Selection => {
            (!carriers.face_selected.is_empty()).then(|| by_polygon(&|p| carriers.face_selected[p]))
        }
        LabelSource::Quality => (!carriers.face_quality.is_empty())
            .then(|| by_polygon(&|p| carriers.face_quality[p] >= 0.5)),
        LabelSource::FaceColour => (!carriers.face_colour.is_empty())
            .then(|| by_polygon(&|p| carriers.face_colour[p].is_some_and(is_red))),
        LabelSource::VertexColour => (!carriers.vertex_colour.is_empty()).then(|| {
            by_polygon(&|p| {
                raw.faces.corners_of(p).iter().all(|&v| is_red(carriers.vertex_colour[v as usize]))
            })
        }),
        LabelSource::Name => (!carriers.name_sets.is_empty()).then(|| {
            let marked = matching_name_sets(carriers, &params.names);
            by_polygon(&|p| marked[carriers.face_names[p] as usize])
        }),
    }
}

/// Red: strong in the first channel, weak in the others.
///
/// The bounds leave room for formats that keep five bits a channel (255 comes back as 248) and for
/// the shades programs use for a selection; orange and pink stay out.
fn is_red([r, g, b]: [u8; 3]) -> bool {
    r >= 180 && g <= 80 && b <= 80
}

fn matching_name_sets(carriers: &LabelCarriers, patterns: &[String]) -> Vec<bool> {
    let patterns: Vec<String> = patterns.iter().map(|p| plain(p)).collect();
    let matching: Vec<bool> = carriers
        .names
        .iter()
        .map(|n| patterns.iter().any(|p| matches_pattern(p.as_bytes(), plain(n).as_bytes())))
        .collect();
    carriers.name_sets.iter().map(|set| set.iter().any(|&n| matching[n as usize])).collect()
}

/// Lower case, with one sign for all the ways to write "non design".
fn plain(name: &str) -> String {
    name.trim().to_lowercase().replace(['-', ' '], "_")
}

/// Whether `name` matches `pattern`, where `*` stands for any run of characters.
fn matches_pattern(pattern: &[u8], name: &[u8]) -> bool {
    let (mut p, mut n, mut star) = (0, 0, None);
    while n < name.len() {
        if pattern.get(p) == Some(&b'*') {
            star = Some((p, n));
            p += 1;
        } else if pattern.get(p) == Some(&name[n]) {
            p += 1;
            n += 1;
        } else if let Some((star_at, from)) = star {
            star = Some((star_at, from + 1));
            p = star_at + 1;
            n = from + 1;
        } else {
            return false;
        }
    }
    pattern[p..].iter().all(|&c| c == b'*')
}

fn in_boxes(mesh: &IndexedMesh, boxes: &[[f64; 6]]) -> Vec<bool> {
    let slack = 1e-6 * extent(&mesh.positions);
    let inside = |p: &Point3<f64>, b: &[f64; 6]| {
        (0..3).all(|k| p[k] >= b[k].min(b[k + 3]) - slack && p[k] <= b[k].max(b[k + 3]) + slack)
    };
    mesh.triangles
        .iter()
        .map(|t| boxes.iter().any(|b| t.iter().all(|&v| inside(&mesh.positions[v as usize], b))))
        .collect()
}

/// A face lies on a second mesh when its corners and its middle are no farther from it than this,
/// in lengths of the model's diagonal. Larger and design faces that leave the part at a flat angle
/// are taken for it; smaller and coordinates rounded to single precision no longer match.
const ON_SECOND_MESH: f64 = 1e-5;

fn on_or_in_second_meshes(mesh: &IndexedMesh, parts: &[IndexedMesh]) -> Vec<bool> {
    let slack = ON_SECOND_MESH * extent(&mesh.positions);
    let trees: Vec<TriangleTree> = parts.iter().map(tree_of).collect();
    let belongs = |p: &Point3<f64>, tree: &TriangleTree| {
        tree.nearest(p).is_some_and(|(_, distance, _)| distance <= slack) || tree.contains(p)
    };
    let corner_parts: Vec<Vec<bool>> = trees
        .iter()
        .map(|tree| mesh.positions.iter().map(|p| belongs(p, tree)).collect())
        .collect();
    mesh.triangles
        .iter()
        .map(|t| {
            let middle = centre(&t.map(|v| mesh.positions[v as usize]));
            trees.iter().zip(&corner_parts).any(|(tree, corners)| {
                t.iter().all(|&v| corners[v as usize]) && belongs(&middle, tree)
            })
        })
        .collect()
}

fn tree_of(part: &IndexedMesh) -> TriangleTree {
    TriangleTree::new(
        part.triangles.iter().map(|t| t.map(|v| part.positions[v as usize])).collect(),
    )
}

fn centre([a, b, c]: &[Point3<f64>; 3]) -> Point3<f64> {
    Point3::from((a.coords + b.coords + c.coords) / 3.0)
}

/// Length of the diagonal of the bounding box, mm.
pub(super) fn extent(points: &[Point3<f64>]) -> f64 {
    let Some(&first) = points.first() else { return 0.0 };
    let (low, high) = points.iter().fold((first, first), |(l, h), p| (l.inf(p), h.sup(p)));
    (high - low).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn default_names_match_the_usual_spellings() {
        for name in
            ["non_design", "Non-Design part 2", "NONDESIGN", "fixed_3", "keep", "x non design"]
        {
            let hit = DEFAULT_NAMES
                .iter()
                .any(|p| matches_pattern(plain(p).as_bytes(), plain(name).as_bytes()));
            assert!(hit, "{name}");
        }
        for name in ["design", "Design-1", "unfixed", "default", ""] {
            let hit = DEFAULT_NAMES
                .iter()
                .any(|p| matches_pattern(plain(p).as_bytes(), plain(name).as_bytes()));
            assert!(!hit, "{name}");
        }
    }

    #[test]
    fn a_star_stands_for_any_run() {
        assert!(matches_pattern(b"a*c*", b"abbbcc"));
        assert!(matches_pattern(b"*", b""));
        assert!(!matches_pattern(b"a*c", b"abcd"));
    }

    #[test]
    fn five_bit_red_is_red_and_orange_is_not() {
        assert!(is_red([248, 0, 0]));
        assert!(!is_red([255, 128, 0]));
    }
}
