//! What is written: each output as a file, or by its ending alone beside the STEP file.

use std::path::{Path, PathBuf};

use clap::Args;

use super::exit::Failure;

#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Output")]
pub(crate) struct OutputArgs {
    /// STEP file with one named solid a beam
    ///
    /// Any other output may be given by its ending alone: `--report .html` goes beside the STEP file,
    /// under its name.
    #[arg(short, long, value_name = "OUT.step", required_unless_present = "out_dir")]
    pub(crate) output: Option<PathBuf>,

    /// Folder for the results of many meshes, each under its own name
    ///
    /// Other outputs are then given by their endings alone: `--report .html --picture .png`.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["output", "compare"])]
    pub(crate) out_dir: Option<PathBuf>,

    /// Cut list: .csv .json (default: beside the STEP file, ending .csv)
    #[arg(long, value_name = "FILE")]
    pub(crate) cut_list: Option<PathBuf>,

    /// Skeleton: .json .obj .ply .cg .swc (default: beside the STEP file, ending .skeleton.json)
    #[arg(long, value_name = "FILE")]
    pub(crate) skeleton: Option<PathBuf>,

    /// Section properties at every skeletal point and along every beam: .json .csv
    #[arg(long, value_name = "FILE")]
    pub(crate) sections: Option<PathBuf>,

    /// What else to write, by extension: .mlp (MeshLab project with its layers), .glb (3D scene),
    /// .dxf (axes), .ifc (IFC4 members), .inp (CalculiX beams); may be repeated
    #[arg(long, value_name = "FILE")]
    pub(crate) export: Vec<PathBuf>,

    /// Picture of mesh and beams: .png .svg; may be repeated
    #[arg(long, value_name = "FILE")]
    pub(crate) picture: Vec<PathBuf>,

    /// Report to look at in a browser: one .html file that needs no network
    #[arg(long, value_name = "FILE.html")]
    pub(crate) report: Option<PathBuf>,

    /// Skeleton of another program to hold against ours in the report; may be repeated
    #[arg(long, value_name = "SKELETON", requires = "report")]
    pub(crate) compare: Vec<PathBuf>,

    /// Leave the non-design parts out of the STEP file
    #[arg(long)]
    pub(crate) no_non_design: bool,
}

impl OutputArgs {
    /// The same for one mesh: its STEP file, and beside it all that is given by its ending alone.
    pub(crate) fn of_one(&self, step: PathBuf) -> Self {
        let mut one = self.clone();
        for (_, path) in one.others_mut() {
            if let Some(ending) = ending(path) {
                *path = step.with_extension(ending);
            }
        }
        one.output = Some(step);
        one
    }

    /// All outputs but the STEP file, each with its option.
    fn others_mut(&mut self) -> impl Iterator<Item = (&'static str, &mut PathBuf)> {
        let single = [
            ("--cut-list", &mut self.cut_list),
            ("--skeleton", &mut self.skeleton),
            ("--sections", &mut self.sections),
            ("--report", &mut self.report),
        ];
        let several = [("--export", &mut self.export), ("--picture", &mut self.picture)];
        let single = single.into_iter().filter_map(|(option, path)| Some((option, path.as_mut()?)));
        let several =
            several.into_iter().flat_map(|(option, all)| all.iter_mut().map(move |p| (option, p)));
        single.chain(several)
    }

    /// Whether all outputs can be those of many meshes.
    ///
    /// # Errors
    /// The first that names one file.
    pub(crate) fn check_endings(&self) -> Result<(), Failure> {
        let mut output = self.clone();
        let Some((option, path)) = output.others_mut().find(|(_, path)| ending(path).is_none())
        else {
            return Ok(());
        };
        let wanted = path.extension().or(path.file_name()).unwrap_or_default().to_string_lossy();
        Err(Failure::usage(format!(
            "{option} {} is one file for many meshes: with --out-dir give its ending alone, \
             {option} .{}",
            path.display(),
            wanted.trim_start_matches('.')
        )))
    }
}

/// `png` for a path that is nothing but `.png`.
pub(crate) fn ending(path: &Path) -> Option<&str> {
    let ending = path.to_str()?.strip_prefix('.')?;
    (!ending.is_empty() && ending != "." && !ending.contains(['/', '\\'])).then_some(ending)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ending_is_a_dot_and_no_path() {
        for (path, wanted) in [(".png", Some("png")), (".skeleton.ply", Some("skeleton.ply"))] {
            assert_eq!(ending(Path::new(path)), wanted, "{path}");
        }
        for path in ["png", "a.png", "./.png", "../a.png", ".", "..", "", "/tmp/.png"] {
            assert_eq!(ending(Path::new(path)), None, "{path}");
        }
    }
}
