//! Cutting the triangles of a run.
//!
//! A triangle that is cut into a few parts has too little to do for a processor that does
//! sixteen things at once, so such triangles go side by side, as many as are cut equally deep.

use crate::Mesh;
use crate::density::DensityField;
use crate::part::{MAX_DEPTH, TABLE_DEPTH, Table, first_part};
use crate::subdivide::{Name, uvs};
use crate::sums::Run;
use crate::window::{Corners, LANES, Row, place};

/// Depth to which triangles are read side by side.
const SHALLOW: u32 = 2;

/// Most parts of those.
const FEW: usize = 1 << (2 * SHALLOW);

/// Density of a part whose parts have different ones.
const MIXED: f32 = f32::NAN;

/// Cuts the triangles of a run.
pub(crate) struct Cutter<'a, D, N> {
    pub mesh: &'a Mesh,
    pub density: &'a D,
    pub table: &'a Table,
    pub part_bits: u32,
    /// Densities of the parts of each depth.
    pub levels: [Vec<f32>; MAX_DEPTH as usize + 1],
    pub names: &'a mut [N],
    pub before: &'a mut [u64],
    pub run: Run,
}

impl<D: DensityField, N: Name> Cutter<'_, D, N> {
    /// Cuts `triangles`, each as often as `depths` tells.
    #[inline(always)]
    pub(crate) fn cut(&mut self, triangles: &[u32], depths: &[u8]) {
        let shallow = self.read_shallow(triangles, depths);
        for first in (0..triangles.len()).step_by(LANES) {
            let last = (first + LANES).min(triangles.len());
            let mut block = [triangles[first]; LANES];
            block[..last - first].copy_from_slice(&triangles[first..last]);
            let areas = self.mesh.areas(&block);
            for (k, area) in (first..last).zip(areas) {
                // A NaN has no area either.
                if area > 0.0 && area.is_finite() {
                    self.cut_one(triangles[k], depths[k] as u32, area, &shallow[k]);
                }
            }
        }
    }

    /// The densities at the centres of the parts of each of `triangles`, if they are few.
    #[inline(always)]
    fn read_shallow(&self, triangles: &[u32], depths: &[u8]) -> Vec<[f32; FEW]> {
        let mut densities = vec![[0.0; FEW]; triangles.len()];
        let mut equal = Vec::with_capacity(triangles.len());
        for depth in 0..=SHALLOW {
            equal.clear();
            for (k, &own) in depths.iter().enumerate() {
                if own as u32 == depth {
                    equal.push(k);
                }
            }
            for lanes in equal.chunks(LANES) {
                let mut corners = Corners::splat(uvs(self.mesh, triangles[lanes[0]]));
                for (lane, &k) in lanes.iter().enumerate() {
                    corners.set(lane, uvs(self.mesh, triangles[k]));
                }
                let centres = self.table.centres(depth);
                let mut rows: [Row; FEW] = [[0.0; LANES]; FEW];
                self.density
                    .read_all(&corners, centres, &mut rows[..centres.len()]);
                for (lane, &k) in lanes.iter().enumerate() {
                    for (density, row) in densities[k].iter_mut().zip(&rows) {
                        *density = row[lane];
                    }
                }
            }
        }
        densities
    }

    #[inline(always)]
    fn cut_one(&mut self, triangle: u32, depth: u32, area: f64, shallow: &[f32; FEW]) {
        match depth {
            0..=SHALLOW => {
                let level = &mut self.levels[depth as usize];
                level.clear();
                level.extend_from_slice(&shallow[..1 << (2 * depth)]);
            }
            _ => self.read(triangle, depth),
        }
        // What is less than nothing, or no number, is nothing too.
        for density in &mut self.levels[depth as usize] {
            *density = density.max(0.0);
        }
        let uncut = (0..depth)
            .rev()
            .find(|&d| !self.merge(d))
            .map_or(0, |d| d + 1);
        let weight = area * self.density.value() as f64;
        if uncut == depth {
            self.add_all(triangle, depth, weight);
        } else {
            // The parts above are all mixed.
            for part in 0..1 << (2 * uncut) {
                self.add(triangle, uncut, part, weight);
            }
        }
    }

    /// Reads the density at the centres of the parts of depth `depth`.
    #[inline(always)]
    fn read(&mut self, triangle: u32, depth: u32) {
        let uv = uvs(self.mesh, triangle);
        let level = &mut self.levels[depth as usize];
        level.resize(1 << (2 * depth), 0.0);
        let within = depth.min(TABLE_DEPTH);
        let bases = self.table.parts(depth - within);
        for (base, level) in bases.iter().zip(level.chunks_exact_mut(1 << (2 * within))) {
            let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
            let corners = corners.map(|[p, q]| place(uv, base.at(p, q)));
            let centres = self.table.centres(within);
            self.density.read(corners, centres, level);
        }
    }

    /// Gives the parts of depth `depth` the density that their four parts share, and
    /// tells whether any could be merged.
    #[inline(always)]
    fn merge(&mut self, depth: u32) -> bool {
        let (above, below) = self.levels.split_at_mut(depth as usize + 1);
        let (above, below) = (&mut above[depth as usize], below[0].as_chunks().0);
        let mut merged = false;
        above.resize(below.len(), 0.0);
        for (above, &[a, b, c, d]) in above.iter_mut().zip(below) {
            let same = (a == b) & (a == c) & (a == d);
            merged |= same;
            *above = if same { a } else { MIXED };
        }
        merged
    }

    /// Adds all parts of depth `depth` that have a density.
    #[inline(always)]
    fn add_all(&mut self, triangle: u32, depth: u32, weight: f64) {
        let share = weight / (1u64 << (2 * depth)) as f64;
        let first = first_part(depth) as u32;
        let Run { mut len, mut sum } = self.run;
        for (i, &density) in self.levels[depth as usize].iter().enumerate() {
            // Overwritten where it does not count.
            self.names[len] = N::new(triangle, first + i as u32, self.part_bits);
            self.before[len] = sum.to_bits();
            let weight = share * density as f64;
            len += (weight > 0.0) as usize;
            sum += weight;
        }
        self.run = Run { len, sum };
    }

    /// Adds the largest parts of one density in part `i` of depth `d`.
    fn add(&mut self, triangle: u32, d: u32, i: usize, weight: f64) {
        let density = self.levels[d as usize][i];
        if density.is_nan() {
            for child in 4 * i..4 * i + 4 {
                self.add(triangle, d + 1, child, weight);
            }
            return;
        }
        let weight = weight / (1u64 << (2 * d)) as f64 * density as f64;
        if weight > 0.0 {
            let part = (first_part(d) + i) as u32;
            self.names[self.run.len] = N::new(triangle, part, self.part_bits);
            self.before[self.run.len] = self.run.sum.to_bits();
            self.run.len += 1;
            self.run.sum += weight;
        }
    }
}
