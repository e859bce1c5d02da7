//! The cut list of the samples: sums that agree with the frame.

use std::f64::consts::{FRAC_PI_3, PI, TAU};
use std::path::Path;

use beamwright::frame::Loft;
use beamwright::frame::shape::ShapeStation;
use beamwright::joint::JointKind;
use beamwright::output::assembly::{assembly, mark};
use beamwright::output::cut_list::{CutList, CutListParams, Stock};
use beamwright::output::material::Material;
use beamwright::pipeline::{self, Outcome, Settings};
use beamwright::section::outline::Outline;

type Outcomes = Result<(), Box<dyn std::error::Error>>;

fn run(sample: &str, joints: JointKind) -> Result<Outcome, pipeline::PipelineError> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(sample);
    pipeline::run(&path, &Settings { joints, ..Settings::default() }, &mut ())
}

fn list(outcome: &Outcome, stock: Option<Stock>) -> CutList {
    let params = CutListParams {
        material: Material { name: "=steel".into(), ..Material::default() },
        stock,
    };
    let sizes = assembly("list", &outcome.frame, &outcome.joints, params.material.density)
        .expect("solids")
        .sizes;
    CutList::new(&outcome.frame, &outcome.joints, &sizes, &params)
}

#[test]
fn one_bar_is_one_piece_of_its_length_and_mass() -> Outcomes {
    let list = list(&run("single_bar.obj", JointKind::None)?, None);
    let [bar] = list.pieces.as_slice() else { panic!("{:?}", list.pieces) };
    assert_eq!((bar.quantity, bar.piece.as_str()), (1, "P01"));
    assert!((bar.length_mm - 80.0).abs() < 0.05);
    // π 4² · 80 mm³ of steel.
    assert!((bar.mass_kg / (PI * 16.0 * 80.0 * 7850e-9) - 1.0).abs() < 0.01);
    assert!((bar.unit_surface_m2 / (TAU * 4.0 * 80.0 * 1e-6) - 1.0).abs() < 0.01);
    Ok(())
}

#[test]
fn masses_and_surfaces_of_tapered_round_members_are_those_of_their_cones() -> Outcomes {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/quadpod.obj");
    for loft in [Loft::Taper, Loft::Multi] {
        let mut settings = Settings { joints: JointKind::None, ..Settings::default() };
        settings.profiles.loft = loft;
        settings.profiles.choice = "round".parse()?;
        let outcome = pipeline::run(&path, &settings, &mut ())?;
        let list = list(&outcome, None);
        for piece in &list.pieces {
            let named = |i: &usize| piece.marks[0] == mark(*i);
            let i = (0..outcome.frame.beams.len()).find(named).expect("a beam");
            let beam = &outcome.frame.beams[i];
            let radius = |s: &ShapeStation| match &s.region.outer {
                Outline::Circle { radius, .. } => *radius,
                other => panic!("{other:?}"),
            };
            let (mut volume, mut skin) = (0.0, 0.0);
            for w in beam.shape.stations.windows(2) {
                let [a, b] = [radius(&w[0]), radius(&w[1])];
                let height = (w[1].at - w[0].at) * beam.cut_length;
                volume += FRAC_PI_3 * height * (a * a + a * b + b * b);
                skin += PI * (a + b) * height.hypot(b - a);
            }
            let (mass, surface) = (volume * 7850e-9, skin * 1e-6);
            // To the last digit of the list.
            let name = &piece.piece;
            assert!((piece.unit_mass_kg - mass).abs() < 6e-7, "{loft:?} {name}: {mass}");
            assert!((piece.unit_surface_m2 - surface).abs() < 6e-7, "{loft:?} {name}: {surface}");
        }
    }
    Ok(())
}

#[test]
fn every_beam_is_listed_once_and_totals_add_up() -> Outcomes {
    for sample in ["cantilever.obj", "four_fixings.obj", "quadpod.obj", "y_form.obj"] {
        let outcome = run(sample, JointKind::Trim)?;
        let stock = Stock { length_mm: 500.0, kerf_mm: 2.0 };
        let list = list(&outcome, Some(stock));
        let mut marks: Vec<&String> = list.pieces.iter().flat_map(|p| &p.marks).collect();
        marks.sort();
        marks.dedup();
        assert_eq!(marks.len(), outcome.frame.beams.len(), "{sample}");
        assert!(list.pieces.iter().all(|p| p.marks.len() == p.quantity));
        let mass: f64 = list.pieces.iter().map(|p| p.mass_kg).sum();
        assert!((list.mass() - mass).abs() < 1e-6 * mass.max(1.0) + 1e-5, "{sample}");
        let nesting = list.nesting.as_ref().ok_or("asked for")?;
        let nested: usize = nesting.bars.iter().map(|b| b.pieces.len()).sum();
        assert_eq!(nested + nesting.too_long.len(), marks.len(), "{sample}");
    }
    Ok(())
}

#[test]
fn all_lines_of_the_csv_have_the_same_columns_and_no_formula() -> Outcomes {
    let list = list(&run("y_form.obj", JointKind::Mitre)?, None);
    let mut text = Vec::new();
    list.write_csv(&mut text)?;
    let mut reader = csv::ReaderBuilder::new().from_reader(text.as_slice());
    let records = reader.records().collect::<Result<Vec<_>, _>>()?;
    assert_eq!(records.iter().filter(|r| r[0].starts_with('P')).count(), list.pieces.len());
    assert!(records.iter().flatten().all(|cell| !cell.starts_with('=')));
    assert!(String::from_utf8(text)?.contains("'=steel"));
    Ok(())
}
