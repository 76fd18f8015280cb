//! The stages of a picture, in order.

use crate::accel::{CurveTree, Layers, SurfaceTree};
use crate::backdrop::Backdrop;
use crate::color::Rgb;
use crate::density::Density;
use crate::film::{Filter, Sample};
use crate::floor::Floor;
use crate::leaf::Ray;
use crate::light_field::{LightField, Occluders};
use crate::lights::Lighting;
use crate::picture::develop;
use crate::sampling::{hash2, point_bits};
use crate::shade::{HairShader, fibers_before};
use crate::skin::Skin;
use crate::stage::{Frame, View};
use crate::tessellate::Cuts;
use crate::{Camera, Picture, RenderError, Scene, Settings};
use glam::Vec3;
use rayon::prelude::*;

/// Rows of pixels whose samples are held at a time.
const BAND: usize = 24;
/// Brightest sample; brighter ones would leave specks.
const BRIGHTEST: f32 = 12.0;
/// Radius around the origin outside which nothing is in the unit scene: half the
/// diagonal, with room for curves that bulge and hairs that are wide.
const RADIUS: f32 = 0.75;
/// Share of the progress that is over when the first pixel is made.
const PREPARED: f32 = 0.3;

/// Makes a picture of `scene` seen by `camera`.
///
/// `progress` is called with growing shares of the work done, 0..=1, from any
/// thread. Fails where settings, camera or arrays are out of range, or the threads
/// asked for cannot be started; strands that cannot be drawn are left out and
/// counted in [`Picture::skipped_strands`].
pub fn render(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    progress: impl Fn(f32) + Sync,
) -> Result<Picture, RenderError> {
    settings.check()?;
    camera.check()?;
    scene.check()?;
    match settings.threads {
        None => picture(scene, camera, settings, &progress),
        Some(threads) => {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let pool = pool.map_err(|e| RenderError::Threads {
                threads,
                reason: e.to_string(),
            })?;
            pool.install(|| picture(scene, camera, settings, &progress))
        }
    }
}

fn picture(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    progress: &(impl Fn(f32) + Sync),
) -> Result<Picture, RenderError> {
    progress(0.0);
    let frame = Frame::of(&scene.bounds());
    let view = View::new(camera, &frame, settings.aspect());
    let lighting = Lighting::new(&settings.lights, view.forward, view.world_up);
    let mut cuts = Cuts::of(scene, &frame, &view, settings)?;
    let mut skin = Skin::new(scene, &frame);
    let surface = skin.tree();
    let density = Density::new(&cuts, settings.grid);
    let occluders = Occluders {
        density: &density,
        surface: &surface,
    };
    let (curves, ()) = rayon::join(
        || CurveTree::new(&cuts, settings.shape == crate::Shape::Round),
        || skin.light(occluders, &lighting),
    );
    progress(0.1);
    let field = LightField::new(occluders, &lighting);
    progress(0.16);
    let counts = fibers_before(&cuts, &lighting);
    let shaded = HairShader {
        cuts: &cuts,
        counts,
        surface: &surface,
        field: &field,
        lighting: &lighting,
        settings,
        eye: view.eye,
    }
    .shade(&|share| progress(0.16 + (PREPARED - 0.16) * share));
    cuts.looks = shaded;
    drop(field);
    let floor = floor_under(&cuts, &skin, settings, occluders, &lighting);
    let tracer = Tracer {
        cuts: &cuts,
        curves: &curves,
        skin: &skin,
        surface: &surface,
        occluders,
        lighting: &lighting,
        floor: floor.as_ref(),
        view: &view,
        settings,
    };
    let rgb = tracer.picture(&|share| progress(PREPARED + (1.0 - PREPARED) * share));
    Ok(Picture {
        width: settings.width,
        height: settings.height,
        rgb,
        skipped_strands: cuts.skipped,
    })
}

/// The floor under the lowest point of the scene, where one is asked for.
fn floor_under(
    cuts: &Cuts,
    skin: &Skin,
    settings: &Settings,
    occluders: Occluders,
    lighting: &Lighting,
) -> Option<Floor> {
    if !matches!(settings.backdrop, Backdrop::Studio { .. }) {
        return None;
    }
    let hair = (0..cuts.places.len()).map(|i| cuts.position(i));
    let surface = skin.corners.iter().flatten().copied();
    let heights = hair.chain(surface).map(|p| p.dot(lighting.up));
    let lowest = heights
        .filter(|h| h.is_finite())
        .fold(f32::INFINITY, f32::min);
    let height = if lowest.is_finite() { lowest } else { -0.5 };
    Some(Floor::new(height, settings.height, occluders, lighting))
}

/// All that rays from the eye meet.
struct Tracer<'a> {
    cuts: &'a Cuts,
    curves: &'a CurveTree,
    skin: &'a Skin<'a>,
    surface: &'a SurfaceTree,
    occluders: Occluders<'a>,
    lighting: &'a Lighting,
    floor: Option<&'a Floor>,
    view: &'a View,
    settings: &'a Settings,
}

impl Tracer<'_> {
    fn picture(&self, progress: &(impl Fn(f32) + Sync)) -> Vec<[f32; 3]> {
        let (width, height) = (self.settings.width as usize, self.settings.height as usize);
        let row_length = width * self.settings.samples as usize;
        let filter = Filter::new();
        let mut pixels = Vec::with_capacity(width * height);
        // Samples of the band's rows and of those its pixels reach into.
        let mut rows: Vec<Vec<Sample>> = Vec::new();
        let mut first_row = 0;
        for start in (0..height).step_by(BAND) {
            let end = (start + BAND).min(height);
            let kept = start.saturating_sub(Filter::REACH) - first_row;
            rows.drain(..kept.min(rows.len()));
            first_row += kept;
            let traced = first_row + rows.len();
            let wanted = (end + Filter::REACH).min(height);
            let mut fresh = vec![vec![Sample::default(); row_length]; wanted - traced];
            self.trace_rows(traced, &mut fresh);
            rows.append(&mut fresh);
            let row = |y: Option<usize>| {
                let k = y?.checked_sub(first_row)?;
                rows.get(k).map(Vec::as_slice)
            };
            let band: Vec<Vec<[f32; 3]>> = (start..end)
                .into_par_iter()
                .map(|y| {
                    self.develop_row(
                        &filter,
                        [row(y.checked_sub(1)), row(Some(y)), row(Some(y + 1))],
                    )
                })
                .collect();
            band.into_iter().for_each(|row| pixels.extend(row));
            progress(end as f32 / height as f32);
        }
        pixels
    }

    fn trace_rows(&self, first: usize, rows: &mut [Vec<Sample>]) {
        // Runs of a few pixels share what they touch in the trees.
        let run = 8 * self.settings.samples as usize;
        rows.par_iter_mut().enumerate().for_each(|(k, row)| {
            row.par_chunks_mut(run)
                .enumerate()
                .for_each(|(chunk, out)| {
                    for (i, sample) in out.iter_mut().enumerate() {
                        let index = chunk * run + i;
                        *sample = self.sample(index, first + k);
                    }
                });
        });
    }

    fn develop_row(&self, filter: &Filter, rows: [Option<&[Sample]>; 3]) -> Vec<[f32; 3]> {
        let gain = libm::exp2f(self.settings.exposure);
        let per_pixel = self.settings.samples as usize;
        (0..self.settings.width as usize)
            .map(|x| filter.pixel(rows, x, per_pixel))
            .map(|light| develop(light, gain, self.settings.film_tone))
            .collect()
    }

    /// Sample number `index` of the row `y`.
    fn sample(&self, index: usize, y: usize) -> Sample {
        let per_pixel = self.settings.samples as usize;
        let (x, number) = (index / per_pixel, (index % per_pixel) as u32);
        let pixel = (y * self.settings.width as usize + x) as u32;
        let seed = hash2(pixel, self.settings.seed);
        let [u, v] = point_bits(number, seed);
        let at = (u & 0xffff_0000) | (v >> 16);
        let [u, v] = Sample::place(at);
        let right = (x as f32 + u) / self.settings.width as f32 * 2.0 - 1.0;
        let up = 1.0 - (y as f32 + v) / self.settings.height as f32 * 2.0;
        let direction = self.view.direction(right, up);
        let light = self.radiance(direction, hash2(seed, number));
        let light = if light.is_finite() { light } else { Rgb::ZERO };
        let rgb = light.clamp(Rgb::ZERO, Rgb::splat(BRIGHTEST)).to_array();
        Sample { rgb, at }
    }

    /// Light from `direction` at the eye.
    fn radiance(&self, direction: Vec3, seed: u32) -> Rgb {
        let behind = || {
            self.settings
                .backdrop
                .radiance(self.floor, self.view.eye, direction)
        };
        let Some(start) = enter(self.view.eye, direction) else {
            return behind();
        };
        let ray = Ray::new(self.view.eye + direction * start, direction);
        let skin = self.surface.nearest(&ray, f32::INFINITY);
        let far = skin.map_or(f32::INFINITY, |hit| hit.t);
        let layers = self.curves.layers(self.cuts, &ray, far);
        let (hair, left) = self.blend(&layers);
        if left <= 0.0 {
            return hair;
        }
        let back = match skin {
            Some(hit) => {
                let (lighting, occluders) = (self.lighting, self.occluders);
                self.skin
                    .radiance(&hit, direction, occluders, lighting, seed)
            }
            None => behind(),
        };
        hair + back * left
    }

    /// The layers' light, nearest first, and how much shows through them.
    fn blend(&self, layers: &Layers) -> (Rgb, f32) {
        let (mut sum, mut left) = (Rgb::ZERO, 1.0);
        for layer in layers.found() {
            let i = layer.leaf as usize;
            let (a, b) = (self.cuts.looks[i], self.cuts.looks[i + 1]);
            let color = Rgb::new(a[0], a[1], a[2]).lerp(Rgb::new(b[0], b[1], b[2]), layer.s);
            sum += color * (left * layer.opacity);
            left *= 1.0 - layer.opacity;
        }
        if left < 0.01 || layers.full() {
            // What is too deep to be looked at is like what lies before it.
            return (sum / (1.0 - left), 0.0);
        }
        (sum, left)
    }
}

/// How far from `eye` along `direction` the unit scene may begin.
fn enter(eye: Vec3, direction: Vec3) -> Option<f32> {
    let nearest = -eye.dot(direction);
    let off = (eye + direction * nearest).length_squared();
    let half = RADIUS * RADIUS - off;
    if half < 0.0 {
        return None;
    }
    let half = half.sqrt();
    (nearest + half > 0.0).then(|| (nearest - half).max(0.0))
}
