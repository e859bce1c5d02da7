//! Small writers of every format, for tests that read again what was written.

#![allow(dead_code, unreachable_pub, reason = "each test uses a part of this")]

use std::fmt::Write;

use beamwright_formats::Format;

/// A mesh to be written.
#[derive(Clone, Debug)]
pub struct Model {
    /// Points; of 32 bits, as most formats keep no more.
    pub positions: Vec<[f32; 3]>,
    /// Polygons.
    pub faces: Vec<Vec<u32>>,
    /// Which faces are non-design.
    pub non_design: Vec<bool>,
}

/// A way to write a model: format, variant, and the bytes.
pub type Variant = (Format, &'static str, fn(&Model) -> Vec<u8>);

/// All formats and encodings.
pub const VARIANTS: [Variant; 10] = [
    (Format::Off, "OFF", off),
    (Format::Obj, "OBJ", obj),
    (Format::Ply, "ASCII PLY", |model| ply(model, "ascii")),
    (Format::Ply, "little-endian PLY", |model| ply(model, "binary_little_endian")),
    (Format::Ply, "big-endian PLY", |model| ply(model, "binary_big_endian")),
    (Format::Stl, "ASCII STL", stl_ascii),
    (Format::Stl, "binary STL", stl_binary),
    (Format::Gltf, "glTF", |model| gltf(model, false)),
    (Format::Gltf, "glTF with strides and sparse points", |model| gltf(model, true)),
    (Format::Glb, "GLB", glb),
];

/// A cube of six squares, one of them non-design.
pub fn cube() -> Model {
    let positions = (0..8_u8).map(|corner| [0, 1, 2].map(|axis| f32::from(corner >> axis & 1)));
    let faces: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Model {
        positions: positions.collect(),
        faces: faces.iter().map(|face| face.to_vec()).collect(),
        non_design: vec![true, false, false, false, false, false],
    }
}

/// The triangles that the formats without polygons get: a fan of each polygon.
pub fn fans(model: &Model) -> Vec<([u32; 3], bool)> {
    let polygons = model.faces.iter().zip(&model.non_design);
    polygons
        .flat_map(|(face, &non_design)| {
            face[1..].windows(2).map(move |pair| ([face[0], pair[0], pair[1]], non_design))
        })
        .collect()
}

/// OFF with colours of faces.
pub fn off(model: &Model) -> Vec<u8> {
    let mut text = format!("COFF\n{} {} 0\n", model.positions.len(), model.faces.len());
    for [x, y, z] in &model.positions {
        writeln!(text, "{x} {y} {z}").unwrap();
    }
    for (face, &non_design) in model.faces.iter().zip(&model.non_design) {
        write!(text, "{}", face.len()).unwrap();
        face.iter().for_each(|corner| write!(text, " {corner}").unwrap());
        writeln!(text, " {} 0 10 255", if non_design { 255 } else { 0 }).unwrap();
    }
    text.into_bytes()
}

/// OBJ with groups.
pub fn obj(model: &Model) -> Vec<u8> {
    let mut text = String::from("o part\n");
    for [x, y, z] in &model.positions {
        writeln!(text, "v {x} {y} {z}").unwrap();
    }
    for (face, &non_design) in model.faces.iter().zip(&model.non_design) {
        writeln!(text, "g {}", if non_design { "non_design" } else { "design" }).unwrap();
        write!(text, "f").unwrap();
        face.iter().for_each(|corner| write!(text, " {}", corner + 1).unwrap());
        text.push('\n');
    }
    text.into_bytes()
}

/// PLY with a property `non_design`.
pub fn ply(model: &Model, encoding: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat {encoding} 1.0\nelement vertex {}\nproperty float x\nproperty float y\n\
         property float z\nelement face {}\nproperty list uchar uint vertex_indices\n\
         property short non_design\nend_header\n",
        model.positions.len(),
        model.faces.len()
    )
    .into_bytes();
    let mut put = |little: &[u8], text: String| match encoding {
        "ascii" => bytes.extend(text.bytes()),
        "binary_big_endian" => bytes.extend(little.iter().rev()),
        _ => bytes.extend(little),
    };
    for [x, y, z] in &model.positions {
        put(&x.to_le_bytes(), format!("{x} "));
        put(&y.to_le_bytes(), format!("{y} "));
        put(&z.to_le_bytes(), format!("{z}\n"));
    }
    for (face, &non_design) in model.faces.iter().zip(&model.non_design) {
        put(&[face.len() as u8], face.len().to_string());
        face.iter().for_each(|corner| put(&corner.to_le_bytes(), format!(" {corner}")));
        let flag = i16::from(non_design);
        put(&flag.to_le_bytes(), format!(" {flag}\n"));
    }
    bytes
}

/// ASCII STL with a solid for each run of equal labels.
pub fn stl_ascii(model: &Model) -> Vec<u8> {
    let name = |non_design| if non_design { "non_design" } else { "design" };
    let mut text = String::new();
    for run in fans(model).chunk_by(|a, b| a.1 == b.1) {
        writeln!(text, "solid {}", name(run[0].1)).unwrap();
        for (triangle, _) in run {
            text.push_str("facet normal 0 0 0\nouter loop\n");
            for corner in triangle {
                let [x, y, z] = model.positions[*corner as usize];
                writeln!(text, "vertex {x:e} {y} {z}").unwrap();
            }
            text.push_str("endloop\nendfacet\n");
        }
        writeln!(text, "endsolid {}", name(run[0].1)).unwrap();
    }
    text.into_bytes()
}

/// Binary STL with colours.
pub fn stl_binary(model: &Model) -> Vec<u8> {
    let triangles = fans(model);
    let mut bytes = b"solid with a header that begins like text".to_vec();
    bytes.resize(80, 0);
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for (triangle, non_design) in triangles {
        bytes.extend([0; 12]);
        for corner in triangle {
            let position = model.positions[corner as usize];
            bytes.extend(position.into_iter().flat_map(f32::to_le_bytes));
        }
        let attribute: u16 = if non_design { 0x801f } else { 0 };
        bytes.extend(attribute.to_le_bytes());
    }
    bytes
}

/// The buffer of a glTF file, and where its parts are.
struct GltfBuffer {
    bytes: Vec<u8>,
    /// Bytes from point to point.
    stride: usize,
    points_end: usize,
    /// Indices of non-design and of design faces, one behind the other.
    counts: [usize; 2],
    sparse_at: usize,
}

/// `is_odd`: with room between the points, the first of which is given once more as a sparse value.
fn gltf_buffer(model: &Model, is_odd: bool) -> GltfBuffer {
    let stride = if is_odd { 20 } else { 12 };
    let mut bytes = Vec::new();
    for position in &model.positions {
        bytes.extend(position.iter().flat_map(|number| number.to_le_bytes()));
        bytes.resize(bytes.len() + stride - 12, 0xff);
    }
    let points_end = bytes.len();
    let triangles = fans(model);
    let counts = [true, false].map(|wanted| {
        let before = bytes.len();
        for (triangle, _) in triangles.iter().filter(|triangle| triangle.1 == wanted) {
            bytes.extend(triangle.iter().flat_map(|corner| corner.to_le_bytes()));
        }
        (bytes.len() - before) / 4
    });
    let sparse_at = bytes.len();
    if is_odd {
        bytes.extend(model.positions[0].into_iter().flat_map(f32::to_le_bytes));
        bytes.extend([0, 0]);
    }
    GltfBuffer { bytes, stride, points_end, counts, sparse_at }
}

/// The JSON and the buffer of a glTF file: two primitives with a material each.
fn gltf_parts(model: &Model, uri: Option<&str>, is_odd: bool) -> (String, Vec<u8>) {
    let GltfBuffer { bytes, stride, points_end, counts, sparse_at } = gltf_buffer(model, is_odd);
    let sparse = if is_odd {
        r#","sparse":{"count":1,"indices":{"bufferView":2,"byteOffset":12,"componentType":5123},"values":{"bufferView":2}}"#
    } else {
        ""
    };
    let uri = uri.map_or(String::new(), |uri| format!(r#","uri":"{uri}""#));
    let mut accessors = vec![format!(
        r#"{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"{sparse}}}"#,
        model.positions.len()
    )];
    let mut primitives = Vec::new();
    for (material, (start, count)) in
        [(0, counts[0]), (4 * counts[0], counts[1])].into_iter().enumerate()
    {
        if count > 0 {
            let number = accessors.len();
            accessors.push(format!(
                r#"{{"bufferView":1,"byteOffset":{start},"componentType":5125,"count":{count},"type":"SCALAR"}}"#
            ));
            primitives.push(format!(
                r#"{{"attributes":{{"POSITION":0}},"indices":{number},"material":{material}}}"#
            ));
        }
    }
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"name":"part"}}],
            "meshes":[{{"primitives":[{}]}}],"materials":[{{"name":"non_design"}},{{"name":"design"}}],
            "accessors":[{}],
            "bufferViews":[{{"buffer":0,"byteLength":{points_end},"byteStride":{stride}}},
                           {{"buffer":0,"byteOffset":{points_end},"byteLength":{}}},
                           {{"buffer":0,"byteOffset":{sparse_at},"byteLength":{}}}],
            "buffers":[{{"byteLength":{}{uri}}}]}}"#,
        primitives.join(","),
        accessors.join(","),
        4 * (counts[0] + counts[1]),
        bytes.len() - sparse_at,
        bytes.len(),
    );
    (json, bytes)
}

/// glTF with its buffer written out.
pub fn gltf(model: &Model, is_odd: bool) -> Vec<u8> {
    let (_, buffer) = gltf_parts(model, None, is_odd);
    let bytes: String = buffer.iter().fold(String::new(), |mut text, byte| {
        write!(text, "%{byte:02x}").unwrap();
        text
    });
    gltf_parts(model, Some(&format!("data:application/octet-stream,{bytes}")), is_odd)
        .0
        .into_bytes()
}

/// GLB.
pub fn glb(model: &Model) -> Vec<u8> {
    let (json, mut buffer) = gltf_parts(model, None, false);
    let mut json = json.into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let length = (12 + 8 + json.len() + 8 + buffer.len()) as u32;
    let mut bytes = [&b"glTF"[..], &2_u32.to_le_bytes(), &length.to_le_bytes()].concat();
    for (chunk, kind) in [(json, b"JSON"), (buffer, b"BIN\0")] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}
