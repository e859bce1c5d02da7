//! Options from a file: every long flag by its name.
//!
//! ```toml
//! profile = "catalogue:CHS"
//! joints = "trim"
//! continuous = true
//! non-design-name = ["pad*", "fixed"]
//! ```
//!
//! The options of the file are put before what was typed, so that what was typed counts more; lists
//! are joined. A file may serve several subcommands: options that another one has are passed over.
//! What is wrong with an option of the file is told with its line there.

use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use beamwright::output::{OutputFiles, check_target};
use clap::{Arg, ArgAction, ArgMatches, Command, CommandFactory};
use toml::{Spanned, Value};

use super::command::Cli;
use super::exit::{Exit, Failure};
use super::outputs::ending;

/// Options that say what this one run reads and writes: no part of a file for many runs.
const OF_ONE_RUN: [&str; 8] =
    ["config", "write-config", "output", "out-dir", "compare", "non-design", "help", "version"];

/// Options that are part of such a file where they name endings, and no files of one run.
const OUTPUTS: [&str; 6] = ["cut-list", "skeleton", "sections", "export", "picture", "report"];

/// What was typed, with the options of its `--config` put behind the subcommand.
#[derive(Debug)]
pub(crate) struct Words {
    /// All of them, as if they had been typed.
    pub(crate) all: Vec<OsString>,
    file: Option<FileOptions>,
}

/// Options that a file set.
#[derive(Debug)]
struct FileOptions {
    path: PathBuf,
    /// Where each stands, counted from 1; without those that were typed too.
    lines: BTreeMap<String, usize>,
}

impl FileOptions {
    fn fault(&self, what: &dyn std::fmt::Display) -> String {
        format!("cannot use the options of {}: {what}", self.path.display())
    }
}

impl Words {
    /// Reads the options of the file that was typed.
    ///
    /// # Errors
    /// A file that cannot be read, is no TOML, or has an option that no subcommand knows.
    pub(crate) fn new(typed: impl IntoIterator<Item = OsString>) -> Result<Self, Failure> {
        let mut typed: Vec<OsString> = typed.into_iter().collect();
        let all = Cli::command();
        let place = typed.iter().position(|w| all.find_subcommand(w).is_some());
        let (Some(path), Some(place)) = (config_of(&typed), place) else {
            return Ok(Self { all: typed, file: None });
        };
        let mut file = FileOptions { path: path.into(), lines: BTreeMap::new() };
        let text = read(&file.path).map_err(|fault| Failure::usage(file.fault(&fault)))?;
        let table: BTreeMap<Spanned<String>, Value> = toml::from_str(&text)
            .map_err(|e| Failure::usage(file.fault(&in_one_line(&e, &text))))?;
        let mut words = Vec::new();
        for (name, value) in &table {
            let line = line_of(text.as_bytes(), name.span().start);
            let fault = |what: String| Failure::usage(file.fault(&format!("line {line}: {what}")));
            let name = name.as_ref();
            let of = |command: &Command| flag(command, name).cloned();
            let here = all.find_subcommand(&typed[place]).and_then(of).or_else(|| of(&all));
            match here {
                Some(arg) => words.extend(words_of(&arg, name, value).map_err(fault)?),
                None if all.get_subcommands().any(|c| of(c).is_some()) => {}
                None => return Err(fault(format!("there is no option {name}"))),
            }
            if !is_typed(&typed, name) {
                file.lines.insert(name.clone(), line);
            }
        }
        typed.splice(place + 1..=place, words);
        Ok(Self { all: typed, file: Some(file) })
    }

    /// A fault of an option as a message with its place, if the file set the option; the fault names
    /// the option as it is typed.
    pub(crate) fn placed(&self, fault: &str) -> Option<String> {
        let file = self.file.as_ref()?;
        let (_, named) = fault.split_once("--")?;
        let end = named.find(|c: char| !c.is_alphanumeric() && c != '-').unwrap_or(named.len());
        let line = file.lines.get(&named[..end])?;
        Some(file.fault(&format!("line {line}: {fault}")))
    }
}

/// The text of a file.
fn read(path: &Path) -> Result<String, String> {
    let bytes = std::fs::read(path).map_err(|e| e.to_string())?;
    String::from_utf8(bytes).map_err(|e| {
        let line = line_of(e.as_bytes(), e.utf8_error().valid_up_to());
        format!("line {line}: not UTF-8 text; save the file as UTF-8")
    })
}

/// Line of a place in a text, counted from 1.
fn line_of(text: &[u8], place: usize) -> usize {
    1 + text.iter().take(place).filter(|&&byte| byte == b'\n').count()
}

/// A fault of the text itself.
fn in_one_line(fault: &toml::de::Error, text: &str) -> String {
    let line = fault.span().map_or(1, |span| line_of(text.as_bytes(), span.start));
    format!("line {line}: {}", fault.message().replace('\n', "; "))
}

/// Whether an option is among the words, `--NAME VALUE` or `--NAME=VALUE`.
fn is_typed(words: &[OsString], name: &str) -> bool {
    let is_it = |word: &str| {
        let rest = word.strip_prefix("--").and_then(|w| w.strip_prefix(name));
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('='))
    };
    words.iter().any(|word| word.to_str().is_some_and(is_it))
}

/// The file named by `--config FILE` or `--config=FILE`.
fn config_of(typed: &[OsString]) -> Option<OsString> {
    typed.iter().enumerate().find_map(|(i, word)| {
        if word == "--config" {
            return typed.get(i + 1).cloned();
        }
        word.to_str()?.strip_prefix("--config=").map(OsString::from)
    })
}

fn flag<'a>(command: &'a Command, name: &str) -> Option<&'a Arg> {
    command.get_arguments().find(|a| a.get_long() == Some(name))
}

/// The words one would type for an option.
fn words_of(arg: &Arg, name: &str, value: &Value) -> Result<Vec<OsString>, String> {
    let word = |value: &Value| match value {
        Value::String(text) => Ok(OsString::from(format!("--{name}={text}"))),
        Value::Integer(_) | Value::Float(_) => Ok(format!("--{name}={value}").into()),
        _ => Err(format!("the option {name} takes no {}", value.type_str())),
    };
    match value {
        Value::Boolean(on) if !arg.get_action().takes_values() => {
            Ok(if *on { vec![format!("--{name}").into()] } else { Vec::new() })
        }
        _ if !arg.get_action().takes_values() => Err(format!("the option {name} is true or false")),
        Value::Array(values) if matches!(arg.get_action(), ArgAction::Append) => {
            values.iter().map(word).collect()
        }
        value => Ok(vec![word(value)?]),
    }
}

/// Whether a value is one ending such as `.png` or several.
fn is_endings(value: &Value) -> bool {
    match value {
        Value::String(text) => ending(Path::new(text)).is_some(),
        Value::Array(values) => values.iter().all(is_endings),
        _ => false,
    }
}

/// Writes all options of a run, given or not, as a file for `--config`.
///
/// # Errors
/// What creating the file fails with.
pub(crate) fn write(file: &Path, typed: &[OsString]) -> Result<Exit, Failure> {
    let all = Cli::command();
    let matches = all.clone().try_get_matches_from(typed).map_err(Failure::usage)?;
    let Some((name, matches)) = matches.subcommand() else { return Ok(Exit::Done) };
    let Some(command) = all.find_subcommand(name) else { return Ok(Exit::Done) };
    let mut text = format!("# Options of beamwright {name}; see beamwright {name} --help.\n");
    for arg in command.get_arguments().chain(all.get_arguments()) {
        let Some(long) = arg.get_long().filter(|l| !OF_ONE_RUN.contains(l)) else { continue };
        let value = value_of(arg, matches);
        if OUTPUTS.contains(&long) && value.as_ref().is_some_and(|v| !is_endings(v)) {
            continue;
        }
        let help = arg.get_help().map(|h| h.to_string()).unwrap_or_default();
        text += &format!("\n# {help}\n");
        text += &match value {
            Some(value) => format!("{long} = {value}\n"),
            None => format!("# {long} =\n"),
        };
    }
    check_target(file).map_err(Failure::input)?;
    let mut files = OutputFiles::default();
    files.add(file, |out| out.write_all(text.as_bytes())).map_err(Failure::input)?;
    files.commit().map_err(Failure::input)?;
    Ok(Exit::Done)
}

/// The value of an option in this run.
fn value_of(arg: &Arg, matches: &ArgMatches) -> Option<Value> {
    let id = arg.get_id().as_str();
    if !arg.get_action().takes_values() {
        return Some(Value::Boolean(matches.get_flag(id)));
    }
    let mut values = matches.get_raw(id)?.map(typed_value);
    if matches!(arg.get_action(), ArgAction::Append) {
        return Some(Value::Array(values.collect()));
    }
    values.next()
}

fn typed_value(word: &OsStr) -> Value {
    let text = word.to_string_lossy();
    let integer = || text.parse().ok().map(Value::Integer);
    let float = || text.parse().ok().filter(|x: &f64| x.is_finite()).map(Value::Float);
    integer().or_else(float).unwrap_or_else(|| Value::String(text.into_owned()))
}
