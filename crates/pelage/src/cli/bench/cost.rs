//! What the generation of a scene costs: cold, with everything made, and warm, where
//! what was captured of the rest pose is kept and only a pose is evaluated.

use super::measure::fastest;
use super::scenes::Scene;
use crate::cli::stats::{forget_peak_memory, peak_memory};
use anyhow::Result;
use pelage::groom::{Capture, Clock, Pose, Posed, Scratch, Stage};
use pelage::strands::{Null, StreamInfo};
use pelage::surface::AlongSurface;
use pelage::{Order, Plan, Request, Sink, StrandBuffer, generate};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Instant;

/// Hairs captured together, as generation does it.
const CHUNK: u64 = 1024;

/// What was measured, as `--json` gives it.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Name of the scene, and of the order where it is not that of the indices.
    pub scene: String,
    #[serde(skip)]
    pub order: Order,
    pub hairs: u64,
    /// Vertices of a hair.
    pub cvs: u32,
    /// Fibres of a hair; 1 where hairs are single.
    pub fibers: u32,
    pub threads: usize,
    /// Everything, from the root to the sink.
    pub seconds_cold: f64,
    /// From what was captured to the sink.
    pub seconds_warm: f64,
    /// The cold run by stage, summed over threads.
    pub stages: BTreeMap<&'static str, f64>,
    /// Most memory the process held in the cold runs, where the system tells.
    pub peak_bytes: Option<u64>,
}

impl Row {
    /// The row of `scene` in `order` with `threads` threads.
    pub fn new(
        (scene, order): (&Scene, Order),
        threads: usize,
        cold: &Cold,
        seconds_warm: f64,
    ) -> Self {
        let suffix = match order {
            Order::Surface => ", along the surface",
            Order::Index | Order::Auto => "",
        };
        let spent = |stage: Stage| (stage.name(), cold.clock.spent(stage).as_secs_f64());
        Self {
            scene: format!("{}{suffix}", scene.name),
            order,
            hairs: scene.plan.count(),
            cvs: scene.segments + 1,
            fibers: scene.fibers,
            threads,
            seconds_cold: cold.seconds,
            seconds_warm,
            stages: Stage::ALL.map(spent).into(),
            peak_bytes: cold.peak_bytes,
        }
    }

    /// Nanoseconds a hair that a stage of the cold run took.
    pub fn nanoseconds(&self, stage: &str) -> f64 {
        let seconds = self.stages.get(stage).copied().unwrap_or(0.0);
        seconds * 1e9 / self.hairs.max(1) as f64
    }
}

/// The fastest of some runs that made everything.
pub struct Cold {
    seconds: f64,
    clock: Clock,
    peak_bytes: Option<u64>,
}

/// Makes all hairs of `plan` into the null sink.
pub fn cold(plan: &Plan, order: Order, threads: usize, runs: usize) -> Result<Cold> {
    let request = Request {
        order,
        hairs: 0..plan.count(),
        threads,
        frame: 0.0,
        info: StreamInfo::default(),
    };
    forget_peak_memory();
    let mut best = (f64::INFINITY, Clock::default());
    for _ in 0..runs {
        let started = Instant::now();
        let report = generate(
            plan,
            &request,
            &mut |_| Ok(Pose::default()),
            &mut Null,
            &mut |_| true,
        )?;
        let seconds = started.elapsed().as_secs_f64();
        if seconds < best.0 {
            best = (seconds, report.clock);
        }
    }
    Ok(Cold {
        seconds: best.0,
        clock: best.1,
        peak_bytes: peak_memory(),
    })
}

/// Everything that the hairs of a plan take from the rest pose.
pub fn captured(plan: &Plan, order: Order) -> Vec<Capture> {
    let count = plan.count();
    let along = match order {
        Order::Surface => plan.roots().along_surface(0..count, CHUNK),
        Order::Index | Order::Auto => None,
    };
    let chunks = along
        .as_ref()
        .map_or(count.div_ceil(CHUNK), AlongSurface::parts);
    let capture = |chunk: u64| {
        let (mut capture, clock) = (Capture::default(), &mut Clock::default());
        let first = chunk * CHUNK;
        match &along {
            None => plan.capture(first..(first + CHUNK).min(count), &mut capture, clock),
            Some(along) => plan.capture_along(along, chunk, &mut capture, clock),
        }
        capture
    };
    (0..chunks).into_par_iter().map(capture).collect()
}

/// Seconds of the fastest run that evaluated all of `captures` into the null sink.
pub fn warm(plan: &Plan, captures: &[Capture], threads: usize, runs: usize) -> Result<f64> {
    let share = captures.len().div_ceil(threads).max(1);
    let posed = plan.posed(&Pose::default())?;
    let posed = &posed;
    Ok(fastest(runs, || {
        let started = Instant::now();
        std::thread::scope(|scope| {
            for captures in captures.chunks(share) {
                scope.spawn(move || evaluate(plan, posed, captures));
            }
        });
        started.elapsed().as_secs_f64()
    }))
}

fn evaluate(plan: &Plan, posed: &Posed, captures: &[Capture]) {
    let (mut scratch, mut strands) = (Scratch::default(), StrandBuffer::default());
    for capture in captures {
        let clock = &mut Clock::default();
        plan.evaluate(capture, posed, &mut scratch, &mut strands, clock);
        // It takes everything.
        let _ = Null.write(std::hint::black_box(&strands));
    }
}

/// Bytes that a hair of `scene` has in the arrays handed to the sink.
pub fn bytes_of_a_hair(scene: &Scene) -> Result<f64> {
    let plan = &scene.plan;
    let (mut capture, mut strands) = (Capture::default(), StrandBuffer::default());
    let clock = &mut Clock::default();
    plan.capture(0..CHUNK.min(plan.count()), &mut capture, clock);
    plan.evaluate(
        &capture,
        &plan.posed(&Pose::default())?,
        &mut Scratch::default(),
        &mut strands,
        clock,
    );
    Ok(strands.bytes() as f64 / capture.len().max(1) as f64)
}

/// Bytes a second, read and written, of `threads` threads that each copy a large array.
pub fn copying(threads: usize, bytes: usize, runs: usize) -> f64 {
    let each = bytes / threads;
    let mut pairs: Vec<_> = (0..threads)
        .map(|_| (vec![1u8; each], vec![0u8; each]))
        .collect();
    let seconds = fastest(runs, || {
        let started = Instant::now();
        std::thread::scope(|scope| {
            for (source, target) in &mut pairs {
                scope.spawn(|| {
                    target.copy_from_slice(std::hint::black_box(source));
                    std::hint::black_box(target);
                });
            }
        });
        started.elapsed().as_secs_f64()
    });
    (2 * each * threads) as f64 / seconds
}
