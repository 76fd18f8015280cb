//! Triangles cut until a density map is constant on each piece.
//!
//! Source: document 004, section 2.1.4. A triangle is cut into four by its edge
//! midpoints, again and again, until a piece covers at most one texel; four pieces of
//! equal density are merged again.
//!
//! How deep a triangle will be cut is known before the map is read, and so is the most
//! that can come of it. So all pieces get their places at once, and each is written once,
//! in the form in which it stays; only where some were merged or left out the others
//! close up.

use crate::Mesh;
use crate::density::DensityField;
use crate::part::{MAX_DEPTH, TABLE_DEPTH, Table, first_part};
use crate::sums::{PADDING, Run, Sums, divide};
use crate::window::place;
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec2;
use rayon::prelude::*;
use std::ops::Range;

/// What a piece is called.
pub(crate) trait Name: Copy + Default + Send {
    /// The name of part `part` of `triangle`, where parts have `part_bits` bits.
    fn new(triangle: u32, part: u32, part_bits: u32) -> Self;
}

/// Which part of which triangle a piece of constant density is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Piece {
    pub triangle: u32,
    pub part: u32,
}

impl Name for Piece {
    #[inline(always)]
    fn new(triangle: u32, part: u32, _: u32) -> Self {
        Self { triangle, part }
    }
}

/// Both in one word.
impl Name for u32 {
    #[inline(always)]
    fn new(triangle: u32, part: u32, part_bits: u32) -> Self {
        triangle << part_bits | part
    }
}

/// The pieces of a surface, without those of density zero.
#[derive(Default)]
pub(crate) struct Cut<N> {
    pub names: Vec<N>,
    /// Of area times density.
    pub sums: Sums,
}

impl<N: Copy> Cut<N> {
    fn append(&mut self, other: Self) {
        if self.names.is_empty() {
            *self = other;
        } else {
            self.names.extend_from_slice(&other.names);
            self.sums.before.extend_from_slice(&other.sums.before);
            self.sums.runs.extend_from_slice(&other.sums.runs);
        }
    }
}

/// Triangles in a run: enough to share what it costs to begin one.
const RUN: usize = 256;

/// Pieces after which a run takes no more triangles.
const DEEP: usize = 1 << 20;

/// Most pieces that get their places at once, unless one run has more: a map that repeats
/// often over few triangles has far more texels than pieces are left.
const BATCH: usize = 1 << 24;

/// Triangles in the order in which they are to be cut, and how often each is.
pub(crate) struct Plan<'a, D> {
    mesh: &'a Mesh,
    density: &'a D,
    order: &'a [u32],
    depths: Vec<u8>,
}

impl<'a, D: DensityField> Plan<'a, D> {
    pub(crate) fn new(mesh: &'a Mesh, order: &'a [u32], density: &'a D) -> Self {
        let depth = |&triangle: &u32| {
            let uv = uvs(mesh, triangle);
            density.texels(uv).map_or(0, |size| depth_for(uv, size))
        };
        Self {
            mesh,
            density,
            order,
            depths: order.par_iter().with_min_len(RUN).map(depth).collect(),
        }
    }

    /// How often a triangle is cut at most.
    pub(crate) fn deepest(&self) -> u32 {
        self.depths.iter().copied().max().unwrap_or(0) as u32
    }

    /// The pieces of all triangles, in their order.
    pub(crate) fn cut<N: Name>(&self, part_bits: u32) -> Cut<N> {
        let runs = self.runs();
        let mut cut = Cut::default();
        for batch in batches(&runs) {
            cut.append(self.cut_batch(batch, part_bits));
        }
        cut.sums.before.resize(cut.names.len() + PADDING, 0);
        cut
    }

    /// What is cut by one task each.
    fn runs(&self) -> Vec<Stretch> {
        let mut runs: Vec<Stretch> = Vec::new();
        for (k, &depth) in self.depths.iter().enumerate() {
            let room = 1 << (2 * depth);
            match runs.last_mut() {
                Some(run) if run.triangles.len() < RUN && run.room < DEEP => {
                    run.triangles.end += 1;
                    run.room += room;
                }
                _ => runs.push(Stretch {
                    triangles: k..k + 1,
                    room,
                }),
            }
        }
        runs
    }

    fn cut_batch<N: Name>(&self, batch: &[Stretch], part_bits: u32) -> Cut<N> {
        let rooms = || batch.iter().map(|run| run.room);
        let most = rooms().sum();
        let mut names = vec![N::default(); most];
        let mut before = vec![0; most + PADDING];
        let (table, level) = (Table::new(), Level::new());
        let names_of = divide(&mut names, rooms());
        let before_of = divide(&mut before, rooms());
        let runs = (batch, names_of, before_of).into_par_iter();
        let runs: Vec<Run> = runs
            .map(|(stretch, names, before)| {
                let mut cutter = Cutter {
                    plan: self,
                    table: &table,
                    levels: [const { Vec::new() }; MAX_DEPTH as usize + 1],
                    part_bits,
                    names,
                    before,
                    run: Run { len: 0, sum: 0.0 },
                };
                dispatch!(level, simd => {
                    let _ = simd;
                    for k in stretch.triangles.clone() {
                        cutter.cut(self.order[k], self.depths[k] as u32);
                    }
                });
                cutter.run
            })
            .collect();
        close_up(&mut names, rooms(), &runs);
        close_up(&mut before, rooms(), &runs);
        Cut {
            names,
            sums: Sums { before, runs },
        }
    }
}

/// Triangles that follow each other, and the most pieces they can become.
struct Stretch {
    triangles: Range<usize>,
    room: usize,
}

/// Runs that are cut at once.
fn batches(runs: &[Stretch]) -> impl Iterator<Item = &[Stretch]> {
    let mut left = runs;
    std::iter::from_fn(move || {
        let mut room = 0;
        let fits = |run: &&Stretch| {
            room += run.room;
            room <= BATCH
        };
        let count = left.iter().take_while(fits).count().max(1);
        let (batch, later) = left.split_at_checked(count)?;
        left = later;
        Some(batch)
    })
}

/// Moves the runs, which had `rooms`, together, and leaves room for [`PADDING`].
fn close_up<T: Copy>(all: &mut Vec<T>, rooms: impl Iterator<Item = usize>, runs: &[Run]) {
    let (mut from, mut to) = (0, 0);
    for (room, run) in rooms.zip(runs) {
        if from != to {
            all.copy_within(from..from + run.len, to);
        }
        (from, to) = (from + room, to + run.len);
    }
    all.truncate(to);
    all.shrink_to(to + PADDING);
}

fn uvs(mesh: &Mesh, triangle: u32) -> [Vec2; 3] {
    let uv = mesh.uvs().get(triangle as usize);
    uv.copied().unwrap_or([Vec2::ZERO; 3])
}

/// Density of a part whose parts have different ones.
const MIXED: f32 = f32::NAN;

/// Cuts the triangles of a run.
struct Cutter<'a, D, N> {
    plan: &'a Plan<'a, D>,
    table: &'a Table,
    /// Densities of the parts of each depth.
    levels: [Vec<f32>; MAX_DEPTH as usize + 1],
    part_bits: u32,
    names: &'a mut [N],
    before: &'a mut [u64],
    run: Run,
}

impl<D: DensityField, N: Name> Cutter<'_, D, N> {
    #[inline(always)]
    fn cut(&mut self, triangle: u32, depth: u32) {
        let area = self.plan.mesh.area(triangle as usize);
        // A NaN has no area either.
        let has_area = area > 0.0 && area.is_finite();
        if !has_area {
            return;
        }
        self.sample(triangle, depth);
        let uncut = (0..depth)
            .rev()
            .find(|&d| !self.merge(d))
            .map_or(0, |d| d + 1);
        let weight = area * self.plan.density.value() as f64;
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
    fn sample(&mut self, triangle: u32, depth: u32) {
        let uv = uvs(self.plan.mesh, triangle);
        let level = &mut self.levels[depth as usize];
        level.resize(1 << (2 * depth), 0.0);
        let within = depth.min(TABLE_DEPTH);
        let bases = self.table.parts(depth - within);
        for (base, level) in bases.iter().zip(level.chunks_exact_mut(1 << (2 * within))) {
            let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
            let corners = corners.map(|[p, q]| place(uv, base.at(p, q)));
            self.plan
                .density
                .read(corners, self.table.centres(within), level);
        }
        // What is less than nothing, or no number, is nothing too.
        for density in level {
            *density = density.max(0.0);
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

/// Longest side a part may have, in texels, where its area alone would do: slivers of
/// texture are resolved along their length too.
const LONGEST: f32 = 4.0;

/// Least depth at which a part covers at most one texel (document 004, eq. 2.3).
#[inline(always)]
fn depth_for(uv: [Vec2; 3], [width, height]: [u32; 2]) -> u8 {
    let texel = |p: Vec2| p * Vec2::new(width as f32, height as f32);
    let [a, b, c] = uv.map(texel);
    let area = (b - a).perp_dot(c - a).abs() / 2.0;
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    let depths = 0..MAX_DEPTH as u8;
    let fits = |d: &u8| {
        let side = (1u32 << d) as f32;
        area <= side * side && longest <= LONGEST * side
    };
    depths.into_iter().find(fits).unwrap_or(MAX_DEPTH as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_are_all_runs_in_order_and_no_larger_than_they_may_be() {
        let rooms = [5, BATCH - 5, 1, 3 * BATCH, BATCH / 2, BATCH / 2, BATCH];
        let run = |(k, &room): (usize, &usize)| Stretch {
            triangles: k..k + 1,
            room,
        };
        let runs: Vec<Stretch> = rooms.iter().enumerate().map(run).collect();
        let counts: Vec<usize> = batches(&runs).map(|batch| batch.len()).collect();
        assert_eq!(counts, [2, 1, 1, 2, 1]);
        assert_eq!(batches(&[]).count(), 0);
    }

    #[test]
    fn what_is_left_of_runs_closes_up() {
        let run = |len| Run { len, sum: 1.0 };
        let mut all = vec![1, 2, 0, 3, 0, 0, 4, 5, 6, 7];
        let rooms = [3, 3, 3];
        close_up(&mut all, rooms.into_iter(), &[run(2), run(1), run(3)]);
        assert_eq!(all, [1, 2, 3, 4, 5, 6]);
    }
}
