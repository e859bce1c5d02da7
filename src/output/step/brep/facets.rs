//! The boundary of a solid of flat and cylindrical faces.

use std::collections::{BTreeMap, HashMap};

use nalgebra::Vector3;

use super::curve::across;
use super::{
    Axes, Conic, Curve, Edge, Face, Shell, Skin, Solid, Surface, Vertex, Wire, face, solid_of,
};
use crate::output::step::error::BodyError;
use crate::output::step::facets::{Facet, Facets, Loop};

/// Builds the solid of checked facets; cavities become shells of their own.
pub(super) fn solid(facets: &Facets) -> Result<Solid, BodyError> {
    let mut builder = Builder::new(facets);
    let faces = (0..facets.faces.len())
        .map(|index| builder.face(index))
        .collect::<Result<Vec<Face>, _>>()?;
    let pieces = builder.pieces();
    let volume = |piece: &[usize]| piece.iter().map(|&f| facets.cone_volume(f)).sum::<f64>();
    let (outer, voids): (Vec<_>, Vec<_>) = pieces.iter().partition(|piece| volume(piece) > 0.0);
    if outer.len() > 1 {
        return Err(BodyError::SeveralSolids { count: outer.len() });
    }
    let shell = |piece: &Vec<usize>| piece.iter().map(|&f| faces[f].clone()).collect::<Shell>();
    solid_of(outer.into_iter().chain(voids).map(shell).collect())
}

/// Makes each corner and edge once, however many faces meet there.
struct Builder<'a> {
    facets: &'a Facets,
    vertices: Vec<Vertex>,
    rounds: Vec<Edge>,
    straights: HashMap<(u32, u32), (usize, Edge)>,
    /// Faces joined so far; each face leads to the first of its shell.
    leads: Vec<usize>,
    /// First face seen at each circle.
    at_circle: Vec<Option<usize>>,
}

impl<'a> Builder<'a> {
    fn new(facets: &'a Facets) -> Self {
        let rounds = facets.circles.iter().map(|circle| {
            let axis = circle.axis.normalize();
            let p = across(&axis).normalize() * circle.radius;
            let conic = Conic { centre: circle.centre, p, q: axis.cross(&p) };
            let start = Vertex::new(circle.centre + p);
            Edge::new_unchecked(&start, &start, Curve::Conic(conic))
        });
        Self {
            facets,
            vertices: facets.corners.iter().map(|p| Vertex::new(*p)).collect(),
            rounds: rounds.collect(),
            straights: HashMap::new(),
            leads: (0..facets.faces.len()).collect(),
            at_circle: vec![None; facets.circles.len()],
        }
    }

    fn face(&mut self, index: usize) -> Result<Face, BodyError> {
        match &self.facets.faces[index] {
            Facet::Flat { normal, outer, inner } => {
                let normal = normal.normalize();
                let mut wires = vec![self.wire(index, outer, &normal)?];
                for hole in inner {
                    wires.push(self.wire(index, hole, &-normal)?);
                }
                let axes = Axes::about(self.facets.on_loop(outer), normal, across(&normal));
                face(wires, Skin { surface: Surface::Plane(axes), seam: None }, true)
            }
            Facet::Round { circles, bore } => self.round(index, *circles, *bore),
        }
    }

    /// A loop of a flat face, counter-clockwise about `normal`.
    fn wire(
        &mut self,
        face: usize,
        boundary: &Loop,
        normal: &Vector3<f64>,
    ) -> Result<Wire, BodyError> {
        match boundary {
            Loop::Circle(c) => Ok(vec![self.circle(face, *c, normal)].into()),
            Loop::Corners(corners) => {
                let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
                let edges = pairs
                    .map(|(&a, &b)| self.straight(face, a, b))
                    .collect::<Result<Vec<_>, _>>()?;
                let wire = Wire::from(edges);
                let forward = self.facets.area_vector(corners).dot(normal) > 0.0;
                Ok(if forward { wire } else { wire.inverse() })
            }
        }
    }

    /// The edge of a circle, counter-clockwise about `normal`.
    fn circle(&mut self, face: usize, c: usize, normal: &Vector3<f64>) -> Edge {
        match self.at_circle[c] {
            Some(other) => self.join(face, other),
            None => self.at_circle[c] = Some(face),
        }
        let forward = self.facets.circles[c].axis.dot(normal) > 0.0;
        if forward { self.rounds[c].clone() } else { self.rounds[c].inverse() }
    }

    /// The edge from corner `a` to corner `b`, shared both ways.
    fn straight(&mut self, face: usize, a: u32, b: u32) -> Result<Edge, BodyError> {
        let key = (a.min(b), a.max(b));
        if let Some((other, edge)) = self.straights.get(&key) {
            let (other, edge) = (*other, edge.clone());
            self.join(face, other);
            return Ok(if a < b { edge } else { edge.inverse() });
        }
        let (from, to) = (&self.vertices[key.0 as usize], &self.vertices[key.1 as usize]);
        let length = (to.point() - from.point()).norm();
        if length < crate::output::step::tolerance::SHORTEST {
            return Err(BodyError::TinyEdge { piece: face, length });
        }
        let edge = Edge::new_unchecked(from, to, Curve::Line);
        self.straights.insert(key, (face, edge.clone()));
        Ok(if a < b { edge } else { edge.inverse() })
    }

    fn round(&mut self, index: usize, [a, b]: [usize; 2], bore: bool) -> Result<Face, BodyError> {
        let (first, second) = (&self.facets.circles[a], &self.facets.circles[b]);
        let up = (second.centre - first.centre).normalize();
        let out = if bore { -up } else { up };
        let wires = vec![
            vec![self.circle(index, a, &out)].into(),
            vec![self.circle(index, b, &-out)].into(),
        ];
        let axes = Axes::about(first.centre, up, across(&up));
        let surface = Surface::Cylinder { axes, radius: first.radius };
        face(wires, Skin { surface, seam: Some(Curve::Line) }, !bore)
    }

    fn lead(&mut self, mut face: usize) -> usize {
        while self.leads[face] != face {
            self.leads[face] = self.leads[self.leads[face]]; // halve the way for the next time
            face = self.leads[face];
        }
        face
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.lead(a), self.lead(b));
        let (first, second) = (a.min(b), a.max(b));
        self.leads[second] = first;
    }

    /// The faces of each connected piece of the boundary, in order.
    fn pieces(&mut self) -> Vec<Vec<usize>> {
        let mut pieces: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for face in 0..self.leads.len() {
            pieces.entry(self.lead(face)).or_default().push(face);
        }
        pieces.into_values().collect()
    }
}
