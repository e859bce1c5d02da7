//! Catalogue profiles against the values printed in tables of their standards.
//!
//! Sources: EN 10210-2:2006 and EN 10219-2:2006, tables of annex B; ArcelorMittal, *Sections and
//! Merchant Bars* (EN 10365, EN 10056-1); EN 10058 and EN 10060, tables 1; AISC *Steel
//! Construction Manual*, 15th edition, tables 1-1, 1-11 to 1-14, kept in the data files themselves.
//! Tables print three or four digits: values agree within half a percent.

use beamwright::section::Catalogue;
use beamwright::section::profile::STEEL;

/// Rounding of three printed digits.
const PRINTED: f64 = 0.005;

/// Tables of torsion constants of rolled shapes round to three digits of one of several formulas.
const PRINTED_TORSION: f64 = 0.01;

/// Name, A cm², I_y cm⁴, I_z cm⁴, I_t cm⁴, mass kg/m.
const TABLE: [(&str, f64, f64, f64, f64, f64); 22] = [
    ("CHS 21.3x3.2", 1.82, 0.768, 0.768, 1.54, 1.43),
    ("CHS 60.3x4", 7.07, 28.2, 28.2, 56.3, 5.55),
    ("CHS 114.3x5", 17.2, 257.0, 257.0, 514.0, 13.5),
    ("CHS 219.1x8", 53.1, 2960.0, 2960.0, 5919.0, 41.6),
    ("SHS 50x50x4", 7.19, 25.0, 25.0, 40.4, 5.64),
    ("SHS 100x100x5", 18.7, 279.0, 279.0, 439.0, 14.7),
    ("RHS 120x80x5", 18.7, 365.0, 193.0, 401.0, 14.7),
    ("RHS 200x100x8", 44.8, 2234.0, 739.0, 1804.0, 35.1),
    ("CFSHS 100x100x5", 18.4, 271.0, 271.0, 441.0, 14.4),
    ("IPE 80", 7.64, 80.1, 8.49, 0.70, 6.0),
    ("IPE 200", 28.48, 1943.0, 142.4, 6.98, 22.4),
    ("IPE 300", 53.81, 8356.0, 603.8, 20.12, 42.2),
    ("IPE 600", 156.0, 92080.0, 3387.0, 165.4, 122.0),
    ("HEA 200", 53.83, 3692.0, 1336.0, 20.98, 42.3),
    ("HEB 200", 78.08, 5696.0, 2003.0, 59.28, 61.3),
    ("HEB 300", 149.1, 25170.0, 8563.0, 185.0, 117.0),
    ("HEM 200", 131.3, 10640.0, 3651.0, 259.4, 103.0),
    ("UPE 200", 29.0, 1909.0, 187.3, f64::NAN, 22.8),
    ("L 100x100x10", 19.15, 176.7, 176.7, f64::NAN, 15.04),
    ("Round 24", 4.52, f64::NAN, f64::NAN, f64::NAN, 3.55),
    ("Round 50", 19.6, f64::NAN, f64::NAN, f64::NAN, 15.4),
    ("Flat 50x10", 5.0, f64::NAN, f64::NAN, f64::NAN, 3.93),
];

#[track_caller]
fn near(name: &str, what: &str, value: f64, published: f64, tolerance: f64) {
    let off = value / published - 1.0;
    assert!(
        published.is_nan() || off.abs() <= tolerance,
        "{name}: {what} = {value:.4}, published {published}"
    );
}

#[test]
fn european_profiles_have_the_printed_properties() {
    for (name, area, i_y, i_z, i_t, mass) in TABLE {
        let entry = Catalogue::builtin().find(name).unwrap_or_else(|| panic!("{name} is missing"));
        let p = &entry.properties;
        near(name, "A", p.area / 1e2, area, PRINTED);
        near(name, "I_y", p.i_xx / 1e4, i_y, PRINTED);
        near(name, "I_z", p.i_yy / 1e4, i_z, PRINTED);
        near(name, "I_t", p.j / 1e4, i_t, PRINTED_TORSION);
        near(name, "mass", entry.mass_per_metre(STEEL), mass, 0.008);
    }
}

/// Name, W_el,y, W_pl,y, W_el,z, W_pl,z in cm³.
#[test]
fn section_moduli_are_the_printed_ones() {
    let table = [
        ("CHS 60.3x4", 9.34, 12.7, 9.34, 12.7),
        ("CHS 114.3x5", 45.0, 59.8, 45.0, 59.8),
        ("SHS 100x100x5", 55.9, 66.4, 55.9, 66.4),
        ("RHS 120x80x5", 60.9, 74.6, 48.2, 56.1),
        ("IPE 300", 557.1, 628.4, 80.50, 125.2),
        ("HEA 200", 388.6, 429.5, 133.6, 203.8),
        ("HEB 300", 1678.0, 1869.0, 570.9, 870.1),
    ];
    for (name, el_y, pl_y, el_z, pl_z) in table {
        let m = Catalogue::builtin().find(name).unwrap().profile.moduli();
        near(name, "W_el,y", m.w_el_y / 1e3, el_y, PRINTED);
        near(name, "W_pl,y", m.w_pl_y / 1e3, pl_y, PRINTED);
        near(name, "W_el,z", m.w_el_z / 1e3, el_z, PRINTED);
        near(name, "W_pl,z", m.w_pl_z / 1e3, pl_z, PRINTED);
    }
}

/// ArcelorMittal: I_u, I_v in cm⁴ and the slope of u against the longer leg's normal; u of an
/// angle with equal legs lies at 45°.
#[test]
fn angles_have_the_printed_principal_axes() {
    let table = [
        ("L 100x100x10", 280.4, 73.0, 1.0),
        ("L 100x50x8", 123.0, 12.8, 0.258),
        ("L 75x50x6", 46.6, 8.36, 0.435),
    ];
    for (name, i_u, i_v, slope) in table {
        let p = &Catalogue::builtin().find(name).unwrap().properties;
        near(name, "I_u", p.i_1 / 1e4, i_u, 0.01);
        near(name, "I_v", p.i_2 / 1e4, i_v, 0.01);
        near(name, "tan α", p.principal_angle.abs().tan(), slope, 0.01);
    }
}

/// Surface to paint, m² per m: IPE 200 0.768, HEA 200 1.136, HEB 300 1.732, CHS 60.3 0.189.
#[test]
fn surfaces_to_paint_are_the_printed_ones() {
    for (name, surface) in
        [("IPE 200", 0.768), ("HEA 200", 1.136), ("HEB 300", 1.732), ("CHS 60.3x4", 0.189)]
    {
        let profile = &Catalogue::builtin().find(name).unwrap().profile;
        near(name, "surface", profile.outer_perimeter() / 1e3, surface, PRINTED);
    }
}

/// AISC Manual, 15th edition, table 1-1 and 1-11: in², in⁴.
#[test]
fn american_profiles_have_the_printed_properties() {
    const IN: f64 = 25.4;
    let table = [
        ("W8X31", 9.13, 110.0, 37.1, 0.536, 0.02),
        ("W12X26", 7.65, 204.0, 17.3, 0.300, 0.03),
        ("W14X90", 26.5, 999.0, 362.0, 4.06, 0.02),
        ("HSS4X4X1/4", 3.37, 7.80, 7.80, 12.8, 0.01),
        ("HSS8X4X3/8", 7.58, 58.7, 19.6, 49.3, 0.01),
    ];
    for (name, area, i_x, i_y, j, torsion) in table {
        let p = &Catalogue::builtin().find(name).unwrap().properties;
        near(name, "A", p.area / IN.powi(2), area, 0.01);
        near(name, "I_x", p.i_xx / IN.powi(4), i_x, 0.01);
        near(name, "I_y", p.i_yy / IN.powi(4), i_y, 0.01);
        near(name, "J", p.j / IN.powi(4), j, torsion);
    }
}

#[test]
fn every_family_of_the_standards_is_there() {
    let families = Catalogue::builtin().families();
    let expected = [
        ("CHS", 200),
        ("SHS", 100),
        ("RHS", 100),
        ("CFSHS", 140),
        ("CFRHS", 150),
        ("IPE", 18),
        ("HEA", 24),
        ("HEB", 24),
        ("HEM", 24),
        ("UPE", 14),
        ("L", 80),
        ("ROUND", 58),
        ("FLAT", 140),
        ("W", 280),
        ("HSS-ROUND", 180),
        ("HSS-SQUARE", 120),
        ("HSS-RECT", 390),
        ("PIPE", 40),
    ];
    for (name, least) in expected {
        let family = families.iter().find(|family| family.name == name);
        assert!(family.is_some_and(|f| f.count >= least && !f.standard.is_empty()), "{name}");
    }
    let names: std::collections::BTreeSet<&str> =
        Catalogue::builtin().entries().iter().map(|entry| entry.name()).collect();
    assert_eq!(names.len(), Catalogue::builtin().entries().len(), "names are unique");
}
