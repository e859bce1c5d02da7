//! Round holes and bosses: rings of narrow flat faces between two circles made one cylinder.

use std::collections::HashMap;

use nalgebra::{Point3, Vector3};

use crate::output::step::{Circle, Facet, Facets, Loop};

/// Fewest corners of a circle: a hole of eight or ten sides may be meant as one.
const FEWEST: usize = 12;

/// How far corners of a circle may lie off it, in radii: single precision and a little more. The
/// circle of a hole cut from voxels is off by tenths.
const ROUND: f64 = 1e-4;

/// A loop of corners: its face and its place there, 0 for the outside.
type Place = (usize, usize);

/// Makes cylinders of all rings of faces that are exactly round.
pub(super) fn rounded(mut facets: Facets) -> Facets {
    let sides = sides(&facets);
    let mut gone = vec![false; facets.faces.len()];
    let mut cylinders = Vec::new();
    for (place, lower) in circular(&facets) {
        let Some((other, strips)) = ring_of_strips(&facets, &sides, place) else { continue };
        let Some(upper) = corners(&facets, other).and_then(|c| circle(&facets, c)) else {
            continue;
        };
        if gone[strips[0]] || !is_one_cylinder(&lower, &upper) {
            continue;
        }
        let bore = faces_its_axis(&facets, strips[0], &lower);
        strips.iter().for_each(|&face| gone[face] = true);
        cylinders.push((place, lower, other, upper, bore));
    }
    for (place, lower, other, upper, bore) in cylinders {
        let axis = upper.centre - lower.centre;
        let radius = 0.5 * (lower.radius + upper.radius);
        let first = facets.circles.len();
        facets.circles.extend([lower, upper].map(|c| Circle { axis, radius, ..c }));
        *loop_at(&mut facets, place) = Loop::Circle(first);
        *loop_at(&mut facets, other) = Loop::Circle(first + 1);
        facets.faces.push(Facet::Round { circles: [first, first + 1], bore });
        gone.push(false);
    }
    let mut marks = gone.iter();
    facets.faces.retain(|_| !marks.next().is_some_and(|g| *g));
    facets
}

/// Drops the corners that no face uses.
pub(super) fn compact(mut facets: Facets) -> Facets {
    let mut new_index = vec![u32::MAX; facets.corners.len()];
    let mut used = Vec::new();
    for face in &mut facets.faces {
        let Facet::Flat { outer, inner, .. } = face else { continue };
        for boundary in std::iter::once(outer).chain(inner) {
            let Loop::Corners(corners) = boundary else { continue };
            for c in corners {
                let new = &mut new_index[*c as usize];
                if *new == u32::MAX {
                    *new = used.len() as u32;
                    used.push(facets.corners[*c as usize]);
                }
                *c = *new;
            }
        }
    }
    facets.corners = used;
    facets
}

fn loops(face: &Facet) -> impl Iterator<Item = &Loop> {
    let (outer, inner) = match face {
        Facet::Flat { outer, inner, .. } => (Some(outer), inner.as_slice()),
        Facet::Round { .. } => (None, &[][..]),
    };
    outer.into_iter().chain(inner)
}

fn corners(facets: &Facets, (face, place): Place) -> Option<&[u32]> {
    match loops(&facets.faces[face]).nth(place) {
        Some(Loop::Corners(corners)) => Some(corners),
        _ => None,
    }
}

fn loop_at(facets: &mut Facets, (face, place): Place) -> &mut Loop {
    match &mut facets.faces[face] {
        Facet::Flat { outer, .. } if place == 0 => outer,
        Facet::Flat { inner, .. } => &mut inner[place - 1],
        Facet::Round { .. } => unreachable!("only flat faces have loops of corners"),
    }
}

/// The loop each directed side belongs to.
fn sides(facets: &Facets) -> HashMap<(u32, u32), Place> {
    let mut sides = HashMap::new();
    for (f, face) in facets.faces.iter().enumerate() {
        for (place, boundary) in loops(face).enumerate() {
            let Loop::Corners(c) = boundary else { continue };
            let next = c.iter().cycle().skip(1);
            sides.extend(c.iter().zip(next).map(|(&a, &b)| ((a, b), (f, place))));
        }
    }
    sides
}

/// All loops whose corners lie on a circle.
fn circular(facets: &Facets) -> Vec<(Place, Circle)> {
    let mut found = Vec::new();
    for (f, face) in facets.faces.iter().enumerate() {
        for place in 0..loops(face).count() {
            let circle = corners(facets, (f, place)).and_then(|c| circle(facets, c));
            found.extend(circle.map(|c| ((f, place), c)));
        }
    }
    found
}

/// The circle through corners, if they are many and close to it.
fn circle(facets: &Facets, corners: &[u32]) -> Option<Circle> {
    let n = corners.len();
    if n < FEWEST {
        return None;
    }
    let at = |i: usize| facets.corners[corners[i] as usize];
    let (a, b, c) = (at(0), at(n / 3), at(2 * n / 3));
    let (u, v) = (b - a, c - a);
    let axis = u.cross(&v);
    let centre = a
        + (axis.cross(&u) * v.norm_squared() + v.cross(&axis) * u.norm_squared())
            / (2.0 * axis.norm_squared());
    let radius = (a - centre).norm();
    let longest = 2.0 * radius * (std::f64::consts::PI / FEWEST as f64).sin() * (1.0 + ROUND);
    let fits = (0..n).all(|i| {
        let p = at(i);
        ((p - centre).norm() - radius).abs() <= ROUND * radius
            && (p - at((i + 1) % n)).norm() <= longest
    });
    (fits && radius > 0.0).then_some(Circle { centre, axis, radius })
}

/// The loop at the other end of the four-sided faces around a loop, and those faces.
fn ring_of_strips(
    facets: &Facets,
    sides: &HashMap<(u32, u32), Place>,
    place: Place,
) -> Option<(Place, Vec<usize>)> {
    let around = corners(facets, place)?;
    let next = around.iter().cycle().skip(1);
    let mut other = None;
    let mut strips = Vec::with_capacity(around.len());
    for (&a, &b) in around.iter().zip(next) {
        let &(strip, _) = sides.get(&(b, a))?;
        let quad = corners(facets, (strip, 0)).filter(|c| c.len() == 4)?;
        let at = quad.iter().position(|&c| c == b)?;
        let opposite = (quad[(at + 2) % 4], quad[(at + 3) % 4]);
        let &beyond = sides.get(&(opposite.1, opposite.0))?;
        if loops(&facets.faces[strip]).count() != 1 || *other.get_or_insert(beyond) != beyond {
            return None;
        }
        strips.push(strip);
    }
    let other = other.filter(|o| o.0 != place.0)?;
    (corners(facets, other)?.len() == around.len()).then_some((other, strips))
}

fn is_one_cylinder(a: &Circle, b: &Circle) -> bool {
    let between = b.centre - a.centre;
    let along = |axis: &Vector3<f64>| {
        between.cross(axis).norm() <= ROUND * between.norm().min(a.radius) * axis.norm()
    };
    between.norm() > ROUND * a.radius
        && (a.radius - b.radius).abs() <= ROUND * a.radius
        && along(&a.axis)
        && along(&b.axis)
}

fn faces_its_axis(facets: &Facets, strip: usize, circle: &Circle) -> bool {
    let Facet::Flat { normal, outer: Loop::Corners(c), .. } = &facets.faces[strip] else {
        return false;
    };
    let at = |i: u32| facets.corners[i as usize].coords;
    let middle = Point3::from(c.iter().map(|&i| at(i)).sum::<Vector3<f64>>() / c.len() as f64);
    let axis = circle.axis.normalize();
    let out = middle - circle.centre;
    (out - axis * axis.dot(&out)).dot(normal) < 0.0
}
