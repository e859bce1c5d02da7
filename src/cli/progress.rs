//! Progress on standard error, and the wish to stop.
//!
//! Ctrl-C sets a mark that the work asks for between its steps. What is at work where nothing asks is
//! ended from outside after [`PATIENCE`], and no temporary file is left.

use std::io::{IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use beamwright::observer::{Observer, Stage};
use beamwright::output::OutputFiles;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::args::{GlobalArgs, ProgressStyle as How};
use super::exit::Failure;

/// Set by Ctrl-C.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Set by whoever tells how the run ends.
static IS_TOLD: AtomicBool = AtomicBool::new(false);

/// The bar on the terminal, if there is one.
static BAR: OnceLock<ProgressBar> = OnceLock::new();

/// How long the work may take to answer Ctrl-C; most of its steps do within a hundredth of it.
const PATIENCE: Duration = Duration::from_millis(700);

/// Lets Ctrl-C end the run without a half-written file.
pub(crate) fn watch_for_interrupt() {
    // A second handler cannot be set in one process; the first one keeps working.
    let _ = ctrlc::set_handler(|| {
        INTERRUPTED.store(true, Ordering::SeqCst);
        std::thread::sleep(PATIENCE);
        let _no_more_files = OutputFiles::stop_all();
        if may_tell_the_end() {
            if let Some(bar) = BAR.get() {
                bar.finish_and_clear();
            }
            let Failure { exit, message } = Failure::interrupted();
            super::show::error(&message);
            std::process::exit(exit.code().into());
        }
    });
}

/// Whether nobody has told yet how the run ends; true for the first that asks.
pub(crate) fn may_tell_the_end() -> bool {
    !IS_TOLD.swap(true, Ordering::SeqCst)
}

/// Whether the user asked to stop.
pub(crate) fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::SeqCst)
}

/// Shows progress in the way that was asked for.
pub(crate) struct Progress {
    shown: Shown,
    /// The stage at work and when it began; kept where notes are wanted.
    clock: Option<Clock>,
}

enum Shown {
    Bar(ProgressBar),
    Json,
    Nothing,
}

#[derive(Default)]
struct Clock {
    at_work: Option<(Stage, Instant)>,
}

impl Progress {
    pub(crate) fn new(args: &GlobalArgs) -> Self {
        let shown = match args.progress {
            How::Json => Shown::Json,
            How::Auto if !args.quiet && std::io::stderr().is_terminal() => {
                Shown::Bar(BAR.get_or_init(bar).clone())
            }
            _ => Shown::Nothing,
        };
        Self { shown, clock: args.verbose.then(Clock::default) }
    }

    /// Takes the bar away, so that nothing is left of it on the terminal.
    pub(crate) fn finish(&mut self) {
        self.end_stage();
        if let Shown::Bar(bar) = &self.shown {
            bar.finish_and_clear();
        }
    }

    /// A line on standard error for those who asked for notes.
    pub(crate) fn note(&self, text: &str) {
        if self.clock.is_none() {
            return;
        }
        // Nobody listens any more: that is no reason to stop the work.
        let write = || drop(writeln!(std::io::stderr(), "{text}"));
        match &self.shown {
            Shown::Bar(bar) => bar.suspend(write),
            _ => write(),
        }
    }

    fn end_stage(&mut self) {
        if let Some((stage, since)) = self.clock.as_mut().and_then(|clock| clock.at_work.take()) {
            self.note(&format!("{:<10} {:.3} s", stage.name(), since.elapsed().as_secs_f64()));
        }
    }

    fn begin_stage(&mut self, stage: Stage) {
        let Some(clock) = &self.clock else { return };
        if clock.at_work.is_none_or(|(at_work, _)| at_work != stage) {
            self.end_stage();
            self.clock = Some(Clock { at_work: Some((stage, Instant::now())) });
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
        self.begin_stage(stage);
        match &self.shown {
            Shown::Bar(bar) => {
                bar.set_message(stage.name());
                bar.set_length(total as u64);
                bar.set_position(done as u64);
            }
            Shown::Json => {
                let line =
                    serde_json::json!({ "stage": stage.name(), "done": done, "total": total });
                // Nobody listens any more: that is no reason to stop the work.
                let _ = writeln!(std::io::stderr(), "{line}");
            }
            Shown::Nothing => {}
        }
        self.keep_on()
    }

    fn keep_on(&mut self) -> ControlFlow<()> {
        if interrupted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
