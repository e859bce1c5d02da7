//! The names a file gives to its faces, each kept once.

use indexmap::IndexSet;

use crate::raw_mesh::LabelCarriers;

/// Most names, and most combinations of names, of one file.
///
/// A name of a few bytes takes some two hundred bytes of memory with its place in the tables. A
/// file made of nothing but names would thus take many times its size; no real part has so many.
pub(crate) const MOST_NAMES: usize = 250_000;

/// The file has more names than [`MOST_NAMES`].
#[derive(Debug)]
pub(crate) struct TooManyNames;

/// Names, and the sets of names that hold together for a face.
///
/// Sets are made when a face needs one, so names without faces leave no trace.
#[derive(Debug, Default)]
pub(crate) struct NameTable {
    names: IndexSet<String>,
    sets: IndexSet<Vec<u32>>,
    face_sets: Vec<u32>,
}

impl NameTable {
    /// The set of some names, told by bytes that need not be UTF-8; empty and doubled names fall out.
    ///
    /// The names must be few: each is looked for among all others.
    pub(crate) fn set<'n>(
        &mut self,
        names: impl IntoIterator<Item = &'n [u8]>,
    ) -> Result<u32, TooManyNames> {
        let mut set = Vec::new();
        for name in names.into_iter().filter(|name| !name.is_empty()) {
            let name = self.name(name)?;
            if !set.contains(&name) {
                set.push(name);
            }
        }
        let (index, _) = self.sets.insert_full(set);
        if index >= MOST_NAMES { Err(TooManyNames) } else { Ok(index as u32) }
    }

    fn name(&mut self, name: &[u8]) -> Result<u32, TooManyNames> {
        let name = String::from_utf8_lossy(name);
        let index = match self.names.get_index_of(name.as_ref()) {
            Some(index) => index,
            None => self.names.insert_full(name.into_owned()).0,
        };
        if index >= MOST_NAMES { Err(TooManyNames) } else { Ok(index as u32) }
    }

    /// Gives the next `count` faces a set.
    #[inline]
    pub(crate) fn give(&mut self, set: u32, count: usize) {
        self.face_sets.resize(self.face_sets.len() + count, set);
    }

    /// Moves everything to the carriers; nothing if no face has a name.
    pub(crate) fn move_to(self, carriers: &mut LabelCarriers) {
        if !self.names.is_empty() {
            carriers.names = self.names.into_iter().collect();
            carriers.name_sets = self.sets.into_iter().collect();
            carriers.face_names = self.face_sets;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_kept_once_and_a_set_too() {
        let mut table = NameTable::default();
        let first = table.set([&b"pad"[..], b"", b"steel", b"pad"]).unwrap();
        let second = table.set([&b"strut"[..], b"steel"]).unwrap();
        table.give(first, 2);
        table.give(second, 1);
        assert_eq!(table.set([&b"pad"[..], b"steel"]).unwrap(), first);
        let mut carriers = LabelCarriers::default();
        table.move_to(&mut carriers);
        assert_eq!(carriers.names, ["pad", "steel", "strut"]);
        assert_eq!(carriers.name_sets, [[0, 1], [2, 1]]);
        assert_eq!(carriers.face_names, [0, 0, 1]);
    }

    #[test]
    fn without_a_name_there_is_no_carrier() {
        let mut table = NameTable::default();
        let nameless = table.set([&b""[..]]).unwrap();
        table.give(nameless, 3);
        let mut carriers = LabelCarriers::default();
        table.move_to(&mut carriers);
        assert_eq!(carriers, LabelCarriers::default());
    }

    #[test]
    fn bytes_that_are_not_utf8_are_replaced() {
        let mut table = NameTable::default();
        table.set([&b"Tr\xe4ger"[..]]).unwrap();
        assert_eq!(table.names[0], "Tr\u{fffd}ger");
    }
}
