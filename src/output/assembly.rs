//! The frame as a STEP assembly: one named, coloured solid a beam.

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion};

use super::step::{self, Body, Document, Group, Loft, Part, Property, Station, Value};
use crate::frame::shape::{BeamShape, ShapeStation};
use crate::frame::{Beam, Frame};
use crate::section::outline::{Outline, Segment};

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

/// Mark of beam number `index`, counted from 0: `B001`.
pub fn mark(index: usize) -> String {
    format!("B{:03}", index + 1)
}

/// The assembly of a frame.
///
/// * `name`: of the root.
/// * `density`: kg/m³, for the masses.
///
/// # Errors
/// A shape that is no solid.
pub fn document(name: &str, frame: &Frame, density: f64) -> Result<Document, step::BodyError> {
    let mut profiles: Vec<String> = Vec::new();
    let mut parts = Vec::with_capacity(frame.beams.len());
    for (i, beam) in frame.beams.iter().enumerate() {
        let profile = beam.shape.name();
        let colour = profiles.iter().position(|p| *p == profile).unwrap_or_else(|| {
            profiles.push(profile);
            profiles.len() - 1
        });
        parts.push(part(i, beam, frame, COLOURS[colour % COLOURS.len()], density)?);
    }
    let beams = Group { name: "Beams".into(), parts, groups: Vec::new() };
    Ok(Document { name: name.to_owned(), groups: vec![beams] })
}

fn part(
    index: usize,
    beam: &Beam,
    frame: &Frame,
    colour: [u8; 3],
    density: f64,
) -> Result<Part, step::BodyError> {
    let body = body(&beam.shape, beam.cut_length)?;
    let name = beam.shape.name();
    let volume = body.volume()?;
    let properties = vec![
        Property::text("profile", name.clone()),
        Property::new("length", Value::Length(beam.cut_length)),
        Property::new("area", Value::Area(beam.shape.properties.area)),
        Property::new("mass", Value::Mass(volume * density * 1e-9)),
    ];
    Ok(Part {
        name: format!("{} {name}", mark(index)),
        product: format!("{name} L={:.1}", beam.cut_length),
        colour,
        placement: placement(beam, frame),
        body,
        properties,
    })
}

/// From the coordinates of the body (x, y across, z along) to those of the model.
fn placement(beam: &Beam, frame: &Frame) -> Isometry3<f64> {
    let [start, _] = frame.axis(beam);
    let axes = beam.axes.rolled(beam.shape.roll);
    let columns = Matrix3::from_columns(&[*axes.y, *axes.z, *axes.x]);
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(columns));
    Isometry3::from_parts(Translation3::from(start.coords), turn)
}

/// The loft of a shape over a length.
fn body(shape: &BeamShape, length: f64) -> Result<Body, step::BodyError> {
    let stations = shape
        .stations
        .iter()
        .map(|s| station(s, length))
        .collect::<Result<Vec<_>, step::BodyError>>()?;
    Ok(Body::Loft(Loft::between_stations(stations)))
}

fn station(station: &ShapeStation, length: f64) -> Result<Station, step::BodyError> {
    Ok(Station {
        z: station.at * length,
        outer: outline(&station.region.outer)?,
        holes: station.region.holes.iter().map(outline).collect::<Result<_, _>>()?,
    })
}

fn outline(outline: &Outline) -> Result<step::Outline, step::BodyError> {
    Ok(match outline {
        Outline::Circle { centre, radius } => {
            step::Outline::Circle { centre: *centre, radius: *radius }
        }
        Outline::Ellipse { centre, half_axes, turn } => {
            step::Outline::Ellipse { centre: *centre, half_axes: *half_axes, turn: *turn }
        }
        Outline::Path(path) => step::Outline::Path(step::Path {
            start: path.start,
            segments: path
                .segments
                .iter()
                .map(|s| match *s {
                    Segment::Line { to } => step::Segment::Line { to },
                    Segment::Arc { to, sweep } => step::Segment::Arc { to, sweep },
                })
                .collect(),
        }),
        Outline::Freeform(curve) => {
            step::Outline::Freeform(step::Freeform::through(curve.points())?)
        }
    })
}
