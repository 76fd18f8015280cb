//! Polygon meshes of PLY files: text, little and big endian.
//!
//! Source: Greg Turk, "The PLY Polygon File Format" (1994). The header is parsed
//! by `ply-rs-bw`. Why not the rest: its elements are boxed one by one, its text
//! numbers refuse `1.` and `.5`, an element without properties may repeat 2⁶⁴
//! times, and its errors quote whole lines but name no element.
//!
//! Read are `vertex` (x, y, z; nx, ny, nz; s, t or u, v or texture_u, texture_v)
//! and `face` (`vertex_indices` or `vertex_index`; `texcoord`, two numbers a
//! corner, which wins over the vertices' own). Everything else is skipped.

use crate::source::read_bytes;
use crate::{Blame, ReadError};
use pelage_surface::PolygonMesh;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    DefaultElement, ElementDef, Encoding, Header, PropertyDef, PropertyType, ScalarType,
};
use std::io::Cursor;
use std::path::Path;

/// The mesh in the PLY file `path`.
///
/// Normals and texture coordinates of vertices become those of their corners.
pub fn read_ply_mesh(path: &Path) -> Result<PolygonMesh, ReadError> {
    parse_ply_mesh(&read_bytes(path)?, path)
}

/// Like [`read_ply_mesh`], of `bytes`; `path` only names them in errors.
pub fn parse_ply_mesh(bytes: &[u8], path: &Path) -> Result<PolygonMesh, ReadError> {
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = Parser::<DefaultElement>::new()
        .read_header(&mut reader)
        .map_err(|error| header_error(path, &error))?;
    let start = reader.into_inner().position() as usize;
    let mut values = Values {
        encoding: header.encoding,
        bytes,
        at: start.min(bytes.len()),
    };
    check_counts(&header, bytes.len() - values.at, path)?;
    let mut found = Found::default();
    for (_, element) in &header.elements {
        read_element(element, &mut values, &mut found, path)?;
    }
    found.into_mesh(path)
}

/// The decoder's error as one line: the file's own text may fill pages.
fn header_error(path: &Path, error: &ply_rs_bw::parser::ParseError) -> ReadError {
    let text = error.to_string();
    let first = text.lines().next().unwrap_or("broken header");
    let first = first.split_once(": ").map_or(first, |(_, rest)| rest);
    let short: String = first.chars().take(200).collect();
    let result = ReadError::file(path, format!("header: {short}"));
    match error.line() {
        Some(line) => result.at(format!("line {line}")),
        None => result,
    }
}

/// Refuses counts that the file cannot hold, before anything is allocated.
fn check_counts(header: &Header, bytes_left: usize, path: &Path) -> Result<(), ReadError> {
    for (name, element) in &header.elements {
        let smallest: usize = element
            .properties
            .iter()
            .map(|(_, property)| smallest_bytes(&property.data_type, header.encoding))
            .sum();
        let fits = match smallest {
            0 => element.count == 0,
            bytes => element.count <= bytes_left / bytes + 1,
        };
        if !fits {
            let message = format!(
                "{} elements `{name}`, but only {bytes_left} bytes follow the header",
                element.count
            );
            return Err(ReadError::new(path, Blame::Limit, message));
        }
    }
    Ok(())
}

fn smallest_bytes(kind: &PropertyType, encoding: Encoding) -> usize {
    match (encoding, kind) {
        // A digit and a space.
        (Encoding::Ascii, _) => 2,
        (_, PropertyType::Scalar(kind) | PropertyType::List(kind, _)) => size_of_scalar(kind),
    }
}

fn size_of_scalar(kind: &ScalarType) -> usize {
    match kind {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// The numbers behind the header, one after the other.
struct Values<'a> {
    encoding: Encoding,
    bytes: &'a [u8],
    at: usize,
}

impl Values<'_> {
    /// The next number. Every type of the format fits into f64 exactly.
    fn next(&mut self, kind: &ScalarType) -> Result<f64, String> {
        match self.encoding {
            Encoding::Ascii => self.next_word(),
            Encoding::BinaryLittleEndian => self.next_bytes(kind, false),
            Encoding::BinaryBigEndian => self.next_bytes(kind, true),
        }
    }

    fn next_word(&mut self) -> Result<f64, String> {
        let rest = &self.bytes[self.at..];
        let start = rest.iter().position(|b| !b.is_ascii_whitespace());
        let rest = &rest[start.ok_or("the file ends here")?..];
        let end = rest.iter().position(u8::is_ascii_whitespace);
        let word = &rest[..end.unwrap_or(rest.len())];
        std::str::from_utf8(word)
            .ok()
            .and_then(|word| word.parse().ok())
            .inspect(|_| self.at = self.bytes.len() - rest.len() + word.len())
            .ok_or_else(|| {
                let before = self.bytes[..self.at].iter();
                let line = 1 + before.filter(|&&byte| byte == b'\n').count();
                let shown: String = String::from_utf8_lossy(word).chars().take(40).collect();
                format!("line {line}: {shown:?} is no number")
            })
    }

    fn next_bytes(&mut self, kind: &ScalarType, big: bool) -> Result<f64, String> {
        let size = size_of_scalar(kind);
        let found = self.bytes.get(self.at..self.at + size);
        let mut b = [0; 8];
        b[..size].copy_from_slice(found.ok_or("the file ends here")?);
        self.at += size;
        if big {
            b[..size].reverse();
        }
        Ok(match kind {
            ScalarType::Char => f64::from(b[0] as i8),
            ScalarType::UChar => f64::from(b[0]),
            ScalarType::Short => f64::from(i16::from_le_bytes([b[0], b[1]])),
            ScalarType::UShort => f64::from(u16::from_le_bytes([b[0], b[1]])),
            ScalarType::Int => f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            ScalarType::UInt => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            ScalarType::Float => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            ScalarType::Double => f64::from_le_bytes(b),
        })
    }

    /// Reads one property and hands its numbers to `take`; lists tell their length
    /// to `begin` first.
    fn property(
        &mut self,
        property: &PropertyDef,
        mut take: impl FnMut(f64),
    ) -> Result<usize, String> {
        let (count, kind) = match &property.data_type {
            PropertyType::Scalar(kind) => (1, kind),
            PropertyType::List(length, kind) => {
                let count = self.next(length)?;
                if count < 0.0 || count.fract() != 0.0 || count > self.bytes.len() as f64 {
                    return Err(format!("a list of {count} numbers"));
                }
                (count as usize, kind)
            }
        };
        for _ in 0..count {
            take(self.next(kind)?);
        }
        Ok(count)
    }
}

/// What the file has, as it has it.
#[derive(Default)]
struct Found {
    positions: Vec<[f32; 3]>,
    vertex_normals: Vec<[f32; 3]>,
    vertex_uvs: Vec<[f32; 2]>,
    face_sizes: Vec<u32>,
    corner_vertices: Vec<u32>,
    corner_uvs: Vec<[f32; 2]>,
    has_faces: bool,
}

/// What a property means to us.
#[derive(Clone, Copy, PartialEq)]
enum Meaning {
    Position(usize),
    Normal(usize),
    Uv(usize),
    Corners,
    CornerUvs,
    Other,
}

fn meaning(element: &str, property: &PropertyDef) -> Meaning {
    let list = matches!(property.data_type, PropertyType::List(..));
    match (element, property.name.as_str(), list) {
        ("vertex", "x", false) => Meaning::Position(0),
        ("vertex", "y", false) => Meaning::Position(1),
        ("vertex", "z", false) => Meaning::Position(2),
        ("vertex", "nx", false) => Meaning::Normal(0),
        ("vertex", "ny", false) => Meaning::Normal(1),
        ("vertex", "nz", false) => Meaning::Normal(2),
        ("vertex", "s" | "u" | "texture_u", false) => Meaning::Uv(0),
        ("vertex", "t" | "v" | "texture_v", false) => Meaning::Uv(1),
        ("face", "vertex_indices" | "vertex_index", true) => Meaning::Corners,
        ("face", "texcoord", true) => Meaning::CornerUvs,
        _ => Meaning::Other,
    }
}

fn read_element(
    element: &ElementDef,
    values: &mut Values<'_>,
    found: &mut Found,
    path: &Path,
) -> Result<(), ReadError> {
    let name = element.name.as_str();
    let properties: Vec<_> = element
        .properties
        .iter()
        .map(|(_, property)| (property, meaning(name, property)))
        .collect();
    let has = |wanted| properties.iter().any(|&(_, meaning)| meaning == wanted);
    let (has_normals, has_uvs) = match name {
        "vertex" => {
            if !(0..3).all(|axis| has(Meaning::Position(axis))) {
                return Err(ReadError::file(path, "the vertices lack x, y or z"));
            }
            (
                (0..3).all(|axis| has(Meaning::Normal(axis))),
                (0..2).all(|axis| has(Meaning::Uv(axis))),
            )
        }
        _ => (false, false),
    };
    let is_face = name == "face" && has(Meaning::Corners);
    found.has_faces |= is_face;
    for index in 0..element.count {
        let at = |message| ReadError::file(path, message).at(format!("{name} {index}"));
        let record = Record::read(&properties, values).map_err(at)?;
        if name == "vertex" {
            found.positions.push(finite(record.position).map_err(at)?);
            if has_normals {
                found
                    .vertex_normals
                    .push(finite(record.normal).map_err(at)?);
            }
            if has_uvs {
                found.vertex_uvs.push(finite(record.uv).map_err(at)?);
            }
        } else if is_face {
            found.push_face(&record).map_err(at)?;
        }
    }
    Ok(())
}

/// One vertex or face.
#[derive(Default)]
struct Record {
    position: [f64; 3],
    normal: [f64; 3],
    uv: [f64; 2],
    corners: Vec<f64>,
    corner_uvs: Vec<f64>,
}

impl Record {
    fn read(
        properties: &[(&PropertyDef, Meaning)],
        values: &mut Values<'_>,
    ) -> Result<Self, String> {
        let mut record = Self::default();
        for &(property, meaning) in properties {
            values.property(property, |value| match meaning {
                Meaning::Position(axis) => record.position[axis] = value,
                Meaning::Normal(axis) => record.normal[axis] = value,
                Meaning::Uv(axis) => record.uv[axis] = value,
                Meaning::Corners => record.corners.push(value),
                Meaning::CornerUvs => record.corner_uvs.push(value),
                Meaning::Other => {}
            })?;
        }
        Ok(record)
    }
}

/// `numbers` as f32, where they are finite there.
fn finite<const N: usize>(numbers: [f64; N]) -> Result<[f32; N], String> {
    let narrow = numbers.map(|number| number as f32);
    match narrow.iter().position(|number| !number.is_finite()) {
        None => Ok(narrow),
        Some(i) => Err(format!("{} is not a finite 32-bit number", numbers[i])),
    }
}

impl Found {
    fn push_face(&mut self, record: &Record) -> Result<(), String> {
        let size = record.corners.len();
        if size < 3 {
            return Err(format!("{size} corners; a face needs at least 3"));
        }
        for &corner in &record.corners {
            if corner.fract() != 0.0 || !(0.0..f64::from(u32::MAX)).contains(&corner) {
                return Err(format!("{corner} is no vertex index"));
            }
            self.corner_vertices.push(corner as u32);
        }
        // The list was in memory, one number a corner: its length fits.
        self.face_sizes.push(size as u32);
        match record.corner_uvs.len() {
            0 => {}
            length if length == 2 * size => {
                for uv in record.corner_uvs.as_chunks::<2>().0 {
                    self.corner_uvs.push(finite(*uv)?);
                }
            }
            length => {
                return Err(format!("{length} numbers `texcoord` for {size} corners"));
            }
        }
        Ok(())
    }

    fn into_mesh(self, path: &Path) -> Result<PolygonMesh, ReadError> {
        if self.face_sizes.is_empty() {
            let message = match self.has_faces {
                true => "there is no face in this file",
                false => "there is no element `face` with a list `vertex_indices`",
            };
            return Err(ReadError::file(path, message));
        }
        let vertices = self.positions.len();
        let stray = |&&corner: &&u32| corner as usize >= vertices;
        if let Some(corner) = self.corner_vertices.iter().find(stray) {
            let message = format!("a face names vertex {corner}; the file has {vertices}");
            return Err(ReadError::file(path, message));
        }
        let of_corners = |index: &u32| *index as usize;
        let corner_uvs = match self.corner_uvs.len() == self.corner_vertices.len() {
            true => self.corner_uvs,
            false => spread(
                &self.vertex_uvs,
                self.corner_vertices.iter().map(of_corners),
            ),
        };
        let corners = self.corner_vertices.iter().map(of_corners);
        Ok(PolygonMesh {
            corner_normals: spread(&self.vertex_normals, corners),
            corner_uvs,
            positions: self.positions,
            face_sizes: self.face_sizes,
            corner_vertices: self.corner_vertices,
        })
    }
}

/// The entry of each corner's vertex, or nothing where vertices have none.
fn spread<T: Copy>(entries: &[T], corners: impl Iterator<Item = usize>) -> Vec<T> {
    corners.map_while(|i| entries.get(i).copied()).collect()
}

#[cfg(test)]
#[path = "ply_tests.rs"]
mod tests;
