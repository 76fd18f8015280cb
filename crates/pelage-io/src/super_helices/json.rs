//! The JSON form: a header, then arrays a strand and arrays an element.

use super::SuperHelices;
use super::arrays::VERSION;
use super::check::Wrong;
use crate::source::read_bytes;
use crate::{AtomicFile, ReadError};
use pelage_strands::UpAxis;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;

/// What `format` says.
const FORMAT: &str = "super-helices";

/// What must be right before anything else is looked at.
#[derive(Deserialize)]
struct Header {
    format: String,
    version: u32,
}

/// The whole file. Its first key tells what it is: `is_json` looks for it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File<'a> {
    format: Cow<'a, str>,
    version: u32,
    up_axis: Option<Axis>,
    meters_per_unit: Option<f64>,
    strands: Strands<'a>,
    elements: Elements<'a>,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
enum Axis {
    Y,
    Z,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Strands<'a> {
    elements: Vec<u32>,
    vertices: Cow<'a, [u32]>,
    root: Cow<'a, [[f32; 3]]>,
    tangent: Cow<'a, [[f32; 3]]>,
    normal: Cow<'a, [[f32; 3]]>,
    error: Cow<'a, [f32]>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Elements<'a> {
    length: Cow<'a, [f32]>,
    twist: Cow<'a, [f32]>,
    curvature_1: Cow<'a, [f32]>,
    curvature_2: Cow<'a, [f32]>,
}

/// Whether a file that starts like this is of this form.
pub(crate) fn is_json(start: &[u8]) -> bool {
    let dense: Vec<u8> = start
        .iter()
        .copied()
        .filter(|byte| !byte.is_ascii_whitespace())
        .collect();
    dense.starts_with(format!("{{\"format\":\"{FORMAT}\"").as_bytes())
}

pub(super) fn write(path: &Path, strands: &SuperHelices) -> io::Result<()> {
    let axis = |axis| match axis {
        UpAxis::Y => Axis::Y,
        UpAxis::Z => Axis::Z,
    };
    let file = File {
        format: FORMAT.into(),
        version: VERSION,
        up_axis: strands.up_axis.map(axis),
        meters_per_unit: strands.meters_per_unit,
        strands: Strands {
            elements: strands.element_counts(),
            vertices: (&strands.vertices[..]).into(),
            root: (&strands.roots[..]).into(),
            tangent: (&strands.tangents[..]).into(),
            normal: (&strands.normals[..]).into(),
            error: (&strands.errors[..]).into(),
        },
        elements: Elements {
            length: (&strands.lengths[..]).into(),
            twist: (&strands.twists[..]).into(),
            curvature_1: (&strands.curvatures_1[..]).into(),
            curvature_2: (&strands.curvatures_2[..]).into(),
        },
    };
    let mut out = AtomicFile::create(path)?;
    serde_json::to_writer(&mut out, &file)?;
    out.write_all(b"\n")?;
    out.commit()
}

pub(super) fn read(path: &Path) -> Result<SuperHelices, ReadError> {
    parse_super_helices(&read_bytes(path)?, path)
}

/// Parses Super-Helices in JSON; errors call the file `path`.
pub fn parse_super_helices(bytes: &[u8], path: &Path) -> Result<SuperHelices, ReadError> {
    let header: Header = serde_json::from_slice(bytes).map_err(|e| told(path, &e))?;
    if header.format != FORMAT {
        let message = format!("format is {:?}, not {FORMAT:?}", header.format);
        return Err(ReadError::unsupported(path, message));
    }
    if header.version != VERSION {
        let message = format!("version {} is not read, only {VERSION}", header.version);
        return Err(ReadError::unsupported(path, message));
    }
    let file: File = serde_json::from_slice(bytes).map_err(|e| told(path, &e))?;
    let unit = file.meters_per_unit;
    if unit.is_some_and(|unit| !(unit > 0.0 && unit.is_finite())) {
        return Err(ReadError::file(path, "a number above 0 belongs here").at("meters_per_unit"));
    }
    let mut strands = SuperHelices {
        up_axis: file.up_axis.map(|axis| match axis {
            Axis::Y => UpAxis::Y,
            Axis::Z => UpAxis::Z,
        }),
        meters_per_unit: unit,
        offsets: Vec::new(),
        vertices: file.strands.vertices.into_owned(),
        roots: file.strands.root.into_owned(),
        tangents: file.strands.tangent.into_owned(),
        normals: file.strands.normal.into_owned(),
        errors: file.strands.error.into_owned(),
        lengths: file.elements.length.into_owned(),
        twists: file.elements.twist.into_owned(),
        curvatures_1: file.elements.curvature_1.into_owned(),
        curvatures_2: file.elements.curvature_2.into_owned(),
    };
    let dealt = strands.deal(&file.strands.elements);
    dealt
        .and_then(|()| strands.check())
        .map_err(|Wrong { place, message }| ReadError::file(path, message).at(place))?;
    Ok(strands)
}

/// An error of the parser, its place in front.
fn told(path: &Path, error: &serde_json::Error) -> ReadError {
    let text = error.to_string();
    let what = text
        .rsplit_once(" at line ")
        .map_or(&*text, |(what, _)| what);
    let place = format!("line {}, column {}", error.line(), error.column());
    ReadError::file(path, what).at(place)
}
