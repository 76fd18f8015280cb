//! The radiance of hair, at every cut of every strand.

use crate::accel::{CurveTree, SurfaceTree};
use crate::color::Rgb;
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

/// How much of a far light's fibres are counted by rays, the rest by the grid:
/// rays see single strands and are noisy, the grid is smooth and blurs them.
const BY_RAYS: f32 = 0.75;
/// Fibres that rays count at most.
const COUNTED: f32 = 10.0;
/// Strands shaded by one task.
const CHUNK: usize = 512;

/// All that hair is shaded with.
pub(crate) struct HairShader<'a> {
    pub cuts: &'a Cuts,
    pub curves: &'a CurveTree,
    pub surface: &'a SurfaceTree,
    pub field: &'a LightField<'a>,
    pub lighting: &'a Lighting,
    pub settings: &'a Settings,
    pub eye: Vec3,
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
        let (mut crossed, mut arrivals) = (Vec::new(), Vec::new());
        for strand in strands {
            let start = self.cuts.starts[strand] as usize;
            let end = self.cuts.starts[strand + 1] as usize;
            self.count_fibers(start, end, &mut crossed);
            for i in start..end {
                let [r, g, b, opacity] = self.cuts.looks[i];
                let row = &crossed[(i - start) * beams..(i - start + 1) * beams];
                let tangent = self.cuts.tangent(i, start, end);
                let color = Rgb::new(r, g, b);
                let c = self.shade_cut(i, tangent, color, row, model, &mut arrivals);
                shaded.push([c.x, c.y, c.z, opacity]);
            }
        }
        shaded
    }

    /// Fibres before each light at the cuts `start..end` of a strand, counted by one
    /// ray each and smoothed along the strand; below 0 where the surface is in the
    /// way.
    fn count_fibers(&self, start: usize, end: usize, counts: &mut Vec<f32>) {
        let beams = self.lighting.beams.len();
        counts.clear();
        for i in start..end {
            for (k, beam) in self.lighting.beams.iter().enumerate() {
                // One sequence a strand: its cuts sample different parts of the light.
                let sample = point((i - start) as u32, hash2(start as u32, k as u32));
                let to = in_cone(beam.to_light, beam.cos_angle, sample);
                let ray = Ray::new(self.cuts.position(i), to);
                counts.push(if self.surface.blocks(&ray, NEAR) {
                    -1.0
                } else {
                    // Not itself, nor the leaves next to where it starts.
                    let own = i.saturating_sub(2).max(start)..(i + 2).min(end);
                    let near = self.cuts.places[i][3];
                    self.curves.crossings(self.cuts, &ray, near, own, COUNTED)
                });
            }
        }
        smooth(counts, beams);
    }

    fn shade_cut(
        &self,
        i: usize,
        tangent: Vec3,
        color: Rgb,
        crossed: &[f32],
        model: &Marschner,
        arrivals: &mut Vec<Arrival>,
    ) -> Rgb {
        let p = self.cuts.position(i);
        let to_eye = (self.eye - p).try_normalize().unwrap_or(Vec3::Z);
        let (sky, sky_fibers) = self.field.at(p, arrivals);
        let fiber = &self.settings.fiber;
        let shares = model.shares(color);
        let exponent = kajiya_kay::exponent(fiber.roughness);
        let mut sum = match self.settings.reflection {
            Reflection::Marschner => sky * ambient(&shares, sky_fibers),
            Reflection::KajiyaKay => sky * color * libm::expf(-0.7 * sky_fibers),
        };
        for ((beam, arrival), &counted) in self.lighting.beams.iter().zip(arrivals).zip(crossed) {
            let open = if counted < 0.0 { 0.0 } else { 1.0 };
            let open = open * BY_RAYS + arrival.open * (1.0 - BY_RAYS);
            if open <= 0.0 {
                continue;
            }
            // Rays stop counting where the grid may still go on.
            let far = (arrival.fibers - COUNTED).max(0.0);
            let by_rays = counted.max(0.0) + if counted >= COUNTED { far } else { 0.0 };
            let n = by_rays * BY_RAYS + arrival.fibers * (1.0 - BY_RAYS);
            let g = Geometry::new(tangent, beam.to_light, to_eye);
            let n = n.min(ENOUGH);
            let sent = match self.settings.reflection {
                Reflection::Marschner => scatter(model, &g, &shares, n),
                Reflection::KajiyaKay => {
                    kajiya_kay::scatter(&g, color, n, exponent, fiber.gloss)
                }
            };
            sum += beam.irradiance * sent * open;
        }
        sum
    }
}

/// Averages each count of a row with those of the rows before and after it; counts
/// below 0 neither give nor change.
fn smooth(counts: &mut [f32], beams: usize) {
    if beams == 0 {
        return;
    }
    let rows = counts.len() / beams;
    for k in 0..beams {
        let mut before = counts[k];
        for row in 0..rows {
            let here = counts[row * beams + k];
            let after = counts[(row + 1).min(rows - 1) * beams + k];
            if here >= 0.0 {
                let or_here = |x: f32| if x < 0.0 { here } else { x };
                let mean = 0.5 * here + 0.25 * (or_here(before) + or_here(after));
                counts[row * beams + k] = mean;
            }
            before = here;
        }
    }
}
