//! Meshes that cross themselves: an end, no nonsense, and the file is named.

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use beamwright::frame::Moments;
use beamwright::observer::{Observer, Stage};
use beamwright::pipeline::{self, Outcome, PipelineError, Settings};

/// The sample `y_form` with one line moved to another place of the file. A point that is moved shifts
/// the numbers of all between, so that their faces lie criss-cross through the part.
fn with_line_moved(from: impl Fn(&str) -> bool, to: usize) -> String {
    let text = fs::read_to_string("samples/y_form.obj").expect("the sample");
    let mut lines: Vec<&str> = text.lines().collect();
    let at = lines.iter().rposition(|line| from(line)).expect("a line like that");
    let line = lines.remove(at);
    lines.insert(to, line);
    lines.join("\n")
}

fn written(folder: &Path, text: &str) -> PathBuf {
    let path = folder.join("crossed.obj");
    fs::write(&path, text).expect("a temporary file");
    path
}

/// What a run ends in: beams that can be built, or an error that names the file.
fn check(end: Result<Outcome, PipelineError>) {
    match end {
        Ok(Outcome { frame, sections, .. }) => {
            let nodes = frame.nodes.iter().flat_map(|n| n.position.iter().copied());
            assert!(nodes.into_iter().all(f64::is_finite));
            for beam in &frame.beams {
                let area = beam.shape.properties.area;
                assert!(area.is_finite() && area > 0.0, "{beam:?}");
                assert!(beam.length.is_finite() && beam.length > 0.0, "{beam:?}");
            }
            for section in sections.iter().flatten() {
                assert!(Moments::of_polygon(&section.outline()).principal().1 > 0.0, "{section:?}");
            }
        }
        Err(fault) => assert!(fault.to_string().contains("crossed.obj"), "{fault}"),
    }
}

#[test]
fn points_in_a_wrong_order_end_in_beams_or_in_an_error_that_names_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let is_point = |line: &str| line.starts_with("v ");
    for to in [4, 600, 1200, 1600] {
        let path = written(folder.path(), &with_line_moved(is_point, to));
        check(pipeline::run(&path, &Settings::default(), &mut ()));
    }
}

/// Stops the work at the first question within a stage.
struct StopsIn {
    stage: Stage,
    reached: bool,
}

impl Observer for StopsIn {
    fn progress(&mut self, stage: Stage, _: usize, _: usize) -> ControlFlow<()> {
        self.reached |= stage == self.stage;
        ControlFlow::Continue(())
    }

    fn keep_on(&mut self) -> ControlFlow<()> {
        if self.reached { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn every_stage_that_takes_long_asks_whether_to_keep_on() {
    for stage in [Stage::Mesh, Stage::Skeleton, Stage::Sections, Stage::Frame] {
        let mut stops = StopsIn { stage, reached: false };
        let path = Path::new("samples/y_form.obj");
        let end = pipeline::run(path, &Settings::default(), &mut stops);
        assert!(matches!(end, Err(PipelineError::Cancelled)), "{}", stage.name());
    }
}
