//! Non-design parts as solids of their own: real planar faces, real round holes.
//!
//! ```text
//!   set of faces, open        closed over its         coplanar triangles     rings of narrow
//!   where the design was  →   interface sections  →   one face            →  faces one cylinder
//!        closed                    closed                 planes                 rounds
//! ```
//!
//! A part that is no sound solid this way is tried with a face a triangle. What is still none, and
//! what would bring more than [`FACE_BUDGET`] faces into the STEP file, goes into a mesh file
//! beside it, with a finding.
//!
//! # What does not hold
//! Curved faces other than full cylinders stay as many flat ones as the mesh has. A set that is
//! only the wall of a hole encloses no material and is left out, with a finding.

mod closed;
mod planes;
mod rounds;

use nalgebra::Isometry3;

use super::mesh_export::PartMesh;
use super::step::{Body, Facets, Part, Property, Value};
use crate::finding::{Finding, FindingKind};
use crate::mesh::Surface;
use crate::mesh::id::SetId;
use closed::Closed;

/// Most faces of all non-design solids together in a STEP file: 5 MB, and ten seconds to open.
pub const FACE_BUDGET: usize = 5000;

/// Non-design parts are darker than balls and stand for no profile.
const COLOUR: [u8; 3] = [110, 110, 115];

/// The non-design parts of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NonDesign {
    /// Solids for the STEP file.
    pub parts: Vec<Part>,
    /// What goes beside it, as closed meshes.
    pub meshes: Vec<PartMesh>,
    /// What could not be made, and what was put beside.
    pub findings: Vec<Finding>,
}

/// Makes solids of the non-design sets of a surface.
///
/// * `density`: kg/m³, for the masses.
pub fn non_design(surface: &Surface, density: f64) -> NonDesign {
    let mut found = NonDesign::default();
    let mut bodies = Vec::new();
    for set in (0..surface.labels.sets).map(SetId::new) {
        let closed = closed::bodies_of(surface, set).unwrap_or_default();
        let solid: Vec<Closed> = closed.into_iter().filter(|b| b.volume() > 0.0).collect();
        if solid.is_empty() {
            found.findings.push(no_material(surface, set));
        }
        bodies.extend(solid);
    }
    let solids: Vec<Option<Facets>> = bodies.iter().map(solid).collect();
    let fits = within_budget(&solids);
    for (i, (body, facets)) in bodies.iter().zip(solids).enumerate() {
        let name = format!("N{:03} Non-design", i + 1);
        match facets.filter(|_| fits[i]) {
            Some(facets) => found.parts.push(part(name, i, facets, density)),
            None => {
                found.findings.push(beside(&name, body));
                found.meshes.push(mesh(name, body));
            }
        }
    }
    found
}

/// The body with as few faces as its shape allows; `None` if no form of it is a sound solid.
fn solid(body: &Closed) -> Option<Facets> {
    let merged = planes::merged(body);
    let round = merged.clone().map(rounds::rounded);
    let sound = |facets: Facets| {
        let facets = rounds::compact(facets);
        Body::Facets(facets.clone()).check().is_ok().then_some(facets)
    };
    let plain = || (body.triangles.len() <= FACE_BUDGET).then(|| planes::unmerged(body));
    round.and_then(sound).or_else(|| merged.and_then(sound)).or_else(|| plain().and_then(sound))
}

/// Which solids stay within the budget together, those of few faces first.
fn within_budget(solids: &[Option<Facets>]) -> Vec<bool> {
    let count = |i: usize| solids[i].as_ref().map_or(0, |f| f.faces.len());
    let mut order: Vec<usize> = (0..solids.len()).collect();
    order.sort_by_key(|&i| (count(i), i));
    let mut fits = vec![false; solids.len()];
    let mut total = 0;
    for i in order {
        total += count(i);
        fits[i] = total <= FACE_BUDGET;
    }
    fits
}

fn part(name: String, index: usize, facets: Facets, density: f64) -> Part {
    let faces = facets.faces.len() as i32;
    let body = Body::Facets(facets);
    let volume = body.volume().unwrap_or(0.0);
    Part {
        name,
        product: format!("Non-design {}", index + 1),
        colour: COLOUR,
        placement: Isometry3::identity(),
        body,
        properties: vec![
            Property::new("volume", Value::Volume(volume)),
            Property::new("mass", Value::Mass(volume * density * 1e-9)),
            Property::new("faces", Value::Count(faces)),
        ],
    }
}

fn mesh(name: String, body: &Closed) -> PartMesh {
    let (points, triangles) = (body.points.clone(), body.triangles.clone());
    PartMesh { name, colour: COLOUR, points, triangles }
}

fn beside(name: &str, body: &Closed) -> Finding {
    let text = format!(
        "{name} has too many faces for the STEP file ({} triangles, at most {FACE_BUDGET} faces in \
         all), or does not close up as a solid; it is in a mesh file beside it",
        body.triangles.len()
    );
    Finding::note(FindingKind::NonDesign, body.points.first().copied(), text)
}

fn no_material(surface: &Surface, set: SetId) -> Finding {
    let text = format!(
        "non-design set {} encloses no material of its own (the wall of a hole?); it is no part of \
         the STEP file",
        set.index() + 1
    );
    let place = surface.interfaces.iter().find(|i| i.set == set).map(|i| i.centroid);
    Finding::note(FindingKind::NonDesign, place, text)
}
