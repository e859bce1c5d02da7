//! The tables that are compiled in; see `data/profiles`.

use super::{Catalogue, Entry};

/// The tables in the order they are listed.
const TABLES: [&str; 18] = [
    include_str!("../../../data/profiles/en_chs.csv"),
    include_str!("../../../data/profiles/en_shs.csv"),
    include_str!("../../../data/profiles/en_rhs.csv"),
    include_str!("../../../data/profiles/en_cfshs.csv"),
    include_str!("../../../data/profiles/en_cfrhs.csv"),
    include_str!("../../../data/profiles/en_ipe.csv"),
    include_str!("../../../data/profiles/en_hea.csv"),
    include_str!("../../../data/profiles/en_heb.csv"),
    include_str!("../../../data/profiles/en_hem.csv"),
    include_str!("../../../data/profiles/en_upe.csv"),
    include_str!("../../../data/profiles/en_l.csv"),
    include_str!("../../../data/profiles/en_round.csv"),
    include_str!("../../../data/profiles/en_flat.csv"),
    include_str!("../../../data/profiles/aisc_w.csv"),
    include_str!("../../../data/profiles/aisc_hss_round.csv"),
    include_str!("../../../data/profiles/aisc_hss_square.csv"),
    include_str!("../../../data/profiles/aisc_hss_rect.csv"),
    include_str!("../../../data/profiles/aisc_pipe.csv"),
];

/// Reads all tables.
///
/// # Panics
/// If a table is malformed; a test reads them all.
pub(super) fn read() -> Catalogue {
    let entries: Vec<Entry> = TABLES
        .into_iter()
        .flat_map(|text| match Catalogue::parse_csv(text, "") {
            Ok(catalogue) => catalogue.entries,
            Err(fault) => panic!("{fault} in\n{text:.200}"),
        })
        .collect();
    Catalogue { entries }
}
