//! How fast hair is written, next to a plain write of the same bytes to the same
//! disk. Both end with the data handed to the disk.
//!
//! `cargo bench -p pelage-io --bench write_rate -- [HAIRS] [FOLDER]`; the folder is
//! the target directory's unless given.

use pelage_io::{WriteOptions, sink_for};
use pelage_strands::{SinkError, StrandBuffer, StrandMeta, StreamInfo};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

const VERTICES: usize = 6;
const CHUNK: usize = 2000;
/// Disks are uneven: each way is tried so often, in turn, and the best counts.
const ROUNDS: usize = 3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Cargo adds `--bench`.
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| !argument.starts_with("--"))
        .collect();
    let hairs: usize = match arguments.first() {
        Some(number) => number.parse()?,
        None => 1_000_000,
    };
    let folder = match arguments.get(1) {
        Some(folder) => PathBuf::from(folder),
        None => PathBuf::from(env!("CARGO_TARGET_TMPDIR")),
    };
    println!(
        "{hairs} hairs of {VERTICES} vertices into {}",
        folder.display()
    );
    for format in ["usdc", "npz", "usda", "rib"] {
        compare(&folder.join(format!("write_rate.{format}")), hairs)?;
    }
    Ok(())
}

fn compare(path: &Path, hairs: usize) -> Result<(), Box<dyn std::error::Error>> {
    let plain_path = path.with_extension("plain");
    let (mut sink, mut plain) = (f64::INFINITY, f64::INFINITY);
    let mut bytes = 0;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        write_hair(path, hairs)?;
        sink = sink.min(start.elapsed().as_secs_f64());
        bytes = fs::metadata(path)?.len();
        let start = Instant::now();
        write_plain(&plain_path, bytes)?;
        plain = plain.min(start.elapsed().as_secs_f64());
    }
    fs::remove_file(path)?;
    fs::remove_file(plain_path)?;
    let rate = |seconds: f64| bytes as f64 / 1e6 / seconds;
    println!(
        "{:>5}: {:7.1} MB, sink {:6.2} s ({:6.0} MB/s, {:5.2} M hairs/s), plain {:6.2} s \
         ({:6.0} MB/s), ratio {:.2}",
        path.extension().unwrap_or_default().display(),
        bytes as f64 / 1e6,
        sink,
        rate(sink),
        hairs as f64 / 1e6 / sink,
        plain,
        rate(plain),
        plain / sink,
    );
    Ok(())
}

/// One chunk, written over and over: what is measured is writing, not making hair.
fn write_hair(path: &Path, hairs: usize) -> Result<(), SinkError> {
    let chunk = chunk();
    let mut sink = sink_for(path, &WriteOptions::default())?;
    sink.begin(&StreamInfo::default())?;
    sink.begin_frame(0)?;
    for _ in 0..hairs / CHUNK {
        sink.write(&chunk)?;
    }
    sink.end_frame()?;
    sink.finish()
}

fn chunk() -> StrandBuffer {
    let mut buffer = StrandBuffer::new();
    for i in 0..CHUNK {
        let x = (i as f32 * 0.618).fract();
        for k in 0..VERTICES {
            let t = k as f32 / VERTICES as f32;
            buffer.points.push([x, 0.3 * t * t, t * (1.0 + x)]);
            buffer.widths.push(0.012_34 * (1.0 - t));
            buffer.colors.push([0.3 + 0.1 * x, 0.2, 0.1 * t]);
            buffer.opacities.push(1.0);
        }
        buffer.push_meta(&StrandMeta {
            hair_id: i as u64,
            root_uv: [x, 1.0 - x],
            root_rest: [x, 0.0, 0.0],
            ..Default::default()
        });
    }
    buffer
}

/// The same number of bytes, in large blocks.
fn write_plain(path: &Path, bytes: u64) -> io::Result<()> {
    let block = vec![0x5a; 1 << 20];
    let mut file = File::create(path)?;
    let mut left = bytes;
    while left > 0 {
        let now = left.min(block.len() as u64);
        file.write_all(&block[..now as usize])?;
        left -= now;
    }
    file.sync_all()
}
