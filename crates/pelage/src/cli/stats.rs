//! Counts and times of a run, as JSON.

use pelage::Report;
use pelage::groom::Stage;
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Duration;

/// What `--stats` writes.
#[derive(Debug, Serialize)]
pub struct Stats {
    /// Version of Pelage.
    pub version: &'static str,
    /// Hairs asked for.
    pub hairs: u64,
    /// Strands written in each frame.
    pub strands: u64,
    /// Vertices written in each frame.
    pub vertices: u64,
    /// Frames.
    pub frames: usize,
    /// Hairs left out because their group has no guide.
    pub dropped_without_guides: u64,
    /// Hairs left out because they have no length.
    pub dropped_without_length: u64,
    /// Hairs left out because they are cut at the root.
    pub dropped_cut: u64,
    /// Guides.
    pub guides: usize,
    /// Triangles of the surface.
    pub triangles: usize,
    /// Triangles without area.
    pub degenerate_triangles: usize,
    /// Threads used.
    pub threads: usize,
    /// Seconds to read and compile the recipe and all it names.
    pub load_seconds: f64,
    /// Seconds from the first hair to the finished file.
    pub generate_seconds: f64,
    /// Seconds to render the picture, where one was asked for.
    pub picture_seconds: Option<f64>,
    /// Hairs a second.
    pub hairs_per_second: f64,
    /// Nanoseconds a hair by stage, summed over threads.
    pub nanoseconds_per_hair: BTreeMap<&'static str, f64>,
    /// Most memory the process held, where the system tells.
    pub peak_memory_bytes: Option<u64>,
}

impl Stats {
    /// Statistics of a run of `hairs` hairs over `frames` frames.
    pub fn new(
        loaded: &pelage::Loaded,
        report: &Report,
        hairs: u64,
        frames: usize,
        threads: usize,
        [load, generate]: [Duration; 2],
    ) -> Self {
        let made = (hairs * frames as u64).max(1) as f64;
        let rest = loaded.plan.rest();
        let cost = |stage| report.clock.spent(stage).as_secs_f64() * 1e9 / made;
        Self {
            version: env!("CARGO_PKG_VERSION"),
            hairs,
            strands: report.strands,
            vertices: report.vertices,
            frames,
            dropped_without_guides: report.dropped.without_guides,
            dropped_without_length: report.dropped.without_length,
            dropped_cut: report.dropped.cut,
            guides: loaded.plan.guide_count(),
            triangles: rest.triangles().len(),
            degenerate_triangles: rest.degenerate_triangles(),
            threads,
            load_seconds: load.as_secs_f64(),
            generate_seconds: generate.as_secs_f64(),
            picture_seconds: None,
            hairs_per_second: made / generate.as_secs_f64().max(1e-9),
            nanoseconds_per_hair: Stage::ALL.iter().map(|&s| (s.name(), cost(s))).collect(),
            peak_memory_bytes: peak_memory(),
        }
    }
}

/// Most memory the process held so far; `None` where the system does not tell.
pub fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|l| l.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024)
}

/// Lets [`peak_memory`] begin anew, where the system does that; else it goes on.
pub fn forget_peak_memory() {
    // Linux: proc(5), clear_refs.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}
