//! Reports, 3D scenes and pictures, written by the program itself.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

type Result<T = ()> = std::result::Result<T, Box<dyn Error>>;

/// A folder with one run's results.
struct Run {
    folder: tempfile::TempDir,
    output: Output,
}

impl Run {
    /// Reconstructs a mesh with further arguments; files named in them go to the run's folder.
    fn new(input: &Path, arguments: &[&str]) -> Result<Self> {
        let folder = tempfile::tempdir()?;
        let output = Command::new(env!("CARGO_BIN_EXE_beamwright"))
            .current_dir(&folder)
            .arg("reconstruct")
            .arg(std::path::absolute(input)?)
            .args(["-o", "out.step", "-q"])
            .args(arguments)
            .output()?;
        Ok(Self { folder, output })
    }

    fn expect_success(self) -> Self {
        assert!(self.output.status.success(), "{}", String::from_utf8_lossy(&self.output.stderr));
        self
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn bytes(&self, name: &str) -> Result<Vec<u8>> {
        Ok(std::fs::read(self.path(name))?)
    }

    fn text(&self, name: &str) -> Result<String> {
        Ok(String::from_utf8(self.bytes(name)?)?)
    }
}

const EVERYTHING: [&str; 8] =
    ["--report", "out.html", "--export", "out.glb", "--picture", "out.png", "--picture", "out.svg"];

fn sample(name: &str) -> PathBuf {
    Path::new("samples").join(name)
}

#[test]
fn the_same_input_gives_the_same_bytes() -> Result {
    let runs = [0, 1].map(|_| Run::new(&sample("single_bar.obj"), &EVERYTHING));
    let [first, second] = runs.map(|r| r.map(Run::expect_success));
    let (first, second) = (first?, second?);
    for name in ["out.html", "out.glb", "out.png", "out.svg"] {
        assert!(first.bytes(name)? == second.bytes(name)?, "{name}");
    }
    Ok(())
}

/// A report is one file: no address in it is fetched, and its policy allows nothing to be.
#[test]
fn a_report_is_whole_in_itself() -> Result {
    let run = Run::new(&sample("single_bar.obj"), &["--report", "out.html"])?.expect_success();
    let page = run.text("out.html")?;
    assert!(page.contains("default-src 'none'; script-src &#39;sha256-"));
    let markup = without_scripts(&page);
    assert!(!markup.contains(" src=") && !markup.contains("<link"), "something is fetched");
    assert!(!markup.contains(" style=") && !markup.contains(" onclick="), "against the policy");
    Ok(())
}

fn without_scripts(page: &str) -> String {
    let mut parts = page.split("<script");
    let head = parts.next().unwrap_or_default().to_owned();
    parts.fold(head, |all, part| all + part.split_once("</script>").map_or("", |(_, rest)| rest))
}

/// The nodes of the 3D scene of a run.
fn nodes(run: &Run) -> Result<Vec<serde_json::Value>> {
    let glb = run.bytes("out.glb")?;
    let length = u32::from_le_bytes(glb[12..16].try_into()?) as usize;
    let content: serde_json::Value = serde_json::from_slice(&glb[20..20 + length])?;
    Ok(content["nodes"].as_array().cloned().unwrap_or_default())
}

#[test]
fn the_scene_has_one_named_node_a_beam_in_metres() -> Result {
    let run = Run::new(&sample("cantilever.obj"), &["--export", "out.glb"])?.expect_success();
    let options = beamwright_formats::ReadOptions::default();
    let mesh = beamwright_formats::read(&run.path("out.glb"), &options)?;
    let original = beamwright_formats::read(&sample("cantilever.obj"), &options)?;
    // Read back, metres are millimetres again.
    let reach = |m: &beamwright_formats::RawMesh| {
        m.positions.iter().flatten().fold(0.0f64, |far, x| far.max(x.abs()))
    };
    assert!((reach(&mesh) / reach(&original) - 1.0).abs() < 0.2);

    let nodes = nodes(&run)?;
    let marks: Vec<&str> = nodes.iter().filter_map(|n| n["extras"]["mark"].as_str()).collect();
    assert!(marks.len() > 5, "{marks:?}");
    for (i, mark) in marks.iter().enumerate() {
        assert_eq!(*mark, format!("B{:03}", i + 1));
        assert!(
            nodes.iter().any(|n| n["name"].as_str().is_some_and(|name| name.starts_with(mark)))
        );
    }
    Ok(())
}

#[test]
fn the_picture_shows_mesh_and_beams() -> Result {
    let run = Run::new(&sample("cantilever.obj"), &["--picture", "out.png"])?.expect_success();
    let file = std::io::BufReader::new(std::fs::File::open(run.path("out.png"))?);
    let mut reader = png::Decoder::new(file).read_info()?;
    let mut pixels = vec![0; reader.output_buffer_size().ok_or("too large")?];
    reader.next_frame(&mut pixels)?;
    let info = reader.info();
    let (width, height) = (info.width as usize, info.height as usize);
    let painted = |columns: std::ops::Range<usize>, rows: std::ops::Range<usize>| {
        let at = |x: usize, y: usize| &pixels[3 * (y * width + x)..][..3];
        let all = rows.clone().flat_map(|y| columns.clone().map(move |x| (x, y)));
        let full = all.filter(|&(x, y)| at(x, y) != [255; 3]).count();
        full as f64 / (columns.len() * rows.len()) as f64
    };
    let (half, third, lower) = (width / 2, width / 3, height * 6 / 10);
    assert!(painted(0..half, 0..lower) > 0.1, "mesh");
    assert!(painted(half..width, 0..lower) > 0.1, "beams");
    for view in 0..3 {
        assert!(painted(view * third..(view + 1) * third, lower..height) > 0.02, "view {view}");
    }
    Ok(())
}

#[test]
fn skeletons_of_others_are_held_against_ours() -> Result {
    let first = Run::new(&sample("single_bar.obj"), &[])?.expect_success();
    let peer = first.path("out.skeleton.json");
    let peer = peer.to_str().ok_or("no UTF-8")?;
    let arguments = ["--report", "out.html", "--compare", peer];
    let run = Run::new(&sample("single_bar.obj"), &arguments)?.expect_success();
    assert!(run.text("out.html")?.contains("<th>out.skeleton.json</th>"));
    Ok(())
}

#[test]
fn wrong_endings_are_told_before_the_work_begins() -> Result {
    for (flag, file) in [("--report", "r.pdf"), ("--picture", "p.jpg"), ("--export", "e.fbx")] {
        let run = Run::new(&sample("single_bar.obj"), &[flag, file])?;
        assert_eq!(run.output.status.code(), Some(2), "{file}");
        assert!(String::from_utf8_lossy(&run.output.stderr).contains(file));
        assert!(!run.path("out.step").exists());
    }
    Ok(())
}
