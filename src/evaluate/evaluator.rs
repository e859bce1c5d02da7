//! One mesh, many skeletons: what depends on the mesh alone is worked out once.

use nalgebra::{Point3, Vector3};
use serde::Serialize;

use super::Evaluation;
use super::ball::Ball;
use super::centeredness::{Centeredness, Scale, gather};
use super::coverage::Coverage;
use super::error::EvaluateError;
use super::interfaces::Interfaces;
use super::options::{BoundingSphere, EvaluateOptions};
use super::outside::Outside;
use super::plane_cut::Cutter;
use super::point::{Gauge, PointMeasure, normal_plane};
use super::resample::resample_graph;
use super::topology::{MeshTopology, Topology};
use crate::mesh::{LoopFrame, Surface, TriangleTree};
use crate::skeleton::graph::Skeleton;
use crate::skeleton_file::LineGraph;

/// What the figures of an evaluation are relative to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshFacts {
    /// Triangles.
    pub triangles: usize,
    /// Whether some faces are labelled non-design.
    pub is_labelled: bool,
    /// r of eq. (2.2): radius of the bounding sphere, mm.
    pub r: f64,
    /// Which sphere that is.
    pub sphere: BoundingSphere,
    /// Radius of the smallest sphere that holds all vertices, mm.
    pub r_smallest: f64,
    /// Radius of the sphere about the centre of the bounding box, mm.
    pub r_box_centred: f64,
    /// Mean strut radius 2 V / A, mm: volume of the design part closed over its interface sections,
    /// area of the design surface. Exact for round rods.
    pub r_mean: f64,
    /// Half the side of the cube in which crossings are collected, mm.
    pub cube_half: f64,
    /// Where that comes from.
    pub cube_from: CubeSource,
    /// Components and tunnels.
    pub topology: MeshTopology,
}

/// Where the size of the cube comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CubeSource {
    /// The options.
    Given,
    /// The largest interface section (thesis §4.4).
    InterfaceSections,
    /// Twice the mean strut radius: there are no interface sections.
    MeanRadius,
}

/// Evaluates skeletons of one mesh.
pub struct Evaluator<'a> {
    surface: &'a Surface,
    facts: MeshFacts,
    interfaces: Interfaces,
    /// The non-design parts, each closed over its interface sections.
    non_design: Option<TriangleTree>,
    step: f64,
}

impl<'a> Evaluator<'a> {
    /// Measures the mesh.
    ///
    /// # Errors
    /// If an option is outside its range.
    pub fn new(surface: &'a Surface, options: &EvaluateOptions) -> Result<Self, EvaluateError> {
        options.check()?;
        let interfaces = Interfaces::of(surface);
        let is_labelled = surface.labels.sets > 0;
        let positions = surface.mesh.positions();
        let balls = [Ball::smallest(positions), Ball::box_centred(positions)].map(|b| b.radius);
        let r_mean = mean_radius(surface);
        let (cube_half, cube_from) = match (options.cube_half, interfaces.largest_reach()) {
            (Some(given), _) => (given, CubeSource::Given),
            (None, Some(reach)) => (reach, CubeSource::InterfaceSections),
            (None, None) => (2.0 * r_mean, CubeSource::MeanRadius),
        };
        let facts = MeshFacts {
            triangles: surface.mesh.face_count(),
            is_labelled,
            r: balls[options.sphere as usize],
            sphere: options.sphere,
            r_smallest: balls[0],
            r_box_centred: balls[1],
            r_mean,
            cube_half,
            cube_from,
            topology: MeshTopology::of(surface, &interfaces),
        };
        let non_design = is_labelled.then(|| TriangleTree::new(closed(surface, false)));
        let step = options.step.unwrap_or(r_mean);
        Ok(Self { surface, facts, interfaces, non_design, step })
    }

    /// What the figures are relative to.
    pub fn facts(&self) -> &MeshFacts {
        &self.facts
    }

    pub(super) fn interfaces(&self) -> &Interfaces {
        &self.interfaces
    }

    pub(super) fn non_design(&self) -> Option<&TriangleTree> {
        self.non_design.as_ref()
    }

    /// Measures a skeleton.
    ///
    /// Points of it at the centre of an interface section count as such, whatever their kind.
    ///
    /// # Errors
    /// If the skeleton is millions of strut radii long: its unit is then not that of the mesh.
    pub fn evaluate(&self, skeleton: &Skeleton) -> Result<Evaluation, EvaluateError> {
        let graph = self.graph_of(skeleton);
        let even = resample_graph(&graph, self.step)?;
        let (facts, r_mean) = (self.facts.clone(), self.facts.r_mean);
        let coverage = Coverage::of(&graph, self.surface, r_mean)?;
        let topology =
            Topology::of(&graph, &facts.topology, facts.is_labelled, &self.interfaces, r_mean);
        Ok(Evaluation {
            mesh: facts,
            raw: self.centeredness(&graph),
            resampled: self.centeredness(&even),
            resample_step: self.step,
            outside: Outside::of(&graph, &self.surface.tree, r_mean),
            topology,
            coverage,
        })
    }

    /// What is measured at each point of a skeleton; `None` for points the criterion leaves out and
    /// points that another one at the same place stands for.
    pub fn point_measures(&self, skeleton: &Skeleton) -> Vec<(Point3<f64>, Option<PointMeasure>)> {
        let graph = self.graph_of(skeleton);
        let places = graph.points().iter().map(|p| p.position);
        places.zip(self.measures(&graph)).collect()
    }

    fn graph_of(&self, skeleton: &Skeleton) -> LineGraph {
        let mut graph = LineGraph::of(skeleton);
        self.interfaces.mark(&mut graph);
        graph
    }

    fn is_in_non_design(&self, p: &Point3<f64>) -> bool {
        self.non_design.as_ref().is_some_and(|tree| tree.contains(p))
    }

    /// Measures at all points but those the criterion leaves out (thesis §4.4): junctions, ends and
    /// non-design points.
    fn measures(&self, graph: &LineGraph) -> Vec<Option<PointMeasure>> {
        let mut gauge = Gauge::new(Cutter::new(self.surface), self.facts.cube_half);
        let mut measure = |p: u32| {
            let here = graph.position(p);
            let &[previous, next] = graph.neighbours(p) else { return None };
            if graph.is_interface(p) || self.is_in_non_design(&here) {
                return None;
            }
            let along = graph.position(next.point) - graph.position(previous.point);
            Some(gauge.measure(&normal_plane(here, &along)?))
        };
        graph.indices().map(&mut measure).collect()
    }

    fn centeredness(&self, graph: &LineGraph) -> Centeredness {
        let scale = Scale { r: self.facts.r, r_mean: self.facts.r_mean };
        let mut gathered = gather(graph, &self.measures(graph), scale);
        for p in graph.indices() {
            let excluded = &mut gathered.excluded;
            let place = graph.position(p);
            excluded.junctions += usize::from(graph.degree(p) >= 3);
            excluded.ends += usize::from(graph.degree(p) == 1);
            excluded.interfaces += usize::from(graph.is_interface(p));
            excluded.in_non_design +=
                usize::from(!graph.is_interface(p) && self.is_in_non_design(&place));
            gathered.points_outside += usize::from(!self.surface.tree.contains(&place));
        }
        gathered
    }
}

/// Mean strut radius 2 V / A of the design part; of the whole mesh where labels leave no volume.
fn mean_radius(surface: &Surface) -> f64 {
    let mesh = &surface.mesh;
    let origin = mesh.positions()[0];
    let volume: f64 = closed(surface, true)
        .iter()
        .map(|t| t.map(|p| p - origin))
        .map(|[a, b, c]: [Vector3<f64>; 3]| a.dot(&b.cross(&c)) / 6.0)
        .sum();
    let design = mesh.faces().filter(|&f| surface.labels.is_design(f));
    let area: f64 = design.map(|f| mesh.face_area(f)).sum();
    if volume > 0.0 {
        2.0 * volume / area
    } else {
        2.0 * mesh.volume() / mesh.faces().map(|f| mesh.face_area(f)).sum::<f64>()
    }
}

/// The triangles of the design (or non-design) part with a fan over every interface section.
fn closed(surface: &Surface, design: bool) -> Vec<[Point3<f64>; 3]> {
    let mesh = &surface.mesh;
    let own = mesh.faces().filter(|&f| surface.labels.is_design(f) == design);
    let mut triangles: Vec<[Point3<f64>; 3]> = own.map(|f| mesh.corners(f)).collect();
    for interface in &surface.interfaces {
        let rim: Vec<Point3<f64>> =
            interface.half_edges.iter().map(|&h| mesh.position(mesh.origin(h))).collect();
        let hub = LoopFrame::of(&rim).centroid;
        for (k, &a) in rim.iter().enumerate() {
            let b = rim[(k + 1) % rim.len()];
            // The loop has the design part on its left: its lid runs the other way round.
            triangles.push(if design { [b, a, hub] } else { [a, b, hub] });
        }
    }
    triangles
}
