//! Strands to write, and Python to read the files back with.
#![allow(dead_code, reason = "every test program uses another part")]
#![allow(clippy::unwrap_used, reason = "these are tests too")]

use pelage_io::{WriteOptions, root_sink_for, sink_for};
use pelage_strands::{Sink, SinkError, StrandBuffer, StrandMeta, StreamInfo};
use std::path::Path;
use std::process::Command;

/// `count` strands of 2 to 6 vertices whose every value follows from the index.
pub fn strands(count: usize) -> StrandBuffer {
    let mut buffer = StrandBuffer::new();
    for i in 0..count {
        push_strand(&mut buffer, i, 2 + i % 5);
    }
    buffer
}

/// Appends strand `i` of `vertices` vertices.
pub fn push_strand(buffer: &mut StrandBuffer, i: usize, vertices: usize) {
    let x = i as f32 * 0.01;
    for k in 0..vertices {
        let t = k as f32 / vertices.max(2) as f32;
        buffer.points.push([x, t * t, t]);
        buffer.widths.push(0.01 * (1.0 - t));
        buffer.colors.push([t, 0.5, 0.1]);
        buffer.opacities.push(1.0);
        buffer.normals.push([1.0, 0.0, 0.0]);
    }
    buffer.push_meta(&StrandMeta {
        hair_id: i as u64 + (1 << 40),
        strand_id: (i % 3) as u32,
        root_uv: [x, 0.25],
        strand_uv: [0.0; 2],
        group: (i % 2) as u32,
        triangle: i as u32,
        barycentric: [0.5, 0.25, 0.25],
        root_rest: [x, 0.0, 0.0],
    });
}

/// Moves all points up by `height`.
pub fn raised(strands: &StrandBuffer, height: f32) -> StrandBuffer {
    let mut raised = strands.clone();
    raised.points.iter_mut().for_each(|p| p[1] += height);
    raised
}

/// Strands `start..end` of `strands`, all attributes included.
pub fn part(strands: &StrandBuffer, start: usize, end: usize) -> StrandBuffer {
    let mut part = StrandBuffer::new();
    let (first, last) = (strands.offsets[start], strands.offsets[end]);
    let (a, b) = (first as usize, last as usize);
    part.offsets = strands.offsets[start..=end]
        .iter()
        .map(|o| o - first)
        .collect();
    macro_rules! cut { ($range:expr, $($name:ident),*) => { $(
        part.$name = strands.$name.get($range).unwrap_or(&[]).to_vec();
    )* } }
    cut!(a..b, points, widths, colors, opacities, normals);
    cut!(start..end, hair_id, strand_id, root_uv, strand_uv, group);
    cut!(start..end, triangle, barycentric, root_rest);
    part
}

/// The sink that a path asks for; `.ply` takes roots only.
pub fn sink(path: &Path, options: &WriteOptions) -> Result<Box<dyn Sink>, SinkError> {
    match path.extension().is_some_and(|e| e == "ply") {
        true => root_sink_for(path, options),
        false => sink_for(path, options),
    }
}

/// Writes one buffer a frame to `path`, in chunks of `chunk` strands.
pub fn write(
    path: &Path,
    options: &WriteOptions,
    info: &StreamInfo,
    frames: &[StrandBuffer],
    chunk: usize,
) -> Result<(), SinkError> {
    let mut sink = sink(path, options)?;
    sink.begin(info)?;
    for (index, strands) in frames.iter().enumerate() {
        sink.begin_frame(index)?;
        let mut start = 0;
        while start < strands.len() {
            let end = strands.len().min(start + chunk);
            sink.write(&part(strands, start, end))?;
            start = end;
        }
        sink.end_frame()?;
    }
    sink.finish()
}

/// Writes a still with plain options.
pub fn write_still(path: &Path, strands: &StrandBuffer) {
    let options = WriteOptions::default();
    let info = StreamInfo::default();
    write(path, &options, &info, std::slice::from_ref(strands), 1000).unwrap();
}

/// Runs `script` in a Python that has `module`, with `arguments`; `false` where there
/// is none, which a message says. Panics where the script fails.
///
/// The Python is `$PELAGE_PYTHON`, else `python3`.
pub fn python(module: &str, script: &str, arguments: &[&Path]) -> bool {
    let program = std::env::var("PELAGE_PYTHON").unwrap_or_else(|_| "python3".into());
    let has_module = Command::new(&program)
        .args(["-c", &format!("import {module}")])
        .output()
        .is_ok_and(|output| output.status.success());
    if !has_module {
        eprintln!("skipped: {program} has no module {module} (set PELAGE_PYTHON)");
        return false;
    }
    let output = Command::new(&program)
        .args(["-c", script])
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(
        output.status.success(),
        "{}{}",
        text(&output.stdout),
        text(&output.stderr)
    );
    print!("{}", text(&output.stdout));
    true
}
