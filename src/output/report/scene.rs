//! Geometry and figures of the 3D view and the plots, as the script reads them.

use nalgebra::Point3;
use serde::Serialize;

use super::Report;
use super::measure::{Peer, along};
use super::packed::{Grid, Indices};
use super::tables::worst_error;
use crate::frame::Section;
use crate::mesh::Surface;
use crate::output::beam_table;
use crate::output::decimate::Shown;
use crate::output::view::View;
use crate::skeleton::{PointKind, Skeleton};

/// Triangles of the mesh that are shown; a larger one is thinned for the view. A browser without a
/// graphics card still turns so many smoothly.
const MOST_TRIANGLES: usize = 100_000;

/// Points of a section outline that are kept: a round one is followed within 1 % of its radius.
const OUTLINE_POINTS: usize = 32;

/// Everything the script shows.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Scene {
    grid: Grid,
    /// Diagonal of the mesh, mm.
    size: f64,
    #[serde(skip)]
    triangles: usize,
    #[serde(skip)]
    shown_triangles: usize,
    mesh: MeshScene,
    beam_mesh: BeamMesh,
    beams: Vec<BeamScene>,
    skeleton: SkeletonScene,
    outlines: Outlines,
    peers: Vec<PeerScene>,
    findings: Vec<Option<[f64; 3]>>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct MeshScene {
    points: String,
    design: Indices,
    non_design: Indices,
}

/// All beams in one list of triangles.
#[derive(Serialize)]
struct BeamMesh {
    points: String,
    indices: Indices,
    /// First triangle of each beam, and the number of all.
    starts: Vec<usize>,
}

#[derive(Serialize)]
struct BeamScene {
    mark: String,
    profile: String,
    colour: Option<[u8; 3]>,
    ends: [[f64; 3]; 2],
    branches: Vec<u32>,
    area: f64,
    deviation: f64,
    offset: Option<f64>,
    error: Option<f64>,
}

#[derive(Serialize)]
struct SkeletonScene {
    points: Vec<[f64; 3]>,
    kinds: Vec<u8>,
    radii: Vec<f64>,
    areas: Vec<Option<f64>>,
    offsets: Vec<Option<f64>>,
    outside: Vec<usize>,
    branches: Vec<Vec<u32>>,
}

#[derive(Serialize)]
struct Outlines {
    points: String,
    /// First point of each outline, and the number of all.
    starts: Vec<usize>,
}

#[derive(Serialize)]
struct PeerScene {
    name: String,
    points: Vec<[f64; 3]>,
    segments: Vec<[u32; 2]>,
    outside: Vec<usize>,
}

impl Scene {
    pub(super) fn new(report: &Report<'_>) -> Self {
        let view = report.view;
        let grid = Grid::round(
            view.surface.mesh.positions().iter().chain(view.parts.iter().flat_map(|p| &p.points)),
        );
        let triangles = view.surface.mesh.face_count();
        let shown = Shown::of(view.surface).reduced(MOST_TRIANGLES);
        let peers = report.measures.peers.iter();
        let places = report.summary.findings.iter().map(|f| f.place.map(|p| p.map(tidy)));
        Self {
            size: tidy(report.summary.mesh.diagonal),
            triangles,
            shown_triangles: shown.triangles.len(),
            mesh: MeshScene::new(&shown, &grid),
            beam_mesh: BeamMesh::new(view, &grid),
            beams: beams(report),
            skeleton: SkeletonScene::new(view, &report.measures.offsets),
            outlines: Outlines::new(view.sections, &grid),
            peers: peers.map(|p| PeerScene::new(p, view.surface)).collect(),
            findings: places.collect(),
            grid,
        }
    }

    /// Triangles shown and triangles there are, when that is less.
    pub(super) fn thinned(&self) -> Option<[usize; 2]> {
        (self.shown_triangles < self.triangles).then_some([self.shown_triangles, self.triangles])
    }
}

impl MeshScene {
    fn new(shown: &Shown, grid: &Grid) -> Self {
        let of = |design: bool| {
            let wanted = shown.triangles.iter().filter(|t| t.1 == design);
            Indices::new(&wanted.flat_map(|t| t.0).collect::<Vec<u32>>())
        };
        Self { points: grid.points(shown.points.iter()), design: of(true), non_design: of(false) }
    }
}

impl BeamMesh {
    fn new(view: &View<'_>, grid: &Grid) -> Self {
        let (mut points, mut indices, mut starts) = (Vec::new(), Vec::new(), vec![0]);
        for part in view.beam_meshes() {
            if let Some(part) = part {
                let first = points.len() as u32;
                indices.extend(part.triangles.iter().flatten().map(|i| i + first));
                points.extend(&part.points);
            }
            starts.push(indices.len() / 3);
        }
        let points = grid.points(points.into_iter());
        Self { points, indices: Indices::new(&indices), starts }
    }
}

fn beams(report: &Report<'_>) -> Vec<BeamScene> {
    let view = report.view;
    let rows = beam_table::rows(view.frame);
    let along = along(view.frame, view.skeleton, &report.measures.offsets);
    let meshes = view.beam_meshes();
    rows.into_iter()
        .zip(along)
        .zip(meshes)
        .map(|((row, along), part)| BeamScene {
            colour: part.map(|p| p.colour),
            ends: [row.start.map(tidy), row.end.map(tidy)],
            area: tidy(row.area),
            deviation: tidy(along.deviation),
            offset: along.offset.map(tidy),
            error: worst_error(&row).map(tidy),
            mark: row.mark,
            profile: row.profile,
            branches: row.branches,
        })
        .collect()
}

impl SkeletonScene {
    fn new(view: &View<'_>, offsets: &[Option<f64>]) -> Self {
        let skeleton = view.skeleton;
        let points = &skeleton.points;
        Self {
            points: places(skeleton),
            kinds: points.iter().map(|p| p.kind as u8).collect(),
            radii: points.iter().map(|p| tidy(p.radius)).collect(),
            areas: view.sections.iter().map(|s| s.as_ref().map(|s| tidy(s.area))).collect(),
            offsets: offsets.iter().map(|o| o.map(tidy)).collect(),
            outside: outside(skeleton, view.surface),
            branches: skeleton.branches.iter().map(|b| b.points.clone()).collect(),
        }
    }
}

impl Outlines {
    fn new(sections: &[Option<Section>], grid: &Grid) -> Self {
        let (mut points, mut starts) = (Vec::new(), vec![0]);
        for section in sections.iter().flatten() {
            let stride = section.contour.len().div_ceil(OUTLINE_POINTS).max(1);
            points.extend(section.contour.iter().step_by(stride));
            starts.push(points.len());
        }
        Self { points: grid.points(points.into_iter()), starts }
    }
}

impl PeerScene {
    fn new(peer: &Peer, surface: &Surface) -> Self {
        Self {
            name: peer.name.clone(),
            points: places(&peer.skeleton),
            segments: peer.skeleton.segments().collect(),
            outside: outside(&peer.skeleton, surface),
        }
    }
}

fn places(skeleton: &Skeleton) -> Vec<[f64; 3]> {
    skeleton.points.iter().map(|p| <[f64; 3]>::from(p.position).map(tidy)).collect()
}

/// Points outside of the object; centres of interface sections lie on its design part's border.
fn outside(skeleton: &Skeleton, surface: &Surface) -> Vec<usize> {
    let is_outside = |p: &Point3<f64>| !surface.tree.contains(p);
    (0..skeleton.points.len())
        .filter(|&i| skeleton.points[i].kind != PointKind::Interface)
        .filter(|&i| is_outside(&skeleton.points[i].position))
        .collect()
}

/// A number with six digits: as many as a picture can show.
fn tidy(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tidy_numbers_have_six_digits() {
        assert_eq!(tidy(123.456_789_01), 123.457);
        assert_eq!(tidy(-1.0 / 3.0), -0.333_333);
        assert_eq!(tidy(0.0), 0.0);
    }
}
