//! ASCII STL, word by word: any number of solids, each with a name.
//!
//! `stl_io` reads the first solid only, without its name, and takes ten times as long. Here keywords
//! may be in capitals, a line may hold several of them, and a facet may have more than three points.

use crate::builder::Builder;
use crate::error::ReadError;
use crate::input::Input;
use crate::line::{FieldFault, Fields, Line};
use crate::names::{MOST_NAMES, NameTable};
use crate::raw_mesh::RawMesh;

/// Where the labels of this variant live.
const LABEL_SOURCE: &str = "names of the solids in the ASCII STL";

/// What may come next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// `solid`.
    Outside,
    /// `facet` or `endsolid`.
    Solid,
    /// `outer loop`.
    Facet,
    /// `vertex` or `endloop`.
    Loop,
    /// `endfacet`.
    LoopEnd,
}

impl State {
    fn expected(self) -> &'static str {
        match self {
            Self::Outside => "`solid`",
            Self::Solid => "`facet normal` or `endsolid`",
            Self::Facet => "`outer loop`",
            Self::Loop => "`vertex` or `endloop`",
            Self::LoopEnd => "`endfacet`",
        }
    }
}

/// Reads an ASCII STL file.
pub(super) fn read(input: &mut Input<'_>, builder: Builder<'_>) -> Result<RawMesh, ReadError> {
    input.skip_byte_order_mark()?;
    let names = NameTable::default();
    let state = State::Outside;
    let mut reader = Reader { builder, names, name: Vec::new(), name_set: None, state };
    while let Some(line) = input.next_line()? {
        reader.line(&line)?;
    }
    if reader.state != State::Outside {
        return Err(input.cut_off(reader.state.expected()));
    }
    let mut mesh = reader.builder.finish(LABEL_SOURCE)?;
    reader.names.move_to(&mut mesh.carriers);
    Ok(mesh)
}

/// The words that a statement begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Keyword {
    Solid,
    Facet,
    Outer,
    Vertex,
    EndLoop,
    EndFacet,
    EndSolid,
}

impl Keyword {
    /// The keyword that a word is, or that it makes with the next: some programs write `end loop`.
    #[inline]
    fn of(word: &[u8], fields: &mut Fields<'_>) -> Option<Self> {
        match word {
            b"vertex" => Some(Self::Vertex),
            b"outer" => Some(Self::Outer),
            b"facet" => Some(Self::Facet),
            b"endloop" => Some(Self::EndLoop),
            b"endfacet" => Some(Self::EndFacet),
            b"solid" => Some(Self::Solid),
            b"endsolid" => Some(Self::EndSolid),
            b"end" => match fields.word()?.to_ascii_lowercase().as_slice() {
                b"loop" => Some(Self::EndLoop),
                b"facet" => Some(Self::EndFacet),
                b"solid" => Some(Self::EndSolid),
                _ => None,
            },
            _ if word.len() <= 8 && word.iter().any(u8::is_ascii_uppercase) => {
                Self::of(&word.to_ascii_lowercase(), fields)
            }
            _ => None,
        }
    }
}

struct Reader<'a> {
    builder: Builder<'a>,
    names: NameTable,
    name: Vec<u8>,
    /// Set of names of the solid, made when it has a facet.
    name_set: Option<u32>,
    state: State,
}

impl Reader<'_> {
    #[inline]
    fn line(&mut self, line: &Line<'_>) -> Result<(), ReadError> {
        let mut fields = line.fields();
        while let Some(word) = fields.word() {
            self.statement(line, word, &mut fields)?;
        }
        Ok(())
    }

    #[inline]
    fn statement(
        &mut self,
        line: &Line<'_>,
        word: &[u8],
        fields: &mut Fields<'_>,
    ) -> Result<(), ReadError> {
        self.state = match (self.state, Keyword::of(word, fields)) {
            (State::Loop, Some(Keyword::Vertex)) => return self.vertex(line, fields),
            (State::Loop, Some(Keyword::EndLoop)) => State::LoopEnd,
            (State::LoopEnd, Some(Keyword::EndFacet)) => {
                self.end_facet(line)?;
                State::Solid
            }
            (State::Solid, Some(Keyword::Facet)) => {
                skip_normal(line, fields)?;
                State::Facet
            }
            (State::Facet, Some(Keyword::Outer)) => match fields.word() {
                Some(word) if word.eq_ignore_ascii_case(b"loop") => State::Loop,
                word => return Err(line.malformed("`loop`", word.unwrap_or_default())),
            },
            (State::Outside, Some(Keyword::Solid)) => {
                self.name.clear();
                self.name.extend_from_slice(fields.rest());
                self.name_set = None;
                *fields = Fields::of(b"");
                State::Solid
            }
            (State::Solid, Some(Keyword::EndSolid)) => {
                // The name may follow once more.
                *fields = Fields::of(b"");
                State::Outside
            }
            _ => return Err(line.malformed(self.state.expected(), word)),
        };
        Ok(())
    }

    #[inline]
    fn vertex(&mut self, line: &Line<'_>, fields: &mut Fields<'_>) -> Result<(), ReadError> {
        let mut number = || fields.number().map_err(|fault| line.fault("vertex x y z", fault));
        let position = [number()?, number()?, number()?];
        self.builder.corner(self.builder.mesh.positions.len() as u32);
        self.builder.point(position).map_err(|_| line.overflow())
    }

    fn end_facet(&mut self, line: &Line<'_>) -> Result<(), ReadError> {
        let corners = self.builder.open_corners();
        if corners < 3 {
            let found = format!("{corners} of them before {}", String::from_utf8_lossy(line.text));
            return Err(line.malformed("three vertices in a facet", found.as_bytes()));
        }
        self.builder.close_face()?;
        let set = match self.name_set {
            Some(set) => set,
            None => {
                let set = self
                    .names
                    .set([&self.name[..]])
                    .map_err(|_| self.builder.too_many("names of solids", MOST_NAMES as u64))?;
                *self.name_set.insert(set)
            }
        };
        self.names.give(set, 1);
        Ok(())
    }
}

/// Passes over `normal x y z`; the numbers may be anything, as in `normal -nan(ind) 0 0`.
fn skip_normal(line: &Line<'_>, fields: &mut Fields<'_>) -> Result<(), ReadError> {
    let expected = "`normal x y z` after `facet`";
    match fields.word() {
        Some(word) if word.eq_ignore_ascii_case(b"normal") => {}
        word => return Err(line.malformed(expected, word.unwrap_or_default())),
    }
    for _ in 0..3 {
        fields.word().ok_or_else(|| line.fault(expected, FieldFault::Missing))?;
    }
    Ok(())
}
