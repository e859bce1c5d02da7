//! The text of STEP files: golden file, determinism, references, sharing.

mod step_family;

use std::collections::{BTreeMap, BTreeSet};

use beamwright::output::step::{self, Body, Document, Property, Value};
use beamwright::section::Outline;
use nalgebra::Isometry3;
use step_family::{cases, document, part, solids};

fn text(document: &Document) -> String {
    let mut text = Vec::new();
    step::write(document, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

fn count(text: &str, entity: &str) -> usize {
    let begins = |line: &&str| {
        let after = line.split_once('=').and_then(|(_, rest)| rest.strip_prefix(entity));
        after.is_some_and(|rest| rest.starts_with('('))
    };
    text.lines().filter(begins).count()
}

/// Set `BEAMWRIGHT_WRITE_GOLDEN=1` to rewrite the file; then read the difference.
#[test]
fn one_round_beam_is_the_golden_file() {
    let mut beam = part("B001 round 10", Body::round_bar(5.0, 100.0));
    beam.properties = vec![Property::new("length", Value::Length(100.0))];
    let text = text(&document("golden", vec![beam]));
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/step_round_beam.step");
    if std::env::var_os("BEAMWRIGHT_WRITE_GOLDEN").is_some() {
        std::fs::write(path, &text).unwrap();
    }
    let version = concat!("beamwright ", env!("CARGO_PKG_VERSION"));
    let golden = std::fs::read_to_string(path).unwrap();
    let golden = golden.replace("beamwright 0.1.0", version);
    for (line, meant) in text.lines().zip(golden.lines()) {
        assert_eq!(line, meant);
    }
    assert_eq!(text.len(), golden.len());
}

#[test]
fn same_document_gives_the_same_bytes() {
    for case in cases() {
        assert!(text(&case.document) == text(&case.document.clone()), "{}", case.name);
    }
}

#[test]
fn every_reference_leads_to_one_entity() {
    for case in cases() {
        let text = text(&case.document);
        let mut defined = BTreeSet::new();
        let mut used = BTreeSet::new();
        for line in text.lines().filter(|line| line.starts_with('#')) {
            let (id, rest) = line.split_once('=').unwrap();
            assert!(defined.insert(id.to_owned()), "{}: {id} twice", case.name);
            used.extend(references(rest));
        }
        let missing: Vec<_> = used.difference(&defined).collect();
        assert!(missing.is_empty(), "{}: {missing:?}", case.name);
    }
}

/// All `#12` outside strings.
fn references(entity: &str) -> Vec<String> {
    let outside = entity.split('\'').step_by(2);
    outside
        .flat_map(|text| text.split('#').skip(1))
        .map(|tail| {
            let digits: String = tail.chars().take_while(char::is_ascii_digit).collect();
            format!("#{digits}")
        })
        .collect()
}

#[test]
fn closed_shells_use_every_edge_once_each_way() {
    for case in cases() {
        let text = text(&case.document);
        let mut uses: BTreeMap<String, Vec<bool>> = BTreeMap::new();
        for line in text.lines() {
            if let Some((_, rest)) = line.split_once("=ORIENTED_EDGE('',*,*,") {
                let (edge, sense) = rest.split_once(',').unwrap();
                uses.entry(edge.to_owned()).or_default().push(sense == ".T.);");
            }
        }
        assert!(!uses.is_empty());
        for (edge, senses) in uses {
            assert!(senses == [true, false] || senses == [false, true], "{}: {edge}", case.name);
        }
    }
}

#[test]
fn equal_beams_share_a_product() {
    let text = text(&solids::frame().document);
    // Two lengths, one of them in two colours, the ball, the pad.
    assert_eq!(count(&text, "MANIFOLD_SOLID_BREP"), 5);
    // The frame itself, Beams, Joints, Non-design and Pads; the empty group is left out.
    assert_eq!(count(&text, "PRODUCT"), 5 + 5);
    assert_eq!(count(&text, "NEXT_ASSEMBLY_USAGE_OCCURRENCE"), 17 + 4);
    assert_eq!(count(&text, "COLOUR_RGB"), 3);
    for i in 0..12 {
        assert!(text.contains(&format!("'B{i:03} CHS 60.3x4'")), "{i}");
    }
}

#[test]
fn product_numbers_are_unique() {
    let bars = (0..3).map(|i| part("bar", Body::round_bar(1.0, 10.0 + f64::from(i))));
    let text = text(&document("bar", bars.collect()));
    for id in ["'bar'", "'bar (2)'", "'bar (3)'", "'bar (4)'"] {
        assert!(text.contains(&format!("=PRODUCT({id},'bar','',")), "{id}");
    }
}

#[test]
fn exact_shapes_have_exact_surfaces() {
    let has = |body: Body, entities: &[(&str, usize)]| {
        let text = text(&document("d", vec![part("p", body)]));
        for (entity, times) in entities {
            assert_eq!(count(&text, entity), *times, "{entity}\n{text}");
        }
        assert_eq!(count(&text, "B_SPLINE_SURFACE_WITH_KNOTS"), 0);
    };
    has(Body::round_bar(5.0, 10.0), &[("CYLINDRICAL_SURFACE", 1), ("PLANE", 2), ("CIRCLE", 2)]);
    has(Body::tube(5.0, 4.0, 10.0), &[("CYLINDRICAL_SURFACE", 2), ("PLANE", 2), ("CIRCLE", 4)]);
    has(Body::Sphere { radius: 5.0 }, &[("SPHERICAL_SURFACE", 1), ("VERTEX_LOOP", 1)]);
    let find = |profile: &str, loft: &str, cut: &str| {
        let (_, profile) = step_family::profiles().into_iter().find(|p| p.0 == profile).unwrap();
        let (_, loft) = step_family::lofts(profile).into_iter().find(|l| l.0 == loft).unwrap();
        let (_, start, end) = step_family::cuts().into_iter().find(|c| c.0 == cut).unwrap();
        Body::Loft(step::Loft { start, end, ..loft })
    };
    has(find("round", "constant", "mitres"), &[("CYLINDRICAL_SURFACE", 1), ("ELLIPSE", 2)]);
    has(find("tube", "taper", "mitres"), &[("CONICAL_SURFACE", 2), ("ELLIPSE", 4)]);
    has(find("ellipse", "constant", "mitres"), &[("SURFACE_OF_LINEAR_EXTRUSION", 1), ("PLANE", 2)]);
    has(find("rectangle", "taper", "mitres"), &[("PLANE", 6), ("LINE", 12)]);
    has(
        find("box", "constant", "mitres"),
        &[("CYLINDRICAL_SURFACE", 8), ("PLANE", 10), ("ELLIPSE", 16)],
    );
}

#[test]
fn stations_on_a_straight_way_make_one_face() {
    let circle =
        |z: f64| step::Station { z, outer: Outline::circle(10.0 - 0.01 * z), holes: vec![] };
    let loft = step::Loft::between_stations([0.0, 100.0, 250.0, 300.0].map(circle).to_vec());
    let text = text(&document("d", vec![part("p", Body::Loft(loft))]));
    assert_eq!(count(&text, "CONICAL_SURFACE"), 1);
    assert_eq!(count(&text, "ADVANCED_FACE"), 3);
}

#[test]
fn hostile_names_stay_inside_their_strings() {
    let text = text(&solids::names().document);
    assert_eq!(count(&text, "PRODUCT"), solids::HOSTILE.len() + 2);
    assert!(text.is_ascii());
    for line in text.lines().filter(|line| line.starts_with('#')) {
        assert!(line.ends_with(';'), "{line}");
        assert_eq!(line.matches('\'').count() % 2, 0, "{line}");
    }
}

#[test]
fn nameless_things_get_a_name() {
    let mut nameless = part("", Body::round_bar(1.0, 5.0));
    nameless.placement = Isometry3::translation(1.0, 2.0, 3.0);
    let text = text(&document("", vec![nameless]));
    assert!(text.contains("=PRODUCT('Part','Part','',"));
    assert!(!text.contains("=PRODUCT('','"));
}
