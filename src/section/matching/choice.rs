//! What the user asks for: which profiles, and what must agree.

use std::fmt;
use std::str::FromStr;

/// Which profiles a beam may get (`--profile`).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum ProfileChoice {
    /// The simplest family that covers the measured contour.
    #[default]
    Auto,
    /// Solid round.
    Round,
    /// Round tube.
    Tube,
    /// Solid rectangle.
    Rectangle,
    /// Rectangular hollow section.
    Box,
    /// Solid ellipse.
    Ellipse,
    /// I section.
    I,
    /// Channel.
    C,
    /// Angle.
    L,
    /// Smooth outline through the measured contour.
    Freeform,
    /// A profile of a catalogue, from the named families or from all.
    Catalogue(Vec<String>),
}

/// What must agree between profile and section (`--match`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MatchMode {
    /// The bending stiffnesses I_1 and I_2.
    #[default]
    Stiffness,
    /// The area.
    Area,
    /// None of A, I_1, I_2, J may be less than measured.
    NotWeaker,
}

/// A word that is none of the choices.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown {what} {text:?}; use one of {known}")]
pub struct UnknownChoice {
    what: &'static str,
    text: String,
    known: &'static str,
}

const CHOICES: &str =
    "auto, round, tube, rectangle, box, ellipse, i, c, l, freeform, catalogue[:FAMILY,...]";
const MODES: &str = "stiffness, area, not-weaker";

impl FromStr for ProfileChoice {
    type Err = UnknownChoice;

    fn from_str(text: &str) -> Result<Self, UnknownChoice> {
        let (word, families) = text.split_once(':').unwrap_or((text, ""));
        let families = families.split(',').map(str::trim).filter(|f| !f.is_empty());
        let choice = match word.trim().to_lowercase().as_str() {
            "catalogue" => return Ok(Self::Catalogue(families.map(str::to_owned).collect())),
            "auto" => Self::Auto,
            "round" => Self::Round,
            "tube" => Self::Tube,
            "rectangle" => Self::Rectangle,
            "box" => Self::Box,
            "ellipse" => Self::Ellipse,
            "i" => Self::I,
            "c" => Self::C,
            "l" => Self::L,
            "freeform" => Self::Freeform,
            _ => return Err(unknown("profile", text, CHOICES)),
        };
        if text.contains(':') { Err(unknown("profile", text, CHOICES)) } else { Ok(choice) }
    }
}

impl fmt::Display for ProfileChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = match self {
            Self::Auto => "auto",
            Self::Round => "round",
            Self::Tube => "tube",
            Self::Rectangle => "rectangle",
            Self::Box => "box",
            Self::Ellipse => "ellipse",
            Self::I => "i",
            Self::C => "c",
            Self::L => "l",
            Self::Freeform => "freeform",
            Self::Catalogue(families) if families.is_empty() => "catalogue",
            Self::Catalogue(families) => return write!(f, "catalogue:{}", families.join(",")),
        };
        f.write_str(word)
    }
}

impl FromStr for MatchMode {
    type Err = UnknownChoice;

    fn from_str(text: &str) -> Result<Self, UnknownChoice> {
        match text.trim().to_lowercase().as_str() {
            "stiffness" => Ok(Self::Stiffness),
            "area" => Ok(Self::Area),
            "not-weaker" => Ok(Self::NotWeaker),
            _ => Err(unknown("match", text, MODES)),
        }
    }
}

impl fmt::Display for MatchMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Stiffness => "stiffness",
            Self::Area => "area",
            Self::NotWeaker => "not-weaker",
        })
    }
}

fn unknown(what: &'static str, text: &str, known: &'static str) -> UnknownChoice {
    UnknownChoice { what, text: text.to_owned(), known }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_read_back_what_they_print() {
        for text in ["auto", "round", "box", "i", "freeform", "catalogue", "catalogue:CHS,IPE"] {
            assert_eq!(text.parse::<ProfileChoice>().unwrap().to_string(), text);
        }
        for text in ["stiffness", "area", "not-weaker"] {
            assert_eq!(text.parse::<MatchMode>().unwrap().to_string(), text);
        }
    }

    #[test]
    fn unknown_words_are_answered_with_the_known_ones() {
        let fault = "squircle".parse::<ProfileChoice>().unwrap_err().to_string();
        assert!(fault.contains("\"squircle\"") && fault.contains("ellipse"), "{fault}");
        assert!("round:CHS".parse::<ProfileChoice>().is_err());
        assert!("strong".parse::<MatchMode>().is_err());
    }
}
