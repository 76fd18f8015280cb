//! The bytes behind glTF accessors: buffers from the file, beside it or in `data:`
//! URIs, and numbers cut out of them with every bound checked.

use crate::ReadError;
use crate::source::read_bytes;
use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::buffer::View;
use gltf::json::validation::Checked;
use gltf::json::{Index, Root};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;

/// All buffers of a file, read when first asked for.
pub(crate) struct Buffers<'a> {
    root: &'a Root,
    /// The binary chunk of a `.glb`.
    blob: Option<&'a [u8]>,
    path: &'a Path,
    /// Bytes by URI: buffers that name one file share its bytes.
    loaded: BTreeMap<&'a str, Vec<u8>>,
}

/// The part of a buffer that an accessor covers.
struct Span<'b> {
    bytes: &'b [u8],
    count: usize,
    stride: usize,
    component: ComponentType,
    normalized: bool,
}

impl<'a> Buffers<'a> {
    /// The buffers of the file `path`.
    pub fn new(root: &'a Root, blob: Option<&'a [u8]>, path: &'a Path) -> Self {
        Self {
            root,
            blob,
            path,
            loaded: BTreeMap::new(),
        }
    }

    /// Entries that `accessor` claims to have.
    pub fn count(&self, accessor: Index<Accessor>) -> u64 {
        let accessor = self.root.accessors.get(accessor.value());
        accessor.map_or(0, |accessor| accessor.count.0)
    }

    /// The vectors of an accessor, integers normalised where it says so; all finite.
    pub fn vectors<const N: usize>(
        &mut self,
        accessor: Index<Accessor>,
        place: &str,
        name: &str,
    ) -> Result<Vec<[f32; N]>, ReadError> {
        let path = self.path;
        let place = format!("{place}.{name}");
        let kind = [Type::Vec2, Type::Vec3][usize::from(N == 3)];
        let span = self.span(accessor, kind, &place)?;
        let size = span.component.size();
        let mut vectors = Vec::with_capacity(span.count);
        for i in 0..span.count {
            let entry = &span.bytes[i * span.stride..];
            let vector: [f32; N] = std::array::from_fn(|c| {
                number(&entry[c * size..], span.component, span.normalized)
            });
            if !vector.iter().all(|number| number.is_finite()) {
                let message = format!("entry {i} is {vector:?}; it must be finite");
                return Err(ReadError::file(path, message).at(place));
            }
            vectors.push(vector);
        }
        Ok(vectors)
    }

    /// The indices of an accessor of unsigned integers.
    pub fn indices(
        &mut self,
        accessor: Index<Accessor>,
        place: &str,
    ) -> Result<Vec<u32>, ReadError> {
        let path = self.path;
        let place = format!("{place}.indices");
        let span = self.span(accessor, Type::Scalar, &place)?;
        let read: fn(&[u8]) -> u32 = match span.component {
            ComponentType::U8 => |b| u32::from(b[0]),
            ComponentType::U16 => |b| u32::from(u16::from_le_bytes([b[0], b[1]])),
            ComponentType::U32 => |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]),
            other => {
                let message = format!("indices of type {other:?}; they must be unsigned integers");
                return Err(ReadError::file(path, message).at(place));
            }
        };
        let entries = (0..span.count).map(|i| read(&span.bytes[i * span.stride..]));
        Ok(entries.collect())
    }

    /// Finds an accessor's bytes: `count` entries of `stride` bytes, the last one
    /// whole.
    fn span(
        &mut self,
        index: Index<Accessor>,
        kind: Type,
        place: &str,
    ) -> Result<Span<'_>, ReadError> {
        let path = self.path;
        let fail = |message: String| ReadError::file(path, message).at(place);
        let root = self.root;
        let accessor = root
            .accessors
            .get(index.value())
            .ok_or_else(|| fail(format!("accessor {} does not exist", index.value())))?;
        let component = match (&accessor.component_type, &accessor.type_) {
            (Checked::Valid(component), Checked::Valid(found)) if *found == kind => component.0,
            _ => return Err(fail(format!("its accessor is no {kind:?} of numbers"))),
        };
        let view = match (&accessor.sparse, accessor.buffer_view) {
            (None, Some(view)) => view.value(),
            _ => {
                let message = "sparse accessors and those without a view are not read";
                return Err(ReadError::unsupported(path, message).at(place));
            }
        };
        let view = root
            .buffer_views
            .get(view)
            .ok_or_else(|| fail(format!("buffer view {view} does not exist")))?;
        let entry = component.size() * kind.multiplicity();
        let stride = view.byte_stride.map_or(entry, |stride| stride.0);
        if stride < entry {
            return Err(fail(format!(
                "a stride of {stride} bytes for entries of {entry}"
            )));
        }
        let bytes = self.view_bytes(view, place)?;
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        let count = accessor.count.0;
        let needed = count
            .saturating_sub(1)
            .saturating_mul(stride as u64)
            .saturating_add(if count > 0 { entry as u64 } else { 0 })
            .saturating_add(offset);
        if needed > bytes.len() as u64 {
            let available = bytes.len();
            return Err(fail(format!(
                "{count} entries need {needed} bytes; its view has {available}"
            )));
        }
        Ok(Span {
            bytes: &bytes[offset as usize..],
            count: count as usize,
            stride,
            component,
            normalized: accessor.normalized,
        })
    }

    fn view_bytes(&mut self, view: &View, place: &str) -> Result<&[u8], ReadError> {
        let path = self.path;
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let length = view.byte_length.0;
        let bytes = self.buffer_bytes(view.buffer.value(), place)?;
        let end = start.saturating_add(length);
        if end > bytes.len() as u64 {
            let available = bytes.len();
            let message = format!("its view ends at byte {end} of a buffer of {available}");
            return Err(ReadError::file(path, message).at(place));
        }
        Ok(&bytes[start as usize..end as usize])
    }

    /// All bytes of a buffer; more than it claims do no harm.
    fn buffer_bytes(&mut self, index: usize, place: &str) -> Result<&[u8], ReadError> {
        let path = self.path;
        let fail = |message: String| ReadError::file(path, message).at(place);
        let buffer = self
            .root
            .buffers
            .get(index)
            .ok_or_else(|| fail(format!("buffer {index} does not exist")))?;
        let Some(uri) = buffer.uri.as_deref() else {
            return self
                .blob
                .filter(|_| index == 0)
                .ok_or_else(|| fail(format!("buffer {index} has no URI and no binary chunk")));
        };
        if !self.loaded.contains_key(uri) {
            let bytes = load(uri, path).map_err(|error| error.at(format!("buffers[{index}]")))?;
            self.loaded.insert(uri, bytes);
        }
        Ok(&self.loaded[uri])
    }
}

/// The bytes that a URI names: its own, or those of a file beside `path`.
fn load(uri: &str, path: &Path) -> Result<Vec<u8>, ReadError> {
    if let Some(data) = uri.strip_prefix("data:") {
        return match data.split_once(";base64,") {
            Some((_, base64)) => decode_base64(base64.as_bytes())
                .ok_or_else(|| ReadError::file(path, "a data: URI that is no base64")),
            None => Err(ReadError::unsupported(path, "a data: URI without base64")),
        };
    }
    if uri.contains("://") {
        let short: String = uri.chars().take(80).collect();
        let message = format!("the buffer {short} lies elsewhere");
        return Err(
            ReadError::unsupported(path, message).help("only files beside this one are read")
        );
    }
    let name = decode_percent(uri);
    let beside = path.with_file_name(&*name);
    read_bytes(&beside).map_err(|error| {
        let short: String = name.chars().take(80).collect();
        ReadError::new(path, error.blame, format!("{short}: {}", error.message))
    })
}

/// `%20` and its like as the bytes they stand for.
fn decode_percent(uri: &str) -> Cow<'_, str> {
    if !uri.contains('%') {
        return uri.into();
    }
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        let code = tail
            .get(..2)
            .filter(|_| first == b'%')
            .filter(|hex| hex.iter().all(u8::is_ascii_hexdigit))
            .and_then(|hex| std::str::from_utf8(hex).ok())
            .and_then(|hex| u8::from_str_radix(hex, 16).ok());
        bytes.push(code.unwrap_or(first));
        rest = if code.is_some() { &tail[2..] } else { tail };
    }
    String::from_utf8_lossy(&bytes).into_owned().into()
}

/// Bytes from their base64 text (RFC 4648), or `None` where it is none.
fn decode_base64(text: &[u8]) -> Option<Vec<u8>> {
    let text = text.trim_ascii();
    let text = text.strip_suffix(b"=").unwrap_or(text);
    let text = text.strip_suffix(b"=").unwrap_or(text);
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for group in text.chunks(4) {
        let mut bits = 0u32;
        for &letter in group {
            bits = bits << 6 | base64_digit(letter)?;
        }
        let missing = 4 - group.len();
        if missing == 3 {
            return None;
        }
        bits <<= 6 * missing;
        bytes.extend_from_slice(&bits.to_be_bytes()[1..4 - missing]);
    }
    Some(bytes)
}

fn base64_digit(letter: u8) -> Option<u32> {
    let digit = match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' | b'-' => 62,
        b'/' | b'_' => 63,
        _ => return None,
    };
    Some(u32::from(digit))
}

/// The number at the start of `b`, which holds it whole.
fn number(b: &[u8], component: ComponentType, normalized: bool) -> f32 {
    let (value, largest) = match component {
        ComponentType::I8 => (f32::from(b[0] as i8), 127.0),
        ComponentType::U8 => (f32::from(b[0]), 255.0),
        ComponentType::I16 => (f32::from(i16::from_le_bytes([b[0], b[1]])), 32767.0),
        ComponentType::U16 => (f32::from(u16::from_le_bytes([b[0], b[1]])), 65535.0),
        ComponentType::U32 => (u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as f32, 1.0),
        ComponentType::F32 => (f32::from_le_bytes([b[0], b[1], b[2], b[3]]), 1.0),
    };
    match normalized && largest > 1.0 {
        true => (value / largest).max(-1.0),
        false => value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_follows_the_test_vectors_of_rfc_4648() {
        let vectors = [
            "", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy",
        ];
        for (i, text) in vectors.into_iter().enumerate() {
            assert_eq!(decode_base64(text.as_bytes()).unwrap(), b"foobar"[..i]);
        }
        for text in ["Z", "Zm9v Zg==", "Zm9vZ", "\u{e9}"] {
            assert!(decode_base64(text.as_bytes()).is_none(), "{text}");
        }
    }

    #[test]
    fn percent_codes_are_decoded_and_stray_signs_kept() {
        assert_eq!(decode_percent("a%20b%C3%A9.bin"), "a b\u{e9}.bin");
        assert_eq!(decode_percent("100%"), "100%");
        assert_eq!(decode_percent("%zz%+1"), "%zz%+1");
    }
}
