//! `pelage gallery`: each property in a strip of pictures, from low to high.

mod subject;

use super::args::GalleryArgs;
use super::files;
use super::progress::Bar;
use super::say::{Say, spent};
use anyhow::{Context, Result, bail};
use image::ExtendedColorType;
use image::codecs::jpeg::JpegEncoder;
use pelage::groom::recipe::{STRIPS, Strip};
use pelage::render::{Picture, Scene, Settings, render};
use pelage::strands::StreamInfo;
use pelage::{Collect, Order, Pose, Request, generate};
use std::process::ExitCode;
use std::time::Instant;
use subject::Surfaces;

/// The frame that is shown: far enough for what moves to have moved.
const FRAME: f64 = 12.0;

/// Quality of the files, of 100: they are many, and looked at in passing.
const QUALITY: u8 = 88;

/// Cells along the longest side of the grid of the light in the hair: enough for pictures
/// as small as these, which take mostly the time that it takes.
const GRID: u32 = 32;

/// Pixels between pictures.
const GAP: u32 = 4;

/// Draws the strips.
pub fn run(args: &GalleryArgs, say: &Say) -> Result<ExitCode> {
    let wanted =
        |strip: &&Strip| args.only.is_empty() || args.only.iter().any(|key| key == strip.key);
    let strips: Vec<&Strip> = STRIPS.iter().filter(wanted).collect();
    if let Some(unknown) = args
        .only
        .iter()
        .find(|key| !STRIPS.iter().any(|s| s.key == **key))
    {
        let keys: Vec<&str> = STRIPS.iter().map(|strip| strip.key).collect();
        bail!(
            "--only {unknown}: no strip has this key; there are {}",
            keys.join(", ")
        );
    }
    std::fs::create_dir_all(&args.output)
        .with_context(|| format!("cannot make the folder {}", args.output.display()))?;
    let started = Instant::now();
    let surfaces = Surfaces::new()?;
    let bar = Bar::new(say, strips.len() as u64, "strips");
    for (done, strip) in strips.iter().enumerate() {
        let drawn =
            draw(strip, &surfaces, args).with_context(|| format!("the strip of {}", strip.key))?;
        files::write_bytes(&args.output.join(strip.file()), &drawn)?;
        bar.set(done as u64 + 1);
    }
    drop(bar);
    say.line(format_args!(
        "{}: {} strips ({})",
        args.output.display(),
        strips.len(),
        spent(started.elapsed())
    ));
    Ok(ExitCode::SUCCESS)
}

/// The pictures of a strip side by side, as JPEG.
fn draw(strip: &Strip, surfaces: &Surfaces, args: &GalleryArgs) -> Result<Vec<u8>> {
    let pictures = strip
        .values
        .iter()
        .map(|value| picture(strip, value, surfaces, args));
    let pictures = pictures.collect::<Result<Vec<Picture>>>()?;
    let (width, height) = args.size;
    let whole = (width + GAP) * pictures.len() as u32 - GAP;
    let mut pixels = vec![255; whole as usize * height as usize * 3];
    for (i, picture) in pictures.iter().enumerate() {
        let left = i * (width + GAP) as usize * 3;
        let rows = pixels.chunks_exact_mut(whole as usize * 3);
        for (row, part) in rows.zip(picture.to_rgb8().chunks_exact(width as usize * 3)) {
            row[left..left + part.len()].copy_from_slice(part);
        }
    }
    let mut jpeg = Vec::new();
    JpegEncoder::new_with_quality(&mut jpeg, QUALITY).encode(
        &pixels,
        whole,
        height,
        ExtendedColorType::Rgb8,
    )?;
    Ok(jpeg)
}

fn picture(strip: &Strip, value: &str, surfaces: &Surfaces, args: &GalleryArgs) -> Result<Picture> {
    let plan = surfaces.plan(strip.on, &subject::recipe(strip, value))?;
    let request = Request {
        order: Order::default(),
        hairs: 0..plan.count(),
        threads: args.threads.count(),
        frame: FRAME,
        info: StreamInfo::default(),
    };
    let mut hair = Collect::default();
    let mut still = |_| Ok(Pose::default());
    generate(&plan, &request, &mut still, &mut hair, &mut |_| true)?;
    let scene = Scene::of_strands(&hair.strands).on(plan.rest());
    let settings = Settings {
        width: args.size.0,
        height: args.size.1,
        grid: GRID,
        ..Settings::default()
    };
    Ok(render(
        &scene,
        &subject::camera(strip.on),
        &settings,
        |_| {},
    )?)
}
