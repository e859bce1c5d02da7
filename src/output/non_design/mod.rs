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
//! A ring of strips is a cylinder where the mesh says so: at least twelve corners on each of two
//! circles, all within 1e-4 radii of them, however coarse. Such a hole is larger than its polygon,
//! at twelve corners by 5 % in area. With fewer corners, or corners off the circle, the strips
//! stay faces of their own: the hole may be meant as a polygon.
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
        match facets {
            Some(facets) if fits[i] => found.parts.push(part(name, i, facets, density)),
            facets => {
                found.findings.push(beside(&name, body, facets.is_some()));
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

fn beside(name: &str, body: &Closed, is_solid: bool) -> Finding {
    let triangles = body.triangles.len();
    let why = if is_solid || triangles > FACE_BUDGET {
        format!(
            "has too many faces for the STEP file ({triangles} triangles, at most {FACE_BUDGET} \
             faces in all)"
        )
    } else {
        "does not close up as a solid".to_owned()
    };
    let text = format!("{name} {why}; it is in a mesh file beside the STEP file");
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

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_4, PI, TAU};

    use nalgebra::Point3;

    use super::*;
    use crate::output::step::{Facet, Loop};

    const SIDE: f64 = 40.0;
    const HEIGHT: f64 = 12.0;
    const RADIUS: f64 = 9.0;

    type Mesh = (Vec<Point3<f64>>, Vec<[u32; 3]>);

    /// A square block with a hole of `sides` sides, a multiple of four, from top to bottom.
    ///
    /// * `off`: distance of corner i of the hole from its axis, in radii.
    fn block(sides: usize, off: impl Fn(usize) -> f64) -> Mesh {
        let square = |i: usize| {
            let (quarter, part) = (i / (sides / 4), (i % (sides / 4)) as f64 / (sides / 4) as f64);
            let corner = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
            let (a, b) = (corner[quarter], corner[(quarter + 1) % 4]);
            [0, 1].map(|k| 0.5 * SIDE * (a[k] + part * (b[k] - a[k])))
        };
        let hole = |i: usize| {
            let (sin, cos) = (FRAC_PI_4 + TAU * i as f64 / sides as f64).sin_cos();
            [cos, sin].map(|x| x * RADIUS * off(i))
        };
        let mut points = Vec::new();
        for z in [0.0, HEIGHT] {
            points.extend((0..sides).map(square).map(|[x, y]| Point3::new(x, y, z)));
            points.extend((0..sides).map(hole).map(|[x, y]| Point3::new(x, y, z)));
        }
        // Rings: square and hole below, square and hole above.
        let at = |ring: usize, i: usize| (ring * sides + i % sides) as u32;
        let mut triangles = Vec::new();
        for i in 0..sides {
            for (from, to) in [(0, 2), (2, 3), (3, 1), (1, 0)] {
                let [a, b, c, d] = [at(from, i), at(from, i + 1), at(to, i + 1), at(to, i)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        (points, triangles)
    }

    /// Every triangle divided into four.
    fn divided((mut points, triangles): Mesh) -> Mesh {
        let mut middles = std::collections::BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push(nalgebra::center(&points[a as usize], &points[b as usize]));
                points.len() as u32 - 1
            })
        };
        let quarters = |&[a, b, c]: &[u32; 3]| {
            let [p, q, r] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, p, r], [p, b, q], [r, q, c], [p, q, r]]
        };
        let all = triangles.iter().flat_map(quarters).collect();
        (points, all)
    }

    fn facets((points, triangles): Mesh) -> Facets {
        let bodies = closed::of_triangles(&points, &triangles).expect("closed");
        solid(&bodies[0]).expect("a solid")
    }

    /// Flat faces, those of them with a hole, and bores.
    fn counted(facets: &Facets) -> [usize; 3] {
        let count = |is: &dyn Fn(&Facet) -> bool| facets.faces.iter().filter(|f| is(f)).count();
        [
            count(&|f| matches!(f, Facet::Flat { .. })),
            count(&|f| matches!(f, Facet::Flat { inner, .. } if inner.len() == 1)),
            count(&|f| matches!(f, Facet::Round { bore: true, .. })),
        ]
    }

    fn has_volume(facets: &Facets, area_of_hole: f64) {
        let exact = (SIDE * SIDE - area_of_hole) * HEIGHT;
        let volume = Body::Facets(facets.clone()).check().expect("a closed solid");
        assert!((volume / exact - 1.0).abs() < 1e-9, "{volume} mm³ for {exact} mm³");
    }

    #[test]
    fn a_bolt_hole_becomes_a_cylinder_and_the_rest_six_planes() {
        for mesh in [block(24, |_| 1.0), divided(block(24, |_| 1.0)), block(120, |_| 1.0)] {
            let facets = facets(mesh);
            assert_eq!(counted(&facets), [6, 2, 1]);
            assert!((facets.circles[0].radius - RADIUS).abs() < 1e-9 * RADIUS);
            assert_eq!(facets.corners.len(), 8);
            has_volume(&facets, PI * RADIUS * RADIUS);
        }
    }

    #[test]
    fn a_hole_of_twelve_sides_on_a_circle_is_meant_round() {
        let facets = facets(block(12, |_| 1.0));
        assert_eq!(counted(&facets), [6, 2, 1]);
        has_volume(&facets, PI * RADIUS * RADIUS);
    }

    #[test]
    fn a_hole_of_eight_sides_stays_one() {
        let facets = facets(block(8, |_| 1.0));
        assert_eq!(counted(&facets), [14, 2, 0]);
        has_volume(&facets, 0.5 * 8.0 * RADIUS * RADIUS * (TAU / 8.0).sin());
    }

    #[test]
    fn a_hole_whose_corners_are_off_the_circle_stays_faceted() {
        let off = |i: usize| if i.is_multiple_of(2) { 1.0 } else { 1.001 };
        let facets = facets(block(24, off));
        assert_eq!(counted(&facets), [30, 2, 0]);
        has_volume(&facets, 0.5 * 24.0 * RADIUS * RADIUS * 1.001 * (TAU / 24.0).sin());
        // In single precision they are on it.
        let single = block(24, |i| f64::from((1.0 + 1e-7 * (i as f64).sin()) as f32));
        assert_eq!(counted(&self::facets(single))[2], 1);
    }

    #[test]
    fn a_face_with_a_hole_has_one_outside_and_one_inside() {
        let facets = facets(block(24, |_| 1.0));
        let with_hole = facets.faces.iter().find_map(|f| match f {
            Facet::Flat { outer, inner, .. } if !inner.is_empty() => Some((outer, inner)),
            _ => None,
        });
        let (outer, inner) = with_hole.expect("a face with a hole");
        assert!(matches!(outer, Loop::Corners(c) if c.len() == 4));
        assert!(matches!(inner[..], [Loop::Circle(_)]));
    }

    #[test]
    fn the_budget_goes_to_parts_of_few_faces_first() {
        let of_faces = |n: usize| {
            let mut facets = facets(block(8, |_| 1.0));
            facets.faces = facets.faces.iter().cycle().take(n).cloned().collect();
            Some(facets)
        };
        let solids = [of_faces(FACE_BUDGET - 10), of_faces(14), None, of_faces(7)];
        assert_eq!(within_budget(&solids), [false, true, true, true]);
    }
}
