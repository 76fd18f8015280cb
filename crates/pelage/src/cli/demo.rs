//! `pelage demo`: a furry animal, from nothing.

use super::args::{CameraArgs, DemoArgs, Shading, ViewArgs};
use super::generate::{FirstFrame, Job, options};
use super::say::{Say, spent};
use anyhow::{Context, Result};
use pelage::Recipe;
use pelage::io::sink_for;
use pelage::strands::Tee;
use std::process::ExitCode;
use std::time::Instant;

/// Makes recipe, hair and picture, and says what to try next.
pub fn run(args: &DemoArgs, say: &Say) -> Result<ExitCode> {
    let folder = &args.folder;
    let started = Instant::now();
    let example = pelage::examples::example("animal").context("the example is missing")?;
    let written = pelage::examples::write(&example, folder)
        .with_context(|| format!("cannot write the example into {}", folder.display()))?;
    say.line(format_args!(
        "{}/: {} files, recipe first: {} ({})",
        folder.display(),
        written.len(),
        written[0].display(),
        spent(started.elapsed()),
    ));

    let mut job = Job::load(Recipe::load(&written[0])?, args.threads.count(), say)?;
    let output = folder.join("hair.usdc");
    let mut sink = sink_for(&output, &options(false))?;
    let mut hair = FirstFrame::default();
    let report = job.run(&mut Tee::new(vec![&mut *sink, &mut hair]), say)?;
    job.tell(&report, &output, say);

    let started = Instant::now();
    let picture = folder.join("picture.png");
    let view = ViewArgs {
        camera: CameraArgs {
            size: args.size,
            samples: None,
            from: None,
            to: None,
            fov: None,
        },
        round: false,
        shading: Shading::default(),
        skin: Some(folder.join("skin.png")),
    };
    job.draw(&hair.strands, &view, &picture, say)?;
    say.line(format_args!(
        "{} ({})",
        picture.display(),
        spent(started.elapsed())
    ));
    let folder = folder.display();
    say.line("Try next:");
    say.line(format_args!(
        "  edit {folder}/groom.toml (longer, redder, denser) and run"
    ));
    say.line(format_args!(
        "  pelage generate {folder}/groom.toml -o {folder}/hair.usdc \
         --picture {folder}/picture.png --skin {folder}/skin.png"
    ));
    say.line(format_args!("  pelage inspect {folder}/hair.usdc"));
    say.line("  pelage init my-groom --example head");
    Ok(ExitCode::SUCCESS)
}
