//! The JSON of a glTF file, and the binary part of a GLB file.

use std::borrow::Cow;
use std::path::Path;

use gltf::Document;
use gltf::binary::Error as GlbError;
use gltf::json::Root;
use gltf::json::mesh::Semantic;
use gltf::json::validation::{Checked, Error as Invalid, Validate};

use super::malformed;
use crate::error::{Place, ReadError, excerpt, quote};

/// Header of a GLB file and of its first chunk.
const GLB_HEADER: usize = 20;

/// Most objects in the JSON. Three bytes `{},` can become half a kilobyte in memory.
const MOST_OBJECTS: u64 = 250_000;
/// As many objects may be in any JSON; beyond, they must take up [`OBJECT_BYTES`] each.
const FREE_OBJECTS: u64 = 20_000;
/// Bytes of an object, on the average, in a file that is not made up; nodes take about 50.
const OBJECT_BYTES: u64 = 16;
/// Most values in the JSON. Two bytes `0,` can become 32 in memory.
const MOST_VALUES: u64 = 2_000_000;

/// Required extensions that change how a mesh looks, but not its shape, begin with one of these.
const HARMLESS_EXTENSIONS: [&str; 6] = [
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "KHR_animation_",
    "EXT_texture_",
    "MSFT_texture_",
];

/// Extensions that put geometry where this reader does not look, required or not.
const REFUSED_EXTENSIONS: [&str; 1] = ["EXT_mesh_gpu_instancing"];

/// Parts of the JSON that matter for the shape; faults elsewhere are let pass.
const USED_PARTS: [&str; 5] = ["accessors", "buffer", "meshes", "nodes", "scene"];

/// The JSON and the binary part of a file.
pub(super) fn split<'b>(
    bytes: &'b [u8],
    path: &Path,
) -> Result<(&'b [u8], Option<&'b [u8]>), ReadError> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), None));
    }
    let found = match gltf::Glb::from_slice(check_glb_header(bytes, path)?) {
        Ok(gltf::Glb { json: Cow::Borrowed(json), bin: None, .. }) => return Ok((json, None)),
        Ok(gltf::Glb { json: Cow::Borrowed(json), bin: Some(Cow::Borrowed(blob)), .. }) => {
            return Ok((json, Some(blob)));
        }
        Ok(_) => "none".to_owned(),
        Err(gltf::Error::Binary(GlbError::ChunkLength { length, length_read, .. })) => {
            format!("a chunk of {length} bytes where {length_read} are left")
        }
        Err(error) => error.to_string(),
    };
    Err(wrong_glb(12, "a JSON chunk and then a BIN chunk", found, path))
}

/// The part of a GLB file that its header announces.
///
/// The `gltf` crate subtracts from the length in the header without a look at it.
fn check_glb_header<'b>(bytes: &'b [u8], path: &Path) -> Result<&'b [u8], ReadError> {
    let word = |at: usize| {
        let bytes = bytes.get(at..at + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    };
    let cut_off = |missing: String| ReadError::CutOff {
        path: path.to_owned(),
        place: Place::Byte(bytes.len() as u64),
        missing,
    };
    let (Some(version), Some(length), true) = (word(4), word(8), bytes.len() >= GLB_HEADER) else {
        return Err(cut_off("the end of its header".to_owned()));
    };
    if version != 2 {
        return Err(ReadError::Unsupported {
            path: path.to_owned(),
            feature: format!("version {version} of the GLB container"),
            advice: "export it as glTF 2.0",
        });
    }
    match bytes.get(..length as usize) {
        None => Err(cut_off(format!("the {length} bytes that its header announces"))),
        Some(glb) if glb.len() < GLB_HEADER => {
            Err(wrong_glb(8, "the length of the file", length.to_string(), path))
        }
        Some(glb) => Ok(glb),
    }
}

fn wrong_glb(byte: u64, expected: &str, found: String, path: &Path) -> ReadError {
    ReadError::Malformed {
        path: path.to_owned(),
        place: Place::Byte(byte),
        expected: expected.to_owned(),
        found,
    }
}

/// Makes a document of the JSON in which every index that matters leads somewhere.
pub(super) fn parse(json: &[u8], path: &Path) -> Result<Document, ReadError> {
    check_budget(json, path)?;
    let text = String::from_utf8_lossy(json);
    let root = Root::from_str(&text).map_err(|error| json_error(&error, &text, path))?;
    if !root.asset.version.starts_with("2.") {
        return Err(old_version(&root.asset.version, path));
    }
    check_extensions(&root, path)?;
    validate(&root, path)?;
    Ok(Document::from_json_without_validation(root))
}

/// Counts objects and values before memory is taken for them.
fn check_budget(json: &[u8], path: &Path) -> Result<(), ReadError> {
    let (mut objects, mut values) = (0_u64, 0_u64);
    let mut rest = json;
    while let [byte, after @ ..] = rest {
        rest = after;
        match byte {
            b'{' => objects += 1,
            b'[' | b',' => values += 1,
            b'"' => rest = after_string(rest),
            _ => {}
        }
    }
    let too_many = |what, limit| ReadError::TooMany { path: path.to_owned(), what, limit };
    let most_objects = MOST_OBJECTS.min(FREE_OBJECTS + json.len() as u64 / OBJECT_BYTES);
    if objects > most_objects {
        return Err(too_many("objects in its JSON", most_objects));
    }
    if values > MOST_VALUES {
        return Err(too_many("values in its JSON", MOST_VALUES));
    }
    Ok(())
}

/// What follows a string, from behind its opening quote.
fn after_string(mut rest: &[u8]) -> &[u8] {
    while let Some(at) = memchr::memchr2(b'"', b'\\', rest) {
        if rest[at] == b'"' {
            return &rest[at + 1..];
        }
        rest = rest.get(at + 2..).unwrap_or_default();
    }
    &[]
}

fn json_error(error: &gltf::json::Error, text: &str, path: &Path) -> ReadError {
    let version_1 = text.contains("\"version\": \"1.") || text.contains("\"version\":\"1.");
    if version_1 && error.is_data() {
        return old_version("1.0", path);
    }
    let part = format!("line {} column {}", error.line(), error.column());
    if error.is_eof() {
        return ReadError::CutOff {
            path: path.to_owned(),
            place: Place::Part(part),
            missing: "the end of its JSON".to_owned(),
        };
    }
    malformed(path, part, "JSON as glTF 2.0 has it", excerpt(error.to_string(), 160))
}

fn old_version(version: &str, path: &Path) -> ReadError {
    ReadError::Unsupported {
        path: path.to_owned(),
        feature: format!("version {} of glTF", quote(version)),
        advice: "export it as glTF 2.0",
    }
}

fn check_extensions(root: &Root, path: &Path) -> Result<(), ReadError> {
    let is_harmless = |name: &str| HARMLESS_EXTENSIONS.iter().any(|start| name.starts_with(start));
    let required = root.extensions_required.iter().find(|name| !is_harmless(name));
    let is_refused = |name: &&String| REFUSED_EXTENSIONS.contains(&name.as_str());
    match required.or_else(|| root.extensions_used.iter().find(is_refused)) {
        None => Ok(()),
        Some(name) => Err(ReadError::Unsupported {
            path: path.to_owned(),
            feature: format!("the extension {}", quote(name)),
            advice: "export it without compression, quantization and instancing",
        }),
    }
}

/// Runs the checks of the `gltf` crate, and stops at the first fault that matters.
fn validate(root: &Root, path: &Path) -> Result<(), ReadError> {
    check_position_accessors(root, path)?;
    let mut fault = None;
    root.validate(root, gltf::json::Path::new, &mut |part, error| {
        if fault.is_none() {
            let part = part().to_string();
            fault = matters(&part, error).then_some((part, error));
        }
    });
    let Some((part, error)) = fault else { return Ok(()) };
    let (expected, found) = match error {
        Invalid::IndexOutOfBounds => ("the index of something in the file", "one beyond its end"),
        Invalid::Missing if part.ends_with("[\"POSITION\"]") => {
            ("positions", "a mesh without; it may be compressed, export it without compression")
        }
        Invalid::Missing => {
            ("data", "nothing; it may be compressed, export it without compression")
        }
        Invalid::Oversize => ("a smaller number", "one beyond the memory of this machine"),
        Invalid::Invalid | Invalid::Unsupported => ("a value that glTF 2.0 knows", "another"),
    };
    Err(malformed(path, excerpt(&part, 80), expected, found))
}

/// The checks of the `gltf` crate look up these accessors before they have checked the index.
fn check_position_accessors(root: &Root, path: &Path) -> Result<(), ReadError> {
    for (mesh, primitives) in root.meshes.iter().map(|mesh| &mesh.primitives).enumerate() {
        for (number, primitive) in primitives.iter().enumerate() {
            let index = primitive.attributes.get(&Checked::Valid(Semantic::Positions));
            if index.is_some_and(|index| index.value() >= root.accessors.len()) {
                let part = format!("meshes[{mesh}].primitives[{number}].attributes.POSITION");
                let found = "one beyond its end";
                return Err(malformed(path, part, "the index of something in the file", found));
            }
        }
    }
    Ok(())
}

fn matters(part: &str, error: Invalid) -> bool {
    let is_used = USED_PARTS.iter().any(|used| part.starts_with(used));
    // Many programs leave these out or get them wrong, and nothing here needs them.
    let is_bound = [".min", ".max", ".target"].iter().any(|end| part.ends_with(end));
    // Attributes of an application's own.
    let is_own_attribute = error == Invalid::Invalid && part.contains(".attributes[\"<");
    is_used && !is_bound && !is_own_attribute
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_in_a_string_is_not_counted() {
        assert_eq!(after_string(br#"a\"{,{" , 1"#), b" , 1");
        assert_eq!(after_string(br"never ends\"), b"");
        let many = "{\"a\":\"".to_owned() + &"{,".repeat(5_000_000) + "\"}";
        assert!(check_budget(many.as_bytes(), Path::new("x.gltf")).is_ok());
    }

    #[test]
    fn a_flood_of_objects_is_refused_before_memory_is_taken() {
        let flood = "{\"nodes\":[".to_owned() + &"{},".repeat(300_000);
        let error = check_budget(flood.as_bytes(), Path::new("x.gltf")).unwrap_err();
        let message =
            "cannot read x.gltf: more than 76250 objects in its JSON; reduce or split the mesh";
        assert_eq!(error.to_string(), message);
    }
}
