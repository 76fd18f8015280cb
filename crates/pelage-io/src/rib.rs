//! Hair as a RenderMan archive: `Curves` statements for `ReadArchive`.
//!
//! Curves are Catmull-Rom with the first and last vertex written twice; what varies
//! along a hair has a value for each real vertex, as `varying` has in the
//! nonperiodic cubic (n − 2 values for n vertices). Widths are diameters.
//!
//! Hairs come in blocks of [`BLOCK_HAIRS`], one `Curves` statement each: memory
//! stays bounded, and so does what a renderer must hold to split it. Several frames
//! make one file each: `NAME.####.rib`.

use crate::atomic::Closed;
use crate::columns::Ends;
use crate::drawable::refused;
use crate::file_sink::{Stream, file_sink};
use crate::recorder::Recorder;
use crate::text_numbers::{push_f32, push_int};
use crate::write::WriteOptions;
use crate::{AtomicFile, frame_path};
use pelage_strands::{StrandBuffer, StreamInfo};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

file_sink! {
    /// Writes hair as a RenderMan archive (`.rib`) of Catmull-Rom `Curves`, with
    /// `width`, `Cs`, `Os` (where one differs from 1), `UV` and `ID`, and `N` for
    /// ribbons. Several frames need a path like `NAME.####.rib`.
    RibWriter, Rib
}

/// Hairs of one `Curves` statement: enough that its words do not count, few enough
/// that renderers can cull by block.
const BLOCK_HAIRS: usize = 4096;

#[derive(Debug)]
struct Rib {
    /// One path a frame; one for a still.
    paths: Vec<PathBuf>,
    head: String,
    ribbons: bool,
    /// Checks frames and counts; gathers nothing.
    recorder: Recorder,
    frame: usize,
    open: Option<AtomicFile>,
    /// Frames that wait for the last one, to appear together.
    closed: Vec<Closed>,
    block: StrandBuffer,
}

impl Stream for Rib {
    fn begin(path: &Path, options: &WriteOptions, info: &StreamInfo) -> io::Result<Self> {
        let mut head = String::from("##RenderMan RIB-Structure 1.1\n");
        if !options.tool.is_empty() {
            head += &format!("##Creator {}\n", options.tool.replace(['\n', '\r'], " "));
        }
        head += "AttributeBegin\n";
        head += &format!(
            "Attribute \"identifier\" \"string name\" [\"{}\"]\n",
            info.name.replace(['"', '\\', '\n'], "_")
        );
        head += "Basis \"catmull-rom\" 1 \"catmull-rom\" 1\n";
        Ok(Self {
            paths: frame_path::frame_paths(path, &info.frames)?,
            head,
            ribbons: options.ribbons,
            recorder: Recorder::new(info, Ends::Doubled, Vec::new())?,
            frame: 0,
            open: None,
            closed: Vec::new(),
            block: StrandBuffer::new(),
        })
    }

    fn begin_frame(&mut self) -> io::Result<()> {
        self.recorder.begin_frame()?;
        let mut file = AtomicFile::create(&self.paths[self.frame])?;
        file.write_all(self.head.as_bytes())?;
        self.open = Some(file);
        Ok(())
    }

    fn write(&mut self, strands: &StrandBuffer) -> io::Result<()> {
        let strands = &*self.recorder.take(strands, |_, _| ())?;
        let mut start = 0;
        while start < strands.len() {
            let end = strands.len().min(start + BLOCK_HAIRS - self.block.len());
            self.block.append(&slice(strands, start..end));
            if self.block.len() == BLOCK_HAIRS {
                self.flush_block()?;
            }
            start = end;
        }
        Ok(())
    }

    fn end_frame(&mut self) -> io::Result<()> {
        self.recorder.end_frame()?;
        self.flush_block()?;
        if let Some(mut file) = self.open.take() {
            file.write_all(b"AttributeEnd\n")?;
            self.closed.push(file.close()?);
        }
        self.frame += 1;
        Ok(())
    }

    fn finish(self) -> io::Result<()> {
        self.recorder.finish()?;
        self.closed.into_iter().try_for_each(Closed::publish)
    }
}

impl Rib {
    fn flush_block(&mut self) -> io::Result<()> {
        if !self.block.is_empty() {
            check_finite(&self.block)?;
            let statement = curves(&self.block, self.ribbons);
            if let Some(file) = &mut self.open {
                file.write_all(&statement)?;
            }
        }
        self.block.clear();
        Ok(())
    }
}

/// Strands `range` of `strands`.
fn slice(strands: &StrandBuffer, range: Range<usize>) -> StrandBuffer {
    let offsets = &strands.offsets[range.start..=range.end];
    let (first, last) = (offsets[0], offsets[range.len()]);
    let vertices = first as usize..last as usize;
    let mut part = StrandBuffer {
        offsets: offsets.iter().map(|offset| offset - first).collect(),
        ..Default::default()
    };
    macro_rules! copy { ($($name:ident by $which:expr),* $(,)?) => { $(
        part.$name = strands.$name.get($which.clone()).unwrap_or(&[]).to_vec();
    )* } }
    copy!(
        points by vertices, widths by vertices, colors by vertices,
        opacities by vertices, normals by vertices, hair_id by range, strand_id by range,
        root_uv by range, strand_uv by range,
    );
    part
}

/// RIB has no word for NaN and infinity, and renderers stop at them.
fn check_finite(block: &StrandBuffer) -> io::Result<()> {
    let arrays: [(&str, &[f32]); 6] = [
        ("position", block.points.as_flattened()),
        ("width", &block.widths),
        ("colour", block.colors.as_flattened()),
        ("opacity", &block.opacities),
        ("normal", block.normals.as_flattened()),
        ("root UV", block.root_uv.as_flattened()),
    ];
    for (name, values) in arrays {
        if !values.iter().all(|value| value.is_finite()) {
            return Err(refused(format!(
                "a {name} is not a finite number, which RIB cannot hold"
            )));
        }
    }
    Ok(())
}

/// The statement for all strands of `block`.
fn curves(block: &StrandBuffer, ribbons: bool) -> Vec<u8> {
    let mut text = b"Curves \"cubic\" [".to_vec();
    for strand in 0..block.len() {
        separate(&mut text, strand);
        push_int(&mut text, Ends::Doubled.count(block.vertex_count(strand)));
    }
    text.extend_from_slice(b"] \"nonperiodic\"\n");
    let mut scratch = Vec::new();
    let points = bytemuck::cast_slice(&block.points);
    let points = Ends::Doubled.apply(points, 12, block, &mut scratch);
    push_floats(&mut text, "P", points);
    push_array(&mut text, "varying float width", &block.widths);
    push_array(&mut text, "varying color Cs", block.colors.as_flattened());
    if block.opacities.iter().any(|&opacity| opacity != 1.0) {
        let grey: Vec<[f32; 3]> = block.opacities.iter().map(|&o| [o; 3]).collect();
        push_array(&mut text, "varying color Os", grey.as_flattened());
    }
    if ribbons {
        push_array(&mut text, "varying normal N", block.normals.as_flattened());
    }
    push_array(
        &mut text,
        "uniform float[2] UV",
        block.root_uv.as_flattened(),
    );
    push_ids(
        &mut text,
        "uniform int ID",
        block.hair_id.iter().map(|&id| id as i32),
    );
    if block.strand_id.iter().any(|&id| id != 0) {
        push_ids(
            &mut text,
            "uniform int ID_strand",
            block.strand_id.iter().map(|&id| id as i32),
        );
    }
    if block.strand_uv.iter().any(|&uv| uv != [0.0; 2]) {
        push_array(
            &mut text,
            "uniform float[2] UV_strand",
            block.strand_uv.as_flattened(),
        );
    }
    text
}

fn separate(text: &mut Vec<u8>, index: usize) {
    if index > 0 {
        text.push(b' ');
    }
}

fn push_array(text: &mut Vec<u8>, name: &str, values: &[f32]) {
    if !values.is_empty() {
        push_floats(text, name, bytemuck::cast_slice(values));
    }
}

/// A parameter of raw floats.
fn push_floats(text: &mut Vec<u8>, name: &str, raw: &[u8]) {
    text.extend_from_slice(format!("    \"{name}\" [").as_bytes());
    for (i, b) in raw.chunks_exact(4).enumerate() {
        separate(text, i);
        push_f32(text, f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    }
    text.extend_from_slice(b"]\n");
}

/// A parameter of integers, 32 bits in RIB: larger ids wrap.
fn push_ids(text: &mut Vec<u8>, name: &str, ids: impl ExactSizeIterator<Item = i32>) {
    if ids.len() == 0 {
        return;
    }
    text.extend_from_slice(format!("    \"{name}\" [").as_bytes());
    for (i, id) in ids.enumerate() {
        separate(text, i);
        push_int(text, id);
    }
    text.extend_from_slice(b"]\n");
}
