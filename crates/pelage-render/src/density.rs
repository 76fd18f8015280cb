//! How much hair stands where: a grid of extinction.
//!
//! A voxel holds the mean number of fibres that a ray of unit length and random
//! direction crosses in it: the sum of width times length, times the mean sine
//! π/4 between two directions, over the volume. The optical depth along a ray is
//! then the expected number of fibres crossed, which is what dual scattering asks
//! for (Zinke et al., "Dual Scattering Approximation for Fast Multiple Scattering
//! in Hair", SIGGRAPH 2008, section 4.1; they take it from a deep opacity map).

use crate::tessellate::Cuts;
use glam::{UVec3, Vec3};

/// "No voxel here."
const NONE: u32 = u32::MAX;

/// Extinction over a box of cubic voxels in the unit scene.
#[derive(Clone, Debug)]
pub(crate) struct Density {
    low: Vec3,
    /// Edge of a voxel.
    pub cell: f32,
    dims: UVec3,
    extinction: Vec<f32>,
    /// Per voxel: its entry in `centres`, or [`NONE`].
    slots: Vec<u32>,
    /// Mean position of the hair in each voxel that has some.
    pub centres: Vec<Vec3>,
}

impl Density {
    /// Gathers `cuts` into a grid of `voxels` along the longest side.
    pub fn new(cuts: &Cuts, voxels: u32) -> Self {
        let mut grid = Self::empty(cuts, voxels);
        let mut sums: Vec<[f32; 4]> = Vec::new();
        for w in cuts.starts.windows(2) {
            for i in w[0] as usize..(w[1] as usize).saturating_sub(1) {
                grid.add_leaf(cuts, i, &mut sums);
            }
        }
        let centre = |s: &[f32; 4]| Vec3::new(s[0], s[1], s[2]) / s[3];
        grid.centres = sums.iter().map(centre).collect();
        grid
    }

    fn empty(cuts: &Cuts, voxels: u32) -> Self {
        let positions = || (0..cuts.places.len()).map(|i| cuts.position(i));
        let low = positions().fold(Vec3::INFINITY, Vec3::min);
        let high = positions().fold(Vec3::NEG_INFINITY, Vec3::max);
        let (low, size) = if low.cmple(high).all() {
            (low, high - low)
        } else {
            (Vec3::ZERO, Vec3::ZERO)
        };
        let cell = (size.max_element() / voxels as f32).max(1e-4);
        // A voxel of margin on every side, for what spreads to neighbours.
        let dims = (size / cell).ceil().as_uvec3() + UVec3::splat(3);
        let count = dims.x as usize * dims.y as usize * dims.z as usize;
        Self {
            low: low - Vec3::splat(1.5 * cell),
            cell,
            dims,
            extinction: vec![0.0; count],
            slots: vec![NONE; count],
            centres: Vec::new(),
        }
    }

    fn index(&self, v: UVec3) -> usize {
        (v.z as usize * self.dims.y as usize + v.y as usize) * self.dims.x as usize + v.x as usize
    }

    fn inside(&self, v: UVec3) -> bool {
        v.cmplt(self.dims).all()
    }

    fn add_leaf(&mut self, cuts: &Cuts, i: usize, sums: &mut Vec<[f32; 4]>) {
        let (a, b) = (cuts.position(i), cuts.position(i + 1));
        let length = a.distance(b);
        let steps = (length / (0.7 * self.cell)).ceil().clamp(1.0, 512.0);
        let share =
            length / steps * std::f32::consts::FRAC_PI_4 / (self.cell * self.cell * self.cell);
        for k in 0..steps as u32 {
            let t = (k as f32 + 0.5) / steps;
            let mix = |p: f32, q: f32| p + (q - p) * t;
            // Half-width times opacity is the true one, whatever width is drawn.
            let half = mix(cuts.places[i][3], cuts.places[i + 1][3]);
            let width = 2.0 * half * mix(cuts.looks[i][3], cuts.looks[i + 1][3]);
            if width > 0.0 {
                self.add(a.lerp(b, t), width * share, sums);
            }
        }
    }

    /// Spreads `amount` over the eight voxels around `p`.
    fn add(&mut self, p: Vec3, amount: f32, sums: &mut Vec<[f32; 4]>) {
        let (base, weights) = self.around(p);
        for (corner, weight) in weights.into_iter().enumerate() {
            let v = base + offset(corner);
            if self.inside(v) {
                let k = self.index(v);
                self.extinction[k] += amount * weight;
            }
        }
        let nearest = ((p - self.low) / self.cell).as_uvec3();
        if !self.inside(nearest) {
            return;
        }
        let k = self.index(nearest);
        if self.slots[k] == NONE {
            self.slots[k] = sums.len() as u32;
            sums.push([0.0; 4]);
        }
        let sum = &mut sums[self.slots[k] as usize];
        for (sum, x) in sum.iter_mut().zip([p.x, p.y, p.z, 1.0]) {
            *sum += x;
        }
    }

    /// The lowest of the eight voxels whose centres surround `p`, and the weight of
    /// each in linear interpolation.
    fn around(&self, p: Vec3) -> (UVec3, [f32; 8]) {
        let g = ((p - self.low) / self.cell - Vec3::splat(0.5)).max(Vec3::ZERO);
        let base = g.floor();
        let f = g - base;
        let weight = |corner: usize| {
            let pick = |bit: usize, f: f32| if corner >> bit & 1 == 0 { 1.0 - f } else { f };
            pick(0, f.x) * pick(1, f.y) * pick(2, f.z)
        };
        (base.as_uvec3(), std::array::from_fn(weight))
    }

    /// Calls `take(entry in centres, weight)` for the voxels with hair around `p`;
    /// weights sum to at most 1.
    pub fn neighbours(&self, p: Vec3, mut take: impl FnMut(usize, f32)) {
        let (base, weights) = self.around(p);
        for (corner, weight) in weights.into_iter().enumerate() {
            let v = base + offset(corner);
            if self.inside(v) {
                let slot = self.slots[self.index(v)];
                if slot != NONE {
                    take(slot as usize, weight);
                }
            }
        }
    }

    /// Expected number of fibres crossed from `from` along the unit vector
    /// `direction`, stopping at `enough`.
    ///
    /// Walks voxel by voxel (Amanatides and Woo, 1987).
    pub fn depth(&self, from: Vec3, direction: Vec3, enough: f32) -> f32 {
        let origin = (from - self.low) / self.cell;
        let size = self.dims.as_vec3();
        let inverse = direction.map(|d| {
            if d.abs() < 1e-9 {
                1e9f32.copysign(d)
            } else {
                1.0 / d
            }
        });
        let (t0, t1) = (-origin * inverse, (size - origin) * inverse);
        let mut t = t0.min(t1).max_element().max(0.0);
        let end = t0.max(t1).min_element();
        if t >= end {
            return 0.0;
        }
        let start = (origin + direction * t).clamp(Vec3::ZERO, size - Vec3::splat(0.01));
        let mut voxel = start.as_ivec3();
        let step = direction.signum().as_ivec3();
        let ahead = step.max(glam::IVec3::ZERO);
        let mut next = ((voxel + ahead).as_vec3() - origin) * inverse;
        let per_voxel = inverse.abs();
        let limit = self.dims.as_ivec3();
        let mut depth = 0.0;
        while depth < enough {
            let axis = if next.x <= next.y && next.x <= next.z {
                0
            } else if next.y <= next.z {
                1
            } else {
                2
            };
            let leave = next[axis];
            depth +=
                self.extinction[self.index(voxel.as_uvec3())] * (leave - t).max(0.0) * self.cell;
            t = leave.max(t);
            voxel[axis] += step[axis];
            next[axis] += per_voxel[axis];
            if voxel[axis] < 0 || voxel[axis] >= limit[axis] {
                break;
            }
        }
        depth.min(enough)
    }
}

fn offset(corner: usize) -> UVec3 {
    let bit = |k: usize| (corner >> k & 1) as u32;
    UVec3::new(bit(0), bit(1), bit(2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{in_cone, point};

    /// Fibres of width 0.01 and length 0.1, at random in a unit cube.
    fn fog(count: u32) -> Cuts {
        let mut cuts = Cuts {
            starts: vec![0],
            ..Cuts::default()
        };
        for i in 0..count {
            let ([x, y], [z, _]) = (point(i, 1), point(i, 2));
            let d = in_cone(Vec3::Z, -1.0, point(i, 3)) * 0.1;
            cuts.places.push([x, y, z, 0.005]);
            cuts.places.push([x + d.x, y + d.y, z + d.z, 0.005]);
            cuts.looks.extend([[0.5, 0.5, 0.5, 1.0]; 2]);
            cuts.starts.push(cuts.places.len() as u32);
        }
        cuts
    }

    #[test]
    fn optical_depth_is_the_mean_number_of_fibres_crossed() {
        let cuts = fog(20_000);
        let grid = Density::new(&cuts, 32);
        let tree = crate::accel::CurveTree::new(&cuts, false);
        let (mut by_grid, mut by_rays) = (0.0, 0.0);
        for i in 0..600 {
            let [x, y] = point(i, 7);
            let from = Vec3::new(0.2 + 0.6 * x, 0.2 + 0.6 * y, 0.3);
            let direction = in_cone(Vec3::Z, 0.7, point(i, 8));
            let ray = crate::leaf::Ray::new(from, direction);
            by_grid += grid.depth(from, direction, 1e9);
            by_rays += tree.crossings(&cuts, &ray, 0.0, 0..0, 1e5);
        }
        let ratio = by_grid / by_rays;
        assert!((ratio - 1.0).abs() < 0.05, "grid to rays {ratio}");
    }

    #[test]
    fn rays_that_miss_the_grid_cross_nothing() {
        let grid = Density::new(&fog(100), 16);
        assert_eq!(grid.depth(Vec3::splat(9.0), Vec3::X, 1e9), 0.0);
        assert_eq!(grid.depth(Vec3::new(-3.0, 0.5, 0.5), -Vec3::X, 1e9), 0.0);
        assert!(grid.depth(Vec3::new(-3.0, 0.5, 0.5), Vec3::X, 1e9) > 0.0);
    }
}
