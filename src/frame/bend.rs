//! Breaks pieces that bend, where that is worth a node.
//!
//! The centroids along a piece are followed by a chain of straight parts with its corners in some
//! of them. Of all chains the one is taken that costs least:
//!
//! ```text
//!   cost = Σ_centroids (offset in half-depths)² · (length it stands for, in radii)  +  price · corners
//! ```
//!
//! A branch that bends sharply gets its corner at the bend; a bow gets corners along it. The least
//! is found exactly, from every chain to the next centroid on (dynamic programming, Bellman 1961).

use nalgebra::Point3;
use rustc_hash::FxHashMap;

use super::NodeKind;
use super::beam_station::BeamStation;
use super::depth::Depths;
use super::deviation::worst;
use super::pieces::{Making, Piece};
use crate::segment;

/// Price of a corner, in squares of the wanted deviation times a length of one radius. A straight
/// voxel strut of 20 radii costs 0.2 of the 0.5 at the default; an arm of 8 radii whose end is bent
/// away by one radius 2.7.
const PRICE: f64 = 2.0;

/// No part is shorter than this many radii: as long as half its width, like the nodes that are
/// made one.
const SHORTEST_PART: f64 = 1.0;

/// The same towards a junction: the branch turns into it over the radius of the other branches.
const SHORTEST_AT_JUNCTION: f64 = 1.5;

/// A centroid on the way, with what it is left by.
struct Stop {
    /// Index among the points of the piece.
    at: usize,
    centroid: Point3<f64>,
    depths: Depths,
    /// 1 for a clean section, towards 0 for a swollen one.
    weight: f64,
}

/// Breaks the pieces that bend away by more than wanted; whether there was any.
pub(super) fn split_bent(making: &mut Making<'_>) -> bool {
    let mut corners = Vec::new();
    for (i, piece) in making.pieces.iter().enumerate() {
        // A member was found straight before it was joined.
        let is_bent = piece.passes.is_empty()
            && worst(making, piece).is_some_and(|w| w.depths > making.tolerances[piece.branch]);
        if is_bent {
            corners.extend(corners_of(making, piece).into_iter().map(|at| (i, at)));
        }
    }
    for &(i, at) in corners.iter().rev() {
        making.split(i, at);
    }
    !corners.is_empty()
}

/// Part of the wanted deviation within which two parts are straightened again: the nodes move once
/// more thereafter.
const STRAIGHT_AGAIN: f64 = 0.7;

/// Takes out corners that have become needless since other nodes moved; whether there was any.
pub(super) fn rejoin_straight(making: &mut Making<'_>) -> bool {
    let mut joined = false;
    // For every piece how far it and the next are from their straight axis, if they may be one.
    let mut bends: Vec<Option<f64>> =
        (0..making.pieces.len()).map(|first| needless(making, first)).collect();
    while let Some(first) = straightest(&bends) {
        making.join_at_corner(first);
        bends.remove(first + 1);
        joined = true;
        bends[first] = needless(making, first);
        if let Some(before) = first.checked_sub(1) {
            bends[before] = needless(making, before);
        }
    }
    joined
}

/// The first piece of the corner whose straightening takes its centroids least far from the axis.
fn straightest(bends: &[Option<f64>]) -> Option<usize> {
    let found = bends.iter().enumerate().filter_map(|(first, far)| far.map(|far| (first, far)));
    found.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(first, _)| first)
}

/// How far the centroids of a piece and the next are from one straight axis for both, in half-depths,
/// if a corner lies between them and is needless.
fn needless(making: &Making<'_>, first: usize) -> Option<f64> {
    if !making.is_corner(first) {
        return None;
    }
    let [a, b] = [first, first + 1].map(|i| &making.pieces[i]);
    let ends = [a.ends[0], b.ends[1]].map(|n| making.nodes[n].position);
    let far = [a, b].into_iter().flat_map(|p| offsets_from(making, p, ends)).fold(0.0, f64::max);
    (far <= STRAIGHT_AGAIN * making.tolerances[a.branch]).then_some(far)
}

/// Distances of the own centroids of a piece from an axis, in half-depths.
pub(super) fn offsets_from(
    making: &Making<'_>,
    piece: &Piece,
    [a, b]: [Point3<f64>; 2],
) -> Vec<f64> {
    let offset = |s: &Stop| s.depths.in_depths(&segment::offset(&s.centroid, &a, &b));
    stops(making, piece).iter().filter(|s| s.weight >= 0.5).map(offset).collect()
}

/// Most points of a piece that are weighed as corners, since the time grows with the cube of their
/// number. A piece 500 radii long has as many; of a longer one, a coil of wire, every other is asked.
const MOST_STOPS: usize = 512;

/// The points of a piece at which it is broken, ascending.
fn corners_of(making: &Making<'_>, piece: &Piece) -> Vec<usize> {
    let radius = making.radius(piece);
    let mut stops = stops(making, piece);
    let stride = stops.len().div_ceil(MOST_STOPS).max(1);
    stops = stops.into_iter().step_by(stride).collect();
    let [start, end] = making.axis(piece);
    let count = stops.len();
    if count < 2 || radius <= 0.0 {
        return Vec::new();
    }
    let place = |k: usize| match k {
        0 => start,
        k if k > count => end,
        k => stops[k - 1].centroid,
    };
    let share = (end - start).norm() / count as f64 / radius;
    // What a chain costs by its next corner, unless it is more than is known to be needed.
    let chain = |before: f64, from: usize, to: usize, corner: f64, most: f64| {
        let (a, b) = (place(from), place(to));
        let mut part = 0.0;
        for s in &stops[from..to - 1] {
            let offset = segment::offset(&s.centroid, &a, &b);
            part += s.weight * share * s.depths.in_depths(&offset).powi(2);
            if before + part > most {
                return None;
            }
        }
        Some(before + part + corner).filter(|cost| *cost <= most)
    };
    let least_length = |from: usize, to: usize| {
        let at_junction = |n: usize| making.nodes[piece.ends[n]].kind == NodeKind::Junction;
        let meets_junction = (from == 0 && at_junction(0)) || (to > count && at_junction(1));
        radius * if meets_junction { SHORTEST_AT_JUNCTION } else { SHORTEST_PART }
    };
    let price = PRICE * making.tolerances[piece.branch].powi(2);
    // best[k]: least cost of a chain from the start to place k, and the place before.
    let mut best = vec![(0.0, 0)];
    for to in 1..=count + 1 {
        let candidates = (0..to).filter(|&from| {
            let whole = from == 0 && to == count + 1;
            whole || (place(to) - place(from)).norm() >= least_length(from, to)
        });
        // Short parts first: what they cost ends the look at the long ones. Of equals the longest.
        let mut least: (f64, usize) = (f64::INFINITY, 0);
        for from in candidates.rev() {
            let corner = if from == 0 { 0.0 } else { price };
            if let Some(cost) = chain(best[from].0, from, to, corner, least.0) {
                least = (cost, from);
            }
        }
        best.push(least);
    }
    let mut corners = Vec::new();
    let mut place = best[count + 1].1;
    while place > 0 {
        corners.push(stops[place - 1].at);
        place = best[place].1;
    }
    corners.reverse();
    corners
}

fn stops(making: &Making<'_>, piece: &Piece) -> Vec<Stop> {
    let stations = making.beam_section(piece).stations;
    let radius = making.radius(piece);
    let station_of: FxHashMap<u32, &BeamStation> = stations.iter().map(|s| (s.point, s)).collect();
    let own = |p: &u32| station_of.get(p).map_or(0.0, |s| making.own(piece, radius, s));
    let points = piece.points.iter().enumerate();
    points
        .filter_map(|(at, &p)| {
            let centroid = making.sections[p as usize].as_ref()?.centroid;
            Some(Stop { at, centroid, depths: making.depths[p as usize]?, weight: own(&p) })
        })
        .collect()
}
