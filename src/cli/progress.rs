//! Progress on standard error, and the wish to stop.

use std::io::{IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use beamwright::observer::{Observer, Stage};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::args::{GlobalArgs, ProgressStyle as How};

/// Set by Ctrl-C.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Lets Ctrl-C end the run between two steps, so that no half-written file is left.
pub(crate) fn watch_for_interrupt() {
    // A second handler cannot be set in one process; the first one keeps working.
    let _ = ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::SeqCst));
}

/// Whether the user asked to stop.
pub(crate) fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::SeqCst)
}

/// Shows progress in the way that was asked for.
pub(crate) enum Progress {
    Bar(ProgressBar),
    Json,
    None,
}

impl Progress {
    pub(crate) fn new(args: &GlobalArgs) -> Self {
        match args.progress {
            How::Json => Self::Json,
            How::Auto if !args.quiet && std::io::stderr().is_terminal() => Self::Bar(bar()),
            _ => Self::None,
        }
    }

    /// Takes the bar away, so that nothing is left of it on the terminal.
    pub(crate) fn finish(&self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{msg:10} [{bar:40}] {elapsed}") {
        bar.set_style(style.progress_chars("=> "));
    }
    bar
}

impl Observer for Progress {
    fn progress(&mut self, stage: Stage, done: usize, total: usize) -> ControlFlow<()> {
        match self {
            Self::Bar(bar) => {
                bar.set_message(stage.name());
                bar.set_length(total as u64);
                bar.set_position(done as u64);
            }
            Self::Json => {
                let line =
                    serde_json::json!({ "stage": stage.name(), "done": done, "total": total });
                // Nobody listens any more: that is no reason to stop the work.
                let _ = writeln!(std::io::stderr(), "{line}");
            }
            Self::None => {}
        }
        if interrupted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
