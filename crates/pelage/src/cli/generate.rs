//! `pelage generate`: a recipe's hairs into a file.

use super::args::{GenerateArgs, ViewArgs};
use super::files::{json, write};
use super::picture;
use super::progress::{Bar, PREPARING, Wait};
use super::say::{Made, Say, grouped, spent};
use super::stats::Stats;
use anyhow::{Result, bail};
use pelage::io::{WriteOptions, sink_for};
use pelage::strands::{Collect, SinkError, Tee};
use pelage::{Loaded, Recipe, Report, Sink, StrandBuffer, generate, load_with};
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Generates as asked and says what was made.
pub fn run(args: &GenerateArgs, say: &Say) -> Result<ExitCode> {
    let say = &say.beside(args.stats.as_deref().is_some_and(is_standard_output));
    let recipe = args.run.recipe(&args.recipe, args.count)?;
    let mut job = Job::new(recipe, args, say)?;
    let mut sink = sink_for(&args.output, &options(args.ribbons))?;
    let mut first = FirstFrame::default();
    let report = match args.picture {
        None => job.run(&mut *sink, say)?,
        Some(_) => job.run(&mut Tee::new(vec![&mut *sink, &mut first]), say)?,
    };
    job.tell(&report, &args.output, say);
    let mut stats = job.stats(&report);
    if let Some(path) = &args.picture {
        let started = Instant::now();
        job.draw(&first.strands, &args.view, path, say)?;
        stats.picture_seconds = Some(started.elapsed().as_secs_f64());
        say.line(format_args!(
            "{} ({})",
            path.display(),
            spent(started.elapsed())
        ));
    }
    if let Some(path) = &args.stats {
        write_stats(&stats, path)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Writers note the program that made a file, without a date: same hair, same bytes.
pub fn options(ribbons: bool) -> WriteOptions {
    WriteOptions {
        ribbons,
        tool: format!("Pelage {}", env!("CARGO_PKG_VERSION")),
    }
}

/// A loaded recipe and what is to be made of it.
pub struct Job {
    loaded: Loaded,
    request: pelage::Request,
    load_time: Duration,
    generate_time: Duration,
}

impl Job {
    fn new(recipe: Recipe, args: &GenerateArgs, say: &Say) -> Result<Self> {
        let frames: Vec<f64> = match args.frames {
            Some((first, last)) => (first..=last).map(|f| f as f64).collect(),
            None => Vec::new(),
        };
        let mut job = Self::load(recipe, args.run.threads.count(), say)?;
        job.request.hairs = args.run.hairs(job.loaded.plan.count(), "--count")?;
        job.request.order = args.run.order.into();
        let animated = job.loaded.poses.animated_key();
        if let Some(key) = animated.filter(|_| frames.is_empty() && args.run.frame.is_none()) {
            bail!("{key} has a pose for each frame: say which with --frame or --frames");
        }
        job.request.frame = args.run.frame.map_or(0.0, |f| f as f64);
        job.request.info.frames = frames;
        if !(args.fps > 0.0 && args.fps.is_finite()) {
            bail!("--fps {}: expected a number above 0", args.fps);
        }
        job.request.info.frames_per_second = args.fps;
        Ok(job)
    }

    /// Loads `recipe` for all its hairs, as a still.
    pub fn load(recipe: Recipe, threads: usize, say: &Say) -> Result<Self> {
        let started = Instant::now();
        let wait = Wait::new(say, PREPARING);
        let loaded = load_with(recipe)?;
        drop(wait);
        loaded.plan.notes().iter().for_each(|note| say.note(note));
        let request = loaded.request(0..loaded.plan.count(), threads);
        Ok(Self {
            loaded,
            request,
            load_time: started.elapsed(),
            generate_time: Duration::ZERO,
        })
    }

    /// Runs the plan into `sink`, with a progress bar.
    pub fn run(&mut self, sink: &mut dyn Sink, say: &Say) -> Result<Report> {
        let started = Instant::now();
        let bar = Bar::new(say, self.hairs() * self.frames() as u64, "hairs");
        let loaded = &mut self.loaded;
        let mut poses = |frame| {
            loaded
                .poses
                .pose(&loaded.recipe, loaded.plan.rest(), frame)
                .map_err(Into::into)
        };
        let mut progress = |done| {
            bar.set(done);
            true
        };
        let report = generate(&loaded.plan, &self.request, &mut poses, sink, &mut progress)?;
        self.generate_time = started.elapsed();
        Ok(report)
    }

    fn hairs(&self) -> u64 {
        self.request.hairs.end - self.request.hairs.start
    }

    fn frames(&self) -> usize {
        self.request.info.frames.len().max(1)
    }

    /// What was made, in two lines or three.
    pub fn tell(&self, report: &Report, output: &Path, say: &Say) {
        say.line(format_args!(
            "{} hairs, {} vertices from {} guides on {} triangles{}",
            grouped(report.strands),
            grouped(report.vertices),
            grouped(self.loaded.plan.guide_count() as u64),
            grouped(self.loaded.plan.rest().triangles().len() as u64),
            match self.frames() {
                1 => String::new(),
                n => format!(", {n} frames"),
            },
        ));
        if report.dropped.total() > 0 {
            say.note(format_args!(
                "{} hairs were left out: {} have no length, {} are cut at the root, \
                {} have no guide in their group",
                grouped(report.dropped.total()),
                grouped(report.dropped.without_length),
                grouped(report.dropped.cut),
                grouped(report.dropped.without_guides),
            ));
        }
        say.line(Made {
            output,
            load: self.load_time,
            done: ("generated", self.generate_time),
            count: (self.hairs() * self.frames() as u64, "hairs"),
        });
    }

    fn stats(&self, report: &Report) -> Stats {
        let times = [self.load_time, self.generate_time];
        let (frames, threads) = (self.frames(), self.request.threads);
        Stats::new(&self.loaded, report, self.hairs(), frames, threads, times)
    }

    /// Renders `strands` on the surface of the first frame.
    pub fn draw(
        &mut self,
        strands: &StrandBuffer,
        view: &ViewArgs,
        output: &Path,
        say: &Say,
    ) -> Result<()> {
        let frame = self
            .request
            .info
            .frames
            .first()
            .copied()
            .unwrap_or(self.request.frame);
        let loaded = &mut self.loaded;
        let posed = loaded
            .poses
            .surface(&loaded.recipe, loaded.plan.rest(), frame)?;
        let surface = posed.as_deref().unwrap_or(loaded.plan.rest());
        let up = self.request.info.up_axis;
        picture::draw(strands, Some(surface), up, view, output, say)
    }
}

/// Keeps the strands of the first frame, for a picture.
#[derive(Default)]
pub struct FirstFrame {
    pub strands: StrandBuffer,
    collect: Collect,
    later: bool,
}

impl Sink for FirstFrame {
    fn begin_frame(&mut self, index: usize) -> Result<(), SinkError> {
        self.later = index > 0;
        Ok(())
    }

    fn write(&mut self, strands: &StrandBuffer) -> Result<(), SinkError> {
        if self.later {
            Ok(())
        } else {
            self.collect.write(strands)
        }
    }

    fn finish(&mut self) -> Result<(), SinkError> {
        self.strands = std::mem::take(&mut self.collect.strands);
        Ok(())
    }
}

fn is_standard_output(path: &Path) -> bool {
    path == Path::new("-")
}

fn write_stats(stats: &Stats, path: &Path) -> Result<()> {
    let text = json(stats)?;
    if is_standard_output(path) {
        std::io::stdout().lock().write_all(text.as_bytes())?;
        return Ok(());
    }
    write(path, &text)
}
