//! Lays pieces into stock bars: best fit decreasing.
//!
//! ```text
//!  bar 1  │■■■■■■■■■■■■■│■■■■■■■■■│■■■■■■│░░░│   ■ piece   │ saw cut   ░ offcut
//!  bar 2  │■■■■■■■■■│■■■■■■■■■│░░░░░░░░░░░░░│
//! ```
//!
//! The longest piece first, each into the bar it leaves least of. The heuristic never takes more
//! than 11/9 of the fewest bars, and 1 more (Johnson, *Near-optimal bin packing algorithms*, 1973,
//! shows it for best fit decreasing as for first fit decreasing). Every cut costs a kerf, the one
//! behind the last piece too, where something is left of the bar.

use serde::Serialize;

use super::piece::Piece;

/// Bars pieces are cut from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Stock {
    /// Length of a bar, mm.
    pub length_mm: f64,
    /// Width of a saw cut, mm.
    pub kerf_mm: f64,
}

/// A stock that no piece can be cut from.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{name} must be {wanted}, but is {value}")]
pub struct StockError {
    name: &'static str,
    wanted: &'static str,
    value: f64,
}

/// Longest bar, mm: ten times the longest rails that are rolled.
pub const LONGEST_BAR: f64 = 1e6;

impl Stock {
    /// Checks the lengths.
    ///
    /// # Errors
    /// A length that is no length, or a kerf as long as the bar.
    pub fn check(&self) -> Result<(), StockError> {
        let (length, kerf) = (self.length_mm, self.kerf_mm);
        if !(length > 0.0 && length <= LONGEST_BAR) {
            let wanted = "a length above 0 and no more than 1,000,000 mm";
            return Err(StockError { name: "--stock-length", wanted, value: length });
        }
        if !(kerf >= 0.0 && kerf < length) {
            let wanted = "at least 0 and shorter than the bar";
            return Err(StockError { name: "--kerf", wanted, value: kerf });
        }
        Ok(())
    }
}

/// One bar and what is cut from it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bar {
    /// Its profile.
    pub profile: String,
    /// Marks of the pieces, in the order of cutting.
    pub pieces: Vec<String>,
    /// Their lengths, mm.
    pub lengths_mm: Vec<f64>,
    /// What is left of the bar, mm.
    pub offcut_mm: f64,
}

/// All bars.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Nesting {
    /// The stock.
    pub stock: Stock,
    /// The bars, by profile.
    pub bars: Vec<Bar>,
    /// Marks of pieces longer than a bar, once for each; they are not nested: to be ordered longer,
    /// or spliced.
    pub too_long: Vec<String>,
    /// Part of the bars that is no piece: offcuts and saw cuts.
    pub waste: f64,
}

/// Lays pieces into bars.
pub(super) fn nest(pieces: &[Piece], stock: Stock) -> Nesting {
    let (mut bars, mut too_long) = (Vec::<Bar>::new(), Vec::new());
    let mut first_of_profile = 0;
    // Pieces come sorted by profile, the longest first.
    for (i, piece) in pieces.iter().enumerate() {
        if i > 0 && pieces[i - 1].profile != piece.profile {
            first_of_profile = bars.len();
        }
        for _ in 0..piece.quantity {
            if piece.length_mm > stock.length_mm {
                too_long.push(piece.piece.clone());
                continue;
            }
            let bar = best_bar(&mut bars[first_of_profile..], piece.length_mm);
            match bar {
                Some(bar) => bar.cut(piece, stock),
                None => {
                    let mut bar = Bar::new(piece, stock);
                    bar.cut(piece, stock);
                    bars.push(bar);
                }
            }
        }
    }
    let whole = stock.length_mm * bars.len() as f64;
    let used: f64 = bars.iter().flat_map(|b| &b.lengths_mm).sum();
    let waste = if whole > 0.0 { 1.0 - used / whole } else { 0.0 };
    Nesting { stock, bars, too_long, waste }
}

/// The bar a piece leaves least of.
fn best_bar(bars: &mut [Bar], length: f64) -> Option<&mut Bar> {
    bars.iter_mut()
        .filter(|b| b.offcut_mm >= length)
        .min_by(|a, b| a.offcut_mm.total_cmp(&b.offcut_mm))
}

impl Bar {
    fn new(piece: &Piece, stock: Stock) -> Self {
        let profile = piece.profile.clone();
        Self { profile, pieces: Vec::new(), lengths_mm: Vec::new(), offcut_mm: stock.length_mm }
    }

    fn cut(&mut self, piece: &Piece, stock: Stock) {
        self.pieces.push(piece.piece.clone());
        self.lengths_mm.push(piece.length_mm);
        // What is thinner than a saw cut goes with it.
        self.offcut_mm = (self.offcut_mm - piece.length_mm - stock.kerf_mm).max(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn piece(name: &str, length_mm: f64, quantity: usize) -> Piece {
        Piece {
            piece: name.into(),
            marks: Vec::new(),
            quantity,
            profile: "Round 20".into(),
            family: "round".into(),
            standard: String::new(),
            material: String::new(),
            length_mm,
            axis_length_mm: length_mm,
            angle_1_deg: 0.0,
            angle_2_deg: 0.0,
            saddle_1_mm: 0.0,
            saddle_2_mm: 0.0,
            twist_deg: 0.0,
            lean_deg: 0.0,
            off_mm: 0.0,
            area_mm2: 314.0,
            unit_mass_kg: 1.0,
            mass_kg: 1.0,
            unit_surface_m2: 1.0,
            branches: Vec::new(),
        }
    }

    #[test]
    fn two_halves_and_their_saw_cut_do_not_fit_one_bar() {
        let stock = Stock { length_mm: 6000.0, kerf_mm: 2.0 };
        assert_eq!(nest(&[piece("P01", 3000.0, 2)], stock).bars.len(), 2);
        assert_eq!(nest(&[piece("P01", 2999.0, 2)], stock).bars.len(), 1);
    }

    #[test]
    fn a_piece_as_long_as_the_bar_needs_no_cut() {
        let stock = Stock { length_mm: 1000.0, kerf_mm: 3.0 };
        let nesting = nest(&[piece("P01", 1000.5, 1), piece("P02", 1000.0, 1)], stock);
        assert_eq!(nesting.too_long, ["P01"]);
        assert_eq!((nesting.bars.len(), nesting.waste), (1, 0.0));
    }

    #[test]
    fn a_stock_without_length_is_refused() {
        let message = Stock { length_mm: 0.0, kerf_mm: 2.0 }.check().unwrap_err().to_string();
        assert_eq!(
            message,
            "--stock-length must be a length above 0 and no more than 1,000,000 mm, but is 0"
        );
        assert!(Stock { length_mm: f64::NAN, kerf_mm: 2.0 }.check().is_err());
        assert!(Stock { length_mm: 10.0, kerf_mm: 10.0 }.check().is_err());
    }

    proptest! {
        #[test]
        fn no_bar_is_cut_up_beyond_its_length_and_no_piece_is_lost(
            mut lengths in prop::collection::vec((10.0..7000.0f64, 1..4usize), 1..30),
            kerf in 0.0..10.0f64,
        ) {
            lengths.sort_by(|a, b| b.0.total_cmp(&a.0));
            let pieces: Vec<Piece> = lengths
                .iter()
                .enumerate()
                .map(|(i, &(length, n))| piece(&format!("P{i}"), length, n))
                .collect();
            let nesting = nest(&pieces, Stock { length_mm: 6000.0, kerf_mm: kerf });
            let total: usize = pieces.iter().map(|p| p.quantity).sum();
            let nested: usize = nesting.bars.iter().map(|b| b.pieces.len()).sum();
            prop_assert_eq!(nested + nesting.too_long.len(), total);
            for bar in &nesting.bars {
                let cuts = kerf * (bar.pieces.len() - 1) as f64;
                prop_assert!(bar.lengths_mm.iter().sum::<f64>() + cuts <= 6000.0 + 1e-9);
            }
        }
    }
}
