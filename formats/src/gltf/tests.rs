use std::fs;

use base64::Engine;

use crate::testing::{mesh, message, names_of_faces};
use crate::{Format, RawMesh, ReadError, ReadOptions, Unit, read};

/// A tetrahedron's four points, then indices of its four triangles as u16.
fn tetrahedron() -> Vec<u8> {
    let points: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let corners: [u16; 12] = [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3];
    let points = points.into_iter().flatten().flat_map(f32::to_le_bytes);
    points.chain(corners.into_iter().flat_map(u16::to_le_bytes)).collect()
}

fn data_uri(bytes: &[u8]) -> String {
    let text = base64::engine::general_purpose::STANDARD.encode(bytes);
    format!("data:application/octet-stream;base64,{text}")
}

/// A file of one buffer; `parts` holds the JSON of everything else.
fn gltf(bytes: &[u8], parts: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{},"uri":"{}"}}],{parts}}}"#,
        bytes.len(),
        data_uri(bytes)
    )
}

const TETRAHEDRON_DATA: &str = r#"
    "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                 {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
    "meshes":[{"name":"tet","primitives":[{"attributes":{"POSITION":0},"indices":1}]}]"#;

fn tetrahedron_with(nodes: &str) -> String {
    gltf(&tetrahedron(), &format!("{TETRAHEDRON_DATA},{nodes}"))
}

fn glb(json: &str, blob: &[u8]) -> Vec<u8> {
    let pad = |bytes: &[u8], with: u8| {
        let mut padded = bytes.to_vec();
        padded.resize(bytes.len().next_multiple_of(4), with);
        padded
    };
    let (json, blob) = (pad(json.as_bytes(), b' '), pad(blob, 0));
    let length = (12 + 8 + json.len() + 8 + blob.len()) as u32;
    let mut bytes = [&b"glTF"[..], &2_u32.to_le_bytes(), &length.to_le_bytes()].concat();
    for (chunk, kind) in [(json, b"JSON"), (blob, b"BIN\0")] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

/// Signed volume: positive if the triangles look outward.
fn volume(mesh: &RawMesh) -> f64 {
    let determinant = |[a, b, c]: [[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let triangles = mesh.triangulate().corners;
    triangles
        .iter()
        .map(|t| determinant(t.map(|corner| mesh.positions[corner as usize])) / 6.0)
        .sum()
}

#[test]
fn metres_with_y_up_become_millimetres_with_z_up() {
    let text = tetrahedron_with(r#""nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0"#);
    let in_metres = mesh(&text, Format::Gltf);
    let expected = [[0.0; 3], [1000.0, 0.0, 0.0], [0.0, 0.0, 1000.0], [0.0, -1000.0, 0.0]];
    assert_eq!(in_metres.positions, expected);
    assert!((volume(&in_metres) - 1e9 / 6.0).abs() < 1.0);

    let options = ReadOptions { unit: Some(Unit::Mm), ..ReadOptions::default() };
    let in_mm = crate::read_bytes(text.as_bytes(), Format::Gltf, &options).unwrap();
    assert_eq!(in_mm.positions[3], [0.0, -1.0, 0.0]);
}

#[test]
fn a_glb_file_holds_the_same() {
    let bytes = tetrahedron();
    let parts = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":72}}],{TETRAHEDRON_DATA},"nodes":[{{"mesh":0}}]}}"#
    );
    let from_json = mesh(tetrahedron_with(r#""nodes":[{"mesh":0}]"#), Format::Gltf);
    let mut glb = glb(&parts, &bytes);
    assert_eq!(mesh(&glb, Format::Glb), from_json);
    glb.extend(b"behind the end");
    assert_eq!(mesh(&glb, Format::Glb), from_json);
}

#[test]
fn nodes_move_turn_scale_and_mirror_what_is_below_them() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let nodes = format!(
        r#""nodes":[{{"name":"top","translation":[10,0,0],"children":[1]}},
                    {{"rotation":[0,0,{half},{half}],"scale":[2,-2,2],"mesh":0}}]"#
    );
    let options = ReadOptions { unit: Some(Unit::Mm), ..ReadOptions::default() };
    let text = tetrahedron_with(&nodes);
    let mesh = crate::read_bytes(text.as_bytes(), Format::Gltf, &options).unwrap();
    // (1, 0, 0) → scaled (2, 0, 0) → turned (0, 2, 0) → moved (10, 2, 0) → Z up (10, 0, 2).
    for (found, expected) in mesh.positions[1].into_iter().zip([10.0, 0.0, 2.0]) {
        assert!((found - expected).abs() < 1e-6, "{:?}", mesh.positions);
    }
    assert!((volume(&mesh) - 8.0 / 6.0).abs() < 1e-6, "{}", volume(&mesh));

    let mirrored =
        tetrahedron_with(r#""nodes":[{"mesh":0,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1]}]"#);
    let mesh = crate::read_bytes(mirrored.as_bytes(), Format::Gltf, &options).unwrap();
    assert_eq!(mesh.positions[1], [4.0, 0.0, 0.0]);
    assert!(volume(&mesh) > 0.0);
}

#[test]
fn a_mesh_may_stand_at_several_places_with_the_names_of_each() {
    let nodes = r#""nodes":[{"name":"part","children":[1,2]},{"name":"pad","mesh":0},{"mesh":0,"translation":[5,0,0]}],
                   "scenes":[{"nodes":[0]}]"#;
    let mesh = mesh(tetrahedron_with(nodes), Format::Gltf);
    assert_eq!((mesh.faces.len(), mesh.positions.len()), (8, 8));
    let names = names_of_faces(&mesh);
    assert_eq!(names[0], ["tet", "pad", "part"]);
    assert_eq!(names[7], ["tet", "part"]);
    assert_eq!(mesh.faces.corners_of(4), [4, 6, 5]);
}

#[test]
fn primitives_have_materials_and_may_share_points() {
    let parts = r#"
        "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                     {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},
                     {"bufferView":1,"byteOffset":12,"componentType":5123,"count":6,"type":"SCALAR"}],
        "materials":[{"name":"non_design","pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}},{}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"_OWN":0},"indices":1,"material":0},
                                 {"attributes":{"POSITION":0},"indices":2},
                                 {"attributes":{"POSITION":0},"mode":1}]}]"#;
    let mesh = mesh(gltf(&tetrahedron(), parts), Format::Gltf);
    assert_eq!((mesh.faces.len(), mesh.positions.len()), (4, 4));
    assert_eq!(names_of_faces(&mesh), [&["non_design"][..], &["non_design"], &[], &[]]);
    assert_eq!(mesh.carriers.face_colour, [Some([255, 0, 0]), Some([255, 0, 0]), None, None]);
}

#[test]
fn strips_and_fans_keep_their_sense_of_rotation() {
    // A square as a strip 0 1 3 2, sewn on with a triangle without area, and as a fan 0 1 2 3.
    let points: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let bytes: Vec<u8> =
        points.into_iter().flatten().flat_map(f32::to_le_bytes).chain([0, 1, 3, 2, 2, 0]).collect();
    let parts = |mode: u32, indices: &str| {
        format!(
            r#""bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":6}}],
               "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
                            {{"bufferView":1,"componentType":5121,"count":5,"type":"SCALAR"}}],
               "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":{mode}{indices}}}]}}]"#
        )
    };
    let strip = mesh(gltf(&bytes, &parts(5, ",\"indices\":1")), Format::Gltf);
    assert_eq!(strip.faces.corners, [0, 1, 3, 3, 1, 2]);
    let fan = mesh(gltf(&bytes, &parts(6, "")), Format::Gltf);
    assert_eq!(fan.faces.corners, [0, 1, 2, 0, 2, 3]);
    let message = message(gltf(&bytes, &parts(4, "")), Format::Gltf);
    assert!(
        message.starts_with(
            "meshes[0].primitives[0]: expected three corners for each triangle, found 4"
        )
    );
}

#[test]
fn accessors_may_be_strided_sparse_and_without_indices() {
    // Points every 16 bytes; the second is replaced by a sparse value.
    let points: [[f32; 4]; 3] = [[0.0; 4], [9.0; 4], [0.0, 1.0, 0.0, 9.0]];
    let value: [f32; 3] = [1.0, 0.0, 0.0];
    let mut bytes: Vec<u8> = points.into_iter().flatten().flat_map(f32::to_le_bytes).collect();
    bytes.extend(value.into_iter().flat_map(f32::to_le_bytes));
    bytes.push(1);
    let parts = |index: u32, stride: u32| {
        format!(
            r#""bufferViews":[{{"buffer":0,"byteLength":48,"byteStride":{stride}}},
                              {{"buffer":0,"byteOffset":48,"byteLength":12}},
                              {{"buffer":0,"byteOffset":60,"byteLength":1}}],
               "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{{"count":1,
                   "indices":{{"bufferView":2,"componentType":5121,"byteOffset":{index}}},"values":{{"bufferView":1}}}}}}],
               "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}]"#
        )
    };
    let mesh = mesh(gltf(&bytes, &parts(0, 16)), Format::Gltf);
    assert_eq!(mesh.positions, [[0.0; 3], [1000.0, 0.0, 0.0], [0.0, 0.0, 1000.0]]);
    assert!(message(gltf(&bytes, &parts(1, 16)), Format::Gltf).contains("accessors[0].sparse"));
    assert!(message(gltf(&bytes, &parts(0, 4)), Format::Gltf).contains("a stride of at least 12"));
    bytes[60] = 3;
    let message = message(gltf(&bytes, &parts(0, 16)), Format::Gltf);
    assert!(
        message.starts_with("accessors[0].sparse: expected increasing indices below 3, found 3")
    );
}

#[test]
fn points_have_colours_of_bytes_or_fractions() {
    let mut bytes = tetrahedron();
    bytes.extend([255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 0, 0, 0, 255]);
    let parts = |kind: &str, count: u32| {
        TETRAHEDRON_DATA
            .replace(r#""byteLength":24}"#, r#""byteLength":24},{"buffer":0,"byteOffset":72,"byteLength":16}"#)
            .replace(r#""SCALAR"}"#, &format!(r#""SCALAR"}},{{"bufferView":2,"componentType":{kind},"count":{count},"type":"VEC4","normalized":true}}"#))
            .replace(r#""POSITION":0"#, r#""POSITION":0,"COLOR_0":2"#)
    };
    let colours = mesh(gltf(&bytes, &parts("5121", 4)), Format::Gltf).carriers.vertex_colour;
    assert_eq!(colours, [[255, 0, 0], [0, 255, 0], [0, 0, 255], [0, 0, 0]]);
    assert!(
        message(gltf(&bytes, &parts("5121", 3)), Format::Gltf)
            .contains("a colour for each of the 4 points")
    );
    assert!(message(gltf(&bytes, &parts("5124", 4)), Format::Gltf).contains("accessors[2]"));
    assert!(
        message(gltf(&bytes, &parts("5120", 4)), Format::Gltf).contains("colours as Vec3 or Vec4")
    );
}

#[test]
fn buffers_beside_the_file_are_read() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    fs::write(folder.path().join("sub/a b.bin"), tetrahedron()).unwrap();
    let path = folder.path().join("part.GLTF");
    let read_uri = |uri: &str| {
        let text = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":72,"uri":"{uri}"}}],{TETRAHEDRON_DATA}}}"#
        );
        fs::write(&path, text).unwrap();
        read(&path, &ReadOptions::default())
    };
    assert_eq!(read_uri("sub/a%20b.bin").unwrap().faces.len(), 4);
    assert_eq!(read_uri("./sub/../sub/a b.bin").unwrap().faces.len(), 4);
    for uri in [
        "../../etc/passwd",
        "/etc/passwd",
        "%2e%2e/x.bin",
        "..%2fx.bin",
        "%2Fetc%2Fpasswd",
        "file:///etc/passwd",
        "file:sub/a.bin",
        "https://example.org/a.bin",
        "sub/../../x.bin",
        "..\\\\x.bin",
        "C:\\\\x.bin",
        "FILE:/etc/passwd",
        "%66ile:///etc/passwd",
    ] {
        let error = read_uri(uri).unwrap_err();
        assert!(matches!(error, ReadError::OutsideFolder { .. }), "{uri}: {error}");
    }
    let error = read_uri("none.bin").unwrap_err().to_string();
    assert!(
        error.contains(
            "buffers[0].uri: expected a file beside the glTF file, found `none.bin`: No such file"
        ),
        "{error}"
    );
    assert!(read_uri("sub").unwrap_err().to_string().contains("not a file"));
    fs::write(folder.path().join("sub/a b.bin"), [0; 71]).unwrap();
    let error = read_uri("sub/a b.bin").unwrap_err().to_string();
    assert!(
        error.contains("buffers[0], 71 bytes: the file ends before the 72 bytes it should have"),
        "{error}"
    );
}

#[cfg(unix)]
#[test]
fn a_link_out_of_the_folder_is_not_followed() {
    let folder = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink("/etc/passwd", folder.path().join("a.bin")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", folder.path().join("b.bin")).unwrap();
    for name in ["a.bin", "b.bin"] {
        let path = folder.path().join("part.gltf");
        let text = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":72,"uri":"{name}"}}],{TETRAHEDRON_DATA}}}"#
        );
        fs::write(&path, text).unwrap();
        let error = read(&path, &ReadOptions::default()).unwrap_err();
        assert!(matches!(error, ReadError::OutsideFolder { .. }), "{error}");
    }
}

#[test]
fn a_cycle_of_nodes_is_told() {
    for (nodes, node) in [
        (r#""nodes":[{"mesh":0,"children":[0]}]"#, 0),
        (r#""nodes":[{"children":[1]},{"mesh":0,"children":[0]}],"scenes":[{"nodes":[1]}]"#, 1),
        (r#""nodes":[{"children":[2]},{"children":[2]},{"mesh":0}],"scenes":[{"nodes":[0,1]}]"#, 2),
        (r#""nodes":[{"children":[1,1]},{"mesh":0}]"#, 1),
    ] {
        let message = message(tetrahedron_with(nodes), Format::Gltf);
        let expected =
            format!("nodes[{node}]: expected a node that is the child of one other at most");
        assert!(message.starts_with(&expected), "{message}");
    }
}

#[test]
fn a_chain_of_nodes_may_be_long() {
    let count = 50_000;
    let chain: String =
        (1..count).map(|child| format!(r#"{{"name":"n{child}","children":[{child}]}},"#)).collect();
    let text = tetrahedron_with(&format!(r#""nodes":[{chain}{{"mesh":0}}]"#));
    let mesh = mesh(text, Format::Gltf);
    assert_eq!(mesh.faces.len(), 4);
    assert_eq!(names_of_faces(&mesh)[0].len(), 17);
}

#[test]
fn meshes_repeated_without_end_are_refused() {
    let bytes = vec![0; 12 * 40_000];
    let nodes: String = (0..999).map(|_| r#"{"mesh":0},"#).collect();
    let parts = format!(
        r#""bufferViews":[{{"buffer":0,"byteLength":{0}}}],
           "accessors":[{{"bufferView":0,"componentType":5126,"count":39999,"type":"VEC3"}}],
           "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"nodes":[{nodes}{{"mesh":0}}]"#,
        bytes.len()
    );
    let message = message(gltf(&bytes, &parts), Format::Gltf);
    assert!(message.starts_with("more than 8000000 points and corners of meshes"), "{message}");
}

#[test]
fn values_without_data_are_limited() {
    let parts = r#"
        "bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":48,"byteLength":4}],
        "accessors":[{"componentType":5126,"count":4000000000,"type":"VEC3","sparse":{"count":1,
            "indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":0}}}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]"#;
    let message = message(gltf(&tetrahedron(), parts), Format::Gltf);
    assert!(
        message.starts_with("accessors[0]: expected fewer values than the buffers have bytes"),
        "{message}"
    );
}

#[test]
fn faults_are_told_with_their_part() {
    let text = tetrahedron_with(r#""nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]"#);
    for (from, to, expected) in [
        (
            r#""POSITION":0"#,
            r#""POSITION":9"#,
            "meshes[0].primitives[0].attributes.POSITION: expected the index of something in the file, found one beyond its end",
        ),
        (
            r#""POSITION":0"#,
            r#""NORMAL":0"#,
            "meshes[0].primitives[0].attributes[\\\"POSITION\\\"]: expected positions",
        ),
        (
            r#""indices":1"#,
            r#""indices":0"#,
            "accessors[0]: expected indices as Scalar of U8, U16 or U32, found Vec3 of F32",
        ),
        (r#""indices":1"#, r#""indices":7"#, "meshes[0].primitives[0].indices: expected the index"),
        (
            r#""indices":1"#,
            r#""indices":1,"mode":77"#,
            "meshes[0].primitives[0].mode: expected a value that glTF 2.0 knows",
        ),
        (
            "5126",
            "5122",
            "accessors[0]: expected positions as Vec3 of F32 (export without KHR_mesh_quantization), found Vec3 of I16",
        ),
        ("5126", "1", "accessors[0].componentType: expected a value that glTF 2.0 knows"),
        (r#""VEC3""#, r#""VEC2""#, "accessors[0]: expected positions as Vec3 of F32"),
        (r#""count":4,"#, r#""count":0,"#, "accessors[0]: expected a count of at least 1"),
        (
            r#""count":4,"#,
            r#""count":5,"#,
            "accessors[0]: expected values within the 48 bytes of bufferViews[0], found 5 of them, one every 12 bytes from byte 0",
        ),
        (
            r#""count":4,"#,
            r#""count":18446744073709551615,"#,
            "accessors[0]: expected values within the 48 bytes",
        ),
        (
            r#""count":4,"#,
            r#""count":3,"#,
            "meshes[0].primitives[0].indices[5]: a face names point 3, but points are numbered from 0 to 2",
        ),
        (
            r#""byteLength":48"#,
            r#""byteLength":480"#,
            "bufferViews[0]: expected a part of the 72 bytes of its buffer, found 480 bytes from byte 0",
        ),
        (
            r#""byteOffset":48"#,
            r#""byteOffset":18446744073709551615"#,
            "bufferViews[1]: expected a part of the 72 bytes",
        ),
        (
            r#""buffer":0,"byteLength":48"#,
            r#""buffer":5,"byteLength":48"#,
            "bufferViews[0].buffer: expected the index",
        ),
        (r#""bufferView":0"#, r#""bufferView":5"#, "accessors[0].bufferView: expected the index"),
        (
            r#""bufferView":0,"#,
            "",
            "accessors[0].bufferView: expected data, found nothing; it may be compressed",
        ),
        (r#"{"mesh":0}"#, r#"{"mesh":3}"#, "nodes[0].mesh: expected the index"),
        (
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"children":[5]}"#,
            "nodes[0].children[0]: expected the index",
        ),
        (r#"{"nodes":[0]}"#, r#"{"nodes":[5]}"#, "scenes[0].nodes[0]: expected the index"),
        (
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"translation":[3.4e38,0,0],"scale":[3.4e38,1,1]},{"children":[0],"scale":[3.4e38,1,1]}"#,
            "",
        ),
        (r#"{"mesh":0}"#, "{}", "it has 0 points but no faces"),
        (
            r#""version":"2.0""#,
            r#""version":"1.0""#,
            "it uses version `1.0` of glTF, which is not read; export it as glTF 2.0",
        ),
        (
            r#""asset""#,
            r#""extensionsRequired":["KHR_draco_mesh_compression"],"asset""#,
            "it uses the extension `KHR_draco_mesh_compression`, which is not read; export it without compression",
        ),
        (
            r#""asset""#,
            r#""extensionsRequired":["EXT_meshopt_compression"],"asset""#,
            "it uses the extension `EXT_meshopt_compression`",
        ),
        (
            r#""asset""#,
            r#""extensionsUsed":["EXT_mesh_gpu_instancing"],"asset""#,
            "it uses the extension `EXT_mesh_gpu_instancing`",
        ),
        ("base64,", "base64,?", "buffers[0].uri: expected base64 data, found "),
        (
            r#""byteLength":72"#,
            r#""byteLength":73"#,
            "buffers[0], 72 bytes: the file ends before the 73 bytes it should have",
        ),
    ] {
        if expected.is_empty() {
            continue;
        }
        let message = message(text.replacen(from, to, 1), Format::Gltf);
        assert!(message.starts_with(expected), "{from} → {to}: {message}");
    }
}

#[test]
fn extras_of_any_kind_are_let_pass() {
    for extras in ["{\"a\":[1]}", "[1,2]", "\"text\"", "null", "7"] {
        let nodes = format!(r#""nodes":[{{"mesh":0,"extras":{extras}}}],"extras":{extras}"#);
        assert_eq!(mesh(tetrahedron_with(&nodes), Format::Gltf).faces.len(), 4, "{extras}");
    }
}

#[test]
fn extensions_that_only_change_the_look_are_let_pass() {
    let extensions = r#""extensionsRequired":["KHR_materials_unlit","KHR_texture_transform"]"#;
    let text = tetrahedron_with(r#""nodes":[{"mesh":0}]"#);
    let text = text.replacen(r#""asset""#, &format!(r#"{extensions},"asset""#), 1);
    assert_eq!(mesh(text, Format::Gltf).faces.len(), 4);
}

#[test]
fn a_coordinate_must_be_finite_where_its_node_puts_it() {
    let mut bytes = tetrahedron();
    bytes[12..16].copy_from_slice(&f32::NAN.to_le_bytes());
    let expected = "meshes[0].primitives[0].attributes.POSITION: point 1 (NaN, NaN, NaN), where its node puts it, is not a finite number";
    let found = message(gltf(&bytes, TETRAHEDRON_DATA), Format::Gltf);
    assert!(found.starts_with(expected), "{found}");
}

#[test]
fn faults_of_the_container_are_told_with_their_byte() {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":72}}],{TETRAHEDRON_DATA}}}"#
    );
    let sound = glb(&json, &tetrahedron());
    let with = |at: usize, number: u32| {
        let mut bytes = sound.clone();
        bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
        message(bytes, Format::Glb)
    };
    assert_eq!(
        with(4, 1),
        "it uses version 1 of the GLB container, which is not read; export it as glTF 2.0"
    );
    let length = sound.len();
    assert!(with(8, 99_999).starts_with(&format!(
        "byte {length}: the file ends before the 99999 bytes that its header announces"
    )));
    assert!(with(8, 11).starts_with("byte 8: expected the length of the file, found 11"));
    assert!(with(12, 0xffff_fff0).contains("found a chunk of 4294967280 bytes where"));
    assert!(with(16, 0).starts_with("byte 12: expected a JSON chunk and then a BIN chunk"));
    assert!(
        message(&sound[..15], Format::Glb)
            .starts_with("byte 15: the file ends before the end of its header")
    );
    assert!(message(&sound[..length - 4], Format::Glb).contains("the file ends before"));
    let no_blob = glb(&json, &[]);
    assert!(message(no_blob, Format::Glb).contains("buffers[0]"));
}

#[test]
fn faults_of_the_json_are_told_with_line_and_column() {
    let cut = message("{\"asset\":{\"version\":\"2.0\"},\n\"nodes\":[", Format::Gltf);
    assert!(cut.starts_with("line 2 column 9: the file ends before the end of its JSON"), "{cut}");
    let wrong = message("{\"asset\":{\"version\":\"2.0\"},\n\"nodes\":7}", Format::Gltf);
    assert!(
        wrong.starts_with("line 2 column 9: expected JSON as glTF 2.0 has it, found invalid type"),
        "{wrong}"
    );
    for part in ["extras", "accessors\":[{\"min", "nodes\":[{\"extensions\":{\"a"] {
        let deep =
            format!("{{\"asset\":{{\"version\":\"2.0\"}},\"{part}\":{}", "[".repeat(100_000));
        let message = message(deep, Format::Gltf);
        assert!(
            message.contains("recursion limit") || message.contains("the file ends"),
            "{message}"
        );
    }
    let old = r#"{"asset":{"version":"1.0"},"meshes":{"a":{}}}"#;
    assert!(message(old, Format::Gltf).contains("version `1.0` of glTF"));
}
