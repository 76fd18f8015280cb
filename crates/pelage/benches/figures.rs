//! The figures of docs/results/speed.md, measured again: `cargo bench -p pelage`, or
//! `cargo bench -p pelage -- write` for those of files alone. `TMPDIR` chooses the disk.
//!
//! Each line of the generation is the best of a few runs. Cost by stage comes from the
//! same clock that `pelage generate --stats` shows. Memory bandwidth is that of copying
//! a large array, bytes read plus bytes written, in the same process.

use pelage::groom::{Groom, Images, Stage};
use pelage::io::{WriteOptions, sink_for};
use pelage::strands::{Null, StreamInfo};
use pelage::{Plan, Recipe, Report, Request, Sink, generate};
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
    if !std::env::args().any(|argument| argument == "write") {
        generation(&plan, cores)?;
    }
    let folder = std::env::temp_dir().join(format!("pelage-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let written = write_rates(&plan, cores, &folder);
    std::fs::remove_dir_all(&folder)?;
    written
}

fn generation(plan: &Plan, cores: usize) -> Result<(), String> {
    println!("copying memory, one core: {:.1} GB/s", bandwidth());
    for threads in [1, cores] {
        let (seconds, report) = best(3, || run(plan, threads, &mut Null))?;
        println!(
            "null sink, {threads} threads: {seconds:.3} s, {:.2} M hairs/s",
            HAIRS as f64 / seconds / 1e6
        );
        if threads == 1 {
            stages(&report);
        }
    }
    Ok(())
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
        frame: 0.0,
        hairs: 0..HAIRS,
        threads,
        info: StreamInfo::default(),
    };
    generate(plan, &request, &mut |_| Ok(None), sink, &mut |_| true).map_err(|e| e.to_string())
}

fn best<T>(runs: usize, mut work: impl FnMut() -> Result<T, String>) -> Result<(f64, T), String> {
    let mut best: Option<(f64, T)> = None;
    for _ in 0..runs {
        let started = Instant::now();
        let made = work()?;
        let seconds = started.elapsed().as_secs_f64();
        if best.as_ref().is_none_or(|(b, _)| seconds < *b) {
            best = Some((seconds, made));
        }
    }
    best.ok_or_else(|| "no run".into())
}

fn stages(report: &Report) {
    for stage in Stage::ALL {
        let cost = report.clock.spent(stage).as_secs_f64() * 1e9 / HAIRS as f64;
        println!("  {:<12} {cost:6.1} ns a hair", stage.name());
    }
}

fn bandwidth() -> f64 {
    let source = vec![1u8; 256 << 20];
    let mut target = vec![0u8; source.len()];
    let seconds = (0..5)
        .map(|_| {
            let started = Instant::now();
            target.copy_from_slice(std::hint::black_box(&source));
            std::hint::black_box(&target);
            started.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min);
    2.0 * source.len() as f64 / seconds / 1e9
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
