use crate::testing::{mesh, message, names_of_faces};
use crate::{Format, RawMesh};

const POINTS: &str = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const SQUARE: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const CORNERS: &str = "property list uchar int vertex_indices\n";

fn ascii(faces: usize, properties: &str, data: &str) -> String {
    format!(
        "ply\nformat ascii 1.0\n{POINTS}element face {faces}\n{CORNERS}{properties}end_header\n{SQUARE}{data}"
    )
}

/// A square of one face, with properties of all kinds, in a binary encoding.
fn binary(is_big: bool) -> Vec<u8> {
    let encoding = if is_big { "binary_big_endian" } else { "binary_little_endian" };
    let header = format!(
        "ply\nformat {encoding} 1.0\ncomment \u{e4}\nelement extra 2\nproperty double a\nproperty short b\n\
         element odd 1\nproperty list ushort float c\n{POINTS}property uchar red\nproperty uchar green\n\
         property uchar blue\nproperty list uchar uchar d\nelement face 2\n{CORNERS}property int flags\n\
         property double quality\nproperty ushort red\nproperty ushort green\nproperty ushort blue\n\
         property char non-design\nproperty uint region\nelement edge 1\nproperty int vertex1\nend_header\n"
    );
    let mut bytes = header.into_bytes();
    let mut put = |mut number: Vec<u8>| {
        // Numbers come in little endian.
        if is_big {
            number.reverse();
        }
        bytes.extend(number);
    };
    for a in [1.0_f64, 2.0] {
        put(a.to_le_bytes().into());
        put(3_i16.to_le_bytes().into());
    }
    put(2_u16.to_le_bytes().into());
    put(1_f32.to_le_bytes().into());
    put(1_f32.to_le_bytes().into());
    for [x, y] in [[0.0_f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
        [x, y, 0.0].into_iter().for_each(|number| put(number.to_le_bytes().into()));
        [255_u8, 128, 0, 1, 77].into_iter().for_each(|byte| put(vec![byte]));
    }
    for corners in [&[0_i32, 1, 2, 3][..], &[2, 1, 0]] {
        put(vec![corners.len() as u8]);
        corners.iter().for_each(|corner| put(corner.to_le_bytes().into()));
        put((32 * (corners.len() as i32 - 3) + 1).to_le_bytes().into());
        put(0.75_f64.to_le_bytes().into());
        [65535_u16, 257, 0].into_iter().for_each(|channel| put(channel.to_le_bytes().into()));
        put(vec![0xff]);
        put((corners.len() as u32).to_le_bytes().into());
    }
    put(7_i32.to_le_bytes().into());
    bytes
}

fn assert_is_binary_square(mesh: &RawMesh) {
    let carriers = &mesh.carriers;
    assert_eq!(mesh.positions[2], [1.0, 1.0, 0.0]);
    assert_eq!(mesh.faces.corners, [0, 1, 2, 3, 2, 1, 0]);
    assert_eq!(carriers.vertex_colour, [[255, 128, 0]; 4]);
    assert_eq!(carriers.face_selected, [true, false]);
    assert_eq!(carriers.face_quality, [0.75; 2]);
    assert_eq!(carriers.face_colour, [Some([255, 1, 0]); 2]);
    assert_eq!(carriers.face_property, [-1, -1]);
    assert_eq!(names_of_faces(mesh), [["region=4"], ["region=3"]]);
}

#[test]
fn both_binary_encodings_are_read_with_all_labels() {
    assert_is_binary_square(&mesh(binary(false), Format::Ply));
    assert_is_binary_square(&mesh(binary(true), Format::Ply));
}

#[test]
fn bytes_behind_the_last_element_are_padding() {
    let mut bytes = binary(false);
    bytes.extend([0; 100]);
    assert_is_binary_square(&mesh(bytes, Format::Ply));
}

#[test]
fn a_binary_file_may_have_a_header_of_cr_lines() {
    // The data begins with the byte of LF.
    let header = "ply\rformat binary_little_endian 1.0\relement face 1\rproperty list uchar uchar vertex_index\r\
                  element vertex 11\rproperty uchar x\rproperty uchar y\rproperty uchar z\rend_header\r";
    let face: Vec<u8> = [10].into_iter().chain(0..10).collect();
    let points = (0..33).collect();
    let bytes = [header.as_bytes().to_vec(), face, points].concat();
    let mesh = mesh(bytes, Format::Ply);
    assert_eq!(mesh.faces.corners.len(), 10);
    assert_eq!(mesh.positions[10], [30.0, 31.0, 32.0]);
}

#[test]
fn ascii_is_read_with_lf_crlf_or_cr() {
    let text = ascii(1, "", "4 0 1 2 3\n");
    let lf = mesh(&text, Format::Ply);
    assert_eq!(lf.faces.corners, [0, 1, 2, 3]);
    assert_eq!(mesh(text.replace('\n', "\r\n"), Format::Ply), lf);
    assert_eq!(mesh(text.replace('\n', "\r"), Format::Ply), lf);
    assert_eq!(mesh(text.replace('\n', " \n\n"), Format::Ply), lf);
}

#[test]
fn ascii_carries_the_same_labels() {
    let properties = "property int flags\nproperty float quality\nproperty uchar red\nproperty uchar green\n\
                      property uchar blue\nproperty uchar alpha\nproperty int NonDesign\nproperty int id\nproperty int label\n";
    let data = "3 0 1 2 32 0.5 255 0 1 255 1 7 -5\n3 0 2 3 31 nan 0 1 0 255 0 8 2\n";
    let mesh = mesh(ascii(2, properties, data), Format::Ply);
    let carriers = &mesh.carriers;
    assert_eq!(carriers.face_selected, [true, false]);
    assert_eq!(carriers.face_quality[0], 0.5);
    assert!(carriers.face_quality[1].is_nan());
    assert_eq!(carriers.face_colour, [Some([255, 0, 1]), Some([0, 1, 0])]);
    assert_eq!(carriers.face_property, [1, 0]);
    assert_eq!(names_of_faces(&mesh), [["label=-5"], ["label=2"]]);
}

#[test]
fn bytes_of_colours_are_not_taken_for_fractions() {
    let properties = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let bytes = mesh(ascii(1, properties, "3 0 1 2 1 0 0\n"), Format::Ply);
    assert_eq!(bytes.carriers.face_colour, [Some([1, 0, 0])]);
    let fractions = properties.replace("uchar", "float");
    let fractions = mesh(ascii(1, &fractions, "3 0 1 2 1 0 0\n"), Format::Ply);
    assert_eq!(fractions.carriers.face_colour, [Some([255, 0, 0])]);
}

#[test]
fn a_number_of_a_face_is_no_label() {
    let faces = 300;
    let data: String = (0..faces).map(|face| format!("3 0 1 2 {face}\n")).collect();
    let mesh = mesh(ascii(faces, "property int id\n", &data), Format::Ply);
    assert!(mesh.carriers.names.is_empty());
    assert!(mesh.carriers.face_names.is_empty());
}

#[test]
fn names_that_ply_rs_refuses_are_passed_over() {
    let properties = "property float scalar_distance[<0.1]\nproperty uchar 3\u{e4}\n";
    let mesh = mesh(ascii(1, properties, "3 0 1 2 nan 4\n"), Format::Ply);
    assert_eq!(mesh.faces.len(), 1);
    assert_eq!(names_of_faces(&mesh), [["3\u{e4}=4"]]);
}

#[test]
fn numbers_may_lack_digits_on_one_side_of_the_point() {
    let text = ascii(1, "", "3 0 1 2\n").replace("1 1 0", ".5 5. +1e0");
    assert_eq!(mesh(text, Format::Ply).positions[2], [0.5, 5.0, 1.0]);
}

#[test]
fn faults_of_the_header_are_told_with_their_line() {
    let text = ascii(1, "property float q\n", "");
    for (from, to, expected) in [
        ("ply\n", "plyy\n", "line 1: expected `ply`, found `plyy`"),
        ("ascii", "asci", "line 2: expected `format`, `element NAME COUNT`"),
        ("format ascii 1.0\n", "", "line 9: expected `format`"),
        ("vertex 4", "vertex -4", "line 3: expected `format`, `element NAME COUNT`"),
        ("vertex 4", "vertex 99999999999999999999", "line 3: expected `format`"),
        ("float x", "real x", "line 4: expected `format`"),
        (
            "float y",
            "float x",
            "line 5: expected each element and each of its properties to be declared once, found `property float x` again",
        ),
        ("face 1", "vertex 1", "line 7: expected each element"),
        ("float z", "float w", "line 10: expected properties x, y and z"),
        ("vertex_indices", "corners", "line 10: expected `property list … vertex_indices`"),
        (
            "uchar int vertex",
            "uchar float vertex",
            "line 10: expected `property list … vertex_indices`",
        ),
        ("end_header", "end", "line 10: expected `format`"),
        (
            "vertex 4",
            "vertex 4000000",
            "line 3: the header announces 4000000 of element vertex, but the 24 bytes that follow hold at most 4",
        ),
        ("face 1", "face 4000", "line 7: the header announces 4000 of element face"),
        ("element vertex", "element point", "line 10: expected `element vertex` in the header"),
    ] {
        let message = message(text.replace(from, to), Format::Ply);
        // The face line is missing in the text; no fault of the header may get that far.
        assert!(message.starts_with(expected), "{from} → {to}: {message}");
    }
    let text = "ply\nformat ascii 1.0\ncomment cut";
    assert!(message(text, Format::Ply).starts_with("line 3: the file ends before `end_header`"));
}

#[test]
fn faults_of_ascii_data_are_told_with_their_line() {
    let text = ascii(2, "property uchar red\n", "3 0 1 2 9\n4 0 1 2 3 9\n");
    for (from, to, expected) in [
        (
            "1 1 0\n",
            "1 1\n",
            "line 13: expected a number for each property of the element, found the end",
        ),
        ("1 1 0\n", "1 1,5 0\n", "line 13: `1,5` has a comma"),
        ("1 1 0\n", "1 inf 0\n", "line 13: `inf` is not a finite number"),
        ("1 1 0\n", "1 1 0 0\n", "line 13: expected no more values than the header declares"),
        (
            "3 0 1 2",
            "3 0 1 4",
            "line 15: a face names point 4, but points are numbered from 0 to 3",
        ),
        ("3 0 1 2", "3 0 1 -1", "line 15: a face names point -1, but"),
        ("3 0 1 2", "3 0 1 1.5", "line 15: expected the index of a corner, found `1.5`"),
        (
            "3 0 1 2 9",
            "2 0 1 9",
            "line 15: expected a face of at least three corners, found one of 2",
        ),
        ("3 0 1 2", "-3 0 1 2", "line 15: expected the length of a list, found `-3`"),
        ("3 0 1 2", "4294967296 0 1 2", "more than 60000 corners of one face"),
        ("3 0 1 2 9", "3 0 1 2 x", "line 15: expected a whole number for each property"),
        ("4 0 1 2 3 9\n", "", "line 15: the file ends before face 2 of 2"),
        (
            "3 0 1 2 9\n",
            "3 0 1 2 9\n\n3 0 1 2 9\n",
            "line 18: expected the end of the file after the last element",
        ),
    ] {
        let message = message(text.replacen(from, to, 1), Format::Ply);
        assert!(message.contains(expected), "{from} → {to}: {message}");
    }
}

#[test]
fn faults_of_binary_data_are_told_with_their_byte() {
    let bytes = binary(false);
    let cut = message(&bytes[..bytes.len() - 20], Format::Ply);
    let end = bytes.len() - 20;
    assert!(
        cut.starts_with(&format!("byte {end}: the file ends before the end of face 2 of 2")),
        "{cut}"
    );

    let start = bytes.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
    let points = start + 2 * 10 + 2 + 8;
    let mut nan = bytes.clone();
    nan[points..points + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    let message_of_nan = message(nan, Format::Ply);
    let expected = format!("byte {points}: the point (NaN, 0.0, 0.0) is not a finite number");
    assert!(message_of_nan.starts_with(&expected), "{message_of_nan}");

    let faces = points + 4 * 17;
    let mut high = bytes;
    high[faces + 1] = 4;
    let message_of_high = message(high, Format::Ply);
    let expected =
        format!("byte {faces}: a face names point 4, but points are numbered from 0 to 3");
    assert!(message_of_high.starts_with(&expected), "{message_of_high}");
}

#[test]
fn triangle_strips_are_refused_by_name() {
    let text = format!(
        "ply\nformat ascii 1.0\n{POINTS}element tristrips 1\n{CORNERS}end_header\n{SQUARE}3 0 1 2\n"
    );
    assert!(message(text, Format::Ply).contains("element tristrips"));
}
