//! From what a file says to a surface one can march on: mends what is safe, reports it, and says
//! plainly what cannot be used.
//!
//! | step | what | function |
//! |---|---|---|
//! | 1 | equal points merged, empty and repeated triangles dropped | [`weld`] |
//! | 2 | sides paired, triangles turned the same way round | `pair_and_orient` |
//! | 3 | points of a torn surface merged within a tolerance | `merge_near_border_points` |
//! | 4 | small and flat openings closed | `close_openings` |
//! | 5 | fans that touch in a vertex separated | `split_shared_vertices` |
//! | 6 | shells turned outwards; cavities and islands left out | `choose_shells` |
//! | 7 | triangles numbered by the shape alone | `renumbered` |
//! | 8 | labels cleaned, sets and interface sections found | [`Labels`], [`interface_sections`] |
//!
//! **Cavities** (closed hollows inside the material) are left out: a curve skeleton cannot see
//! them, and sections are taken as solid. **Floating islands** (bodies without any non-design
//! face, when other bodies have some) are left out: nothing holds or loads them. Both are reported
//! with their volume and place.

use beamwright_formats::RawMesh;
use nalgebra::Point3;

use super::error::{MeshError, SCALE};
use super::fans::{drop_unused_points, split_shared_vertices};
use super::fill::close_openings;
use super::half_edge::HalfEdgeMesh;
use super::id::FaceId;
use super::indexed::{IndexedMesh, weld};
use super::interface_section::{InterfaceSection, interface_sections};
use super::label::{LabelCounts, LabelParams, extent, non_design_faces};
use super::near::merge_near_border_points;
use super::order::renumbered;
use super::orient::{NO_TWIN, pair_and_orient};
use super::set::Labels;
use super::shell::{Shell, Shells};
use super::triangle_tree::TriangleTree;
use crate::observer::Observer;

/// A surface ready for marching.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The closed, outward oriented mesh: design and non-design faces.
    pub mesh: HalfEdgeMesh,
    /// Label of each face.
    pub labels: Labels,
    /// Loops between design and non-design faces.
    pub interfaces: Vec<InterfaceSection>,
    /// Search tree over the triangles of `mesh`, in the same order.
    pub tree: TriangleTree,
    /// Number of each face in the order of the file; eq. (2.2) of the thesis begins its rays at the
    /// edge that is listed first.
    pub listed: Vec<u32>,
    /// What was found and mended.
    pub report: MeshReport,
    /// Area of each face, mm².
    areas: Vec<f64>,
    design: DesignPart,
}

/// How large the design part is.
#[derive(Clone, Copy, Debug)]
struct DesignPart {
    volume: f64,
    area: f64,
}

impl DesignPart {
    fn new(
        mesh: &HalfEdgeMesh,
        areas: &[f64],
        labels: &Labels,
        interfaces: &[InterfaceSection],
    ) -> Self {
        let origin = mesh.positions().first().copied().unwrap_or_else(Point3::origin);
        let (mut volume, mut area) = (0.0, 0.0);
        for f in mesh.faces().filter(|f| labels.is_design(*f)) {
            let [a, b, c] = mesh.corners(f).map(|p| p - origin);
            volume += a.dot(&b.cross(&c)) / 6.0;
            area += areas[f.index()];
        }
        // The cap of a section looks out of the design part, against the section's normal.
        let caps: f64 =
            interfaces.iter().map(|i| i.normal.dot(&(i.centroid - origin)) * i.area / 3.0).sum();
        Self { volume: volume - caps, area }
    }
}

impl Surface {
    /// Volume of the design part closed over its interface sections, mm³.
    pub fn design_volume(&self) -> f64 {
        self.design.volume
    }

    /// Area of the design faces, mm².
    pub fn design_area(&self) -> f64 {
        self.design.area
    }

    /// Area of a face, mm².
    pub fn face_area(&self, face: FaceId) -> f64 {
        self.areas[face.index()]
    }

    /// Mean strut radius 2 V / A of the design part, mm.
    pub fn mean_radius(&self) -> f64 {
        2.0 * self.design_volume() / self.design_area()
    }
}

/// What a file held and what was mended.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshReport {
    /// Triangles of the surface that is used.
    pub triangles: usize,
    /// Its points.
    pub vertices: usize,
    /// Points merged because they were equal.
    pub merged_points: usize,
    /// Border points merged because they were near.
    pub merged_near_points: usize,
    /// Triangles dropped for having no area.
    pub degenerate_triangles: usize,
    /// Triangles dropped because another one covers the same corners.
    pub duplicate_triangles: usize,
    /// Triangles turned round.
    pub flipped_triangles: usize,
    /// Edges with more than two triangles that were cut apart.
    pub split_edges: usize,
    /// Vertices made where separate fans touched.
    pub split_vertices: usize,
    /// Openings closed.
    pub closed_openings: usize,
    /// Hollows inside the material, left out.
    pub cavities: Vec<Shell>,
    /// Bodies without non-design faces, left out.
    pub islands: Vec<Shell>,
    /// Bodies that are used.
    pub bodies: usize,
    /// Tunnels through the surface that is used.
    pub genus: usize,
    /// Enclosed volume, mm³.
    pub volume: f64,
    /// Area, mm².
    pub area: f64,
    /// Diagonal of the bounding box, mm.
    pub extent: f64,
    /// Labels by source.
    pub labels: LabelCounts,
}

/// Makes a [`Surface`] of what a reader delivers.
///
/// # Errors
/// When the surface is open, not manifold, one-sided or empty beyond what can be mended safely.
pub fn prepare(raw: &RawMesh, params: &LabelParams) -> Result<Surface, MeshError> {
    prepare_watched(raw, params, &mut ())
}

/// The same, unless the observer asks to stop.
pub(crate) fn prepare_watched(
    raw: &RawMesh,
    params: &LabelParams,
    observer: &mut impl Observer,
) -> Result<Surface, MeshError> {
    let (mut soup, counts) = weld(raw);
    keep_on(observer)?;
    let mut report = MeshReport {
        merged_points: counts.merged_points,
        degenerate_triangles: counts.degenerate,
        duplicate_triangles: counts.duplicate,
        ..MeshReport::default()
    };
    if soup.triangles.is_empty() {
        return Err(MeshError::NoTriangles);
    }
    let twins = make_closed(&mut soup, &mut report)?;
    check_scale(&soup.positions)?;
    keep_on(observer)?;
    let (soup, twins) = choose_outward(&mut soup, twins, &mut report)?;
    keep_on(observer)?;
    let (mesh, non_design, listed) = label(soup, twins, raw, params, &mut report)?;
    keep_on(observer)?;
    Ok(finish(mesh, non_design, listed, report))
}

fn keep_on(observer: &mut impl Observer) -> Result<(), MeshError> {
    if observer.keep_on().is_break() { Err(MeshError::Cancelled) } else { Ok(()) }
}

/// Steps 2 to 5.
fn make_closed(soup: &mut IndexedMesh, report: &mut MeshReport) -> Result<Vec<u32>, MeshError> {
    let mut pairing = pair_and_orient(soup);
    if pairing.twins.contains(&NO_TWIN) {
        report.merged_near_points = merge_near_border_points(soup, &pairing);
        if report.merged_near_points > 0 {
            report.duplicate_triangles += soup.drop_duplicates();
            pairing = pair_and_orient(soup);
        }
    }
    if let Some(first) = pairing.one_sided {
        return Err(MeshError::OneSided { first });
    }
    if let Some((edges, first)) = pairing.unsound {
        return Err(MeshError::NonManifold { edges, first });
    }
    report.flipped_triangles = pairing.flipped;
    report.split_edges = pairing.split_edges;
    let mut twins = pairing.twins;
    let filled = close_openings(soup, &mut twins);
    report.closed_openings = filled.closed;
    if let Some((edges, loops, first)) = filled.left {
        return Err(MeshError::Open { edges, loops, first });
    }
    report.split_vertices = split_shared_vertices(soup, &twins);
    drop_unused_points(soup);
    Ok(twins)
}

/// An error for a part that no number measures. The largest side of its box tells, which is a number
/// where the diagonal is none any more.
fn check_scale(points: &[Point3<f64>]) -> Result<(), MeshError> {
    let side = |k: usize| {
        let along = points.iter().map(|p| p[k]);
        let (low, high) = along.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        (high - low).min(f64::MAX)
    };
    let width = (0..3).map(side).fold(0.0, f64::max);
    let is_measured = (SCALE[0]..=SCALE[1]).contains(&width);
    if is_measured { Ok(()) } else { Err(MeshError::OutOfScale { width }) }
}

/// Step 6: turns every body outwards and drops the cavities.
fn choose_outward(
    soup: &mut IndexedMesh,
    twins: Vec<u32>,
    report: &mut MeshReport,
) -> Result<(IndexedMesh, Vec<u32>), MeshError> {
    let mut soup = std::mem::take(soup);
    let mut twins = twins;
    let mesh = HalfEdgeMesh::from_parts(soup.positions, soup.triangles, twins);
    let shells = Shells::new(&mesh);
    (soup.positions, soup.triangles, twins) = mesh.into_parts();
    if shells.all.iter().all(|s| s.volume == 0.0) {
        return Err(MeshError::NoVolume);
    }
    let inside_out: Vec<bool> =
        shells.of_face.iter().map(|&s| shells.all[s as usize].volume < 0.0).collect();
    let cavity = |s: &Shell| s.depth > 0;
    for shell in shells.all.iter().filter(|s| cavity(s)) {
        report.cavities.push(Shell { volume: shell.volume.abs(), ..*shell });
    }
    let turned =
        |s: &&u32| shells.all[**s as usize].volume < 0.0 && !cavity(&shells.all[**s as usize]);
    report.flipped_triangles += shells.of_face.iter().filter(turned).count();
    super::orient::flip(&mut soup, &mut twins, &inside_out);
    let keep: Vec<bool> =
        shells.of_face.iter().map(|&s| !cavity(&shells.all[s as usize])).collect();
    keep_faces(&mut soup, &mut twins, &keep);
    Ok((soup, twins))
}

/// Drops whole shells; the twins of what stays are renumbered.
fn keep_faces(soup: &mut IndexedMesh, twins: &mut Vec<u32>, keep: &[bool]) {
    if !keep.contains(&false) {
        return;
    }
    let mut new_index = vec![0u32; keep.len()];
    let kept = (0..keep.len()).filter(|&f| keep[f]);
    for (new, f) in (0..).zip(kept) {
        new_index[f] = new;
    }
    let mut f = 0;
    soup.triangles.retain(|_| (keep[f], f += 1).0);
    f = 0;
    soup.sources.retain(|_| (keep[f], f += 1).0);
    let mut h = 0;
    twins.retain(|_| (keep[h / 3], h += 1).0);
    for t in twins.iter_mut() {
        *t = 3 * new_index[*t as usize / 3] + *t % 3;
    }
    drop_unused_points(soup);
}

/// Steps 7 and 8, after islands are dropped: the mesh, its non-design faces, and which triangle of the
/// file each was.
fn label(
    mut soup: IndexedMesh,
    mut twins: Vec<u32>,
    raw: &RawMesh,
    params: &LabelParams,
    report: &mut MeshReport,
) -> Result<(HalfEdgeMesh, Vec<bool>, Vec<u32>), MeshError> {
    let (mut non_design, counts) = non_design_faces(&soup, raw, params);
    if let (None, Some((source, _))) =
        (counts.used, counts.marked.iter().find(|(_, n)| *n == soup.triangles.len()))
    {
        return Err(MeshError::NoDesign { by: source.describe() });
    }
    report.labels = counts;
    let mesh = HalfEdgeMesh::from_parts(soup.positions, soup.triangles, twins);
    let shells = Shells::new(&mesh);
    (soup.positions, soup.triangles, twins) = mesh.into_parts();
    let keep = held_faces(&shells, &non_design, report);
    keep_faces(&mut soup, &mut twins, &keep);
    let mut marks = keep.iter();
    non_design.retain(|_| *marks.next().unwrap_or(&true));
    let kept = shells.of_face.iter().zip(&keep).filter(|(_, kept)| **kept);
    let shell_of_face: Vec<u32> = kept.map(|(s, _)| *s).collect();
    let mesh = HalfEdgeMesh::from_parts(soup.positions, soup.triangles, twins);
    let (mesh, listed) = renumbered(mesh, &shell_of_face);
    let non_design = listed.iter().map(|&f| non_design[f as usize]).collect();
    Ok((mesh, non_design, listed))
}

/// Which faces belong to bodies that a non-design part holds (all, when there are no labels).
fn held_faces(shells: &Shells, non_design: &[bool], report: &mut MeshReport) -> Vec<bool> {
    let mut held = vec![!non_design.contains(&true); shells.all.len()];
    for (&s, _) in shells.of_face.iter().zip(non_design).filter(|(_, n)| **n) {
        held[s as usize] = true;
    }
    report.islands = shells.all.iter().zip(&held).filter(|(_, h)| !**h).map(|(s, _)| *s).collect();
    report.bodies = held.iter().filter(|h| **h).count();
    shells.of_face.iter().map(|&s| held[s as usize]).collect()
}

fn finish(
    mesh: HalfEdgeMesh,
    non_design: Vec<bool>,
    listed: Vec<u32>,
    mut report: MeshReport,
) -> Surface {
    debug_assert_eq!(mesh.check(), Ok(()));
    let labels = Labels::new(&mesh, non_design);
    let tree = TriangleTree::new(mesh.faces().map(|f| mesh.corners(f)).collect());
    let interfaces = interface_sections(&mesh, &labels, &tree);
    report.triangles = mesh.face_count();
    report.vertices = mesh.positions().len();
    report.genus = genus(&mesh, report.bodies);
    report.volume = mesh.volume();
    let areas: Vec<f64> = mesh.faces().map(|f| mesh.face_area(f)).collect();
    report.area = areas.iter().sum();
    report.extent = extent(mesh.positions());
    let design = DesignPart::new(&mesh, &areas, &labels, &interfaces);
    Surface { mesh, labels, interfaces, tree, listed, report, areas, design }
}

/// Tunnels of a closed surface: χ = V − E + F = 2 (bodies − genus).
fn genus(mesh: &HalfEdgeMesh, bodies: usize) -> usize {
    let (v, f) = (mesh.positions().len() as i64, mesh.face_count() as i64);
    let euler = v - 3 * f / 2 + f;
    (bodies as i64 - euler / 2).max(0) as usize
}
