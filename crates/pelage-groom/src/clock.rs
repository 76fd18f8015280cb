//! Time spent in each stage, summed over chunks and threads.

use std::time::{Duration, Instant};

/// A stage of the pipeline, as reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Roots and groups.
    Roots,
    /// Nearest guides and their weights.
    Weights,
    /// Colours, opacities and widths read from maps.
    Maps,
    /// Mixing of guides, and scale.
    Interpolate,
    /// Frizz.
    Frizz,
    /// Kink.
    Kink,
    /// Hairs that stray.
    Flyaway,
    /// Root frames of the pose, and positions.
    World,
    /// Which clumps hairs belong to, and drawing them together.
    Clump,
    /// Fibres of multi-strands.
    Strand,
    /// Cutting, and which vertices stay.
    Thin,
    /// Colours, opacities and widths along the hair.
    Look,
    /// Curve normals.
    Frames,
    /// The sink.
    Sink,
}

impl Stage {
    /// All stages in the order in which they run.
    pub const ALL: [Stage; 14] = [
        Stage::Roots,
        Stage::Weights,
        Stage::Maps,
        Stage::Interpolate,
        Stage::Frizz,
        Stage::Kink,
        Stage::Flyaway,
        Stage::World,
        Stage::Clump,
        Stage::Strand,
        Stage::Thin,
        Stage::Look,
        Stage::Frames,
        Stage::Sink,
    ];

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Roots => "roots",
            Stage::Weights => "weights",
            Stage::Maps => "maps",
            Stage::Interpolate => "interpolate",
            Stage::Frizz => "frizz",
            Stage::Kink => "kink",
            Stage::Flyaway => "flyaway",
            Stage::World => "world",
            Stage::Clump => "clump",
            Stage::Strand => "strand",
            Stage::Thin => "thin",
            Stage::Look => "look",
            Stage::Frames => "frames",
            Stage::Sink => "sink",
        }
    }
}

/// Sums the time of each stage. Read twice a stage and chunk, it costs nothing.
#[derive(Clone, Debug, Default)]
pub struct Clock {
    spent: [Duration; Stage::ALL.len()],
}

impl Clock {
    /// Now.
    pub fn start(&self) -> Instant {
        Instant::now()
    }

    /// Adds the time since `started` to `stage`, and gives the time now.
    pub fn stop(&mut self, stage: Stage, started: Instant) -> Instant {
        let now = Instant::now();
        self.spent[stage as usize] += now - started;
        now
    }

    /// Time spent in `stage`.
    pub fn spent(&self, stage: Stage) -> Duration {
        self.spent[stage as usize]
    }

    /// Adds another clock's sums.
    pub fn add(&mut self, other: &Clock) {
        for (mine, theirs) in self.spent.iter_mut().zip(&other.spent) {
            *mine += *theirs;
        }
    }
}
