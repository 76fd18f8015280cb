//! The radiance of hair, at every cut of every strand.

use crate::accel::SurfaceTree;
use crate::color::Rgb;
use crate::deep_map::DeepMap;
use crate::dual_scattering::{ambient, scatter};
use crate::kajiya_kay;
use crate::leaf::Ray;
use crate::light_field::{Arrival, ENOUGH, LightField, NEAR};
use crate::lights::Lighting;
use crate::marschner::{Geometry, Marschner};
use crate::sampling::{hash2, in_cone, point};
use crate::tessellate::Cuts;
use crate::{Reflection, Settings};
use glam::Vec3;
use rayon::prelude::*;

/// How much of a far light's fibres are counted by the deep map, the rest by the
/// grid: the map sees single strands and is noisy, the grid is smooth and blurs.
const BY_MAP: f32 = 0.75;
/// Cuts from one look at what the surface hides to the next.
const SURFACE_STEP: usize = 5;
/// Strands shaded by one task.
const CHUNK: usize = 512;

/// All that hair is shaded with.
pub(crate) struct HairShader<'a> {
    pub cuts: &'a Cuts,
    /// Per beam and cut: fibres before the light, see [`fibers_before`].
    pub counts: Vec<Vec<f32>>,
    pub surface: &'a SurfaceTree,
    pub field: &'a LightField<'a>,
    pub lighting: &'a Lighting,
    pub settings: &'a Settings,
    pub eye: Vec3,
}

/// Fibres before each beam at every cut. Maps are made and dropped one by one:
/// together they would be most of a picture's memory.
pub(crate) fn fibers_before(cuts: &Cuts, lighting: &Lighting) -> Vec<Vec<f32>> {
    let each = (0u32..).zip(&lighting.beams).map(|(k, beam)| {
        let map = DeepMap::new(cuts, beam.to_light);
        let radius = 2.0 * map.blur(beam.cos_angle);
        (0..cuts.places.len())
            .into_par_iter()
            .with_min_len(1024)
            .map(|i| {
                // Cuts of a strand see different parts of the light.
                let shift = point(i as u32, hash2(k, 41)).map(|x| (x - 0.5) * radius);
                map.fibers_before(cuts.position(i), shift)
            })
            .collect()
    });
    each.collect()
}

/// Light at the cuts of a strand, cut by cut and within a cut beam by beam.
#[derive(Default)]
struct StrandLight {
    /// Fibres before the beam.
    counts: Vec<f32>,
    /// Share of the beam that the surface leaves.
    open: Vec<f32>,
    /// The beams at one cut, by the grid.
    arrivals: Vec<Arrival>,
}

impl HairShader<'_> {
    /// Radiance towards the eye at every cut, with the opacities of the cuts.
    pub fn shade(&self, progress: &(impl Fn(f32) + Sync)) -> Vec<[f32; 4]> {
        let model = Marschner::new(&self.settings.fiber);
        let starts = &self.cuts.starts;
        let strands = starts.len() - 1;
        let mut shaded = Vec::with_capacity(self.cuts.looks.len());
        // Tasks come in groups, so that there is something to report in between.
        let group = CHUNK * 64;
        for first in (0..strands).step_by(group) {
            let last = (first + group).min(strands);
            let parts: Vec<Vec<[f32; 4]>> = (first..last)
                .into_par_iter()
                .step_by(CHUNK)
                .map(|from| self.shade_strands(from..(from + CHUNK).min(last), &model))
                .collect();
            parts.into_iter().for_each(|part| shaded.extend(part));
            progress(last as f32 / strands as f32);
        }
        shaded
    }

    fn shade_strands(&self, strands: std::ops::Range<usize>, model: &Marschner) -> Vec<[f32; 4]> {
        let beams = self.lighting.beams.len();
        let mut shaded = Vec::new();
        let mut light = StrandLight::default();
        for strand in strands {
            let start = self.cuts.starts[strand] as usize;
            let end = self.cuts.starts[strand + 1] as usize;
            self.count_fibers(start, end, &mut light.counts);
            self.see_lights(start, end, &mut light.open);
            for i in start..end {
                let [r, g, b, opacity] = self.cuts.looks[i];
                let row = (i - start) * beams;
                let tangent = self.cuts.tangent(i, start, end);
                let color = Rgb::new(r, g, b);
                let c = self.shade_cut(i, tangent, color, model, row, &mut light);
                shaded.push([c.x, c.y, c.z, opacity]);
            }
        }
        shaded
    }

    /// Fibres before each light at the cuts `start..end` of a strand, smoothed along
    /// it.
    fn count_fibers(&self, start: usize, end: usize, counts: &mut Vec<f32>) {
        counts.clear();
        for i in start..end {
            counts.extend(self.counts.iter().map(|beam| beam[i]));
        }
        smooth(counts, self.counts.len());
    }

    /// Share of each light that the surface leaves at the cuts `start..end`: looked
    /// at now and then, linear in between.
    fn see_lights(&self, start: usize, end: usize, open: &mut Vec<f32>) {
        let beams = self.lighting.beams.len();
        open.clear();
        open.resize((end - start) * beams, 1.0);
        let last = end - start - 1;
        let steps = last.div_ceil(SURFACE_STEP).max(1);
        for (k, beam) in self.lighting.beams.iter().enumerate() {
            let mut before = (0, 1.0);
            for step in 0..=steps {
                let i = last * step / steps;
                let sample = point(step as u32, hash2(start as u32, 100 + k as u32));
                let to = in_cone(beam.to_light, beam.cos_angle, sample);
                let blocked = self
                    .surface
                    .blocks(&Ray::new(self.cuts.position(start + i), to), NEAR);
                let here = if blocked { 0.0 } else { 1.0 };
                for j in before.0..=i {
                    let t = (j - before.0) as f32 / (i - before.0).max(1) as f32;
                    open[j * beams + k] = before.1 + (here - before.1) * t;
                }
                open[i * beams + k] = here;
                before = (i, here);
            }
        }
    }

    fn shade_cut(
        &self,
        i: usize,
        tangent: Vec3,
        color: Rgb,
        model: &Marschner,
        row: usize,
        light: &mut StrandLight,
    ) -> Rgb {
        let p = self.cuts.position(i);
        let to_eye = (self.eye - p).try_normalize().unwrap_or(Vec3::Z);
        let (sky, sky_fibers) = self.field.at(p, &mut light.arrivals);
        let fiber = &self.settings.fiber;
        let shares = model.shares(color);
        let exponent = kajiya_kay::exponent(fiber.roughness);
        let mut sum = match self.settings.reflection {
            Reflection::Marschner => sky * ambient(&shares, color, sky_fibers),
            Reflection::KajiyaKay => sky * color * libm::expf(-0.7 * sky_fibers),
        };
        for (k, (beam, arrival)) in self.lighting.beams.iter().zip(&light.arrivals).enumerate() {
            let open = light.open[row + k] * BY_MAP + arrival.open * (1.0 - BY_MAP);
            if open <= 0.0 {
                continue;
            }
            let n = light.counts[row + k] * BY_MAP + arrival.fibers * (1.0 - BY_MAP);
            let g = Geometry::new(tangent, beam.to_light, to_eye);
            let n = n.min(ENOUGH);
            let sent = match self.settings.reflection {
                Reflection::Marschner => scatter(model, &g, &shares, n),
                Reflection::KajiyaKay => kajiya_kay::scatter(&g, color, n, exponent, fiber.gloss),
            };
            sum += beam.irradiance * sent * open;
        }
        sum
    }
}

/// Averages each count of a row with those of the rows before and after it.
fn smooth(counts: &mut [f32], beams: usize) {
    let rows = counts.len().checked_div(beams).unwrap_or(0);
    for k in 0..beams.min(counts.len()) {
        let mut before = counts[k];
        for row in 0..rows {
            let here = counts[row * beams + k];
            let after = counts[(row + 1).min(rows - 1) * beams + k];
            counts[row * beams + k] = 0.5 * here + 0.25 * (before + after);
            before = here;
        }
    }
}
