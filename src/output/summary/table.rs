//! A summary in words: a table of 80 columns.

use std::fmt::{self, Display, Write};

use super::{
    FindingSummary, FrameSummary, InterfaceSummary, LabelSummary, MeshSummary, SkeletonSummary,
    Summary,
};
use crate::wording::{counted, figures};

/// Columns of the table, and of those before its texts.
const WIDTH: usize = 80;
const INDENT: usize = 12;

/// Findings of one kind that are printed: as many as fill no screen. A noisy mesh has thousands.
const MOST_OF_A_KIND: usize = 20;

impl Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut row = |name: &str, text: &str| {
            wrapped(text, WIDTH - INDENT).iter().enumerate().try_for_each(|(i, line)| {
                writeln!(f, "{:<INDENT$}{line}", if i == 0 { name } else { "" })
            })
        };
        row("input", &self.input)?;
        row("mesh", &mesh_line(&self.mesh))?;
        if !self.mesh.mended.is_empty() {
            let mended: Vec<String> = self
                .mesh
                .mended
                .iter()
                .map(|(what, n)| format!("{} {}", grouped(*n), what.replace('_', " ")))
                .collect();
            row("mended", &mended.join(", "))?;
        }
        row("labels", &label_line(&self.labels))?;
        if self.skeleton.is_none() {
            for section in &self.labels.interfaces {
                row("", &interface_line(section))?;
            }
        }
        if let Some(skeleton) = &self.skeleton {
            row("skeleton", &skeleton_line(skeleton))?;
        }
        if let Some(frame) = &self.frame {
            row("frame", &frame_line(frame))?;
            row("volume", &volume_line(frame))?;
        }
        for (name, text) in finding_rows(&self.findings) {
            row(name, &text)?;
        }
        Ok(())
    }
}

/// One line on the mesh, in words.
pub(in crate::output) fn mesh_line(mesh: &MeshSummary) -> String {
    format!(
        "{} triangles, {}, genus {}, {} mm across, {} mm³",
        grouped(mesh.triangles),
        counted(mesh.bodies, "body", "bodies"),
        mesh.genus,
        figures(mesh.diagonal, 1),
        volume(mesh.volume)
    )
}

/// One line on the labels, in words.
pub(in crate::output) fn label_line(labels: &LabelSummary) -> String {
    let Some(source) = labels.source else {
        return "none: the whole mesh is design".to_owned();
    };
    let mut line = format!(
        "by {source}: {} non-design faces in {}, {}",
        grouped(labels.non_design_faces),
        counted(labels.sets, "set", "sets"),
        counted(labels.interfaces.len(), "interface section", "interface sections")
    );
    let others: Vec<String> = labels
        .marked
        .iter()
        .filter(|(s, _)| *s != source)
        .map(|(s, n)| format!("{s}: {}", grouped(*n)))
        .collect();
    if !others.is_empty() {
        let _ = write!(line, " (not used: {})", others.join(", "));
    }
    line
}

fn interface_line(section: &InterfaceSummary) -> String {
    let [x, y, z] = section.centroid;
    format!(
        "set {}: {} of {} mm² at ({x:.2}, {y:.2}, {z:.2})",
        section.set + 1,
        section.kind,
        figures(section.area, 2)
    )
}

/// One line on the skeleton, in words.
pub(in crate::output) fn skeleton_line(s: &SkeletonSummary) -> String {
    let mut line = format!(
        "{}, {}, {} points, {} mm; cycles {} of {}",
        counted(s.branches, "branch", "branches"),
        counted(s.junctions, "junction", "junctions"),
        s.points,
        figures(s.length, 1),
        s.cycles,
        s.expected_cycles
    );
    if s.free_ends > 0 {
        let _ = write!(line, "; {}", counted(s.free_ends, "free end", "free ends"));
    }
    line
}

/// One line on the frame, in words.
pub(in crate::output) fn frame_line(frame: &FrameSummary) -> String {
    let beams = counted(frame.beams, "beam", "beams");
    format!("{beams}, {} nodes, {} mm", frame.nodes, figures(frame.length, 1))
}

/// One line on the volume of the beams, in words.
pub(in crate::output) fn volume_line(frame: &FrameSummary) -> String {
    let part = |volume: f64| 100.0 * volume / frame.design_volume;
    format!(
        "beams {} mm³ without overlap at joints, for {} mm³ of design \
         ({:+.1}\u{a0}%); {:.1}\u{a0}% stick out",
        volume(frame.volume_together),
        volume(frame.design_volume),
        part(frame.volume_together) - 100.0,
        part(frame.volume_outside)
    )
}

/// The findings by name and text, of each kind the first ones.
fn finding_rows(findings: &[FindingSummary]) -> Vec<(&'static str, String)> {
    let mut rows = Vec::new();
    for alike in findings.chunk_by(|a, b| (a.breach, a.kind) == (b.breach, b.kind)) {
        let name = if alike[0].breach { "BREACH" } else { "note" };
        rows.extend(alike.iter().take(MOST_OF_A_KIND).map(|one| (name, finding_line(one))));
        let left = alike.len().saturating_sub(MOST_OF_A_KIND);
        if left > 0 {
            rows.push((
                name,
                format!("and {} more of this kind: --json lists them", grouped(left)),
            ));
        }
    }
    rows
}

fn finding_line(finding: &FindingSummary) -> String {
    match finding.place {
        Some([x, y, z]) => {
            format!("{} at ({x:.2},\u{a0}{y:.2},\u{a0}{z:.2})\u{a0}mm", finding.text)
        }
        None => finding.text.clone(),
    }
}

/// A text in lines, broken between words but not at no-break spaces. A control character, which
/// would command the terminal, is shown as `?`.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let plain: String = text.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    let mut lines = vec![String::new()];
    for word in plain.split(' ').filter(|word| !word.is_empty()) {
        let line = lines.last_mut().filter(|l| !l.is_empty());
        match line {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            Some(_) => lines.push(word.to_owned()),
            None => lines = vec![word.to_owned()],
        }
    }
    lines.iter().map(|line| line.replace('\u{a0}', " ")).collect()
}

/// A count as "1,234,567".
pub(in crate::output) fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(c);
    }
    out
}

/// A volume in whole mm³, grouped; a smaller one with its digits.
fn volume(x: f64) -> String {
    if x.abs() < 10.0 { figures(x, 0) } else { grouped(x.round() as usize) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_broken_between_words_within_the_width() {
        assert_eq!(wrapped("aa bb cc dd", 5), ["aa bb", "cc dd"]);
        assert_eq!(wrapped("a-long-word b", 5), ["a-long-word", "b"]);
        assert_eq!(wrapped("red \u{1b}[31m", 20), ["red ?[31m"]);
        assert_eq!(wrapped("at (1,\u{a0}2)", 5), ["at", "(1, 2)"]);
        assert_eq!(wrapped("", 5), [""]);
    }

    #[test]
    fn of_many_findings_of_a_kind_the_first_are_printed_and_the_rest_counted() {
        let find = |kind, text: &str| FindingSummary {
            kind,
            breach: false,
            text: text.to_owned(),
            place: None,
        };
        let mut findings = vec![find("deviation", "bent"); MOST_OF_A_KIND + 1200];
        findings.push(find("joint", "short"));
        let rows = finding_rows(&findings);
        let texts: Vec<&str> = rows.iter().map(|(_, text)| text.as_str()).collect();
        assert_eq!(texts[..MOST_OF_A_KIND], ["bent"; MOST_OF_A_KIND]);
        let last = ["and 1,200 more of this kind: --json lists them", "short"];
        assert_eq!(texts[MOST_OF_A_KIND..], last);
        assert_eq!(finding_rows(&findings[..MOST_OF_A_KIND]).len(), MOST_OF_A_KIND);
    }

    #[test]
    fn counts_are_grouped_by_three() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1_234_567), "1,234,567");
    }
}
