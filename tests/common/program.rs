//! The real program, run in a folder.

use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Output};

/// What a run left behind.
#[derive(Clone, Debug)]
pub struct Ran {
    /// Exit code; `None` when a signal ended it.
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
        Self {
            code: output.status.code(),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

impl Ran {
    /// Asserts that the run ended well; its standard output.
    pub fn succeeded(self) -> String {
        assert_eq!(self.code, Some(0), "{}", self.stderr);
        self.stdout
    }

    /// Asserts that the run ended with a code and exactly one line on standard error, `error: …`,
    /// and printed nothing else; the line.
    pub fn failed(self, code: i32) -> String {
        assert_eq!(self.code, Some(code), "{self:?}");
        assert_eq!(self.stdout, "", "results of a failure");
        let line = self.stderr.strip_prefix("error: ").unwrap_or_else(|| panic!("{self:?}"));
        let line = line.trim_end_matches('\n');
        assert!(!line.contains('\n'), "more than one line: {line}");
        line.to_owned()
    }
}

/// The program, in a folder.
pub fn command(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_beamwright"));
    command.current_dir(folder);
    command
}

/// Runs the program in a folder.
pub fn run<S: AsRef<OsStr>>(folder: &Path, arguments: &[S]) -> Ran {
    command(folder).args(arguments).output().expect("the program starts").into()
}
