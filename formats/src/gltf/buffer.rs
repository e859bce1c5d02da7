//! The buffers of a glTF file: in the file, beside it, or written out in a `data:` URI.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use gltf::buffer::{Buffer, Source};
use percent_encoding::percent_decode_str;

use super::malformed;
use crate::error::{Place, ReadError, quote};
use crate::nearby::{self, NotNearby};

/// The buffers that were needed so far.
pub(super) struct Buffers<'a> {
    path: &'a Path,
    folder: Option<&'a Path>,
    blob: Option<&'a [u8]>,
    loaded: Vec<Option<Content<'a>>>,
    /// Files that were read: several buffers may name one file.
    files: HashMap<PathBuf, Rc<Vec<u8>>>,
    /// Bytes that may still be read from files.
    allowed: u64,
    /// Largest sum of bytes, for messages.
    limit: u64,
    /// Bytes of all buffers that were loaded, each content once.
    size: u64,
}

#[derive(Clone)]
enum Content<'a> {
    Borrowed(&'a [u8]),
    Shared(Rc<Vec<u8>>),
}

impl<'a> Buffers<'a> {
    /// No buffer loaded yet; `blob` is the binary part of a GLB file.
    pub(super) fn new(
        path: &'a Path,
        folder: Option<&'a Path>,
        blob: Option<&'a [u8]>,
        count: usize,
        limit: u64,
    ) -> Self {
        Self {
            path,
            folder,
            blob,
            loaded: vec![None; count],
            files: HashMap::new(),
            allowed: limit,
            limit,
            size: blob.map_or(0, |blob| blob.len() as u64),
        }
    }

    /// The file, for messages.
    pub(super) fn path(&self) -> &'a Path {
        self.path
    }

    /// Bytes of all buffers loaded so far.
    pub(super) fn size(&self) -> u64 {
        self.size
    }

    /// The bytes of a buffer; `None` if it was not loaded.
    pub(super) fn get(&self, index: usize) -> Option<&[u8]> {
        match self.loaded.get(index)?.as_ref()? {
            Content::Borrowed(bytes) => Some(bytes),
            Content::Shared(bytes) => Some(bytes),
        }
    }

    /// Loads a buffer if it is not there yet.
    pub(super) fn load(&mut self, buffer: &Buffer<'_>) -> Result<(), ReadError> {
        let index = buffer.index();
        if self.get(index).is_some() {
            return Ok(());
        }
        let content = match buffer.source() {
            Source::Bin => self.blob.map(Content::Borrowed).ok_or_else(|| {
                let expected = "a `uri`, or the binary part of a .glb file";
                malformed(self.path, format!("buffers[{index}]"), expected, "neither")
            })?,
            Source::Uri(uri) => Content::Shared(self.fetch(uri, index)?),
        };
        if let Some(slot) = self.loaded.get_mut(index) {
            *slot = Some(content);
        }
        match self.get(index) {
            Some(bytes) if bytes.len() < buffer.length() => Err(ReadError::CutOff {
                path: self.path.to_owned(),
                place: Place::Part(format!("buffers[{index}], {} bytes", bytes.len())),
                missing: format!("the {} bytes it should have", buffer.length()),
            }),
            _ => Ok(()),
        }
    }

    fn fetch(&mut self, uri: &str, index: usize) -> Result<Rc<Vec<u8>>, ReadError> {
        let part = format!("buffers[{index}].uri");
        if let Some(data) = strip_scheme(uri, "data:") {
            let bytes =
                decode(data).map_err(|found| malformed(self.path, part, "base64 data", found))?;
            self.size += bytes.len() as u64;
            return Ok(Rc::new(bytes));
        }
        let name = percent_decode_str(uri).decode_utf8_lossy();
        let outside = || ReadError::OutsideFolder { path: self.path.to_owned(), uri: quote(uri) };
        if has_scheme(&name) {
            return Err(outside());
        }
        let missing = |found: String| {
            malformed(self.path, part.as_str(), "a file beside the glTF file", found)
        };
        let Some(folder) = self.folder else {
            return Err(missing(format!("{}, which cannot be looked for", quote(uri))));
        };
        match nearby::find(folder, &name) {
            Ok(file) => self.read_file(file),
            Err(NotNearby::Outside) => Err(outside()),
            Err(NotNearby::Io(error)) => Err(missing(format!("{}: {error}", quote(uri)))),
        }
    }

    fn read_file(&mut self, file: PathBuf) -> Result<Rc<Vec<u8>>, ReadError> {
        if let Some(bytes) = self.files.get(&file) {
            return Ok(Rc::clone(bytes));
        }
        let io = |source| ReadError::Io { path: file.clone(), source };
        let size = file.metadata().map_err(io)?.len();
        if size > self.allowed {
            return Err(ReadError::TooLarge { path: file, size, limit: self.limit });
        }
        let bytes = Rc::new(std::fs::read(&file).map_err(io)?);
        self.allowed = self.allowed.saturating_sub(bytes.len() as u64);
        self.size += bytes.len() as u64;
        self.files.insert(file, Rc::clone(&bytes));
        Ok(bytes)
    }
}

fn strip_scheme<'u>(uri: &'u str, scheme: &str) -> Option<&'u str> {
    let start = uri.get(..scheme.len())?;
    start.eq_ignore_ascii_case(scheme).then(|| &uri[scheme.len()..])
}

/// Whether a URI begins with a scheme such as `https:` or `file:`.
fn has_scheme(uri: &str) -> bool {
    uri.split_once(':').is_some_and(|(scheme, _)| {
        let is_scheme_byte = |byte: u8| byte.is_ascii_alphanumeric() || b"+-.".contains(&byte);
        !scheme.is_empty() && scheme.bytes().all(is_scheme_byte)
    })
}

/// The bytes of a `data:` URI without its scheme.
fn decode(data: &str) -> Result<Vec<u8>, String> {
    /// Programs agree on the alphabet, but not on the `=` at the end.
    const LENIENT: GeneralPurpose = GeneralPurpose::new(
        &alphabet::STANDARD,
        GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
    );
    let Some((kind, data)) = data.split_once(',') else {
        return Err("no comma before the data".to_owned());
    };
    if kind.to_ascii_lowercase().ends_with(";base64") {
        LENIENT.decode(data).map_err(|error| error.to_string())
    } else {
        Ok(percent_decode_str(data).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_is_decoded_with_and_without_padding() {
        for data in ["application/octet-stream;base64,AQI=", ";BASE64,AQI", ",%01%02"] {
            assert_eq!(decode(data).unwrap(), [1, 2], "{data}");
        }
        assert!(decode(";base64,A?").is_err());
        assert!(decode(";base64").is_err());
    }

    #[test]
    fn a_scheme_is_told_from_a_file_name() {
        for uri in ["file:///etc/passwd", "https://a.b/c.bin", "c:buffer.bin"] {
            assert!(has_scheme(uri), "{uri}");
        }
        for uri in ["a.bin", "sub/a:b.bin", ":a.bin", "a b:c.bin"] {
            assert!(!has_scheme(uri), "{uri}");
        }
    }
}
