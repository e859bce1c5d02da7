use crate::Format;
use crate::testing::{mesh, message, names_of_faces};

const FACET: &str = "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

fn binary(header: &[u8], attributes: &[u16]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((attributes.len() as u32).to_le_bytes());
    for (facet, attribute) in attributes.iter().enumerate() {
        let numbers = [0.0, 0.0, 1.0, 0.0, 0.0, facet as f32, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        bytes.extend(numbers.iter().flat_map(|number: &f32| number.to_le_bytes()));
        bytes.extend(attribute.to_le_bytes());
    }
    bytes
}

#[test]
fn every_solid_is_read_with_its_name() {
    let text = format!(
        "solid non_design\n{FACET}{FACET}endsolid non_design\n\nsolid\n{FACET}endsolid\n\
         solid strut 1 \n{FACET}endsolid other\nsolid empty\nendsolid\nsolid non_design\n{FACET}endsolid"
    );
    let mesh = mesh(text, Format::Stl);
    assert_eq!(mesh.faces.len(), 5);
    assert_eq!(mesh.positions.len(), 15);
    let expected: [&[&str]; 5] =
        [&["non_design"], &["non_design"], &[], &["strut 1"], &["non_design"]];
    assert_eq!(names_of_faces(&mesh), expected);
    assert_eq!(mesh.carriers.names, ["non_design", "strut 1"]);
}

#[test]
fn ascii_is_known_however_it_is_written() {
    let plain = mesh(format!("solid a\n{FACET}endsolid a\n"), Format::Stl);
    for text in [
        format!("  SOLID a\n{}ENDSOLID a\n", FACET.to_uppercase()),
        format!("solid a\n{}endsolid a", FACET.replace("\n ", " ").replace("0 0 1 ", "0 0 1\t")),
        format!("solid a\r\n{}endsolid a\r\n", FACET.replace('\n', "\r\n")),
        format!("solid a\r{}endsolid a\r", FACET.replace('\n', "\r")),
        format!(
            "\u{feff}solid a\n\n{}end solid a\n",
            FACET.replace("endloop", "end loop").replace("endfacet", "end facet")
        ),
        format!("solid a\n{}endsolid a", FACET.replace("0 0 1", "-nan(ind) nan 1,5")),
    ] {
        assert_eq!(mesh(&text, Format::Stl), plain, "{text}");
    }
}

#[test]
fn a_facet_may_have_more_than_three_points() {
    let text = format!(
        "solid a\n{}endsolid",
        FACET.replace("  vertex 0 1 0\n", "  vertex 1 1 0\n  vertex 0 1 0\n")
    );
    assert_eq!(mesh(text, Format::Stl).faces.corners, [0, 1, 2, 3]);
}

#[test]
fn a_binary_file_is_read_whatever_its_header_begins_with() {
    for header in
        [&b"solid part"[..], b"", b"# v 1 2 3", b"ply\n", b"OFF\n3 1 0\n", b"solid \xff facet"]
    {
        let mesh = mesh(binary(header, &[0, 0, 0]), Format::Stl);
        assert_eq!(mesh.faces.len(), 3);
        assert_eq!(mesh.positions[6], [0.0, 0.0, 2.0]);
        assert!(mesh.carriers.face_colour.is_empty());
        assert!(mesh.carriers.face_names.is_empty());
    }
}

#[test]
fn attributes_are_colours_where_bit_15_is_set() {
    let attributes = [0x8000 | 31, 0x7fff, 0x8000 | 31 << 5, 0, 0x8000 | 31 << 10];
    let colours = mesh(binary(b"", &attributes), Format::Stl).carriers.face_colour;
    let expected = [Some([248, 0, 0]), None, Some([0, 248, 0]), None, Some([0, 0, 248])];
    assert_eq!(colours, expected);
}

#[test]
fn attributes_of_magics_are_colours_where_bit_15_is_not_set() {
    let attributes = [0x8000, 31, 31 << 10, 0xffff];
    let colours =
        mesh(binary(b"COLOR=\xff\0\0\xff", &attributes), Format::Stl).carriers.face_colour;
    assert_eq!(colours, [None, Some([248, 0, 0]), Some([0, 0, 248]), None]);
}

#[test]
fn attributes_are_kept_over_the_edges_of_blocks() {
    let attributes: Vec<u16> = (0..20_000).map(|number| 0x8000 | number).collect();
    let mut bytes = binary(b"", &attributes);
    bytes.extend([7; 49]);
    let colours = mesh(bytes, Format::Stl).carriers.face_colour;
    for (attribute, colour) in attributes.into_iter().zip(colours) {
        let expected =
            [attribute, attribute >> 5, attribute >> 10].map(|five| ((five & 31) * 8) as u8);
        assert_eq!(colour, Some(expected));
    }
}

#[test]
fn faults_of_ascii_are_told_with_their_line() {
    let text = format!("solid a\n{FACET}endsolid a\n");
    for (from, to, expected) in [
        ("solid a\n", "hello\n", "line 1: expected `solid`, found `hello`"),
        (
            "facet normal",
            "facets normal",
            "line 2: expected `facet normal` or `endsolid`, found `facets`",
        ),
        ("normal 0 0 1", "0 0 1", "line 2: expected `normal x y z` after `facet`, found `0`"),
        (
            "normal 0 0 1",
            "normal 0 0",
            "line 2: expected `normal x y z` after `facet`, found the end",
        ),
        ("outer loop", "outer", "line 3: expected `loop`, found the end of the line"),
        ("vertex 1 0 0", "vertex 1 0", "line 5: expected vertex x y z, found the end of the line"),
        ("vertex 1 0 0", "vertex 1 nan 0", "line 5: `nan` is not a finite number"),
        ("vertex 1 0 0", "vertex 1,0 0 0", "line 5: `1,0` has a comma"),
        ("  vertex 1 0 0\n", "", "line 7: expected three vertices in a facet, found `2 of them"),
        ("endfacet\nendsolid a\n", "", "line 7: the file ends before `endfacet`"),
        ("endsolid a\n", "", "line 8: the file ends before `facet normal` or `endsolid`"),
        (FACET, "", "it has 0 points but no faces"),
    ] {
        let message = message(text.replacen(from, to, 1), Format::Stl);
        assert!(message.starts_with(expected), "{from} → {to}: {message}");
    }
}

#[test]
fn the_count_of_a_binary_file_must_be_that_of_its_triangles() {
    let mut bytes = binary(b"solid", &[0, 0]);
    bytes[80..84].copy_from_slice(&4_000_000_000_u32.to_le_bytes());
    assert!(message(&bytes, Format::Stl).starts_with(
        "byte 80: the header announces 4000000000 triangles, but the 100 bytes that follow hold 2"
    ));
    bytes[80..84].copy_from_slice(&0_u32.to_le_bytes());
    assert!(message(&bytes, Format::Stl).contains("announces 0 triangles"));
    let cut = message(&binary(b"", &[0, 0])[..180], Format::Stl);
    assert!(cut.contains("announces 2 triangles, but the 96 bytes that follow hold 1"), "{cut}");
    assert!(
        message([0; 50], Format::Stl)
            .starts_with("byte 50: the file ends before the end of the header")
    );
    assert!(message([0; 84], Format::Stl).contains("no faces"));
}

#[test]
fn a_point_of_a_binary_file_must_be_finite() {
    for number in [f32::NAN, f32::INFINITY] {
        let mut bytes = binary(b"", &[0, 0]);
        bytes[84 + 50 + 16..84 + 50 + 20].copy_from_slice(&number.to_le_bytes());
        let message = message(bytes, Format::Stl);
        let expected =
            format!("byte 134: the point (0.0, {number}, 1.0) of triangle 2 is not a finite");
        assert!(message.starts_with(&expected), "{message}");
    }
}
