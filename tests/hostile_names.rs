//! Names that would do harm: as part of a page, a spreadsheet, an exchange file or a model. They
//! stand in the mesh, its file name, the profiles and the material, and stay text in all files.

use std::error::Error;
use std::path::{Path, PathBuf};

mod common;

use common::program::run;

type Result<T = ()> = std::result::Result<T, Box<dyn Error>>;

/// An element of a page that runs a script.
const IMAGE: &str = "<img src=x onerror=alert(1)>";

/// What ends a string, an entity and a section of an exchange file.
const PART_21: &str = "');ENDSEC;";

/// A keyword of a CalculiX model.
const KEYWORD: &str = "*STEP ";

/// The mesh of a sample with hostile names of groups, in a file with a hostile name; `non_design`
/// in the name keeps its meaning.
fn mesh(folder: &Path) -> Result<PathBuf> {
    let text = std::fs::read_to_string("samples/single_bar.obj")?;
    let named: String = text
        .lines()
        .map(|line| match line.split_once(' ') {
            Some(("g" | "o", name)) => format!("g {IMAGE}</script>{PART_21}{name}\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    assert!(named.contains(IMAGE), "the sample has no groups");
    let path = folder.join(format!("{KEYWORD}{PART_21}{IMAGE}.obj"));
    std::fs::write(&path, named)?;
    Ok(path)
}

/// A table of profiles; every text a spreadsheet shows begins like a formula.
fn profiles(folder: &Path) -> Result<PathBuf> {
    let path = folder.join("profiles.csv");
    let head = "# family: +mine\n# standard: -2+3\nname,shape,d\n";
    std::fs::write(&path, format!("{head}=HYPERLINK(1){IMAGE}{PART_21},round,10\n"))?;
    Ok(path)
}

const FILES: [&str; 9] = [
    "out.step", "out.csv", "out.html", "out.svg", "out.glb", "out.dxf", "out.ifc", "out.inp",
    "out.mlp",
];

/// A folder with all files written from hostile names.
fn written() -> Result<tempfile::TempDir> {
    let folder = tempfile::tempdir()?;
    let (mesh, profiles) = (mesh(folder.path())?, profiles(folder.path())?);
    let mut arguments: Vec<&str> = vec!["reconstruct", "-q", "-o", "out.step"];
    arguments.push(mesh.to_str().ok_or("no UTF-8")?);
    arguments.extend(["--catalogue", profiles.to_str().ok_or("no UTF-8")?]);
    arguments.extend(["--profile", "catalogue:+mine", "--material=@SUM(A1)<img src=x>"]);
    arguments.extend(["--stock-length", "6000", "--report", "out.html", "--picture", "out.svg"]);
    let exports = FILES[4..].iter().flat_map(|name| ["--export", name]);
    arguments.extend(exports);
    run(folder.path(), &arguments).succeeded();
    Ok(folder)
}

#[test]
#[cfg(unix)]
fn names_stay_text_in_every_file() -> Result {
    let folder = written()?;
    let text = |name: &str| std::fs::read_to_string(folder.path().join(name));
    page(&text("out.html")?);
    for name in ["out.svg", "out.mlp"] {
        assert!(!text(name)?.contains("<img"), "{name}");
    }
    spreadsheet(&text("out.csv")?)?;
    for name in ["out.step", "out.ifc"] {
        exchange_file(&text(name)?);
    }
    drawing(&text("out.dxf")?)?;
    model(&text("out.inp")?);
    scene(&std::fs::read(folder.path().join("out.glb"))?)
}

fn page(page: &str) {
    assert!(!page.contains("<img"), "a tag in the page");
    assert!(page.contains("&#60;img src=x onerror=alert(1)&#62;"), "the name as text");
    assert_eq!(page.matches("</script>").count(), 3);
}

fn spreadsheet(text: &str) -> Result {
    let cells = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    let rows = cells.into_records().collect::<std::result::Result<Vec<_>, _>>()?;
    for cell in rows.iter().flatten() {
        assert!(!cell.starts_with(['=', '+', '-', '@']), "a formula: {cell}");
    }
    for begin in ["'=HYPERLINK(1)", "'+mine", "'-2+3", "'@SUM(A1)"] {
        assert!(rows.iter().flatten().any(|cell| cell.starts_with(begin)), "no cell {begin}");
    }
    Ok(())
}

/// Every line of the data is one entity whose strings end where they should.
fn exchange_file(text: &str) {
    assert!(text.ends_with("ENDSEC;\nEND-ISO-10303-21;\n"));
    assert_eq!(outside_strings(text).matches("ENDSEC;").count(), 2);
    assert!(text.contains("HYPERLINK(1)"), "the name as text");
    let (_, data) = text.split_once("\nDATA;\n").expect("a section of data");
    for line in data.lines().take_while(|line| *line != "ENDSEC;") {
        let line = outside_strings(line);
        assert!(line.starts_with('#') && line.ends_with(");"), "{line}");
        assert_eq!(line.matches('(').count(), line.matches(')').count(), "{line}");
    }
}

/// What is not between quotes; two quotes in a string are one that is part of it.
fn outside_strings(text: &str) -> String {
    text.split('\'').step_by(2).collect()
}

/// Pairs of code and value to the end, and layer names of letters the format allows.
fn drawing(text: &str) -> Result {
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len() % 2, 0);
    for pair in lines.chunks(2) {
        let code: u16 = pair[0].trim().parse()?;
        if code == 8 || code == 2 {
            let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            assert!(pair[1].chars().all(allowed), "{pair:?}");
        }
    }
    let ends = lines.chunks(2).filter(|pair| pair[0].trim() == "0" && pair[1] == "EOF").count();
    assert_eq!(ends, 1);
    assert!(text.contains(IMAGE), "the name in a remark");
    Ok(())
}

/// No keyword but those of nodes, elements, sets, sections and materials.
fn model(text: &str) {
    const KNOWN: [&str; 8] = [
        "*HEADING",
        "*NODE",
        "*ELEMENT",
        "*NSET",
        "*MATERIAL",
        "*ELASTIC",
        "*DENSITY",
        "*BEAM SECTION",
    ];
    let keywords = text.lines().filter(|l| l.starts_with('*') && !l.starts_with("**"));
    for line in keywords {
        let keyword = line.split(',').next().unwrap_or_default();
        assert!(KNOWN.contains(&keyword), "{line}");
    }
    assert!(text.contains(IMAGE), "the name in a remark");
}

fn scene(glb: &[u8]) -> Result {
    let length = u32::from_le_bytes(glb[12..16].try_into()?) as usize;
    let content: serde_json::Value = serde_json::from_slice(&glb[20..20 + length])?;
    let nodes = content["nodes"].as_array().ok_or("no nodes")?;
    assert!(nodes.iter().any(|n| n["name"].as_str().is_some_and(|name| name.contains(IMAGE))));
    Ok(())
}
