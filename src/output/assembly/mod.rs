//! The frame as a STEP assembly: one named, coloured solid a beam.
//!
//! Beams that are one piece (see [`Alike`]) share the solid and the properties of the first of
//! them: its length and mass, all their branches, the worst of their errors.

mod error;

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion};

use crate::finding::{Finding, FindingKind};
pub use crate::frame::mark;
use crate::frame::shape::{BeamShape, ShapeStation};
use crate::frame::{Beam, Frame};
use crate::joint::{Alike, Ball, CutBeam, EndCut, Joints, SAME_PIECE};
use crate::mesh::Surface;
use crate::output::mesh_export::PartMesh;
use crate::output::non_design::{NonDesign, non_design};
use crate::output::step::{self, Body, Document, Group, Loft, Part, Property, Station, Value};
use crate::section::matching::MatchErrors;
use crate::wording::figures;
pub use error::{AssemblyError, NoSolid};

/// Colours given to profiles in turn: distinct for the common kinds of colour blindness
/// (Okabe and Ito, *Color Universal Design*, 2008), without black.
const COLOURS: [[u8; 3]; 7] = [
    [86, 180, 233],
    [230, 159, 0],
    [0, 158, 115],
    [240, 228, 66],
    [0, 114, 178],
    [213, 94, 0],
    [204, 121, 167],
];

/// Balls are grey: they are no profile.
const BALL_COLOUR: [u8; 3] = [160, 160, 160];

/// The assembly of a frame, and what could not be built as wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    /// The document.
    pub document: Document,
    /// Volume and skin of each kind of piece (see [`Alike`]) as it is built; 0 of one that is not.
    pub sizes: Vec<SolidSize>,
    /// Non-design parts that go into a mesh file beside the STEP file.
    pub beside: Vec<PartMesh>,
    /// Beams that were built as simpler solids or not at all, non-design parts that are none.
    pub findings: Vec<Finding>,
}

/// What the solid of a piece weighs and takes of paint, but for its material.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SolidSize {
    /// Volume, mm³.
    pub volume: f64,
    /// Area of the outside between the cuts, mm².
    pub skin: f64,
}

impl Assembly {
    /// Adds the non-design parts of the surface the frame was made from.
    pub fn with_non_design(mut self, surface: &Surface, density: f64) -> Self {
        let NonDesign { parts, meshes, findings } = non_design(surface, density);
        self.document.groups.push(Group { name: "Non-design".into(), parts, groups: Vec::new() });
        self.beside = meshes;
        self.findings.extend(findings);
        self
    }
}

/// Builds the assembly of a frame: beams, and balls where its joints have any.
///
/// * `name`: of the root.
/// * `density`: kg/m³, for the masses.
///
/// # Errors
/// No beam is a solid, not even as a round bar: all are without length or area, or too small for a
/// STEP file.
pub fn assembly(
    name: &str,
    frame: &Frame,
    joints: &Joints,
    density: f64,
) -> Result<Assembly, AssemblyError> {
    let mut profiles: Vec<String> = Vec::new();
    let mut models: Vec<Result<Model, NoSolid>> = Vec::new();
    let mut parts = Vec::with_capacity(frame.beams.len());
    let mut findings = Vec::new();
    for (i, &Alike { kind, motion, .. }) in joints.alike.iter().enumerate() {
        let beam = &frame.beams[i];
        if kind == models.len() {
            let profile = beam.shape.name();
            let colour = profiles.iter().position(|p| *p == profile).unwrap_or_else(|| {
                profiles.push(profile);
                profiles.len() - 1
            });
            let colour = COLOURS[colour % COLOURS.len()];
            let model = Model::new(beam, &joints.beams[i], frame, colour, density);
            models.push(model.map_err(|fault| NoSolid::of(beam, fault)));
        }
        match &mut models[kind] {
            Ok(model) => {
                model.count(beam);
                findings.extend(model.simpler.map(|how| simpler_solid(i, frame, beam, how)));
                parts.push((kind, shown(i, beam), placement(beam, frame) * motion));
            }
            Err(fault) => findings.push(left_out(i, frame, beam, fault)),
        }
    }
    if let (true, Some(Err(fault))) = (parts.is_empty(), models.first()) {
        let (beam, fault) = (shown(0, &frame.beams[0]), fault.clone());
        return Err(AssemblyError::NoBeam { beam, fault });
    }
    let parts = parts.into_iter().filter_map(|(kind, name, at)| {
        models[kind].as_ref().ok().map(|model| model.placed(name, at))
    });
    let parts = parts.collect();
    let size = |m: &Result<Model, _>| m.as_ref().map_or(SolidSize::default(), |m| m.size);
    let sizes = models.iter().map(size).collect();
    let group = |name: &str, parts| Group { name: name.into(), parts, groups: Vec::new() };
    let mut groups = vec![group("Beams", parts)];
    if !joints.balls.is_empty() {
        groups.push(group("Joints", balls(frame, &joints.balls, density)?));
    }
    let document = Document { name: name.to_owned(), groups };
    Ok(Assembly { document, sizes, beside: Vec::new(), findings })
}

/// A beam by its mark and name.
fn shown(index: usize, beam: &Beam) -> String {
    format!("{} {}", mark(index), beam.shape.name())
}

/// A piece that is placed once for each beam that is alike.
struct Model {
    product: String,
    colour: [u8; 3],
    body: Body,
    size: SolidSize,
    /// How it was built where it could not be as wanted.
    simpler: Option<&'static str>,
    /// Facts that all its beams share.
    properties: Vec<Property>,
    branches: Vec<String>,
    /// The worst of the errors of its beams, if they were matched.
    errors: Option<MatchErrors>,
}

impl Model {
    fn new(
        beam: &Beam,
        cut: &CutBeam,
        frame: &Frame,
        colour: [u8; 3],
        density: f64,
    ) -> Result<Self, step::BodyError> {
        let (loft, simpler) = sound_loft(beam, cut, &placement(beam, frame))?;
        let name = beam.shape.name();
        let size = SolidSize { volume: loft.volume()?, skin: loft.skin()? };
        let mass = size.volume * density * 1e-9;
        Ok(Self {
            product: format!("{name} L={}", figures(cut.length, 1)),
            colour,
            body: Body::Loft(loft),
            size,
            simpler,
            properties: vec![
                Property::text("profile", name),
                Property::new("length", Value::Length(cut.length)),
                Property::new("area", Value::Area(beam.shape.properties.area)),
                Property::new("mass", Value::Mass(mass)),
            ],
            branches: Vec::new(),
            errors: None,
        })
    }

    /// Adds what is known of one more beam.
    fn count(&mut self, beam: &Beam) {
        self.branches.push(beam.branch.to_string());
        self.errors = match (self.errors, beam.shape.errors) {
            (Some(a), Some(b)) => Some(a.worst(&b)),
            (a, b) => a.or(b),
        };
    }

    fn placed(&self, name: String, placement: Isometry3<f64>) -> Part {
        let mut properties = self.properties.clone();
        properties.push(Property::text("branch", self.branches.join(" ")));
        if let Some(e) = &self.errors {
            let percent = |x: f64| format!("{:+.1} %", 100.0 * x);
            for (name, error) in
                [("error of A", e.area), ("error of I1", e.i_1), ("error of I2", e.i_2)]
            {
                properties.push(Property::text(name, percent(error)));
            }
        }
        Part {
            name,
            product: self.product.clone(),
            colour: self.colour,
            placement,
            body: self.body.clone(),
            properties,
        }
    }
}

/// The solid of a beam as it is cut; failing that cut square, failing that a round bar of its area,
/// with words for what was done.
fn sound_loft(
    beam: &Beam,
    cut: &CutBeam,
    placement: &Isometry3<f64>,
) -> Result<(Loft, Option<&'static str>), step::BodyError> {
    let sound = |shape: &BeamShape, cut: &CutBeam| {
        let loft = loft(shape, cut, placement);
        Body::Loft(loft.clone()).check().map(|_| loft)
    };
    if let Ok(wanted) = sound(&beam.shape, cut) {
        return Ok((wanted, None));
    }
    let square_at = |e: EndCut| EndCut { setback: e.setback, ..EndCut::SQUARE };
    let square = CutBeam { ends: cut.ends.map(square_at), ..*cut };
    if let Ok(plain) = sound(&beam.shape, &square) {
        return Ok((plain, Some("with its ends cut square")));
    }
    let round = sound(&BeamShape::unmatched(beam.shape.properties.area), &square)?;
    Ok((round, Some("as a round bar of its area")))
}

fn simpler_solid(index: usize, frame: &Frame, beam: &Beam, how: &str) -> Finding {
    let [a, b] = frame.axis(beam);
    let text =
        format!("{} is no sound solid as {}; it was built {how}", mark(index), beam.shape.name());
    Finding::note(FindingKind::SimplerSolid, Some(nalgebra::center(&a, &b)), text)
}

/// A beam that is no solid at all is not in the file: a promise that does not hold.
fn left_out(index: usize, frame: &Frame, beam: &Beam, fault: &NoSolid) -> Finding {
    let [a, b] = frame.axis(beam);
    let text = format!("{} is no solid and left out of the STEP file: {fault}", shown(index, beam));
    Finding::breach(FindingKind::SimplerSolid, Some(nalgebra::center(&a, &b)), text)
}

/// The balls; those that are nearly equal are made as the first of them is.
fn balls(frame: &Frame, balls: &[Ball], density: f64) -> Result<Vec<Part>, step::BodyError> {
    let mut radii: Vec<f64> = Vec::new();
    balls
        .iter()
        .enumerate()
        .map(|(i, ball)| {
            let is_same = |r: &f64| (r - ball.radius).abs() <= SAME_PIECE * r;
            let radius = radii.iter().copied().find(is_same).unwrap_or_else(|| {
                radii.push(ball.radius);
                ball.radius
            });
            let body = Body::Sphere { radius };
            let mass = body.volume()? * density * 1e-9;
            let size = format!("Ball D{}", figures(2.0 * radius, 1));
            Ok(Part {
                name: format!("J{:03} {size}", i + 1),
                product: size,
                colour: BALL_COLOUR,
                placement: Isometry3::from_parts(
                    Translation3::from(frame.node(ball.node).position.coords),
                    UnitQuaternion::identity(),
                ),
                body,
                properties: vec![
                    Property::new("diameter", Value::Length(2.0 * radius)),
                    Property::new("mass", Value::Mass(mass)),
                ],
            })
        })
        .collect()
}

/// From the coordinates of the body (x, y across, z along) to those of the model.
fn placement(beam: &Beam, frame: &Frame) -> Isometry3<f64> {
    let [start, _] = frame.axis(beam);
    let axes = beam.axes.rolled(beam.shape.roll);
    let columns = Matrix3::from_columns(&[*axes.y, *axes.z, *axes.x]);
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(columns));
    Isometry3::from_parts(Translation3::from(start.coords), turn)
}

/// The loft of a shape between the cuts of its ends.
fn loft(shape: &BeamShape, cut: &CutBeam, placement: &Isometry3<f64>) -> Loft {
    let station = |s: &ShapeStation| Station {
        z: cut.ends[0].setback + s.at * cut.axis_length,
        outer: s.region.outer.clone(),
        holes: s.region.holes.clone(),
    };
    let local = |end: &EndCut| match (end.saddle, end.normal) {
        (Some(saddle), _) => step::EndCut::Saddle(saddle),
        (None, Some(normal)) => {
            let normal = placement.rotation.inverse() * normal.into_inner();
            step::EndCut::Plane { normal }
        }
        (None, None) => step::EndCut::Square,
    };
    let [start, end] = [local(&cut.ends[0]), local(&cut.ends[1])];
    let stations = shape.stations.iter().map(station).collect();
    Loft { start, end, ..Loft::between_stations(stations) }
}
