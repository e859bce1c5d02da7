//! The nesting diagram: stock bars and what is cut from them, as parts of their length.
//!
//! ```text
//!  0                                        100 %
//!  │ P01 2400      │ P02 1800    │ P02 1800 ┊░░░│   │ saw cut   ░ offcut
//! ```

use crate::output::cut_list::{Bar, Nesting, Stock};

/// All bars of a cut list.
pub(super) struct Diagram {
    /// Length of a bar and width of a saw cut, mm.
    pub(super) stock: Stock,
    pub(super) bars: Vec<BarDrawing>,
    /// Marks of pieces no bar is long enough for.
    pub(super) too_long: String,
    /// Part of all bars that is no piece, %.
    pub(super) waste: String,
}

/// One bar.
pub(super) struct BarDrawing {
    pub(super) profile: String,
    pub(super) pieces: Vec<PieceDrawing>,
    pub(super) cuts: Vec<Span>,
    pub(super) offcut: Option<Span>,
    /// What is left of the bar, mm, as in the cut list.
    pub(super) offcut_mm: String,
    /// Part of the bar that is no piece, %.
    pub(super) waste: String,
    /// Its pieces in words.
    pub(super) words: String,
}

/// One piece on its bar.
pub(super) struct PieceDrawing {
    pub(super) piece: String,
    /// Length, mm.
    pub(super) length: f64,
    pub(super) span: Span,
}

/// Where something begins on a bar, and how wide it is, % of the bar.
pub(super) struct Span {
    pub(super) x: String,
    pub(super) width: String,
}

impl Diagram {
    pub(super) fn new(nesting: &Nesting) -> Self {
        Self {
            stock: nesting.stock,
            bars: nesting.bars.iter().map(|b| BarDrawing::new(b, nesting.stock)).collect(),
            too_long: nesting.too_long.join(" "),
            waste: percent(nesting.waste),
        }
    }
}

impl BarDrawing {
    fn new(bar: &Bar, stock: Stock) -> Self {
        let (mut pieces, mut cuts, mut at) = (Vec::new(), Vec::new(), 0.0);
        for (piece, &length) in bar.pieces.iter().zip(&bar.lengths_mm) {
            let span = Span::new(at, length, stock);
            pieces.push(PieceDrawing { piece: piece.clone(), length, span });
            at += length;
            let cut = stock.kerf_mm.min(stock.length_mm - at);
            if cut > 0.0 {
                cuts.push(Span::new(at, cut, stock));
                at += cut;
            }
        }
        let used: f64 = bar.lengths_mm.iter().sum();
        Self {
            profile: bar.profile.clone(),
            pieces,
            cuts,
            offcut: (bar.offcut_mm > 0.0).then(|| Span::new(at, bar.offcut_mm, stock)),
            offcut_mm: format!("{:.3}", bar.offcut_mm),
            waste: percent(1.0 - used / stock.length_mm),
            words: words(bar),
        }
    }
}

impl Span {
    fn new(from: f64, length: f64, stock: Stock) -> Self {
        let part = |mm: f64| format!("{:.4}", 100.0 * mm / stock.length_mm);
        Self { x: part(from), width: part(length) }
    }
}

fn percent(part: f64) -> String {
    format!("{:.1}", 100.0 * part)
}

/// `2 × P01 1200, P02 800`: the pieces of a bar from its beginning, equal neighbours together.
fn words(bar: &Bar) -> String {
    let pieces: Vec<(&String, &f64)> = bar.pieces.iter().zip(&bar.lengths_mm).collect();
    let equal = pieces.chunk_by(|a, b| a.0 == b.0).map(|equal| {
        let (piece, length) = equal[0];
        let times = if equal.len() > 1 { format!("{} × ", equal.len()) } else { String::new() };
        format!("{times}{piece} {length}")
    });
    equal.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    const STOCK: Stock = Stock { length_mm: 1000.0, kerf_mm: 10.0 };

    fn bar(lengths: &[f64], offcut_mm: f64) -> Bar {
        let pieces = lengths.iter().map(|l| format!("P{l}")).collect();
        Bar { profile: "Round 20".into(), pieces, lengths_mm: lengths.to_vec(), offcut_mm }
    }

    #[test]
    fn pieces_cuts_and_offcut_fill_the_bar_one_behind_the_other() {
        let drawn = BarDrawing::new(&bar(&[400.0, 400.0], 180.0), STOCK);
        let spans = |of: &Span| (of.x.clone(), of.width.clone());
        let pair = |x: &str, width: &str| (x.to_owned(), width.to_owned());
        let pieces: Vec<_> = drawn.pieces.iter().map(|p| spans(&p.span)).collect();
        assert_eq!(pieces, [pair("0.0000", "40.0000"), pair("41.0000", "40.0000")]);
        let cuts: Vec<_> = drawn.cuts.iter().map(spans).collect();
        assert_eq!(cuts, [pair("40.0000", "1.0000"), pair("81.0000", "1.0000")]);
        assert_eq!(drawn.offcut.as_ref().map(spans), Some(pair("82.0000", "18.0000")));
        assert_eq!((drawn.waste.as_str(), drawn.words.as_str()), ("20.0", "2 × P400 400"));
    }

    #[test]
    fn what_is_thinner_than_a_saw_cut_is_all_cut() {
        let drawn = BarDrawing::new(&bar(&[995.0], 0.0), STOCK);
        assert_eq!(drawn.cuts[0].width, "0.5000");
        assert!(drawn.offcut.is_none());
        assert!(BarDrawing::new(&bar(&[1000.0], 0.0), STOCK).cuts.is_empty());
    }
}
