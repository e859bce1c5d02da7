//! Many meshes into one folder: one bad file does not stop the rest.

use std::path::{Path, PathBuf};

use super::args::{GlobalArgs, ReconstructArgs};
use super::exit::{Exit, Failure};
use super::progress::{Progress, interrupted};
use super::reconstruct::run_one;

/// Reconstructs every mesh; the results of `NAME.EXT` go to `folder/NAME.step` and beside it.
///
/// # Errors
/// A folder that cannot be made, or two meshes of one name. Otherwise, at the end, how many meshes
/// failed, with the exit code of the first of them.
pub(crate) fn run(
    args: &ReconstructArgs,
    folder: &Path,
    global: &GlobalArgs,
    progress: &mut Progress,
) -> Result<Exit, Failure> {
    let inputs: Vec<&PathBuf> = std::iter::once(&args.input.input).chain(&args.more).collect();
    let outputs = outputs(&inputs, folder)?;
    std::fs::create_dir_all(folder)
        .map_err(|e| Failure::input(format!("cannot make the folder {}: {e}", folder.display())))?;
    let mut failed: Vec<(&PathBuf, Exit)> = Vec::new();
    for (input, output) in inputs.iter().zip(outputs) {
        let mut one = args.clone();
        one.input.input = input.to_path_buf();
        one.output.output = Some(output);
        if let Err(Failure { exit, message }) = run_one(&one, global, progress) {
            progress.finish();
            eprintln!("error: {}: {message}", input.display());
            failed.push((input, exit));
        }
        if interrupted() {
            return Err(Failure { exit: Exit::Interrupted, message: "interrupted".into() });
        }
    }
    let Some(&(_, exit)) = failed.first() else { return Ok(Exit::Done) };
    let names: Vec<String> = failed.iter().map(|(path, _)| path.display().to_string()).collect();
    let message =
        format!("{} of {} meshes failed: {}", names.len(), inputs.len(), names.join(", "));
    Err(Failure { exit, message })
}

/// A STEP file for every mesh.
fn outputs(inputs: &[&PathBuf], folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut outputs: Vec<PathBuf> = Vec::with_capacity(inputs.len());
    for input in inputs {
        let name = input.file_stem().unwrap_or_default();
        let mut output = folder.join(name).into_os_string();
        output.push(".step");
        let output = PathBuf::from(output);
        if outputs.contains(&output) {
            let shown = output.display();
            return Err(Failure::usage(format!("two meshes would be written to {shown}")));
        }
        outputs.push(output);
    }
    Ok(outputs)
}
