//! `pelage render`, and the pictures of `generate` and `demo`.

use super::args::{CameraArgs, RenderArgs, Shading, ViewArgs};
use super::curves;
use super::progress::Bar;
use super::say::{Say, spent};
use anyhow::{Context, Result, bail};
use pelage::StrandBuffer;
use pelage::io::{read_image, read_mesh};
use pelage::render::{Camera, Reflection, Scene, Settings, Shape, render};
use pelage::strands::UpAxis;
use pelage::surface::{ImageMap, Mesh, linear_from_srgb};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

/// Where the camera stands by default: three quarters, a little above, in degrees.
const AZIMUTH: f32 = 38.0;
const ELEVATION: f32 = 13.0;

/// Renders a file of hair.
pub fn run(args: &RenderArgs, say: &Say) -> Result<ExitCode> {
    let (strands, up_axis) = curves::read(&args.file, args.frame)?;
    if strands.is_empty() {
        bail!("{}: there are no curves to show", args.file.display());
    }
    let surface = args
        .surface
        .as_deref()
        .map(|path| surface(path, args.frame))
        .transpose()?;
    let up = up_axis.unwrap_or_default();
    let started = Instant::now();
    draw(
        &strands,
        surface.as_ref(),
        up,
        &args.view,
        &args.output,
        say,
    )?;
    say.line(format_args!(
        "{} ({})",
        args.output.display(),
        spent(started.elapsed())
    ));
    Ok(ExitCode::SUCCESS)
}

fn surface(path: &Path, frame: Option<f64>) -> Result<Mesh> {
    let polygons = read_mesh(path, frame)?.mesh;
    Mesh::new(polygons).with_context(|| path.display().to_string())
}

/// Colours of a surface; 8-bit files hold sRGB codes.
fn skin(path: &Path) -> Result<ImageMap> {
    let image = read_image(path)?;
    Ok(if image.is_eight_bit() {
        image.map_texels(linear_from_srgb)
    } else {
        image
    })
}

/// Renders `strands` on `surface` into the PNG at `output`.
pub fn draw(
    strands: &StrandBuffer,
    surface: Option<&Mesh>,
    up: UpAxis,
    view: &ViewArgs,
    output: &Path,
    say: &Say,
) -> Result<()> {
    let mut scene = Scene::of_strands(strands);
    if let Some(surface) = surface {
        scene = scene.on(surface);
    }
    let skin = view.skin.as_deref().map(skin).transpose()?;
    if let Some(skin) = &skin {
        scene = scene.painted(skin);
    }
    let settings = Settings {
        shape: if view.round {
            Shape::Round
        } else {
            Shape::Ribbon
        },
        reflection: match view.shading {
            Shading::Marschner => Reflection::Marschner,
            Shading::KajiyaKay => Reflection::KajiyaKay,
        },
        ..Settings::default()
    };
    draw_scene(&scene, up, &view.camera, settings, output, say)
}

/// The camera that is `asked` for, and for the rest one that frames `scene`.
pub fn camera(scene: &Scene, up: UpAxis, asked: &CameraArgs, aspect: f32) -> Camera {
    let mut camera = Camera::portrait(scene, up, aspect, AZIMUTH, ELEVATION);
    camera.to = asked.to.unwrap_or(camera.to);
    camera.from = asked.from.unwrap_or(camera.from);
    camera.fov = asked.fov.unwrap_or(camera.fov);
    camera
}

/// Renders `scene` as `asked`, and for the rest by `settings`, into the PNG at `output`.
pub fn draw_scene(
    scene: &Scene,
    up: UpAxis,
    asked: &CameraArgs,
    settings: Settings,
    output: &Path,
    say: &Say,
) -> Result<()> {
    let settings = Settings {
        width: asked.size.0,
        height: asked.size.1,
        samples: asked.samples.unwrap_or(settings.samples),
        ..settings
    };
    let camera = camera(scene, up, asked, settings.aspect());
    let bar = Bar::new(say, 100, "% of the picture");
    let picture = render(scene, &camera, &settings, |part| {
        bar.set((part * 100.0) as u64)
    })?;
    drop(bar);
    if picture.skipped_strands > 0 {
        say.note(format_args!(
            "{} strands could not be drawn",
            picture.skipped_strands
        ));
    }
    picture
        .write_png(output)
        .with_context(|| output.display().to_string())
}
