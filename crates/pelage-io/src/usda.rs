//! Hair as USD text.
//!
//! Points stream into the file as they come; all other arrays wait in spools and
//! follow at the end, so memory does not grow with the hair. Numbers are the
//! shortest decimals that read back the same.

use crate::AtomicFile;
use crate::columns::{Content, Ends, Field, Scalar};
use crate::file_sink::{Stream, file_sink};
use crate::hair_prim::{self, Attribute, attribute};
use crate::recorder::{Recorded, Recorder};
use crate::spool::pour;
use crate::text_array::{ArrayText, TextArray};
use crate::text_numbers::push_f64;
use crate::write::WriteOptions;
use pelage_strands::{Bounds, StrandBuffer, StreamInfo};
use std::io::{self, Read, Write};
use std::path::Path;

file_sink! {
    /// Writes hair as USD text (`.usda`); the prims are those of
    /// [`UsdcWriter`](crate::UsdcWriter).
    UsdaWriter, Usda
}

#[derive(Debug)]
struct Usda {
    file: AtomicFile,
    recorder: Recorder,
    frames: Vec<f64>,
    frame: usize,
    points: TextArray,
    scratch: Vec<u8>,
}

impl Stream for Usda {
    fn begin(path: &Path, options: &WriteOptions, info: &StreamInfo) -> io::Result<Self> {
        let recorder = hair_prim::recorder(info, hair_prim::columns(path, options.ribbons))?;
        let mut file = AtomicFile::create(path)?;
        file.write_all(&head(options, info))?;
        Ok(Self {
            file,
            recorder,
            frames: info.frames.clone(),
            frame: 0,
            points: TextArray::new(Scalar::F32, 3),
            scratch: Vec::new(),
        })
    }

    fn begin_frame(&mut self) -> io::Result<()> {
        self.recorder.begin_frame()?;
        let mut text = Vec::new();
        begin_sample(&mut text, &self.frames, self.frame, "point3f[] points");
        self.file.write_all(&text)
    }

    fn write(&mut self, strands: &StrandBuffer) -> io::Result<()> {
        let strands = self.recorder.take(strands, |_, _| ())?;
        let points = bytemuck::cast_slice(&strands.points);
        let points = Ends::Doubled.apply(points, 12, &strands, &mut self.scratch);
        self.points.put(points, &mut self.file)
    }

    fn end_frame(&mut self) -> io::Result<()> {
        self.recorder.end_frame()?;
        self.points.restart();
        let mut text = Vec::new();
        end_sample(&mut text, &self.frames, self.frame, None);
        self.frame += 1;
        self.file.write_all(&text)
    }

    fn finish(self) -> io::Result<()> {
        let mut file = self.file;
        let Recorded {
            info,
            tally,
            columns,
            extents,
        } = self.recorder.finish()?;
        write_extents(&info.frames, &extents, &mut file)?;
        for mut column in columns {
            let field = column.field;
            let entries = field.entries(tally.amount);
            if let Some(attribute) = attribute(field) {
                write_column(
                    field,
                    attribute,
                    column.finish(),
                    entries,
                    &info.frames,
                    &mut file,
                )?;
            }
        }
        file.write_all(b"    }\n}\n")?;
        file.commit()
    }
}

/// Layer metadata and prims up to the first array.
fn head(options: &WriteOptions, info: &StreamInfo) -> Vec<u8> {
    let mut text = b"#usda 1.0\n(\n".to_vec();
    if !options.tool.is_empty() {
        push(&mut text, &format!("    doc = {}\n", quoted(&options.tool)));
    }
    push(&mut text, &format!("    defaultPrim = \"{}\"\n", info.name));
    for (name, value) in hair_prim::layer_numbers(info) {
        push(&mut text, &format!("    {name} = "));
        push_f64(&mut text, value);
        text.push(b'\n');
    }
    let axis = hair_prim::up_axis(info.up_axis);
    push(&mut text, &format!("    upAxis = \"{axis}\"\n)\n\n"));
    push(
        &mut text,
        &format!(
            "def Xform \"{}\" (\n    kind = \"component\"\n)\n{{\n",
            info.name
        ),
    );
    push(
        &mut text,
        &format!("    def BasisCurves \"{}\"\n    {{\n", hair_prim::CURVES),
    );
    for (name, token) in hair_prim::SHAPE {
        push(
            &mut text,
            &format!("        uniform token {name} = \"{token}\"\n"),
        );
    }
    text
}

fn push(text: &mut Vec<u8>, more: &str) {
    text.extend_from_slice(more.as_bytes());
}

/// `words` between quotes that end at the same place for every reader.
fn quoted(words: &str) -> String {
    let plain = words.replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{}\"", plain.replace('\n', "\\n").replace('\r', ""))
}

/// What stands before the values of frame `frame`: `declaration = [` for a still.
fn begin_sample(text: &mut Vec<u8>, frames: &[f64], frame: usize, declaration: &str) {
    if frames.is_empty() {
        push(text, &format!("        {declaration} = ["));
        return;
    }
    if frame == 0 {
        push(text, &format!("        {declaration}.timeSamples = {{\n"));
    }
    push(text, "            ");
    push_f64(text, frames[frame]);
    push(text, ": [");
}

/// What stands after them; `interpolation` as metadata of the attribute, which an
/// animated one takes in a statement of its own (see [`declare`]).
fn end_sample(text: &mut Vec<u8>, frames: &[f64], frame: usize, interpolation: Option<&str>) {
    text.push(b']');
    if frames.is_empty() {
        push_interpolation(text, interpolation);
    } else if frame + 1 < frames.len() {
        push(text, ",\n");
    } else {
        push(text, "\n        }\n");
    }
}

fn push_interpolation(text: &mut Vec<u8>, interpolation: Option<&str>) {
    match interpolation {
        Some(domain) => push(
            text,
            &format!(" (\n            interpolation = \"{domain}\"\n        )\n"),
        ),
        None => text.push(b'\n'),
    }
}

fn write_extents(frames: &[f64], extents: &[Bounds], out: &mut impl Write) -> io::Result<()> {
    for (frame, bounds) in extents.iter().enumerate() {
        let mut text = Vec::new();
        begin_sample(&mut text, frames, frame, "float3[] extent");
        let corners = hair_prim::extent(bounds);
        TextArray::new(Scalar::F32, 3).put(bytemuck::cast_slice(&corners), &mut text)?;
        end_sample(&mut text, frames, frame, None);
        out.write_all(&text)?;
    }
    Ok(())
}

/// Writes one attribute whose samples have `entries` entries each.
fn write_column(
    field: Field,
    attribute: Attribute,
    content: Content,
    entries: u64,
    frames: &[f64],
    out: &mut impl Write,
) -> io::Result<()> {
    let (mut interpolation, mut entries) = (attribute.interpolation, entries);
    let mut reader: Box<dyn Read> = match content {
        Content::Absent | Content::Usual(0.0) => return Ok(()),
        Content::Usual(value) => {
            (interpolation, entries) = (Some("constant"), 1);
            Box::new(io::Cursor::new(value.to_le_bytes()))
        }
        Content::Values(spool) => Box::new(spool.into_reader()),
    };
    let frames = if field == Field::Normals { frames } else { &[] };
    let declaration = format!("{} {}", attribute.kind, attribute.name);
    if !frames.is_empty() {
        let mut text = format!("        {declaration}").into_bytes();
        push_interpolation(&mut text, interpolation);
        out.write_all(&text)?;
    }
    let (scalar, components) = field.element();
    for frame in 0..frames.len().max(1) {
        let mut text = Vec::new();
        begin_sample(&mut text, frames, frame, &declaration);
        out.write_all(&text)?;
        let mut array = ArrayText::new(TextArray::new(scalar, components), &mut *out);
        pour(&mut reader, entries * field.stride() as u64, &mut array)?;
        text.clear();
        end_sample(&mut text, frames, frame, interpolation);
        out.write_all(&text)?;
    }
    Ok(())
}
