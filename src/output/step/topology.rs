//! Solids as STEP entities: shells, faces, loops, edges, vertices.

use nalgebra::Point3;
use rustc_hash::FxHashMap;
use truck_topology::{EdgeID, VertexID};

use super::brep::{Curve, Edge, Face, Shell, Solid, Surface, Vertex, Wire};
use super::geometry::Geometry;
use crate::output::part21::{Fault, Flag, Id, List};

/// Writes the solid of one product.
pub(super) struct Topology<'g, 'w, 'a> {
    geometry: &'g mut Geometry<'w, 'a>,
    vertices: FxHashMap<VertexID<Point3<f64>>, Id>,
    edges: FxHashMap<EdgeID<Curve>, Id>,
}

impl<'g, 'w, 'a> Topology<'g, 'w, 'a> {
    pub(super) fn new(geometry: &'g mut Geometry<'w, 'a>) -> Self {
        Self { geometry, vertices: FxHashMap::default(), edges: FxHashMap::default() }
    }

    /// Writes the solid; its first shell is the outer one.
    pub(super) fn solid(&mut self, solid: &Solid) -> Result<Id, Fault> {
        let shells = solid.boundaries();
        let ids = shells.iter().map(|s| self.shell(s)).collect::<Result<Vec<_>, _>>()?;
        let part = &mut *self.geometry.part;
        let (outer, voids) = (ids[0], &ids[1..]);
        if voids.is_empty() {
            return part.entity(format_args!("MANIFOLD_SOLID_BREP('',{outer})"));
        }
        let voids = voids
            .iter()
            .map(|shell| part.entity(format_args!("ORIENTED_CLOSED_SHELL('',*,{shell},.T.)")))
            .collect::<Result<Vec<_>, _>>()?;
        part.entity(format_args!("BREP_WITH_VOIDS('',{outer},{})", List(&voids)))
    }

    fn shell(&mut self, shell: &Shell) -> Result<Id, Fault> {
        let faces = shell.iter().map(|f| self.face(f)).collect::<Result<Vec<_>, _>>()?;
        self.geometry.part.entity(format_args!("CLOSED_SHELL('',{})", List(&faces)))
    }

    fn face(&mut self, face: &Face) -> Result<Id, Fault> {
        let wires = face.boundaries();
        let skin = face.surface();
        let loops = match (&skin.surface, &skin.seam, &wires[..]) {
            (Surface::Sphere { axes, radius }, _, []) => {
                vec![self.pole(axes.origin + *axes.z * *radius)?]
            }
            (_, Some(seam), [first, second]) => vec![self.seamed_loop(first, seam, second)?],
            _ => wires.iter().map(|w| self.edge_loop(w)).collect::<Result<Vec<_>, _>>()?,
        };
        let mut bounds = Vec::with_capacity(loops.len());
        for (i, boundary) in loops.into_iter().enumerate() {
            let kind = if i == 0 { "FACE_OUTER_BOUND" } else { "FACE_BOUND" };
            bounds.push(self.geometry.part.entity(format_args!("{kind}('',{boundary},.T.)"))?);
        }
        let surface = self.geometry.surface(&skin.surface)?;
        let (bounds, sense) = (List(&bounds), Flag(face.orientation()));
        self.geometry.part.entity(format_args!("ADVANCED_FACE('',{bounds},{surface},{sense})"))
    }

    /// The boundary of a whole sphere: one vertex.
    fn pole(&mut self, at: Point3<f64>) -> Result<Id, Fault> {
        let point = self.geometry.point(&at)?;
        let vertex = self.geometry.part.entity(format_args!("VERTEX_POINT('',{point})"))?;
        self.geometry.part.entity(format_args!("VERTEX_LOOP('',{vertex})"))
    }

    fn edge_loop(&mut self, wire: &Wire) -> Result<Id, Fault> {
        let edges = self.oriented_edges(wire)?;
        self.geometry.part.entity(format_args!("EDGE_LOOP('',{})", List(&edges)))
    }

    /// Along the first wire, up the seam, along the second, down the seam.
    fn seamed_loop(&mut self, first: &Wire, seam: &Curve, second: &Wire) -> Result<Id, Fault> {
        let mut edges = self.oriented_edges(first)?;
        let (from, to) = (first[0].front(), second[0].front());
        let curve = self.geometry.curve(seam, &from.point(), &to.point())?;
        let (from, to) = (self.vertex(from)?, self.vertex(to)?);
        let seam = self.edge_curve(from, to, curve)?;
        edges.push(self.oriented_edge(seam, true)?);
        edges.extend(self.oriented_edges(second)?);
        edges.push(self.oriented_edge(seam, false)?);
        self.geometry.part.entity(format_args!("EDGE_LOOP('',{})", List(&edges)))
    }

    fn oriented_edges(&mut self, wire: &Wire) -> Result<Vec<Id>, Fault> {
        wire.edge_iter()
            .map(|edge| {
                let id = self.edge(edge)?;
                self.oriented_edge(id, edge.orientation())
            })
            .collect()
    }

    fn oriented_edge(&mut self, edge: Id, forward: bool) -> Result<Id, Fault> {
        let forward = Flag(forward);
        self.geometry.part.entity(format_args!("ORIENTED_EDGE('',*,*,{edge},{forward})"))
    }

    fn edge(&mut self, edge: &Edge) -> Result<Id, Fault> {
        if let Some(id) = self.edges.get(&edge.id()) {
            return Ok(*id);
        }
        let (from, to) = (edge.absolute_front(), edge.absolute_back());
        let curve = self.geometry.curve(&edge.curve(), &from.point(), &to.point())?;
        let (from, to) = (self.vertex(from)?, self.vertex(to)?);
        let id = self.edge_curve(from, to, curve)?;
        self.edges.insert(edge.id(), id);
        Ok(id)
    }

    fn edge_curve(&mut self, from: Id, to: Id, curve: Id) -> Result<Id, Fault> {
        self.geometry.part.entity(format_args!("EDGE_CURVE('',{from},{to},{curve},.T.)"))
    }

    fn vertex(&mut self, vertex: &Vertex) -> Result<Id, Fault> {
        if let Some(id) = self.vertices.get(&vertex.id()) {
            return Ok(*id);
        }
        let point = self.geometry.point(&vertex.point())?;
        let id = self.geometry.part.entity(format_args!("VERTEX_POINT('',{point})"))?;
        self.vertices.insert(vertex.id(), id);
        Ok(id)
    }
}
