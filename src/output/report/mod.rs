//! The report: one HTML file to look at a result in a browser, from disk and without a network.
//!
//! | part | what | file |
//! |---|---|---|
//! | page | the words and tables, readable without a script | `templates/report.html`, `tables` |
//! | nesting | the pieces of the cut list on their stock bars | `nesting` |
//! | scene | geometry and figures of the 3D view as JSON | `scene`, `packed` |
//! | script | 3D view, sorting, searching, plots | `app/`, `vendor/` |
//!
//! **Safety.** A mesh may come from anyone, and so may the names in it. The template engine escapes
//! every text; the data block cannot end its element (`script_safe`); and the page forbids by a
//! Content-Security-Policy everything but its own scripts and style, named by their SHA-256: no
//! other script runs and nothing is fetched, whatever a name says.

mod measure;
mod nesting;
mod packed;
mod scene;
mod tables;

use std::io::{self, Write};

use askama::Template;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

use super::cut_list::CutList;
use super::picture::svg_of_beams;
use super::summary::Summary;
use super::summary::table::grouped;
use super::view::View;
pub use measure::{Measures, Peer};
use tables::Tables;

const STYLE: &str = concat!(include_str!("vendor/uplot.min.css"), include_str!("style.css"));
const VENDOR: &str = include_str!("vendor/vendor.min.js");
/// The script of the page: one function, so that nothing of it is seen outside.
const APP: &str = concat!(
    "(() => {\n\"use strict\";\n",
    include_str!("app/data.js"),
    include_str!("app/colours.js"),
    include_str!("app/viewer.js"),
    include_str!("app/selection.js"),
    include_str!("app/table.js"),
    include_str!("app/plots.js"),
    include_str!("app/start.js"),
    "})();\n"
);

/// What a report is made of.
pub struct Report<'a> {
    /// Name of the input file.
    pub name: &'a str,
    /// The run in numbers.
    pub summary: &'a Summary,
    /// What is shown.
    pub view: &'a View<'a>,
    /// How well the skeletons are centred.
    pub measures: &'a Measures,
    /// What is sawn of the beams.
    pub cut_list: &'a CutList,
}

#[derive(Template)]
#[template(path = "report.html")]
struct Page<'a> {
    name: &'a str,
    version: &'static str,
    script_policy: String,
    style_policy: String,
    style: &'static str,
    vendor: &'static str,
    app: &'static str,
    summary: &'a Summary,
    tables: Tables,
    cut_list: &'a CutList,
    picture: String,
    data: String,
    /// Triangles shown and triangles there are, when that is less.
    thinned: Option<[String; 2]>,
}

/// Writes a report.
///
/// # Errors
/// What `out` says.
pub fn write(report: &Report<'_>, out: &mut dyn Write) -> io::Result<()> {
    let scene = scene::Scene::new(report);
    let page = Page {
        name: report.name,
        version: env!("CARGO_PKG_VERSION"),
        script_policy: format!("{} {}", source(VENDOR), source(APP)),
        style_policy: source(STYLE),
        style: STYLE,
        vendor: VENDOR,
        app: APP,
        summary: report.summary,
        tables: Tables::new(report),
        cut_list: report.cut_list,
        picture: svg_of_beams(report.view),
        data: script_safe(&serde_json::to_string(&scene)?),
        thinned: scene.thinned().map(|counts| counts.map(grouped)),
    };
    out.write_all(page.render().map_err(io::Error::other)?.as_bytes())
}

/// The name of an inline script or style in a Content-Security-Policy.
fn source(text: &str) -> String {
    format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)))
}

/// JSON that no HTML parser takes for the end of its element, and no script for a line end.
fn script_safe(json: &str) -> String {
    let mut safe = String::with_capacity(json.len());
    for c in json.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                safe.push_str(&format!("\\u{:04x}", u32::from(c)));
            }
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_cannot_end_its_element_and_means_the_same() {
        let hostile = "</script><!-- & \u{2028}";
        let json = serde_json::to_string(hostile).unwrap();
        let safe = script_safe(&json);
        assert!(!safe.contains(['<', '>', '&', '\u{2028}']));
        assert_eq!(serde_json::from_str::<String>(&safe).unwrap(), hostile);
    }

    #[test]
    fn no_script_or_style_ends_its_own_element() {
        for text in [VENDOR, APP, STYLE] {
            let lower = text.to_lowercase();
            assert!(!lower.contains("</script") && !lower.contains("</style"));
            assert!(!lower.contains("<!--"));
        }
    }
}
