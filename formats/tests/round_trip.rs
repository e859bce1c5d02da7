//! What is written is read again; what is damaged is read or refused, but never more than that.

mod common;

use beamwright_formats::{Format, RawMesh, ReadOptions, Unit, read_bytes};
use common::{Model, VARIANTS, cube, fans};
use proptest::collection::vec;
use proptest::prelude::*;

/// Coordinates that differ much in size, some of them zero or with a long fraction.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        Just(0.0),
        -1e3..1e3_f32,
        any::<i16>().prop_map(f32::from),
        prop::num::f32::NORMAL.prop_filter("overflows in mm", |number| number.abs() < 1e30),
    ]
}

fn model() -> impl Strategy<Value = Model> {
    let positions = vec(prop::array::uniform3(coordinate()), 1..20);
    let faces = vec((vec(0..20_u32, 3..7), any::<bool>()), 1..20);
    (positions, faces).prop_map(|(positions, faces)| {
        let count = positions.len() as u32;
        let (faces, non_design) = faces
            .into_iter()
            .map(|(face, non_design)| {
                (face.iter().map(|corner| corner % count).collect(), non_design)
            })
            .unzip();
        Model { positions, faces, non_design }
    })
}

/// Reads with coordinates as they are in the file.
fn read(bytes: &[u8], format: Format) -> RawMesh {
    let options = ReadOptions { unit: Some(Unit::Mm), ..ReadOptions::default() };
    let mesh = read_bytes(bytes, format, &options).unwrap_or_else(|error| panic!("{error}"));
    mesh.check();
    mesh
}

/// The corners of each face as points, and whether its label says non-design.
///
/// Points have 32 bits again: text read as 64 bits has other digits behind those.
fn faces_of(mesh: &RawMesh) -> Vec<(Vec<[f32; 3]>, bool)> {
    let carriers = &mesh.carriers;
    let has_name = |face: usize| {
        let set = *carriers.face_names.get(face)? as usize;
        let name = |&name: &u32| carriers.names[name as usize].as_str();
        Some(carriers.name_sets[set].iter().map(name).any(|name| name == "non_design"))
    };
    let has_property = |face: usize| carriers.face_property.get(face).map(|&value| value != 0);
    let is_red = |face: usize| {
        let colour = carriers.face_colour.get(face)?;
        Some(colour.is_some_and(|[red, ..]| red > 200))
    };
    let label = |face| has_property(face).or_else(|| has_name(face)).or_else(|| is_red(face));
    let polygons = mesh.faces.iter().enumerate();
    polygons
        .map(|(face, corners)| {
            let points = corners
                .iter()
                .map(|&corner| mesh.positions[corner as usize].map(|c| c as f32))
                .collect();
            (points, label(face).unwrap_or(false))
        })
        .collect()
}

/// The same of a model, as the format keeps it.
fn expected(model: &Model, format: Format) -> Vec<(Vec<[f32; 3]>, bool)> {
    let point = |&corner: &u32| {
        let [x, y, z] = model.positions[corner as usize];
        match format {
            Format::Gltf | Format::Glb => [x, -z, y],
            _ => [x, y, z],
        }
    };
    let polygons = model.faces.iter().zip(&model.non_design);
    let triangles = fans(model).into_iter();
    match format {
        Format::Off | Format::Obj | Format::Ply => {
            polygons.map(|(face, &label)| (face.iter().map(point).collect(), label)).collect()
        }
        Format::Stl => {
            triangles.map(|(face, label)| (face.iter().map(point).collect(), label)).collect()
        }
        Format::Gltf | Format::Glb => {
            let mut triangles: Vec<_> = triangles.collect();
            triangles.sort_by_key(|(_, label)| !label);
            triangles
                .iter()
                .map(|(face, label)| (face.iter().map(point).collect(), *label))
                .collect()
        }
    }
}

/// Reads bytes that may be anything; what comes out has to keep its promises.
fn read_anything(bytes: &[u8], format: Format) {
    match read_bytes(bytes, format, &ReadOptions::default()) {
        Ok(mesh) => {
            mesh.check();
            mesh.triangulate();
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.starts_with("cannot read memory."), "{message}");
            assert!(message.len() < 600, "{message}");
            assert!(!message.contains(char::is_control), "{message:?}");
        }
    }
}

/// A change to a file: where, and what.
#[derive(Clone, Debug)]
enum Damage {
    Set(usize, u8),
    Insert(usize, Vec<u8>),
    Remove(usize, usize),
    Repeat(usize, usize),
    Cut(usize),
}

impl Damage {
    fn apply(&self, bytes: &mut Vec<u8>) {
        let length = bytes.len().max(1);
        match self {
            Self::Set(at, byte) => {
                if let Some(slot) = bytes.get_mut(at % length) {
                    *slot = *byte;
                }
            }
            Self::Insert(at, new) => {
                let at = (at % length).min(bytes.len());
                bytes.splice(at..at, new.iter().copied());
            }
            Self::Remove(at, count) => {
                let at = (at % length).min(bytes.len());
                bytes.drain(at..(at + count).min(bytes.len()));
            }
            Self::Repeat(at, count) => {
                let at = (at % length).min(bytes.len());
                let piece = bytes[at..(at + count).min(bytes.len())].to_vec();
                bytes.splice(at..at, piece);
            }
            Self::Cut(at) => bytes.truncate(at % length),
        }
    }
}

fn damage() -> impl Strategy<Value = Damage> {
    let at = any::<usize>;
    // Pieces that mean something in one format or another.
    let piece = prop_oneof![
        vec(any::<u8>(), 1..6),
        prop::sample::select(vec![
            "-1",
            "99999999999",
            "4294967295",
            "nan",
            "1e999",
            "0",
            " ",
            "\n",
            "\r",
            "\\\n",
            "#",
            "\"",
            "{",
            "]",
            ",",
            "/",
            "v 1 2 3\n",
            "f 1 2 3\n",
            "f -1 -2 -3\n",
            "g a b\n",
            "usemtl a\n",
            "solid x\n",
            "endsolid\n",
            "endloop\n",
            "3 0 1 2\n",
            "element face 9\n",
            "property list int int a\n",
            "\u{fffd}",
            "\0\0\0\0",
        ])
        .prop_map(|text| text.as_bytes().to_vec()),
    ];
    prop_oneof![
        3 => (at(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        2 => (at(), prop::sample::select(b"0123456789-. \n{}[],:\"".to_vec())).prop_map(|(at, byte)| Damage::Set(at, byte)),
        3 => (at(), piece).prop_map(|(at, piece)| Damage::Insert(at, piece)),
        2 => (at(), 1..20_usize).prop_map(|(at, count)| Damage::Remove(at, count)),
        1 => (at(), 1..60_usize).prop_map(|(at, count)| Damage::Repeat(at, count)),
        1 => at().prop_map(Damage::Cut),
    ]
}

proptest! {
    #[test]
    fn every_format_gives_back_what_was_written(model in model()) {
        for (format, name, write) in VARIANTS {
            let mesh = read(&write(&model), format);
            prop_assert_eq!(faces_of(&mesh), expected(&model, format), "{}", name);
        }
    }

    #[test]
    fn a_damaged_file_is_read_or_refused(damages in vec(damage(), 1..8)) {
        for (format, _, write) in VARIANTS {
            let mut bytes = write(&cube());
            damages.iter().for_each(|damage| damage.apply(&mut bytes));
            read_anything(&bytes, format);
        }
    }

    #[test]
    fn random_bytes_are_read_or_refused(bytes in vec(any::<u8>(), 0..400)) {
        let beginnings: [&[u8]; 12] = [
            b"", b"OFF\n", b"COFF\n3 1 0\n", b"v 1 2 3\nf ", b"solid a\nfacet normal 0 0 0\nouter loop\n",
            b"ply\nformat ascii 1.0\n", b"{\"asset\":{\"version\":\"2.0\"},", b"glTF\x02\0\0\0",
            b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
              property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n",
            b"ply\nformat binary_big_endian 1.0\nelement face 2\nproperty list int char vertex_indices\n\
              element vertex 2\nproperty char x\nproperty list uint double q\nproperty char y\nproperty char z\nend_header\n",
            &[0; 84], b"\xef\xbb\xbf",
        ];
        for beginning in beginnings {
            for format in Format::ALL {
                read_anything(&[beginning, &bytes].concat(), format);
            }
        }
    }
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    for (format, name, write) in VARIANTS {
        let whole = write(&cube());
        // A last line end, or the closing of the last solid, can be missed out.
        let needed = whole.trim_ascii_end().len();
        for length in 0..needed {
            let cut = &whole[..length];
            read_anything(cut, format);
            let mesh = read_bytes(cut, format, &ReadOptions::default());
            // Text cut within its last number or name, or behind a solid, can pass for whole.
            let last_line = cut.trim_ascii_end().rsplit(|&byte| byte == b'\n').next();
            let may_pass = matches!(name, "OFF" | "OBJ" | "ASCII PLY")
                || last_line.is_some_and(|line| line.starts_with(b"endsolid"));
            assert!(may_pass || mesh.is_err(), "{name} cut to {length} of {needed} bytes");
        }
    }
}
