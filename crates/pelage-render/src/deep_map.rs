//! How many fibres stand before a far light, seen from anywhere in the hair.
//!
//! A deep shadow map (Lokovic and Veach, "Deep Shadow Maps", SIGGRAPH 2000): per
//! texel of a plane across the light, the fibres over it in order of depth with
//! the sum of what they cover. Built in one pass over the leaves and asked by
//! binary search, it shows the shadow of single strands at a small part of the
//! cost of rays, which in dense fur cross hundreds of leaves.

use crate::sampling::frame;
use crate::tessellate::Cuts;
use glam::Vec3;
use rayon::prelude::*;

/// Most texels along a side.
const FINEST: f32 = 1024.0;
/// Fewest texels along a side.
const COARSEST: f32 = 64.0;
/// Most fragments of a map, at 8 bytes: texels grow to keep to it.
const MOST_FRAGMENTS: f32 = 16e6;

/// A piece of a fibre over a texel.
#[derive(Clone, Copy, Debug, Default)]
struct Fragment {
    /// Distance from the light, up to a constant.
    depth: f32,
    /// Fibres over the texel, up to and with this one, once the map is finished.
    fibers: f32,
}

/// The fibres before one far light.
pub(crate) struct DeepMap {
    to_light: Vec3,
    x: Vec3,
    y: Vec3,
    low: [f32; 2],
    texel: f32,
    dims: [usize; 2],
    /// Where each texel's fragments start; one entry more than texels.
    starts: Vec<u32>,
    fragments: Vec<Fragment>,
}

impl DeepMap {
    /// The map of `cuts` for the light in direction `to_light` (a unit vector).
    pub fn new(cuts: &Cuts, to_light: Vec3) -> Self {
        let mut map = Self::empty(cuts, to_light);
        let texels = map.dims[0] * map.dims[1];
        let mut counts = vec![0u32; texels + 1];
        map.each_fragment(cuts, |texel, _| counts[texel + 1] += 1);
        for k in 0..texels {
            counts[k + 1] += counts[k];
        }
        map.starts = counts;
        let total = map.starts[texels] as usize;
        let mut fragments = vec![Fragment::default(); total];
        let mut next = map.starts.clone();
        map.each_fragment(cuts, |texel, fragment| {
            fragments[next[texel] as usize] = fragment;
            next[texel] += 1;
        });
        drop(next);
        map.fragments = fragments;
        map.sort();
        map
    }

    fn empty(cuts: &Cuts, to_light: Vec3) -> Self {
        let (x, y) = frame(to_light);
        let (mut low, mut high, mut length) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2], 0.0f64);
        for w in cuts.starts.windows(2) {
            let mut before = None;
            for i in w[0] as usize..w[1] as usize {
                let p = cuts.position(i);
                for (k, axis) in [x, y].into_iter().enumerate() {
                    low[k] = low[k].min(p.dot(axis));
                    high[k] = high[k].max(p.dot(axis));
                }
                length += before.map_or(0.0, |b: Vec3| b.distance(p)) as f64;
                before = Some(p);
            }
        }
        let side = (high[0] - low[0]).max(high[1] - low[1]);
        let side = if side.is_finite() {
            side.max(1e-4)
        } else {
            1e-4
        };
        let affordable = MOST_FRAGMENTS * side / (length as f32).max(1e-6);
        let texel = side / affordable.clamp(COARSEST, FINEST);
        let cells = |k: usize| {
            let cells = (high[k] - low[k]) / texel;
            if cells.is_finite() {
                cells as usize + 1
            } else {
                1
            }
        };
        Self {
            to_light,
            x,
            y,
            low,
            texel,
            dims: [cells(0), cells(1)],
            starts: Vec::new(),
            fragments: Vec::new(),
        }
    }

    /// Texel coordinates and depth of `p`.
    fn place(&self, p: Vec3) -> Vec3 {
        let along = |axis: Vec3, low: f32| (p.dot(axis) - low) / self.texel;
        let (u, v) = (along(self.x, self.low[0]), along(self.y, self.low[1]));
        Vec3::new(u, v, -p.dot(self.to_light))
    }

    fn index(&self, u: f32, v: f32) -> Option<usize> {
        let (column, row) = (u as usize, v as usize);
        let inside = u >= 0.0 && v >= 0.0 && column < self.dims[0] && row < self.dims[1];
        inside.then_some(row * self.dims[0] + column)
    }

    /// Walks all leaves in steps of at most a texel.
    fn each_fragment(&self, cuts: &Cuts, mut take: impl FnMut(usize, Fragment)) {
        for w in cuts.starts.windows(2) {
            for i in w[0] as usize..(w[1] as usize).saturating_sub(1) {
                let (a, b) = (
                    self.place(cuts.position(i)),
                    self.place(cuts.position(i + 1)),
                );
                let across = (b - a).truncate().length();
                let steps = across.ceil().clamp(1.0, 4096.0);
                let mix = |p: f32, q: f32, t: f32| p + (q - p) * t;
                for k in 0..steps as u32 {
                    let t = (k as f32 + 0.5) / steps;
                    let half = mix(cuts.places[i][3], cuts.places[i + 1][3], t);
                    let width = 2.0 * half * mix(cuts.looks[i][3], cuts.looks[i + 1][3], t);
                    let p = a.lerp(b, t);
                    if width > 0.0
                        && let Some(texel) = self.index(p.x, p.y)
                    {
                        let fibers = width / self.texel * (across / steps);
                        take(texel, Fragment { depth: p.z, fibers });
                    }
                }
            }
        }
    }

    /// Orders every texel by depth and sums what is covered.
    fn sort(&mut self) {
        let mut texels = Vec::with_capacity(self.starts.len());
        let mut rest = &mut self.fragments[..];
        for w in self.starts.windows(2) {
            let (texel, after) = rest.split_at_mut((w[1] - w[0]) as usize);
            rest = after;
            if !texel.is_empty() {
                texels.push(texel);
            }
        }
        texels.into_par_iter().with_min_len(256).for_each(|texel| {
            // Stable, so that equal depths keep the order of the strands.
            texel.sort_by(|a, b| a.depth.total_cmp(&b.depth));
            let mut sum = 0.0;
            for fragment in texel {
                sum += fragment.fibers;
                fragment.fibers = sum;
            }
        });
    }

    /// Mean number of fibres between `p`, moved across the light by `shift` texels,
    /// and the light. What is nearer than a texel or so is left out: the fibre itself.
    pub fn fibers_before(&self, p: Vec3, shift: [f32; 2]) -> f32 {
        let at = self.place(p);
        let Some(texel) = self.index(at.x + shift[0], at.y + shift[1]) else {
            return 0.0;
        };
        let fragments =
            &self.fragments[self.starts[texel] as usize..self.starts[texel + 1] as usize];
        let depth = at.z - 1.2 * self.texel;
        let before = fragments.partition_point(|f| f.depth < depth);
        match before.checked_sub(1) {
            Some(k) => fragments[k].fibers,
            None => 0.0,
        }
    }

    /// Radius in texels of the light's blur of `cos_angle` at the usual distance
    /// between a hair and the hair that shades it.
    pub fn blur(&self, cos_angle: f32) -> f32 {
        const USUAL: f32 = 0.02;
        let tan = (1.0 - cos_angle * cos_angle).max(0.0).sqrt() / cos_angle;
        (USUAL * tan / self.texel).clamp(0.7, 12.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parallel fibres across Z, one over the other, in `count` layers that each
    /// cover half the area.
    fn layers(count: usize) -> Cuts {
        let mut cuts = Cuts {
            starts: vec![0],
            ..Cuts::default()
        };
        for layer in 0..count {
            for line in 0..100 {
                let (y, z) = ((line as f32 + 0.5) * 0.01 - 0.5, -0.1 * layer as f32);
                cuts.places
                    .extend([[-0.5, y, z, 0.0025], [0.5, y, z, 0.0025]]);
                cuts.looks.extend([[0.5, 0.5, 0.5, 1.0]; 2]);
                cuts.starts.push(cuts.places.len() as u32);
            }
        }
        cuts
    }

    #[test]
    fn fibres_before_the_light_are_counted_by_the_area_they_cover() {
        let cuts = layers(4);
        let map = DeepMap::new(&cuts, Vec3::Z);
        for behind in 0..5 {
            let z = 0.05 - 0.1 * behind as f32;
            let n = 4000;
            let sum: f32 = (0..n)
                .map(|i| crate::sampling::point(i, 4))
                .map(|[x, y]| Vec3::new(0.9 * (x - 0.5), 0.9 * (y - 0.5), z))
                .map(|p| map.fibers_before(p, [0.0; 2]))
                .sum();
            let mean = sum / n as f32;
            assert!(
                (mean - 0.5 * behind as f32).abs() < 0.08,
                "{behind}: {mean}"
            );
        }
    }

    #[test]
    fn no_hair_casts_no_shadow() {
        let map = DeepMap::new(&Cuts::default(), Vec3::Y);
        assert_eq!(map.fibers_before(Vec3::ZERO, [0.0; 2]), 0.0);
    }
}
