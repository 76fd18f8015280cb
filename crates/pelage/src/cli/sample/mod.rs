//! `pelage sample`: the roots of hairs, without hair.

mod dots;
mod paints;

use super::args::{SampleArgs, Shown};
use super::generate::options;
use super::picture::draw_scene;
use super::progress::{Bar, PREPARING, Wait};
use super::say::{Made, Say, grouped, spent};
use anyhow::{Result, bail};
use dots::{Dots, FirstRoots};
use paints::{DensityPaint, PiecePaint};
use pelage::io::root_sink_for;
use pelage::render::{Backdrop, Light, LightRig, Paint, Scene, Settings, Sky};
use pelage::strands::Tee;
use pelage::surface::Mesh;
use pelage::{LoadedRoots, Recipe, Request, StrandBuffer, load_roots, write_roots};
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Draws roots as asked and says what was made.
pub fn run(args: &SampleArgs, say: &Say) -> Result<ExitCode> {
    let recipe = args.run.recipe(&args.recipe, args.count)?;
    let mut sink = root_sink_for(&args.output, &options(false))?;
    let mut job = Job::load(recipe, args, say)?;
    let mut first = FirstRoots::default();
    let drawing = args.picture.is_some() && matches!(args.show, Shown::Roots);
    match drawing {
        true => job.run(&mut Tee::new(vec![&mut *sink, &mut first]), say)?,
        false => job.run(&mut *sink, say)?,
    }
    job.tell(&args.output, say);
    if let Some(path) = &args.picture {
        job.draw(args, &first, path, say)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// A loaded recipe and the roots wanted of it.
struct Job {
    loaded: LoadedRoots,
    request: Request,
    pose: Option<Arc<Mesh>>,
    drawn: u64,
    load_time: Duration,
    draw_time: Duration,
}

impl Job {
    fn load(recipe: Recipe, args: &SampleArgs, say: &Say) -> Result<Self> {
        let started = Instant::now();
        let wanted = args.run.hairs(recipe.hair.count, "-n")?;
        let wait = Wait::new(say, PREPARING);
        let mut loaded = load_roots(recipe)?;
        drop(wait);
        loaded.plan.notes().iter().for_each(|note| say.note(note));
        if let Some(key) = loaded
            .poses
            .animated_key()
            .filter(|_| args.run.frame.is_none())
        {
            bail!("{key} has a pose for each frame: say which with --frame");
        }
        let frame = args.run.frame.map_or(0.0, |f| f as f64);
        let pose = loaded
            .poses
            .surface(&loaded.recipe, loaded.plan.rest(), frame)?;
        Ok(Self {
            request: Request {
                order: args.run.order.into(),
                frame: 0.0,
                hairs: wanted,
                threads: args.run.threads.count(),
                info: loaded.info.clone(),
            },
            loaded,
            pose,
            drawn: 0,
            load_time: started.elapsed(),
            draw_time: Duration::ZERO,
        })
    }

    fn run(&mut self, sink: &mut dyn pelage::Sink, say: &Say) -> Result<()> {
        let started = Instant::now();
        let hairs = &self.request.hairs;
        let bar = Bar::new(say, hairs.end - hairs.start, "roots");
        let mut progress = |done| {
            bar.set(done);
            true
        };
        let (plan, pose) = (&self.loaded.plan, self.pose.as_deref());
        self.drawn = write_roots(plan, &self.request, pose, sink, &mut progress)?;
        self.draw_time = started.elapsed();
        Ok(())
    }

    fn tell(&self, output: &Path, say: &Say) {
        let plan = &self.loaded.plan;
        say.line(format_args!(
            "{} roots on {} triangles, cut into {} pieces of one density",
            grouped(self.drawn),
            grouped(plan.rest().triangles().len() as u64),
            grouped(plan.sampler().map_or(0, |s| s.piece_count()) as u64),
        ));
        say.line(Made {
            output,
            load: self.load_time,
            done: ("drawn", self.draw_time),
            count: (self.drawn, "roots"),
        });
    }

    fn draw(&self, args: &SampleArgs, first: &FirstRoots, output: &Path, say: &Say) -> Result<()> {
        let started = Instant::now();
        let plan = &self.loaded.plan;
        let surface = self.pose.as_deref().unwrap_or(plan.rest());
        let paint: Box<dyn Paint> = match args.show {
            Shown::Density => Box::new(DensityPaint::new(plan)),
            Shown::Pieces => Box::new(PiecePaint::new(plan)),
            Shown::Roots => Box::new(Dots::new(plan, surface, first.roots())),
        };
        if first.left_out > 0 {
            say.note(format_args!(
                "the picture shows the first {} roots",
                grouped(first.roots().len() as u64)
            ));
        }
        let nothing = StrandBuffer::new();
        let scene = Scene::of_strands(&nothing).on(surface).covered(&*paint);
        let up = self.loaded.info.up_axis;
        draw_scene(&scene, up, &args.camera, plain_light(), output, say)?;
        say.line(format_args!(
            "{} ({})",
            output.display(),
            spent(started.elapsed())
        ));
        Ok(())
    }
}

/// Even light before white, under which colours can be read: a figure, not a portrait.
fn plain_light() -> Settings {
    let light = |azimuth, elevation, power: f32| Light {
        azimuth,
        elevation,
        color: [power; 3],
        softness: 5.0,
    };
    Settings {
        lights: LightRig {
            lights: vec![light(-35.0, 48.0, 1.5), light(50.0, 15.0, 0.4)],
            sky: Sky {
                zenith: [0.62; 3],
                horizon: [0.5; 3],
                ground: [0.36; 3],
            },
        },
        backdrop: Backdrop::Plain([1.0; 3]),
        film_tone: false,
        ..Settings::default()
    }
}
