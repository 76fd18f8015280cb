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
use crate::cut::{Cutter, Found};
use crate::density::DensityField;
use crate::lanes::LANES;
use crate::pages::Pages;
use crate::part::{MAX_DEPTH, Table};
use crate::sums::{PADDING, Run, Sums, divide};
use crate::window::Corners;
use bytemuck::{Pod, Zeroable};
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec2;
use rayon::prelude::*;
use std::ops::Range;

/// What a piece is called.
pub(crate) trait Name: Pod + Send + Sync {
    /// The name of part `part` of `triangle`, where parts have `part_bits` bits.
    fn new(triangle: u32, part: u32, part_bits: u32) -> Self;
}

/// Which part of which triangle a piece of constant density is.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
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
pub(crate) struct Cut<N> {
    pub names: Pages<N>,
    /// Of area times density.
    pub sums: Sums,
}

impl<N: Pod> Cut<N> {
    fn append(&mut self, other: Self) {
        self.sums.before.truncate(self.names.len());
        self.names.extend_from_slice(&other.names);
        self.sums.before.extend_from_slice(&other.sums.before);
        self.sums.runs.extend_from_slice(&other.sums.runs);
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
    /// In the order of the mesh.
    areas: Vec<f64>,
}

impl<'a, D: DensityField> Plan<'a, D> {
    pub(crate) fn new(mesh: &'a Mesh, order: &'a [u32], density: &'a D) -> Self {
        // In the order of the mesh its arrays are read one number after the other.
        let mut of_mesh = vec![0; order.len()];
        let mut areas = vec![0.0; order.len()];
        let level = Level::new();
        let runs = (of_mesh.par_chunks_mut(RUN), areas.par_chunks_mut(RUN));
        let runs = runs.into_par_iter().enumerate();
        runs.for_each(|(run, (depths, areas))| {
            dispatch!(level, simd => {
                let _ = simd;
                let rows = depths.chunks_mut(LANES).zip(areas.chunks_mut(LANES));
                for (row, (depths, areas)) in rows.enumerate() {
                    let first = run * RUN + row * LANES;
                    let all = depths_from(mesh, density, first);
                    depths.copy_from_slice(&all[..depths.len()]);
                    let all: [f64; LANES] = mesh.areas(first);
                    areas.copy_from_slice(&all[..areas.len()]);
                }
            })
        });
        let depth = |&triangle: &u32| of_mesh[triangle as usize];
        Self {
            mesh,
            density,
            order,
            depths: order.par_iter().with_min_len(RUN).map(depth).collect(),
            areas,
        }
    }

    /// How often a triangle is cut at most.
    pub(crate) fn deepest(&self) -> u32 {
        self.depths.iter().copied().max().unwrap_or(0) as u32
    }

    /// The pieces of all triangles, in their order.
    pub(crate) fn cut<N: Name>(&self, part_bits: u32) -> Cut<N> {
        let runs = self.runs();
        let mut batches = batches(&runs);
        let mut cut = self.cut_batch(batches.next().unwrap_or_default(), part_bits);
        for batch in batches {
            cut.append(self.cut_batch(batch, part_bits));
        }
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
        let mut names = Pages::zeroed(most);
        let mut before = Pages::zeroed(most + PADDING);
        let (table, level) = (Table::new(), Level::new());
        let names_of = divide(&mut names, rooms());
        let before_of = divide(&mut before, rooms());
        let runs = (batch, names_of, before_of).into_par_iter();
        let runs: Vec<Run> = runs
            .map(|(stretch, names, before)| {
                let mut cutter = Cutter {
                    mesh: self.mesh,
                    areas: &self.areas,
                    density: self.density,
                    table: &table,
                    levels: [const { Vec::new() }; MAX_DEPTH as usize + 1],
                    found: Found {
                        part_bits,
                        names,
                        before,
                        run: Run { len: 0, sum: 0.0 },
                    },
                };
                let range = || stretch.triangles.clone();
                let (triangles, depths) = (&self.order[range()], &self.depths[range()]);
                dispatch!(level, simd => {
                    let _ = simd;
                    cutter.cut(triangles, depths);
                });
                cutter.found.run
            })
            .collect();
        let len = close_up(&mut names, rooms(), &runs);
        names.truncate(len);
        close_up(&mut before, rooms(), &runs);
        before.truncate(len + PADDING);
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

/// Moves the runs, which had `rooms`, together, and tells how many there are of all.
fn close_up<T: Copy>(all: &mut [T], rooms: impl Iterator<Item = usize>, runs: &[Run]) -> usize {
    let (mut from, mut to) = (0, 0);
    for (room, run) in rooms.zip(runs) {
        if from != to {
            all.copy_within(from..from + run.len, to);
        }
        (from, to) = (from + room, to + run.len);
    }
    to
}

pub(crate) fn uvs(mesh: &Mesh, triangle: u32) -> [Vec2; 3] {
    let uv = mesh.uvs().get(triangle as usize);
    uv.copied().unwrap_or([Vec2::ZERO; 3])
}

/// Longest side a part may have, in texels, where its area alone would do: slivers of
/// texture are resolved along their length too.
const LONGEST: f32 = 4.0;

/// Depths of [`LANES`] triangles from `first` on; of the last where there are fewer.
#[inline(always)]
fn depths_from(mesh: &Mesh, density: &impl DensityField, first: usize) -> [u8; LANES] {
    let last = mesh.triangles().len() - 1;
    let (mut areas, mut lengths) = ([0.0; LANES], [0.0; LANES]);
    let mut corners = Corners::<LANES>::splat([Vec2::ZERO; 3]);
    let mut sizes = [Vec2::ZERO; LANES];
    for (lane, size) in sizes.iter_mut().enumerate() {
        let uv = uvs(mesh, (first + lane).min(last) as u32);
        // A triangle of one density is one without texels.
        let [width, height] = density.texels(uv).unwrap_or([0; 2]);
        *size = Vec2::new(width as f32, height as f32);
        corners.set(lane, uv);
    }
    for (lane, size) in sizes.into_iter().enumerate() {
        (areas[lane], lengths[lane]) = extent(corners.get(lane), size);
    }
    let mut depths = [0; LANES];
    for depth in 0..MAX_DEPTH {
        let side = (1u32 << depth) as f32;
        for lane in 0..LANES {
            // Whatever fits a depth fits those below; what is no number fits none.
            let fits = (areas[lane] <= side * side) & (lengths[lane] <= LONGEST * side);
            depths[lane] += !fits as u8;
        }
    }
    depths
}

/// Area and longest side, in texels, of a triangle of a map of `size` texels. It is to be cut
/// until a part covers at most one texel (document 004, eq. 2.3) and is not too long.
#[inline(always)]
fn extent(uv: [Vec2; 3], size: Vec2) -> (f32, f32) {
    let [a, b, c] = uv.map(|p| p * size);
    let area = (b - a).perp_dot(c - a).abs() / 2.0;
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    (area, longest)
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
        let len = close_up(&mut all, rooms.into_iter(), &[run(2), run(1), run(3)]);
        assert_eq!(all[..len], [1, 2, 3, 4, 5, 6]);
    }

    #[test]
    fn a_triangle_is_cut_until_a_part_covers_a_texel_and_no_further() {
        use crate::{ImageMap, Wrap, fixture::sheet};
        let mesh = sheet(5);
        for size in [1, 4, 5, 6, 40, 300] {
            let texels = vec![0u8; (size * size) as usize];
            let map = ImageMap::new(size, size, 1, texels, true).unwrap();
            let density = crate::Density {
                value: 1.0,
                map: Some((&map, 0, Wrap::Repeat)),
            };
            // A square of the sheet has two triangles.
            let texels = (size * size) as f32 / 25.0 / 2.0;
            for depth in depths_from(&mesh, &density, 0) {
                let of_depth = |depth: u8| texels / (1u32 << (2 * depth)) as f32;
                assert!(of_depth(depth) <= 1.0 + 1e-4, "{size}");
                assert!(depth == 0 || of_depth(depth - 1) > 1.0 - 1e-4, "{size}");
            }
        }
    }
}
