//! Running a plan: chunks made by several threads, handed to a sink in order.

use crate::capture::{Capture, Dropped};
use crate::clock::{Clock, Stage};
use crate::evaluate::Scratch;
use crate::in_order::in_order;
use crate::order::{Order, Parts};
use crate::plan::Plan;
use crate::pose::{Pose, Posed};
use pelage_strands::{Amount, Sink, SinkError, StrandBuffer, StreamInfo};
use std::error::Error;
use std::ops::Range;

/// Most hairs in a chunk: its arrays (some 300 KB at six vertices a hair) stay in a
/// core's second-level cache. Fewer cost more hand-overs, more fall out of the cache.
const CHUNK: u64 = 1024;

/// Most vertices in a chunk, so that hairs of very many vertices take no more memory.
const CHUNK_VERTICES: u64 = 16_384;

/// What to generate.
#[derive(Clone, Debug)]
pub struct Request {
    /// The hairs, by index.
    pub hairs: Range<u64>,
    /// In which order the sink gets them.
    pub order: Order,
    /// Threads to use; at least one is.
    pub threads: usize,
    /// The frame of a still; where [`StreamInfo::frames`] names some, it is not looked at.
    pub frame: f64,
    /// What the sink is told before the first strand; how much will come is added.
    pub info: StreamInfo,
}

/// Gives surface and guides at a frame, which becomes the time of the pose.
pub type Poses<'a> = dyn FnMut(f64) -> Result<Pose, Box<dyn Error + Send + Sync>> + 'a;

/// Why a run stopped.
#[derive(Debug, thiserror::Error)]
pub enum GenerateError {
    /// The sink would not take the strands.
    #[error(transparent)]
    Sink(#[from] SinkError),
    /// The pose of a frame could not be had.
    #[error("frame {frame}: {error}")]
    Pose {
        /// The frame, as in [`StreamInfo::frames`].
        frame: f64,
        /// Why.
        error: Box<dyn Error + Send + Sync>,
    },
    /// More hairs are to be sorted along the surface than memory should be taken for.
    #[error(
        "{found} hairs in the order of the surface: where roots.pattern is random or blue-noise \
        they are sorted in memory, {limit} at most; make them in ranges, or in the order of \
        their indices"
    )]
    TooManyToSort {
        /// Hairs asked for.
        found: u64,
        /// Most there may be.
        limit: u64,
    },
    /// The callback asked to stop.
    #[error("stopped")]
    Stopped,
}

/// What a run amounted to.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Strands written, in each frame.
    pub strands: u64,
    /// Vertices written, in each frame.
    pub vertices: u64,
    /// Hairs left out, and why.
    pub dropped: Dropped,
    /// Time spent by stage, summed over threads and frames.
    pub clock: Clock,
}

/// Generates the hairs of `request` into `sink`, frame after frame.
///
/// `progress` is called now and then with the number of hairs done, over all frames;
/// it returns whether to go on.
pub fn generate(
    plan: &Plan,
    request: &Request,
    poses: &mut Poses,
    sink: &mut dyn Sink,
    progress: &mut dyn FnMut(u64) -> bool,
) -> Result<Report, GenerateError> {
    let mut report = Report::default();
    let frames = match &request.info.frames[..] {
        [] => &[request.frame],
        frames => frames,
    };
    let hairs = plan.roots().rooted(request.hairs.clone());
    let total = hairs.end.saturating_sub(hairs.start);
    let each = (CHUNK_VERTICES / plan.most_vertices()).clamp(1, CHUNK);
    let parts = Parts::new(plan.roots(), request, sink, each)?;
    sink.begin(&StreamInfo {
        at_most: Some(Amount {
            strands: total.saturating_mul(plan.fibers() as u64),
            vertices: total.saturating_mul(plan.most_vertices()),
        }),
        ..request.info.clone()
    })?;
    for (index, &frame) in frames.iter().enumerate() {
        let posed =
            posed(plan, poses, frame).map_err(|error| GenerateError::Pose { frame, error })?;
        sink.begin_frame(index)?;
        let mut run = Run {
            plan,
            parts: &parts,
            posed: &posed,
            done: total * index as u64,
            report: Report {
                clock: std::mem::take(&mut report.clock),
                ..Report::default()
            },
        };
        run.run(request.threads, sink, progress)?;
        report = run.report;
        sink.end_frame()?;
    }
    let started = report.clock.start();
    sink.finish()?;
    report.clock.stop(Stage::Sink, started);
    Ok(report)
}

fn posed(
    plan: &Plan,
    poses: &mut Poses,
    frame: f64,
) -> Result<Posed, Box<dyn Error + Send + Sync>> {
    let pose = Pose {
        time: frame,
        ..poses(frame)?
    };
    Ok(plan.posed(&pose)?)
}

/// A chunk of strands with what was noted while it was made.
#[derive(Default)]
struct Chunk {
    strands: StrandBuffer,
    /// Hairs that were to be made.
    asked: u64,
    dropped: Dropped,
    clock: Clock,
}

#[derive(Default)]
struct Worker {
    capture: Capture,
    scratch: Scratch,
}

impl Worker {
    fn make(
        &mut self,
        plan: &Plan,
        (parts, number): (&Parts, u64),
        posed: &Posed,
        chunk: &mut Chunk,
    ) {
        chunk.clock = Clock::default();
        plan.capture_part(parts, number, &mut self.capture, &mut chunk.clock);
        chunk.asked = self.capture.asked();
        chunk.dropped = self.capture.dropped();
        chunk.dropped.without_length += plan.evaluate(
            &self.capture,
            posed,
            &mut self.scratch,
            &mut chunk.strands,
            &mut chunk.clock,
        );
    }
}

struct Run<'a> {
    plan: &'a Plan,
    parts: &'a Parts<'a>,
    posed: &'a Posed,
    /// Hairs taken, with those of the frames before.
    done: u64,
    report: Report,
}

impl Run<'_> {
    fn run(
        &mut self,
        threads: usize,
        sink: &mut dyn Sink,
        progress: &mut dyn FnMut(u64) -> bool,
    ) -> Result<(), GenerateError> {
        let (plan, posed, parts) = (self.plan, self.posed, self.parts);
        in_order(
            parts.count(),
            threads,
            |worker: &mut Worker, number, chunk: &mut Chunk| {
                worker.make(plan, (parts, number), posed, chunk);
            },
            |_, chunk| self.take(chunk, sink, progress),
        )
    }

    fn take(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn Sink,
        progress: &mut dyn FnMut(u64) -> bool,
    ) -> Result<(), GenerateError> {
        let started = self.report.clock.start();
        if !chunk.strands.is_empty() {
            sink.write(&chunk.strands)?;
        }
        self.report.clock.stop(Stage::Sink, started);
        self.report.clock.add(&chunk.clock);
        self.report.strands += chunk.strands.len() as u64;
        self.report.vertices += chunk.strands.points.len() as u64;
        self.report.dropped.add(&chunk.dropped);
        self.done += chunk.asked;
        if progress(self.done) {
            Ok(())
        } else {
            Err(GenerateError::Stopped)
        }
    }
}
