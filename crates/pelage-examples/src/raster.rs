//! Painting maps: what lies under each texel, and filling beyond chart borders.

use glam::DVec2;
use pelage_surface::ImageMap;
use rayon::prelude::*;

/// The place on the mesh under a texel.
#[derive(Clone, Copy, Debug)]
pub struct Texel {
    /// Triangle.
    pub triangle: u32,
    /// Weights of its three corners.
    pub weights: [f64; 3],
}

/// A square of texels over the unit square, rows from the top (v = 1).
#[derive(Clone, Debug)]
pub struct Canvas {
    /// Texels a side.
    pub size: usize,
    /// What lies under each texel's centre.
    pub texels: Vec<Option<Texel>>,
    /// Two triangles of each texel centre that lies inside more than one.
    pub overlapping: Vec<[u32; 2]>,
}

/// Finds the triangle under each texel's centre. `uvs` has three entries a
/// triangle; their order may be either way round.
pub fn canvas(uvs: &[[DVec2; 3]], size: usize) -> Canvas {
    let mut out = Canvas {
        size,
        texels: vec![None; size * size],
        overlapping: Vec::new(),
    };
    for (triangle, uv) in uvs.iter().enumerate() {
        // In texels, rows downwards.
        let p = uv.map(|p| DVec2::new(p.x, 1.0 - p.y) * size as f64 - DVec2::splat(0.5));
        let doubled = (p[1] - p[0]).perp_dot(p[2] - p[0]);
        if doubled == 0.0 {
            continue;
        }
        let low = p[0].min(p[1]).min(p[2]).ceil().max(DVec2::ZERO);
        let high = p[0]
            .max(p[1])
            .max(p[2])
            .min(DVec2::splat(size as f64 - 1.0));
        for y in low.y as usize..(high.y + 1.0).max(0.0) as usize {
            for x in low.x as usize..(high.x + 1.0).max(0.0) as usize {
                let at = DVec2::new(x as f64, y as f64);
                let weights =
                    [1, 2, 0].map(|k| (p[(k + 1) % 3] - p[k]).perp_dot(at - p[k]) / doubled);
                // Neighbours share their edge's texels without counting as overlap.
                if weights.iter().any(|&w| w < 0.0) {
                    continue;
                }
                let there = &mut out.texels[y * size + x];
                if there.is_some() && weights.iter().all(|&w| w > 1e-9) {
                    out.overlapping
                        .push([triangle as u32, there.map_or(0, |t| t.triangle)]);
                }
                *there = Some(Texel {
                    triangle: triangle as u32,
                    weights,
                });
            }
        }
    }
    out
}

/// How far paint goes beyond the border of a chart, in texels: enough for
/// bilinear look-ups and a few levels of a mip map.
const BEYOND: usize = 8;

impl Canvas {
    /// `look` under each texel.
    pub fn each<T: Send>(&self, look: impl Fn(&Texel) -> T + Sync) -> Vec<Option<T>> {
        self.texels
            .par_iter()
            .map(|t| t.as_ref().map(&look))
            .collect()
    }

    /// An image of `N` 8-bit channels: `paint` of what [`Canvas::each`] found, carried
    /// on beyond the chart borders, `empty` elsewhere.
    pub fn paint<T, const N: usize>(
        &self,
        empty: [f64; N],
        looks: &[Option<T>],
        paint: impl Fn(&T) -> [f64; N],
    ) -> ImageMap {
        let mut texels: Vec<Option<[f64; N]>> =
            looks.iter().map(|l| l.as_ref().map(&paint)).collect();
        for _ in 0..BEYOND {
            spread(self.size, &mut texels);
        }
        self.coded(empty, texels)
    }

    /// As [`Canvas::paint`], but colours are never mixed: beyond the charts each
    /// texel has that of a painted neighbour.
    pub fn flood<T, const N: usize>(
        &self,
        empty: [f64; N],
        looks: &[Option<T>],
        paint: impl Fn(&T) -> [f64; N],
    ) -> ImageMap {
        let mut texels: Vec<Option<[f64; N]>> =
            looks.iter().map(|l| l.as_ref().map(&paint)).collect();
        for _ in 0..BEYOND {
            let old = texels.clone();
            for (i, texel) in texels
                .iter_mut()
                .enumerate()
                .filter(|(i, _)| old[*i].is_none())
            {
                let (x, y) = (i % self.size, i / self.size);
                let beside = [
                    (x > 0).then(|| i - 1),
                    (x + 1 < self.size).then_some(i + 1),
                    (y > 0).then(|| i - self.size),
                    (y + 1 < self.size).then_some(i + self.size),
                ];
                *texel = beside.into_iter().flatten().find_map(|n| old[n]);
            }
        }
        self.coded(empty, texels)
    }

    fn coded<const N: usize>(&self, empty: [f64; N], texels: Vec<Option<[f64; N]>>) -> ImageMap {
        let codes = texels
            .iter()
            .flat_map(|t| t.unwrap_or(empty))
            .map(quantised)
            .collect();
        image(self.size as u32, self.size as u32, N as u32, codes)
    }
}

/// A number in 0..1 as an 8-bit file stores it.
pub fn quantised(x: f64) -> f32 {
    ((x.clamp(0.0, 1.0) * 255.0).round() / 255.0) as f32
}

/// An 8-bit map.
pub fn image(width: u32, height: u32, channels: u32, texels: Vec<f32>) -> ImageMap {
    // The callers fill every texel with clamped, hence finite, numbers.
    ImageMap::new(width, height, channels, texels, true)
        .unwrap_or_else(|e| unreachable!("a painted map is whole: {e}"))
}

/// Gives empty texels the mean of their painted neighbours.
fn spread<const N: usize>(size: usize, texels: &mut [Option<[f64; N]>]) {
    let old = texels.to_vec();
    for y in 0..size {
        for x in 0..size {
            if old[y * size + x].is_some() {
                continue;
            }
            let (mut sum, mut count) = ([0.0; N], 0);
            for ny in y.saturating_sub(1)..(y + 2).min(size) {
                for nx in x.saturating_sub(1)..(x + 2).min(size) {
                    if let Some(there) = old[ny * size + nx] {
                        (0..N).for_each(|c| sum[c] += there[c]);
                        count += 1;
                    }
                }
            }
            if count > 0 {
                texels[y * size + x] = Some(sum.map(|s| s / count as f64));
            }
        }
    }
}

/// A linear colour as sRGB, which is how 8-bit colour maps are stored.
pub fn srgb(linear: [f64; 3]) -> [f64; 3] {
    linear.map(|x| {
        if x <= 0.003_130_8 {
            12.92 * x.max(0.0)
        } else {
            1.055 * libm::pow(x, 1.0 / 2.4) - 0.055
        }
    })
}
