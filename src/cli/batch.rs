//! `beamwright reconstruct`: one mesh, or many into one folder, where one bad file does not stop the rest.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::args::GlobalArgs;
use super::exit::{Exit, Failure};
use super::progress::{Progress, interrupted};
use super::reconstruct::{Job, ReconstructArgs};
use super::show;

/// Reconstructs one mesh, or many where a folder is given.
///
/// # Errors
/// As [`into_folder`] and [`Job::run`]; several meshes without a folder.
pub(crate) fn run(
    args: &ReconstructArgs,
    global: &GlobalArgs,
    progress: &mut Progress,
) -> Result<Exit, Failure> {
    args.shop.check()?;
    match (&args.output.out_dir, &args.output.output) {
        (Some(folder), _) => into_folder(args, folder, global, progress),
        (None, _) if !args.more.is_empty() => Err(Failure::usage(
            "for more than one mesh give a folder, --out-dir, instead of --output",
        )),
        (None, step) => {
            let step = step.clone().unwrap_or_default();
            Job::new(args.of_one(&args.input.input, step))?.run(global, progress)
        }
    }
}

/// Reconstructs every mesh; the results of `NAME.EXT` go to `folder/NAME.step` and beside it.
///
/// # Errors
/// An output that is not given by its ending, two files of one name, or a folder that cannot be
/// made. Otherwise, at the end, how many meshes failed, with the exit code of the first of them.
fn into_folder(
    args: &ReconstructArgs,
    folder: &Path,
    global: &GlobalArgs,
    progress: &mut Progress,
) -> Result<Exit, Failure> {
    args.output.check_endings()?;
    let inputs = std::iter::once(&args.input.input).chain(&args.more);
    let jobs: Vec<Job> = inputs
        .map(|input| Job::new(args.of_one(input, step_in(folder, input))))
        .collect::<Result<_, _>>()?;
    check_names(&jobs)?;
    std::fs::create_dir_all(folder)
        .map_err(|e| Failure::input(format!("cannot make the folder {}: {e}", folder.display())))?;
    let count = jobs.len();
    let mut failed: Vec<(String, Exit)> = Vec::new();
    for job in jobs {
        let input = job.input().display().to_string();
        let end = job.run(global, progress);
        if interrupted() {
            return Err(Failure::interrupted());
        }
        if let Err(Failure { exit, message }) = end {
            progress.finish();
            // Most messages name the mesh themselves.
            let of = if message.contains(&input) { String::new() } else { format!("{input}: ") };
            show::error(&format!("{of}{message}"));
            failed.push((input, exit));
        }
    }
    let Some(&(_, exit)) = failed.first() else { return Ok(Exit::Done) };
    let names: Vec<String> = failed.into_iter().map(|(input, _)| input).collect();
    let message = format!("{} of {count} meshes failed: {}", names.len(), names.join(", "));
    Err(Failure { exit, message })
}

/// The STEP file of a mesh.
fn step_in(folder: &Path, input: &Path) -> PathBuf {
    let mut step = folder.join(input.file_stem().unwrap_or_default()).into_os_string();
    step.push(".step");
    step.into()
}

/// Whether every output has a name of its own.
fn check_names(jobs: &[Job]) -> Result<(), Failure> {
    let mut makers: BTreeMap<&Path, usize> = BTreeMap::new();
    for (i, job) in jobs.iter().enumerate() {
        for output in job.outputs() {
            let Some(other) = makers.insert(output, i) else { continue };
            let shown = output.display();
            let [one, two] = [other, i].map(|k| jobs[k].input().display());
            return Err(Failure::usage(if other == i {
                format!("two outputs of {one} would be written to {shown}")
            } else {
                format!("{one} and {two} would both be written to {shown}")
            }));
        }
    }
    Ok(())
}
