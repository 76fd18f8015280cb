//! Times of one method on one surface and map.

use super::maps::Map;
use super::methods::prepare;
use super::surfaces::Surface;
use pelage::surface::SurfacePoint;
use serde::Serialize;
use std::time::Instant;

/// What was measured, as `--json` gives it.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub mesh: &'static str,
    pub triangles: usize,
    pub map: &'static str,
    pub map_size: u32,
    pub method: &'static str,
    pub threads: usize,
    pub samples: u64,
    /// Time to draw the samples.
    pub seconds: f64,
    pub preprocess_seconds: f64,
    /// Memory of the method's tables.
    pub bytes: usize,
}

impl Row {
    /// Millions of samples a second.
    pub fn rate(&self) -> f64 {
        self.samples as f64 / self.seconds / 1e6
    }
}

/// The seconds of the fastest of `runs` runs, each of which tells its own.
pub fn fastest(runs: usize, mut run: impl FnMut() -> f64) -> f64 {
    (0..runs).map(|_| run()).fold(f64::INFINITY, f64::min)
}

/// How much to measure.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Most samples to draw.
    pub samples: u64,
    /// Longest that drawing them may be expected to take; slow methods draw fewer. Tables are
    /// made again and again for so long.
    pub seconds: f64,
    /// Runs, of which the fastest counts.
    pub runs: usize,
}

impl Effort {
    /// As many samples as fit, and the seconds of the fastest run that drew them with
    /// `draw`, which tells the seconds it took.
    pub fn best(&self, mut draw: impl FnMut(u64) -> f64) -> (u64, f64) {
        let samples = self.samples_for(&mut draw);
        (samples, fastest(self.runs, || draw(samples)))
    }

    /// What `make` makes, and the seconds of the fastest of at least as many runs; of more
    /// where they are short.
    fn made<T>(&self, mut make: impl FnMut() -> T) -> (f64, T) {
        let started = Instant::now();
        let mut fastest = f64::INFINITY;
        let mut runs = 0;
        loop {
            let begun = Instant::now();
            let made = make();
            fastest = fastest.min(begun.elapsed().as_secs_f64());
            runs += 1;
            if runs >= self.runs && started.elapsed().as_secs_f64() >= self.seconds {
                return (fastest, made);
            }
        }
    }

    fn samples_for(&self, draw: &mut impl FnMut(u64) -> f64) -> u64 {
        let mut samples = 64;
        loop {
            let fits = self.seconds * samples as f64 / draw(samples).max(1e-9);
            // A tenth of what fits tells well enough how fast it goes.
            if samples as f64 * 10.0 >= fits || samples >= self.samples {
                return self.samples.min(fits as u64).max(64);
            }
            samples = (samples * 8).min(self.samples);
        }
    }
}

/// A pool of `threads` threads.
pub fn pool_of(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        // Refused only where the system has no thread left.
        .expect("a thread pool")
}

/// Measures `method` with `threads` threads.
pub fn measure(
    surface: &Surface,
    map: &Map,
    method: &'static str,
    threads: usize,
    effort: Effort,
) -> Row {
    // On threads of its own each time: one that shares its core with another program would
    // be slow in all of its runs.
    let made = || {
        let pool = pool_of(threads);
        effort.made(|| pool.install(|| prepare(method, &surface.mesh, map)))
    };
    let (before, prepared) = made();
    let mut roots = vec![SurfacePoint::default(); 1 << 14];
    let draw = |samples: u64| {
        roots.resize(samples as usize, SurfacePoint::default());
        let started = Instant::now();
        let share = (samples as usize).div_ceil(threads);
        std::thread::scope(|scope| {
            for (k, roots) in roots.chunks_mut(share).enumerate() {
                let prepared = &prepared;
                scope.spawn(move || prepared.fill((k * share) as u64, roots));
            }
        });
        started.elapsed().as_secs_f64()
    };
    let (samples, seconds) = effort.best(draw);
    let bytes = prepared.bytes();
    drop(prepared);
    let (after, _) = made();
    Row {
        mesh: surface.name,
        triangles: surface.mesh.triangles().len(),
        map: map.name,
        map_size: map.image.width(),
        method,
        threads,
        samples,
        seconds,
        preprocess_seconds: before.min(after),
        bytes,
    }
}
