//! Light on the floor, as a map gathered once: shadows there are soft, so a coarse
//! map smoothly interpolated shows no noise however few rays a pixel has.

use crate::color::Rgb;
use crate::light_field::Occluders;
use crate::lights::Lighting;
use crate::sampling::{frame, in_cone, point, smoothstep};
use crate::skin::sky_on;
use glam::Vec3;
use rayon::prelude::*;
use std::f32::consts::PI;

/// Most texels along a side of the map.
const MOST_TEXELS: u32 = 224;
/// Fewest texels along a side of the map.
const FEWEST_TEXELS: u32 = 32;
/// Half a side of the map, in the unit scene.
const REACH: f32 = 1.15;
/// Directions towards each far light.
const TO_BEAM: u32 = 16;
/// Directions towards the sky.
const TO_SKY: u32 = 32;
/// Radii between which the pool of light on the floor fades, in the unit scene.
const POOL: [f32; 2] = [0.2, 4.5];
/// Brightness outside the pool.
const OUTSIDE: f32 = 0.72;

/// A horizontal floor and the light on it, as a share of what an empty one gets.
pub(crate) struct Floor {
    /// Unit normal.
    pub up: Vec3,
    height: f32,
    x: Vec3,
    y: Vec3,
    /// Texels along a side.
    side: usize,
    texels: Vec<Rgb>,
}

impl Floor {
    /// The floor at `height` along `lighting.up`, under what `occluders` hold,
    /// for a picture `rows` pixels high.
    pub fn new(height: f32, rows: u32, occluders: Occluders, lighting: &Lighting) -> Self {
        let (x, y) = frame(lighting.up);
        let mut floor = Self {
            up: lighting.up,
            height,
            x,
            y,
            // About three pixels each where the scene fills the picture.
            side: (rows * 5 / 16).clamp(FEWEST_TEXELS, MOST_TEXELS) as usize,
            texels: Vec::new(),
        };
        let empty = floor.empty_light(lighting);
        let texels: Vec<Rgb> = (0..floor.side * floor.side)
            .into_par_iter()
            .map(|k| floor.gather(floor.texel(k), occluders, lighting) / empty)
            .collect();
        floor.texels = blurred(&texels, floor.side);
        floor
    }

    fn texel(&self, k: usize) -> Vec3 {
        let along = |i: usize| ((i as f32 + 0.5) / self.side as f32 * 2.0 - 1.0) * REACH;
        let (a, b) = (along(k % self.side), along(k / self.side));
        // A little above, or the lowest hairs would lie under it.
        self.x * a + self.y * b + self.up * (self.height + 1e-4)
    }

    fn gather(&self, p: Vec3, occluders: Occluders, lighting: &Lighting) -> Rgb {
        let mut sum = sky_on(p, self.up, TO_SKY, occluders, lighting);
        for beam in &lighting.beams {
            let facing = beam.to_light.dot(self.up).max(0.0);
            // Softer than on the hair: a floor shows a hard edge that fur hides.
            let cos_angle = beam.cos_angle.min(0.985);
            let open: f32 = (0..TO_BEAM)
                .filter_map(|i| {
                    let to = in_cone(beam.to_light, cos_angle, point(i, 31));
                    occluders.depth(p, to).map(|depth| libm::expf(-depth))
                })
                .sum();
            sum += beam.irradiance * (facing / PI * open / TO_BEAM as f32);
        }
        sum
    }

    fn empty_light(&self, lighting: &Lighting) -> Rgb {
        let mut sum = (0..TO_SKY)
            .map(|i| lighting.sky(crate::sampling::over_cosine(self.up, point(i, 21))))
            .sum::<Rgb>()
            / TO_SKY as f32;
        for beam in &lighting.beams {
            sum += beam.irradiance * (beam.to_light.dot(self.up).max(0.0) / PI);
        }
        sum.max(Rgb::splat(1e-6))
    }

    /// Where the ray from `eye` meets the floor from above.
    pub fn meet(&self, eye: Vec3, direction: Vec3) -> Option<Vec3> {
        let (drop, above) = (-direction.dot(self.up), eye.dot(self.up) - self.height);
        if drop <= 1e-6 || above <= 0.0 {
            return None;
        }
        Some(eye + direction * (above / drop))
    }

    /// Light at `p` on the floor, as a share of what an empty one gets in the middle
    /// of the pool.
    pub fn light(&self, p: Vec3) -> Rgb {
        let (a, b) = (p.dot(self.x), p.dot(self.y));
        let pool = 1.0 - (1.0 - OUTSIDE) * smoothstep(POOL[0], POOL[1], (a * a + b * b).sqrt());
        // Whatever the map holds at its edge, it fades to an empty floor.
        let edge = 1.0 - smoothstep(0.75, 0.98, a.abs().max(b.abs()) / REACH);
        Rgb::ONE.lerp(self.shadow(a, b), edge) * pool
    }

    /// Light on the wall, where the floor never ends.
    pub fn edge(&self) -> f32 {
        OUTSIDE
    }

    /// The map at `a`, `b` by quadratic B-splines.
    fn shadow(&self, a: f32, b: f32) -> Rgb {
        let at = |c: f32| (c / REACH * 0.5 + 0.5) * self.side as f32 - 0.5;
        let (x, y) = (spline(at(a), self.side), spline(at(b), self.side));
        let mut sum = Rgb::ZERO;
        for (row, wy) in y {
            for (column, wx) in x {
                sum += self.texels[row * self.side + column] * (wx * wy);
            }
        }
        sum
    }
}

/// The three texels around `x` and their weights.
fn spline(x: f32, side: usize) -> [(usize, f32); 3] {
    let centre = (x + 0.5).floor().clamp(0.0, (side - 1) as f32);
    let f = (x - centre).clamp(-0.5, 0.5);
    let i = centre as usize;
    [
        (i.saturating_sub(1), 0.5 * (0.5 - f) * (0.5 - f)),
        (i, 0.75 - f * f),
        ((i + 1).min(side - 1), 0.5 * (0.5 + f) * (0.5 + f)),
    ]
}

/// The map with every texel averaged with its eight neighbours.
fn blurred(texels: &[Rgb], side: usize) -> Vec<Rgb> {
    let last = side - 1;
    (0..texels.len())
        .map(|k| {
            let (x, y) = (k % side, k / side);
            let rows = [
                (y.saturating_sub(1), 1.0),
                (y, 2.0),
                ((y + 1).min(last), 1.0),
            ];
            let columns = [
                (x.saturating_sub(1), 1.0),
                (x, 2.0),
                ((x + 1).min(last), 1.0),
            ];
            let mut sum = Rgb::ZERO;
            for (row, wy) in rows {
                for (column, wx) in columns {
                    sum += texels[row * side + column] * (wx * wy);
                }
            }
            sum / 16.0
        })
        .collect()
}
