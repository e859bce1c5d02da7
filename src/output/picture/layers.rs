//! Opaque pieces in as few shapes as hide each other rightly.
//!
//! Drawn one by one from back to front, pieces hide what lies behind them. Many of them may be drawn
//! at once all the same: a piece joins an earlier shape of its colour where nothing that came
//! between lies over a place it is seen at. What is seen where, a depth buffer knows; pieces that are
//! seen nowhere are left out.

use nalgebra::Point3;
use rustc_hash::FxHashMap;

use super::outline::Outline;
use super::raster::visit;

/// Places of the depth buffer for one pixel, each way.
const FINE: f64 = 2.0;

/// How far behind what is seen there a sliver may lie, pixels: its neighbours are as near as that.
const SLACK: f32 = 2.0;

/// A facet, or a part of one, corners in pixels.
pub(super) struct Piece {
    pub(super) corners: [Point3<f64>; 3],
    pub(super) colour: [u8; 3],
}

/// Pieces of one colour that are drawn at once.
pub(super) struct Layer {
    pub(super) colour: [u8; 3],
    pub(super) outline: Outline,
}

/// Layers from back to front.
///
/// * `pieces`: in any order.
/// * `place`: left, top, width and height of the panel they lie in, pixels.
pub(super) fn layers(mut pieces: Vec<Piece>, [left, top, width, height]: [f64; 4]) -> Vec<Layer> {
    let depth = |p: &Piece| p.corners.iter().map(|c| c.z).sum::<f64>();
    pieces.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    let [columns, rows] = [width, height].map(|x| (FINE * x).ceil() as usize);
    let place = |p: Point3<f64>| Point3::new(FINE * (p.x - left), FINE * (p.y - top), p.z);
    let cover = |piece: &Piece, pixel: &mut dyn FnMut(usize, f32)| {
        visit(&piece.corners.map(place), columns, rows, pixel);
    };

    let mut seen = vec![(f32::NEG_INFINITY, usize::MAX); columns * rows];
    for (i, piece) in pieces.iter().enumerate() {
        cover(piece, &mut |at, depth| {
            if depth > seen[at].0 {
                seen[at] = (depth, i);
            }
        });
    }

    // Slivers between the places of the buffer go with their neighbours.
    let in_front = |piece: &Piece| {
        let [a, b, c] = piece.corners.map(place);
        let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
        let [column, row] = [middle.x, middle.y].map(|x| x.max(0.0) as usize);
        let behind = seen.get(row * columns + column.min(columns - 1));
        behind.is_some_and(|(depth, _)| middle.z as f32 > depth - SLACK)
    };

    let mut layers: Vec<Layer> = Vec::new();
    // Number of layers up to the highest that lies over a place.
    let mut over = vec![0; columns * rows];
    let mut newest: FxHashMap<[u8; 3], usize> = FxHashMap::default();
    for (i, piece) in pieces.iter().enumerate() {
        let (mut covers, mut least) = (false, None);
        cover(piece, &mut |at, _| {
            covers = true;
            if seen[at].1 == i {
                least = least.max(Some(over[at]));
            }
        });
        if !covers && in_front(piece) {
            least = Some(0);
        }
        let Some(least) = least else { continue };
        let own = newest.get(&piece.colour).copied().filter(|layer| layer + 1 >= least);
        let layer = own.unwrap_or_else(|| {
            layers.push(Layer { colour: piece.colour, outline: Outline::default() });
            layers.len() - 1
        });
        newest.insert(piece.colour, layer);
        layers[layer].outline.add(&piece.corners);
        cover(piece, &mut |at, _| over[at] = over[at].max(layer + 1));
    }
    layers
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: [u8; 3] = [255, 0, 0];
    const BLUE: [u8; 3] = [0, 0, 255];

    /// The lower left half of a square of 10 pixels.
    fn piece(left: f64, depth: f64, colour: [u8; 3]) -> Piece {
        let corners = [[0.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
        Piece { corners: corners.map(|[x, y]| Point3::new(left + x, y, depth)), colour }
    }

    fn colours(pieces: Vec<Piece>) -> Vec<[u8; 3]> {
        layers(pieces, [0.0, 0.0, 40.0, 20.0]).iter().map(|l| l.colour).collect()
    }

    #[test]
    fn pieces_beside_each_other_share_a_layer() {
        let row = vec![piece(0.0, 1.0, RED), piece(10.0, 2.0, BLUE), piece(20.0, 3.0, RED)];
        assert_eq!(colours(row), [RED, BLUE]);
    }

    #[test]
    fn a_piece_before_another_colour_lies_in_a_layer_above() {
        let stack = vec![piece(3.0, 3.0, RED), piece(0.0, 1.0, RED), piece(1.5, 2.0, BLUE)];
        assert_eq!(colours(stack), [RED, BLUE, RED]);
    }

    #[test]
    fn what_is_hidden_is_left_out() {
        assert_eq!(colours(vec![piece(0.0, 1.0, RED), piece(0.0, 2.0, BLUE)]), [BLUE]);
    }
}
