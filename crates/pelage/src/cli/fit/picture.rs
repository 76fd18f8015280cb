//! Strands, their fits, and the fits coloured by how far off they are, side by side.

use super::super::args::FitArgs;
use super::super::picture::camera;
use super::super::progress::Bar;
use super::super::say::{Say, spent};
use super::super::values::ErrorBound;
use super::Wish;
use super::report::Report;
use anyhow::{Context, Result};
use pelage::StrandBuffer;
use pelage::curves::frenet::{CatmullRom, Measure, SpaceCurve};
use pelage::curves::{DVec3, Vec3};
use pelage::io::SuperHelices;
use pelage::render::{Backdrop, Fiber, Picture, Reflection, Scene, Settings, render};
use pelage::strands::{Bounds, UpAxis};
use std::path::Path;
use std::time::Instant;

/// Colours of the target and of the fit, linear RGB.
const TARGET: [f32; 3] = [0.55, 0.55, 0.55];
const FIT: [f32; 3] = [0.10, 0.35, 0.75];

/// Colours of no error, of half the bound, and of the bound and more.
const HEAT: [[f32; 3]; 3] = [[0.03, 0.10, 0.60], [0.95, 0.80, 0.10], [0.85, 0.03, 0.02]];

/// Colours are to be told apart: nothing shines, bleaches or is bright behind them.
const BEHIND: [f32; 3] = [0.012; 3];
const EXPOSURE: f32 = -0.5;

/// Vertices of a strand in the picture: enough that it is as round as it is.
const VERTICES: u32 = 128;

/// Width of a strand, as a part of the diagonal of all.
const WIDTH: f32 = 1.0 / 450.0;

/// Draws the picture into the PNG at `path`.
#[expect(
    clippy::too_many_arguments,
    reason = "all of one call, and of different types"
)]
pub fn draw(
    strands: &StrandBuffer,
    helices: &SuperHelices,
    wish: &Wish,
    report: &Report,
    up: UpAxis,
    args: &FitArgs,
    path: &Path,
    say: &Say,
) -> Result<()> {
    let started = Instant::now();
    let hottest = wish.bound.unwrap_or(ErrorBound::Part(report.worst_part.0));
    let fits = helices.decode(Some(VERTICES));
    let width = diagonal(strands) * WIDTH;
    let heat = heat(strands, helices, &fits, hottest)?;
    let panels = [
        painted(strands, width, vec![TARGET; strands.points.len()]),
        painted(&fits, width, vec![FIT; fits.points.len()]),
        painted(&fits, width, heat),
    ];
    let settings = Settings {
        width: (args.camera.size.0 / panels.len() as u32).max(1),
        height: args.camera.size.1,
        samples: args.camera.samples.unwrap_or(Settings::default().samples),
        reflection: Reflection::KajiyaKay,
        fiber: Fiber {
            gloss: 0.0,
            ..Fiber::default()
        },
        backdrop: Backdrop::Plain(BEHIND),
        exposure: EXPOSURE,
        film_tone: false,
        ..Settings::default()
    };
    // One camera, that of the target: what differs in the pictures is the curves.
    let first = Scene::of_strands(&panels[0]);
    let camera = camera(&first, up, &args.camera, settings.aspect());
    let bar = Bar::new(say, 100 * panels.len() as u64, "% of the pictures");
    let mut pictures = Vec::new();
    for (i, panel) in panels.iter().enumerate() {
        let scene = Scene::of_strands(panel);
        pictures.push(render(&scene, &camera, &settings, |part| {
            bar.set(((i as f32 + part) * 100.0) as u64);
        })?);
    }
    drop(bar);
    beside(&pictures)
        .write_png(path)
        .with_context(|| path.display().to_string())?;
    let most = match hottest {
        ErrorBound::Length(length) => format!("{length}"),
        ErrorBound::Part(part) => format!("{:.3} % of the length", 100.0 * part),
    };
    say.line(format_args!(
        "{}: the strands, their fits, and these by error: blue none, yellow half, red {most} \
         or more ({})",
        path.display(),
        spent(started.elapsed())
    ));
    Ok(())
}

fn diagonal(strands: &StrandBuffer) -> f32 {
    let bounds = Bounds::of(strands);
    match bounds.is_empty() {
        true => 1.0,
        false => Vec3::from(bounds.max).distance(Vec3::from(bounds.min)),
    }
}

fn painted(strands: &StrandBuffer, width: f32, colors: Vec<[f32; 3]>) -> StrandBuffer {
    StrandBuffer {
        widths: vec![width; strands.points.len()],
        offsets: strands.offsets.clone(),
        points: strands.points.clone(),
        colors,
        ..StrandBuffer::new()
    }
}

/// A colour for each vertex of `fits`, by its distance from the strand at an equal part of
/// the length.
fn heat(
    strands: &StrandBuffer,
    helices: &SuperHelices,
    fits: &StrandBuffer,
    hottest: ErrorBound,
) -> Result<Vec<[f32; 3]>> {
    let mut colors = Vec::with_capacity(fits.points.len());
    for index in 0..fits.len() {
        let places = fits.strand_points(index);
        if helices.elements(index).is_empty() {
            colors.extend(places.iter().map(|_| HEAT[0]));
            continue;
        }
        let points = strands.strand_points(index).iter();
        let points: Vec<DVec3> = points.map(|p| p.as_dvec3()).collect();
        let target = CatmullRom::new(&points)?;
        let measure = Measure::new(&target)?;
        let most = match hottest {
            ErrorBound::Length(length) => length,
            ErrorBound::Part(part) => part * measure.total(),
        };
        let steps = (places.len() - 1).max(1) as f64;
        colors.extend(places.iter().enumerate().map(|(i, place)| {
            let (piece, t) = measure.locate(&target, measure.total() * (i as f64 / steps));
            let off = target.at(piece, t)[0].distance(place.as_dvec3());
            ramp((off / most.max(f64::MIN_POSITIVE)) as f32)
        }));
    }
    Ok(colors)
}

/// The colour of an error that is `part` of the largest.
fn ramp(part: f32) -> [f32; 3] {
    let along = 2.0 * part.clamp(0.0, 1.0);
    let (low, t) = if along < 1.0 {
        (0, along)
    } else {
        (1, along - 1.0)
    };
    std::array::from_fn(|c| HEAT[low][c] + (HEAT[low + 1][c] - HEAT[low][c]) * t)
}

/// Pictures of one size as one, from left to right.
fn beside(pictures: &[Picture]) -> Picture {
    let (width, height) = (pictures[0].width, pictures[0].height);
    let row = |y: usize| {
        let cut = y * width as usize..(y + 1) * width as usize;
        pictures.iter().flat_map(move |p| p.rgb[cut.clone()].iter())
    };
    Picture {
        width: width * pictures.len() as u32,
        height,
        rgb: (0..height as usize).flat_map(row).copied().collect(),
        skipped_strands: 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_go_from_none_over_half_to_the_bound_and_stay() {
        let near = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
        for (part, index) in [(0.0, 0), (0.5, 1), (1.0, 2), (7.0, 2)] {
            assert!(near(ramp(part), HEAT[index]), "{part}");
        }
    }
}
