//! Writes MeshLab projects of the samples and checks what is in them.
//!
//! With `BEAMWRIGHT_MLP_OUT` set to a folder, the projects go there as `NAME.mlp`.

use std::error::Error;
use std::path::{Path, PathBuf};

use beamwright::output::mlp::{self, Project, targets};
use beamwright::output::{OutputFiles, assembly};
use beamwright::pipeline::{self, Settings};
use beamwright_formats::RawMesh;
use nalgebra::Vector3;

#[test]
fn projects_of_the_samples_hold_their_layers() -> Result<(), Box<dyn Error>> {
    let temporary = tempfile::tempdir()?;
    let folder = std::env::var_os("BEAMWRIGHT_MLP_OUT")
        .map_or_else(|| temporary.path().to_owned(), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    for name in ["cantilever", "four_fixings", "single_bar", "y_form"] {
        project(name, &folder)?;
    }
    Ok(())
}

fn project(name: &str, folder: &Path) -> Result<(), Box<dyn Error>> {
    let input = Path::new("samples").join(name).with_extension("obj");
    let outcome = pipeline::run(&input, &Settings::default(), &mut ())?;
    let document = assembly::assembly(name, &outcome.frame, &outcome.joints, 7850.0)?.document;
    let path = folder.join(name).with_extension("mlp");
    let mut files = OutputFiles::default();
    let project = Project {
        surface: &outcome.surface,
        skeleton: &outcome.skeleton,
        sections: &outcome.sections,
        document: &document,
    };
    mlp::add(&mut files, &path, &project)?;
    files.commit()?;

    let [top, mesh, skeleton, off_centre, beams] = targets(&path);
    let text = std::fs::read_to_string(top)?;
    assert_eq!(text.matches("<MLMesh ").count(), 4);
    assert!(!text.contains(folder.to_str().unwrap_or("?")), "layers are named relative to it");

    let again = beamwright_formats::read(&mesh, &Default::default())?;
    assert_eq!(again.faces.len(), outcome.surface.mesh.face_count());
    let labelled = pipeline::surface(&mesh, &Settings::default(), &mut ())?;
    assert_eq!(labelled.labels.sets, outcome.surface.labels.sets, "{name}: the label survives");
    assert_eq!(labelled.interfaces.len(), outcome.surface.interfaces.len());

    for layer in [skeleton, off_centre] {
        let edges = beamwright::skeleton_file::read(&layer, beamwright_formats::Unit::Mm)?;
        assert_eq!(edges.cycle_rank(), outcome.skeleton.cycle_rank());
    }

    let solids = beamwright_formats::read(&beams, &Default::default())?;
    let enclosed: f64 = solids.faces.iter().map(|f| under_face(&solids, f)).sum();
    let parts = document.groups.iter().flat_map(|g| &g.parts);
    let volume = parts.map(|p| p.body.volume()).sum::<Result<f64, _>>()?;
    assert!((enclosed / volume - 1.0).abs() < 0.005, "{name}: {enclosed} {volume}");
    Ok(())
}

/// Signed volume between a triangle and the origin, mm³.
fn under_face(mesh: &RawMesh, face: &[u32]) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|i| Vector3::from(mesh.positions[face[i] as usize]));
    a.dot(&b.cross(&c)) / 6.0
}
