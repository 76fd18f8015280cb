//! Cutting the triangles of a run.
//!
//! A triangle that is cut into a few parts has too little to do for a processor that does
//! sixteen things at once, so such triangles go side by side, as many as are cut equally deep.

use crate::Mesh;
use crate::density::DensityField;
use crate::lanes::LANES;
use crate::part::{MAX_DEPTH, TABLE_DEPTH, Table, first_part};
use crate::subdivide::{Name, uvs};
use crate::sums::Run;
use crate::window::{Corners, Row, place};
use pelage_curves::Vec2;

/// Depth to which triangles are read side by side.
const SHALLOW: u32 = 2;

/// Most parts of those: as many as there are lanes.
const FEW: usize = 1 << (2 * SHALLOW);

/// Density of a part whose parts have different ones.
const MIXED: f32 = f32::NAN;

/// Cuts the triangles of a run.
pub(crate) struct Cutter<'a, D, N> {
    pub mesh: &'a Mesh,
    /// Of all triangles of the mesh.
    pub areas: &'a [f64],
    pub density: &'a D,
    pub table: &'a Table,
    /// Densities of the parts of each depth.
    pub levels: [Vec<f32>; MAX_DEPTH as usize + 1],
    pub found: Found<'a, N>,
}

/// The pieces of a run, as far as they have been found.
pub(crate) struct Found<'a, N> {
    pub part_bits: u32,
    pub names: &'a mut [N],
    pub before: &'a mut [u64],
    pub run: Run,
}

/// What is known of a triangle of few parts.
#[derive(Clone, Copy)]
struct Shallow {
    /// At the centres of the parts.
    densities: [f32; FEW],
    /// Whether four parts are of one density.
    merges: bool,
}

impl<D: DensityField, N: Name> Cutter<'_, D, N> {
    /// Cuts `triangles`, each as often as `depths` tells.
    #[inline(always)]
    pub(crate) fn cut(&mut self, triangles: &[u32], depths: &[u8]) {
        // Triangles along the curve lie far apart in memory. With nothing to do between two
        // readings, processors wait for many at once.
        let mut corners = vec![[Vec2::ZERO; 3]; triangles.len()];
        for (corners, &triangle) in corners.iter_mut().zip(triangles) {
            *corners = uvs(self.mesh, triangle);
        }
        let shallow = self.read_shallow(&corners, depths);
        for ((&triangle, &depth), shallow) in triangles.iter().zip(depths).zip(&shallow) {
            let area = self.areas[triangle as usize];
            // A NaN has no area either.
            if area > 0.0 && area.is_finite() {
                self.cut_one(triangle, depth as u32, area, shallow);
            }
        }
    }

    /// What there is to know of those of `triangles` of texture space that are cut into few
    /// parts.
    #[inline(always)]
    fn read_shallow(&self, triangles: &[[Vec2; 3]], depths: &[u8]) -> Vec<Shallow> {
        let none = Shallow {
            densities: [0.0; FEW],
            merges: false,
        };
        let mut shallow = vec![none; triangles.len()];
        let mut equal = Vec::with_capacity(triangles.len());
        for depth in 0..=SHALLOW {
            equal.clear();
            for (k, &own) in depths.iter().enumerate() {
                if own as u32 == depth {
                    equal.push(k);
                }
            }
            for lanes in equal.chunks(LANES) {
                self.read_lanes(triangles, depth, lanes, &mut shallow);
            }
        }
        shallow
    }

    /// The same for the few of `triangles` that have the indices `lanes`, all of one depth.
    #[inline(always)]
    fn read_lanes(
        &self,
        triangles: &[[Vec2; 3]],
        depth: u32,
        lanes: &[usize],
        shallow: &mut [Shallow],
    ) {
        let mut corners = Corners::splat(triangles[lanes[0]]);
        for (lane, &k) in lanes.iter().enumerate() {
            corners.set(lane, triangles[k]);
        }
        let centres = self.table.centres(depth);
        let mut rows: [Row; LANES] = [[0.0; LANES]; LANES];
        match centres.first_chunk() {
            Some(centres) => self.density.read_each(&corners, centres, &mut rows),
            None => {
                let mut across: [Row; LANES] = [[0.0; LANES]; LANES];
                let read = &mut across[..centres.len()];
                self.density.read_all(&corners, centres, read);
                for (centre, read) in read.iter().enumerate() {
                    for lane in 0..LANES {
                        rows[lane][centre] = read[lane];
                    }
                }
            }
        }
        for (&k, row) in lanes.iter().zip(&rows) {
            let shallow = &mut shallow[k];
            for (density, &read) in shallow.densities.iter_mut().zip(row) {
                *density = sound(read);
            }
            let parts = &shallow.densities[..centres.len()];
            for four in parts.as_chunks().0 {
                shallow.merges |= are_one(four);
            }
        }
    }

    #[inline(always)]
    fn cut_one(&mut self, triangle: u32, depth: u32, area: f64, shallow: &Shallow) {
        let weight = area * self.density.value() as f64;
        if depth <= SHALLOW {
            let densities = &shallow.densities;
            let all = &densities[..1 << (2 * depth)];
            return match shallow.merges {
                false => self.found.add_all(triangle, depth, all, weight),
                true if all.iter().all(|d| *d == all[0]) => {
                    self.found.add_all(triangle, 0, &all[..1], weight)
                }
                true => self.found.add_merged(triangle, depth, 0, densities, weight),
            };
        }
        self.read(triangle, depth);
        let uncut = (0..depth)
            .rev()
            .find(|&d| !self.merge(d))
            .map_or(0, |d| d + 1);
        if uncut == depth {
            let densities = &self.levels[depth as usize];
            self.found.add_all(triangle, depth, densities, weight);
        } else {
            // The parts above are all mixed.
            let (levels, first) = (&self.levels[..=depth as usize], uncut.min(depth - SHALLOW));
            for part in 0..1 << (2 * first) {
                self.found.add(levels, triangle, first, part, weight);
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
        for density in level {
            *density = sound(*density);
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
        for (above, four) in above.iter_mut().zip(below) {
            let same = are_one(four);
            merged |= same;
            *above = if same { four[0] } else { MIXED };
        }
        merged
    }
}

impl<N: Name> Found<'_, N> {
    /// Adds all parts of depth `depth` that have a density.
    #[inline(always)]
    fn add_all(&mut self, triangle: u32, depth: u32, densities: &[f32], weight: f64) {
        let share = weight / (1u64 << (2 * depth)) as f64;
        let first = first_part(depth) as u32;
        let parts = densities.iter().zip(first..);
        self.extend(
            triangle,
            parts.map(|(&density, part)| (part, share * density as f64)),
        );
    }

    /// Adds the [`FEW`] parts of depth `depth` in part `block` of the depth [`SHALLOW`] above;
    /// four of one density make one, but not all do.
    #[inline(always)]
    fn add_merged(
        &mut self,
        triangle: u32,
        depth: u32,
        block: usize,
        densities: &[f32; FEW],
        weight: f64,
    ) {
        let own = first_part(depth) + FEW * block;
        let above = first_part(depth - 1) + FEW / 4 * block;
        let share = weight / (1u64 << (2 * depth)) as f64;
        let mut parts = [(0, 0.0); FEW];
        let fours = parts.as_chunks_mut().0.iter_mut();
        for (i, (parts, four)) in fours.zip(densities.as_chunks().0).enumerate() {
            // Three of four weigh nothing where one stands for all: there is nothing to guess.
            let (first, step, times, others) = match are_one(four) {
                true => (above + i, 0, 4.0, 0.0),
                false => (own + 4 * i, 1, 1.0, 1.0),
            };
            let parts: &mut [_; 4] = parts;
            for (k, (part, &density)) in parts.iter_mut().zip(four).enumerate() {
                let times = if k == 0 { times } else { others };
                *part = ((first + step * k) as u32, share * times * density as f64);
            }
        }
        self.extend(triangle, parts.into_iter());
    }

    /// Adds parts of a triangle with their weights, if they have any.
    #[inline(always)]
    fn extend(&mut self, triangle: u32, parts: impl Iterator<Item = (u32, f64)>) {
        let Run { mut len, mut sum } = self.run;
        // In memory of their own the compiler would look for all of these again for each part.
        let (part_bits, names, before) = (self.part_bits, &mut *self.names, &mut *self.before);
        for (part, weight) in parts {
            // Overwritten where it does not count.
            names[len] = N::new(triangle, part, part_bits);
            before[len] = sum.to_bits();
            len += (weight > 0.0) as usize;
            sum += weight;
        }
        self.run = Run { len, sum };
    }

    /// Adds the largest parts of one density in part `i` of depth `d`, of the densities
    /// `levels`, the last of which are read.
    fn add(&mut self, levels: &[Vec<f32>], triangle: u32, d: u32, i: usize, weight: f64) {
        let density = levels[d as usize][i];
        let deepest = levels.len() as u32 - 1;
        if !density.is_nan() {
            let share = weight / (1u64 << (2 * d)) as f64;
            let part = (first_part(d) + i) as u32;
            self.extend(triangle, std::iter::once((part, share * density as f64)));
        } else if d + SHALLOW == deepest {
            let densities = &levels[deepest as usize].as_chunks().0[i];
            self.add_merged(triangle, deepest, i, densities, weight);
        } else {
            for child in 4 * i..4 * i + 4 {
                self.add(levels, triangle, d + 1, child, weight);
            }
        }
    }
}

/// Whether four parts are of one density, which no mixed one is.
#[inline(always)]
fn are_one([a, b, c, d]: &[f32; 4]) -> bool {
    (a == b) & (a == c) & (a == d)
}

/// A density; what is less than nothing, or no number, is nothing too.
#[inline(always)]
fn sound(density: f32) -> f32 {
    density.max(0.0)
}
