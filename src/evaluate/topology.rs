//! Components and cycles of the skeleton against those of the mesh.
//!
//! A closed surface of b components and Euler number χ = V − E + F has genus g = b − χ/2; a skeleton
//! of the same topology has b components and g independent cycles.

use rustc_hash::FxHashMap;
use serde::Serialize;

use super::interfaces::Interfaces;
use crate::mesh::id::{FaceId, HalfEdgeId};
use crate::mesh::{HalfEdgeMesh, Surface};
use crate::skeleton_file::LineGraph;

/// Topology of a mesh and of its parts, each part closed by a disc over each interface section.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct MeshTopology {
    /// Connected surfaces.
    pub components: usize,
    /// Tunnels.
    pub genus: usize,
    /// Connected surfaces of the design part.
    pub design_components: usize,
    /// Tunnels of the design part.
    pub design_genus: usize,
    /// Connected surfaces of the non-design part.
    pub non_design_components: usize,
    /// Tunnels of the non-design part.
    pub non_design_genus: usize,
    /// Tunnels of the whole that are not those of non-design parts: cycles of the skeleton with each
    /// non-design part as one point.
    pub genus_with_bodies_as_points: usize,
    /// Interface sections.
    pub interfaces: usize,
    /// Interface loops left out as label noise.
    pub interfaces_dropped: usize,
}

impl MeshTopology {
    pub(super) fn of(surface: &Surface, interfaces: &Interfaces) -> Self {
        let is_design = |f: FaceId| surface.labels.is_design(f);
        let loops = surface.interfaces.len();
        let (components, genus) = closed_topology(&surface.mesh, |_| true, 0);
        let (design_components, design_genus) = closed_topology(&surface.mesh, is_design, loops);
        let (non_design_components, non_design_genus) =
            closed_topology(&surface.mesh, |f| !is_design(f), loops);
        Self {
            components,
            genus,
            design_components,
            design_genus,
            non_design_components,
            non_design_genus,
            genus_with_bodies_as_points: genus.saturating_sub(non_design_genus),
            interfaces: interfaces.all.len(),
            interfaces_dropped: interfaces.dropped,
        }
    }
}

/// Components and genus of the chosen faces, closed by `discs` discs over all their borders.
///
/// A vertex counts once for each fan of chosen faces about it: an open fan has one border edge that
/// leaves the vertex, so there are as many open fans as border edges.
fn closed_topology(
    mesh: &HalfEdgeMesh,
    is_chosen: impl Fn(FaceId) -> bool,
    discs: usize,
) -> (usize, usize) {
    let (mut faces, mut inner_sides, mut borders) = (0, 0, 0);
    let mut whole_fan: Vec<Option<bool>> = vec![None; mesh.positions().len()];
    for h in mesh.faces().flat_map(|f| f.half_edges()) {
        let chosen = is_chosen(h.face());
        let whole = &mut whole_fan[mesh.origin(h).index()];
        *whole = Some(whole.unwrap_or(true) && chosen);
        if chosen {
            faces += usize::from(h == h.face().half_edges()[0]);
            let is_inner = is_chosen(mesh.neighbour(h));
            *(if is_inner { &mut inner_sides } else { &mut borders }) += 1;
        }
    }
    let fans = whole_fan.iter().filter(|w| **w == Some(true)).count() + borders;
    let edges = inner_sides / 2 + borders;
    let euler = (fans + faces + discs) as i64 - edges as i64;
    let components = components(mesh, &is_chosen);
    (components, (components as i64 - euler / 2).max(0) as usize)
}

fn components(mesh: &HalfEdgeMesh, is_chosen: &impl Fn(FaceId) -> bool) -> usize {
    let mut seen = vec![false; mesh.face_count()];
    let mut count = 0;
    for seed in mesh.faces().filter(|&f| is_chosen(f)) {
        if std::mem::replace(&mut seen[seed.index()], true) {
            continue;
        }
        count += 1;
        let mut stack = vec![seed];
        while let Some(face) = stack.pop() {
            for next in face.half_edges().map(|h: HalfEdgeId| mesh.neighbour(h)) {
                if is_chosen(next) && !std::mem::replace(&mut seen[next.index()], true) {
                    stack.push(next);
                }
            }
        }
    }
    count
}

/// Topology of a skeleton, beside what the mesh asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Topology {
    /// Connected parts.
    pub components: usize,
    /// Components of the design part (of the mesh, without labels).
    pub expected_components: usize,
    /// Independent cycles: segments − points + components.
    pub cycle_rank: usize,
    /// Tunnels of the design part closed over its interface sections (of the mesh, without labels).
    pub expected_cycle_rank: usize,
    /// Whether both agree.
    pub is_homotopic: bool,
    /// Components with all interface ends of one non-design part joined in one point.
    pub components_bodies_joined: usize,
    /// Cycles with all interface ends of one non-design part joined in one point; to be held against
    /// `genus_with_bodies_as_points` of the mesh.
    pub cycle_rank_bodies_joined: usize,
    /// Ends that are no interface section.
    pub free_ends: usize,
    /// Points that are the centre of an interface section.
    pub interface_ends: usize,
    /// Points with three or more segments.
    pub junctions: usize,
    /// The same, with junctions joined over branches shorter than 2 r_mean.
    pub junction_clusters: usize,
    /// Chains between junctions, ends and interface sections.
    pub branches: usize,
    /// Branches shorter than 2 r_mean.
    pub short_branches: usize,
    /// Length of the skeleton, mm.
    pub length: f64,
}

impl Topology {
    pub(super) fn of(
        graph: &LineGraph,
        mesh: &MeshTopology,
        is_labelled: bool,
        interfaces: &Interfaces,
        r_mean: f64,
    ) -> Self {
        let (of_point, components) = graph.components();
        let cycle_rank = graph.segments().len() + components - graph.points().len();
        let (expected_components, expected_cycle_rank) = if is_labelled {
            (mesh.design_components, mesh.design_genus)
        } else {
            (mesh.components, mesh.genus)
        };
        let joined = bodies_joined(graph, interfaces, &of_point, components);
        let count = |wanted: &dyn Fn(u32) -> bool| graph.indices().filter(|&p| wanted(p)).count();
        let topology = Self {
            components,
            expected_components,
            cycle_rank,
            expected_cycle_rank,
            is_homotopic: components == expected_components && cycle_rank == expected_cycle_rank,
            components_bodies_joined: joined.0,
            cycle_rank_bodies_joined: joined.1,
            free_ends: count(&|p| graph.degree(p) == 1 && !graph.is_interface(p)),
            interface_ends: count(&|p| graph.is_interface(p)),
            junctions: count(&|p| graph.degree(p) >= 3),
            length: graph.length(),
            ..Self::default()
        };
        topology.with_branches(graph, r_mean)
    }

    fn with_branches(mut self, graph: &LineGraph, r_mean: f64) -> Self {
        let mut clusters = Groups::new(graph.points().len());
        self.junction_clusters = self.junctions;
        for chain in graph.chains() {
            self.branches += 1;
            let line = graph.polyline(&chain);
            let length: f64 = line.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
            if length < 2.0 * r_mean {
                self.short_branches += 1;
                let ends = [chain[0], chain[chain.len() - 1]];
                if ends.iter().all(|&p| graph.degree(p) >= 3) && clusters.join(ends[0], ends[1]) {
                    self.junction_clusters -= 1;
                }
            }
        }
        self
    }
}

/// Components and cycles when the interface ends of each non-design part meet in one more point.
fn bodies_joined(
    graph: &LineGraph,
    interfaces: &Interfaces,
    of_point: &[u32],
    components: usize,
) -> (usize, usize) {
    let mut number_of: FxHashMap<u32, u32> = FxHashMap::default();
    let mut joins = Vec::new();
    for p in graph.indices().filter(|&p| graph.is_interface(p)) {
        let Some((nearest, _)) = interfaces.nearest(&graph.position(p)) else { continue };
        let next = (components + number_of.len()) as u32;
        let body = *number_of.entry(interfaces.all[nearest].set.0).or_insert(next);
        joins.push([of_point[p as usize], body]);
    }
    let nodes = components + number_of.len();
    let mut groups = Groups::new(nodes);
    let merged = joins.iter().filter(|[a, b]| groups.join(*a, *b)).count();
    let parts = nodes - merged;
    let segments = graph.segments().len() + joins.len();
    (parts, segments + parts - (graph.points().len() + number_of.len()))
}

/// Which of many things are joined.
struct Groups {
    parent: Vec<u32>,
}

impl Groups {
    fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect() }
    }

    fn root(&mut self, mut x: u32) -> u32 {
        while self.parent[x as usize] != x {
            let above = self.parent[self.parent[x as usize] as usize];
            self.parent[x as usize] = above;
            x = above;
        }
        x
    }

    /// Joins two things; false when they already were.
    fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
        a != b
    }
}
