//! The figures of files in docs/results/speed.md, measured again: `cargo bench -p pelage`.
//! `TMPDIR` chooses the disk. `pelage bench generation` measures what hair costs without
//! a file.

use pelage::groom::{Groom, Images};
use pelage::io::{WriteOptions, sink_for};
use pelage::strands::StreamInfo;
use pelage::{Order, Plan, Pose, Recipe, Report, Request, Sink, generate};
use std::io::Write;
use std::path::Path;
use std::time::Instant;

const HAIRS: u64 = 1_000_000;
/// How often a file is written, in turn with a plain write of as many bytes.
const ROUNDS: usize = 7;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    println!("{cores} cores; {HAIRS} hairs of 6 CVs, 1,000 guides, 3 neighbours, no map\n");
    let plan = plan()?;
    let folder = std::env::temp_dir().join(format!("pelage-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let written = write_rates(&plan, cores, &folder);
    std::fs::remove_dir_all(&folder)?;
    written
}

/// A ball of 9,024 triangles with grown guides.
fn plan() -> Result<Plan, Box<dyn std::error::Error>> {
    let ball = pelage::examples::example("ball").ok_or("the ball is missing")?;
    let recipe = "
        surface.mesh = 'ball.obj'
        groups.segments = 5
        hair = { count = 1_000_000, seed = 1 }
        guides.grow = { count = 1000, length = 0.3, lean = 40, segments = 5 }";
    let recipe = Recipe::parse(recipe, Path::new("bench.toml"))?;
    Ok(Plan::new(Groom {
        recipe,
        mesh: ball.mesh,
        keep_file_normals: true,
        images: Images::new(),
        guides: Vec::new(),
    })?)
}

fn run(plan: &Plan, threads: usize, sink: &mut dyn Sink) -> Result<Report, String> {
    let request = Request {
        order: Order::default(),
        frame: 0.0,
        hairs: 0..HAIRS,
        threads,
        info: StreamInfo::default(),
    };
    generate(
        plan,
        &request,
        &mut |_| Ok(Pose::default()),
        sink,
        &mut |_| true,
    )
    .map_err(|e| e.to_string())
}

/// A USD crate file against a plain write of as many bytes, both synced to disk, in
/// turn: disks are uneven, so both meet the same minutes.
fn write_rates(plan: &Plan, cores: usize, folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let path = folder.join("hair.usdc");
    let (mut ours, mut plain, mut size) = (Vec::new(), Vec::new(), 0);
    for _ in 0..ROUNDS {
        let mut sink = sink_for(&path, &WriteOptions::default())?;
        ours.push(seconds(|| run(plan, cores, &mut *sink))?);
        size = std::fs::metadata(&path)?.len();
        plain.push(seconds(|| write_plain(&folder.join("plain"), size))?);
    }
    let [(our_best, our_median), (plain_best, plain_median)] = [ours, plain].map(ranked);
    println!(
        "USD crate file of {:.0} MB, {ROUNDS} times in turn with a plain write:\n  \
         ours, with generation on {cores} threads: best {our_best:.2} s, median {our_median:.2} s\n  \
         plain write of as many bytes, synced:    best {plain_best:.2} s, median {plain_median:.2} s\n  \
         ours takes {:.2} times the plain write (medians)",
        size as f64 / 1e6,
        our_median / plain_median
    );
    Ok(())
}

fn seconds<T, E>(work: impl FnOnce() -> Result<T, E>) -> Result<f64, E> {
    let started = Instant::now();
    work()?;
    Ok(started.elapsed().as_secs_f64())
}

/// The best and the median of some times.
fn ranked(mut times: Vec<f64>) -> (f64, f64) {
    times.sort_by(f64::total_cmp);
    (times[0], times[times.len() / 2])
}

/// As many bytes, in large blocks.
fn write_plain(path: &Path, bytes: u64) -> std::io::Result<()> {
    let block = vec![7u8; 8 << 20];
    let mut file = std::fs::File::create(path)?;
    let mut left = bytes as usize;
    while left > 0 {
        let now = left.min(block.len());
        file.write_all(&block[..now])?;
        left -= now;
    }
    file.sync_all()
}
