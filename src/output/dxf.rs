//! The axes of the beams as DXF lines, the profile as layer: what frame programs take in.
//!
//! AutoCAD R12 ASCII, which every reader knows. Its layer names hold letters, digits, `-` and `_`
//! only: `CHS 60.3x4` becomes `CHS_60_3X4`; a comment says what each layer stands for. Lines run
//! from node to node, in mm.

use std::io::{self, Write};

use super::plain::one_line;
use crate::frame::Frame;

/// Longest layer name of the format.
const LONGEST_NAME: usize = 31;

/// Colours 1 to 6 of the format are plain and distinct.
const COLOURS: usize = 6;

/// Writes the axes of a frame.
///
/// # Errors
/// What `out` says.
pub fn write(frame: &Frame, out: &mut dyn Write) -> io::Result<()> {
    let layers = layers(frame);
    for (profile, layer) in &layers {
        pair(out, 999, &format!("layer {layer}: {}", one_line(profile)))?;
    }
    section(out, "HEADER", |out| {
        pair(out, 9, "$ACADVER")?;
        pair(out, 1, "AC1009")
    })?;
    section(out, "TABLES", |out| {
        pair(out, 0, "TABLE")?;
        pair(out, 2, "LAYER")?;
        pair(out, 70, &layers.len().to_string())?;
        for (i, (_, layer)) in layers.iter().enumerate() {
            pair(out, 0, "LAYER")?;
            pair(out, 2, layer)?;
            pair(out, 70, "0")?;
            pair(out, 62, &(i % COLOURS + 1).to_string())?;
            pair(out, 6, "CONTINUOUS")?;
        }
        pair(out, 0, "ENDTAB")
    })?;
    section(out, "ENTITIES", |out| {
        for beam in &frame.beams {
            let profile = beam.shape.name();
            let layer = layers.iter().find(|l| l.0 == profile).map_or("0", |l| l.1.as_str());
            let [a, b] = frame.axis(beam);
            pair(out, 0, "LINE")?;
            pair(out, 8, layer)?;
            let places = [(10, a.x), (20, a.y), (30, a.z), (11, b.x), (21, b.y), (31, b.z)];
            places.iter().try_for_each(|(code, x)| pair(out, *code, &format!("{x:?}")))?;
        }
        Ok(())
    })?;
    pair(out, 0, "EOF")
}

/// A layer for every profile, in the order of the beams.
fn layers(frame: &Frame) -> Vec<(String, String)> {
    let mut layers: Vec<(String, String)> = Vec::new();
    for profile in frame.beams.iter().map(|b| b.shape.name()) {
        if layers.iter().any(|l| l.0 == profile) {
            continue;
        }
        let mut layer = layer_name(&profile);
        if layers.iter().any(|l| l.1 == layer) {
            layer = format!("P{}_{}", layers.len() + 1, layer);
            layer.truncate(LONGEST_NAME);
        }
        layers.push((profile, layer));
    }
    layers
}

fn layer_name(profile: &str) -> String {
    let allowed = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    let name: String = profile.chars().map(allowed).take(LONGEST_NAME).collect();
    name.to_ascii_uppercase()
}

fn section(
    out: &mut dyn Write,
    name: &str,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    pair(out, 0, "SECTION")?;
    pair(out, 2, name)?;
    content(out)?;
    pair(out, 0, "ENDSEC")
}

/// A group code and its value.
fn pair(out: &mut dyn Write, code: u16, value: &str) -> io::Result<()> {
    writeln!(out, "{code:>3}\n{value}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layer_names_hold_nothing_the_format_forbids() {
        assert_eq!(layer_name("CHS 60.3x4"), "CHS_60_3X4");
        assert_eq!(layer_name("<img src=x onerror=alert(1)>\n0\nEOF").len(), LONGEST_NAME);
        assert!(layer_name("Träger\n").chars().all(|c| c.is_ascii_alphanumeric() || c == '_'));
    }
}
