//! What light reaches each voxel with hair.
//!
//! Per voxel and far light: how much of the light the surface leaves, and behind
//! how many fibres; per voxel: the sky that the surface leaves, and behind how
//! many fibres. Seen from the mean position of the hair in the voxel, which lies
//! outside the surface even where the voxel's centre does not.

use crate::accel::SurfaceTree;
use crate::color::{Rgb, luminance};
use crate::density::Density;
use crate::leaf::Ray;
use crate::lights::Lighting;
use crate::sampling::{in_cone, point};
use glam::Vec3;
use rayon::prelude::*;

/// Fibres behind which it is night.
pub(crate) const ENOUGH: f32 = 24.0;
/// Directions towards a far light.
const TO_BEAM: u32 = 4;
/// Directions towards the sky.
const TO_SKY: u32 = 28;
/// How far surfaces are not in the way, in the unit scene: roots lie on them.
pub(crate) const NEAR: f32 = 4e-4;

/// What stands between a point and the light.
#[derive(Clone, Copy)]
pub(crate) struct Occluders<'a> {
    pub density: &'a Density,
    pub surface: &'a SurfaceTree,
}

impl Occluders<'_> {
    /// Fibres crossed from `from` along `direction`; `None` where the surface is in
    /// the way.
    pub fn depth(&self, from: Vec3, direction: Vec3) -> Option<f32> {
        if self.surface.blocks(&Ray::new(from, direction), NEAR) {
            return None;
        }
        Some(self.density.depth(from, direction, ENOUGH))
    }
}

/// A far light as it reaches some place.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Arrival {
    /// Share of the light that the surface leaves.
    pub open: f32,
    /// Mean number of fibres before the light.
    pub fibers: f32,
}

/// Light by voxel.
pub(crate) struct LightField<'a> {
    density: &'a Density,
    beams: usize,
    /// Per voxel: `open` and `open * fibers` for each beam, then the sky's colour
    /// and its fibres times the luminance of that colour.
    values: Vec<f32>,
}

impl<'a> LightField<'a> {
    /// Gathers light for every voxel with hair.
    pub fn new(occluders: Occluders<'a>, lighting: &Lighting) -> Self {
        let beams = lighting.beams.len();
        let stride = beams * 2 + 4;
        let mut values = vec![0.0; occluders.density.centres.len() * stride];
        values
            .par_chunks_mut(stride)
            .zip(&occluders.density.centres)
            .for_each(|(out, &centre)| fill(out, centre, occluders, lighting));
        Self {
            density: occluders.density,
            beams,
            values,
        }
    }

    /// The light at `p`: one arrival a beam into `arrivals`; the sky's mean radiance
    /// and the fibres before it are returned. All open where there is no hair.
    pub fn at(&self, p: Vec3, arrivals: &mut Vec<Arrival>) -> (Rgb, f32) {
        arrivals.clear();
        arrivals.resize(self.beams, Arrival::default());
        let stride = self.beams * 2 + 4;
        let (mut sky, mut sky_fibers, mut total) = (Rgb::ZERO, 0.0, 0.0);
        self.density.neighbours(p, |slot, weight| {
            let v = &self.values[slot * stride..(slot + 1) * stride];
            for (k, arrival) in arrivals.iter_mut().enumerate() {
                arrival.open += v[2 * k] * weight;
                arrival.fibers += v[2 * k + 1] * weight;
            }
            let s = &v[2 * self.beams..];
            sky += Rgb::new(s[0], s[1], s[2]) * weight;
            sky_fibers += s[3] * weight;
            total += weight;
        });
        let scale = 1.0 / total.max(1e-6);
        for arrival in arrivals {
            arrival.fibers /= arrival.open.max(1e-6);
            arrival.open *= scale;
        }
        (sky * scale, sky_fibers / luminance(sky).max(1e-6))
    }
}

fn fill(out: &mut [f32], centre: Vec3, occluders: Occluders, lighting: &Lighting) {
    for (k, beam) in lighting.beams.iter().enumerate() {
        let (mut open, mut fibers) = (0.0, 0.0);
        for i in 0..TO_BEAM {
            let to = in_cone(beam.to_light, beam.cos_angle, point(i, 11));
            if let Some(depth) = occluders.depth(centre, to) {
                open += 1.0;
                fibers += depth;
            }
        }
        out[2 * k] = open / TO_BEAM as f32;
        out[2 * k + 1] = fibers / TO_BEAM as f32;
    }
    let (mut sky, mut clear, mut behind) = (Rgb::ZERO, 0.0, 0.0);
    for i in 0..TO_SKY {
        let to = in_cone(lighting.up, -1.0, point(i, 12));
        if let Some(depth) = occluders.depth(centre, to) {
            let radiance = lighting.sky(to);
            sky += radiance;
            let weight = luminance(radiance);
            clear += weight;
            behind += weight * libm::expf(-0.5 * depth);
        }
    }
    let s = &mut out[lighting.beams.len() * 2..];
    let mean = sky / TO_SKY as f32;
    // The one number of fibres that dims the whole sky as its parts do.
    let fibers = if behind > 0.0 {
        -2.0 * libm::logf(behind / clear)
    } else {
        0.0
    };
    s[..3].copy_from_slice(&mean.to_array());
    s[3] = fibers * luminance(mean);
}
