//! Many roots by their index, at the speed of reading the tables in order.
//!
//! Consecutive hairs lie as far apart on the surface as they can, so drawing them one
//! after the other waits for memory at every step. But all hairs whose indices agree in
//! the lower k bits share the first k bits of their first number (see
//! [`RootSequence`](crate::RootSequence)): they are neighbours. A block of hairs is
//! therefore drawn in tiles. A tile row is [`ROWS`] such neighbours, whose tables lie
//! within a few kilobytes; its columns are hairs that follow each other, so that a tile
//! is copied out in runs. What is drawn for a hair does not depend on the tiles.
//!
//! Where the order is of no matter, the runs of neighbours are drawn as they come along
//! the surface.

use crate::drawing::{BATCH, Scratch};
use crate::lanes::LANES;
use crate::neighbours::FEW;
use crate::runs::Run;
use crate::{RootSampler, SurfacePoint};
use fearless_simd::{Level, Simd, dispatch};
use std::ops::Range;

/// Neighbours in a row of a tile: enough that waiting for a row's first tables is little
/// beside drawing it.
const ROWS: usize = 512;

/// Batches of a row of a tile.
const BATCHES: usize = ROWS / BATCH;

/// Runs of an interval that are listed before they are drawn.
const RUNS: usize = 256;

/// Hairs that follow each other in a tile; with roots of 16 bytes, runs of 512 bytes.
const RUN: usize = 32;

/// Roots in a line of the cache: so many columns are drawn in turn for each batch, so
/// that a line of the tile is filled while it is in the first-level cache.
const LINE: usize = 4;

/// A tile's rows are padded, since rows a power of two apart would share cache sets.
const ROW: usize = RUN + 4;

/// Largest block, as a power of two: more would gain little, as its rows already read
/// the tables almost in order.
const LARGEST: u32 = 22;

impl RootSampler {
    /// Appends the roots of `hairs` to `roots`, in the order of their indices.
    ///
    /// Large ranges that start at multiples of large powers of two are fastest.
    pub fn roots(&self, hairs: Range<u64>, roots: &mut Vec<SurfacePoint>) {
        let count = hairs.end.saturating_sub(hairs.start) as usize;
        let before = roots.len();
        roots.resize(before + count, SurfacePoint::default());
        self.fill(hairs.start, &mut roots[before..]);
    }

    /// Writes the roots of the hairs from `first` on to `roots`.
    pub fn fill(&self, first: u64, roots: &mut [SurfacePoint]) {
        dispatch!(Level::new(), simd => {
            self.fill_blocks(simd, first, roots)
        });
    }

    /// Calls `visit` with those of `hairs` whose first number lies in `low..high` (`high` up
    /// to 2^64) and their roots, a few at a time, in the order of the surface: the fastest way
    /// where the order of the hairs is of no matter.
    pub fn roots_in(
        &self,
        low: u64,
        high: u128,
        hairs: Range<u64>,
        visit: impl FnMut(&[u64], &[SurfacePoint]),
    ) {
        self.roots_in_runs([low as u128, high], hairs, BATCH as u64, visit);
    }

    /// The same, where among so many that follow each other the order may be any: the fewer,
    /// the nearer they are, and the more there is to list.
    pub(crate) fn roots_in_runs(
        &self,
        interval: [u128; 2],
        hairs: Range<u64>,
        most: u64,
        mut visit: impl FnMut(&[u64], &[SurfacePoint]),
    ) {
        let mut room = Room::new();
        let mut drawn = room.drawn();
        self.each_runs(interval, hairs, most, |runs| {
            dispatch!(Level::new(), simd => self.draw_runs(simd, runs, &mut drawn, &mut visit));
            drawn.pass_to(&mut visit);
        });
    }

    /// Writes those of `hairs` whose first number lies in `low..high` to `indices`, and their
    /// roots to `roots`, in the order of [`roots_in`](Self::roots_in); to memory that is far
    /// this is faster than to copy them there. Gives how many there are; those for which there
    /// is no room in both are left out.
    ///
    /// ```
    /// use pelage_surface::{Density, Mesh, PolygonMesh, RootSampler, SurfacePoint};
    /// let sheet = Mesh::new(PolygonMesh::sheet(8, 8, |u, v| [u, v, 0.0])).unwrap();
    /// let even = Density { value: 1.0, map: None };
    /// let sampler = RootSampler::new(&sheet, &even, 1).unwrap();
    /// let (mut hairs, mut roots) = ([0; 60], [SurfacePoint::default(); 60]);
    /// let count = sampler.fill_in(0, 1 << 63, 0..100, &mut hairs, &mut roots);
    /// assert_eq!(count, 50);
    /// assert_eq!(roots[7], sampler.root(hairs[7]));
    /// ```
    pub fn fill_in(
        &self,
        low: u64,
        high: u128,
        hairs: Range<u64>,
        indices: &mut [u64],
        roots: &mut [SurfacePoint],
    ) -> usize {
        let places = indices.len().min(roots.len());
        let mut direct = Drawn::into(&mut indices[..places], &mut roots[..places]);
        let mut room = Room::new();
        let mut drawn = room.drawn();
        let mut count = 0;
        self.each_runs([low as u128, high], hairs, BATCH as u64, |runs| {
            // Drawing in place writes beyond the last root; what comes near the end is copied.
            let fits = |run: &Run| {
                let fits = count + BATCH + LANES <= places;
                count += run.count as usize;
                fits
            };
            let in_place = runs.iter().map(fits).filter(|&fits| fits).count();
            let (now, last) = runs.split_at(in_place);
            dispatch!(Level::new(), simd => {
                self.draw_runs(simd, now, &mut direct, &mut |_, _| {});
            });
            let mut copy = |hairs: &[u64], roots: &[SurfacePoint]| direct.append(hairs, roots);
            dispatch!(Level::new(), simd => self.draw_runs(simd, last, &mut drawn, &mut copy));
            drawn.pass_to(&mut copy);
        });
        count
    }

    /// Calls `visit` with the runs of an interval, many at a time: drawing is compiled for the
    /// processor at hand, and what lists them is not.
    fn each_runs(
        &self,
        interval: [u128; 2],
        hairs: Range<u64>,
        most: u64,
        mut visit: impl FnMut(&[Run]),
    ) {
        let mut runs = Vec::with_capacity(RUNS);
        self.sequence().runs_in(interval, hairs, most, &mut |run| {
            runs.push(run);
            if runs.len() == RUNS {
                visit(&runs);
                runs.clear();
            }
        });
        visit(&runs);
    }

    #[inline(always)]
    fn draw_runs<S: Simd>(
        &self,
        simd: S,
        runs: &[Run],
        drawn: &mut Drawn,
        visit: &mut impl FnMut(&[u64], &[SurfacePoint]),
    ) {
        for run in runs {
            if drawn.hairs.len() < drawn.listed + BATCH + LANES {
                self.draw_listed(simd, drawn);
                drawn.pass_to(visit);
            }
            let (start, count) = (drawn.listed, run.count as usize);
            let end = start + count.next_multiple_of(LANES);
            run.write(simd, &mut drawn.hairs[start..end]);
            if start + count > drawn.drawn + BATCH {
                self.draw_listed(simd, drawn);
            }
            drawn.listed += count;
            // Runs that lie in many pieces wait until they are a batch; what comes after them
            // fills it up.
            let room = (&drawn.hairs[start..end], &mut drawn.roots[start..end]);
            if start == drawn.drawn && self.draw_near(simd, run, room, &mut drawn.scratch.few) {
                drawn.drawn = drawn.listed;
            }
        }
        self.draw_listed(simd, drawn);
    }

    /// Draws those hairs that are listed and not yet drawn.
    #[inline(always)]
    fn draw_listed<S: Simd>(&self, simd: S, drawn: &mut Drawn) {
        let (start, end) = (drawn.drawn, drawn.listed);
        let end = start + (end - start).next_multiple_of(LANES);
        let (hairs, roots) = (&drawn.hairs[start..end], &mut drawn.roots[start..end]);
        if start < end {
            self.draw(simd, hairs, roots, &mut drawn.scratch);
        }
        drawn.drawn = drawn.listed;
    }

    /// Draws the roots of `run`, [`BATCH`] at most, and gives them.
    #[inline(always)]
    fn draw_run<'a, S: Simd>(
        &self,
        simd: S,
        run: &Run,
        drawn: &'a mut Drawn<'_>,
    ) -> &'a [SurfacePoint] {
        let padded = (run.count as usize).next_multiple_of(LANES);
        let (hairs, roots) = (&mut drawn.hairs[..padded], &mut drawn.roots[..padded]);
        run.write(simd, hairs);
        if !self.draw_near(simd, run, (hairs, roots), &mut drawn.scratch.few) {
            self.draw(simd, hairs, roots, &mut drawn.scratch);
        }
        &drawn.roots[..run.count as usize]
    }

    #[inline(always)]
    fn fill_blocks<S: Simd>(&self, simd: S, mut first: u64, mut roots: &mut [SurfacePoint]) {
        let (mut tile, mut room) = (Vec::new(), Room::new());
        let mut drawn = room.drawn();
        while !roots.is_empty() {
            let block = largest_block(first, roots.len());
            let (now, later) = roots.split_at_mut(block);
            if block >= ROWS * RUN {
                tile.resize(ROWS * ROW, SurfacePoint::default());
                self.fill_tiles(simd, first, now, (&mut tile, &mut drawn));
            } else {
                self.fill_in_order(simd, first, now, &mut drawn);
            }
            first += block as u64;
            roots = later;
        }
    }

    #[inline(always)]
    fn fill_tiles<S: Simd>(
        &self,
        simd: S,
        first: u64,
        roots: &mut [SurfacePoint],
        (tile, drawn): (&mut [SurfacePoint], &mut Drawn),
    ) {
        let stride = roots.len() / ROWS;
        for start in (0..stride).step_by(RUN) {
            for columns in (0..RUN).step_by(LINE) {
                let hair = first + (start + columns) as u64;
                self.fill_line(simd, hair, stride as u64, (&mut tile[columns..], drawn));
            }
            for (k, run) in tile.chunks_exact(ROW).enumerate() {
                roots[k * stride + start..][..RUN].copy_from_slice(&run[..RUN]);
            }
        }
    }

    /// Fills the first [`LINE`] columns of `tile`: the rows of hairs that are `stride` apart,
    /// from `first` on.
    #[inline(always)]
    fn fill_line<S: Simd>(
        &self,
        simd: S,
        first: u64,
        stride: u64,
        (tile, drawn): (&mut [SurfacePoint], &mut Drawn),
    ) {
        let mut near = true;
        for column in 0..LINE as u64 {
            let bits = stride.trailing_zeros();
            near &= self.are_neighbours(first + column, bits, (FEW * BATCHES) as u32);
        }
        // Where a row lies in few pieces, each batch takes hairs as near as can be, which lie
        // in fewer; elsewhere each takes some of everywhere, so that the first waits for the
        // tables of all.
        let (step, next) = if near { (BATCHES, 1) } else { (1, BATCH) };
        for number in 0..BATCHES {
            let row = number * next;
            for column in 0..LINE {
                let first = first + column as u64 + row as u64 * stride;
                let run = Run {
                    first,
                    step: step as u64 * stride,
                    count: BATCH as u64,
                    number: self.sequence().sample(first).0,
                };
                let rows = tile[row * ROW..].chunks_mut(step * ROW);
                for (row, root) in rows.zip(self.draw_run(simd, &run, drawn)) {
                    row[column] = *root;
                }
            }
        }
    }

    #[inline(always)]
    fn fill_in_order<S: Simd>(
        &self,
        simd: S,
        first: u64,
        roots: &mut [SurfacePoint],
        drawn: &mut Drawn,
    ) {
        let mut run = Run {
            first,
            step: 1,
            count: BATCH as u64,
            number: 0,
        };
        for roots in roots.chunks_mut(BATCH) {
            run.count = roots.len() as u64;
            roots.copy_from_slice(self.draw_run(simd, &run, drawn));
            run.first = run.first.wrapping_add(BATCH as u64);
        }
    }
}

/// Hairs that were listed, and the roots of the first of them.
struct Drawn<'a> {
    hairs: &'a mut [u64],
    roots: &'a mut [SurfacePoint],
    listed: usize,
    /// How many roots are drawn.
    drawn: usize,
    scratch: Scratch,
}

impl<'a> Drawn<'a> {
    /// What is drawn is written to both of one length.
    fn into(hairs: &'a mut [u64], roots: &'a mut [SurfacePoint]) -> Self {
        Self {
            hairs,
            roots,
            listed: 0,
            drawn: 0,
            scratch: Scratch::new(),
        }
    }

    #[inline(always)]
    fn pass_to(&mut self, visit: &mut impl FnMut(&[u64], &[SurfacePoint])) {
        if self.drawn > 0 {
            visit(&self.hairs[..self.drawn], &self.roots[..self.drawn]);
            (self.listed, self.drawn) = (0, 0);
        }
    }

    /// Adds what was drawn elsewhere, as far as there is room.
    fn append(&mut self, hairs: &[u64], roots: &[SurfacePoint]) {
        let count = hairs.len().min(self.hairs.len() - self.drawn);
        let end = self.drawn + count;
        self.hairs[self.drawn..end].copy_from_slice(&hairs[..count]);
        self.roots[self.drawn..end].copy_from_slice(&roots[..count]);
        (self.listed, self.drawn) = (end, end);
    }
}

/// Where what is drawn waits to be passed on.
struct Room {
    hairs: [u64; ROOM],
    roots: [SurfacePoint; ROOM],
}

/// Two batches, and what fills up the last row.
const ROOM: usize = 2 * BATCH + LANES;

impl Room {
    fn new() -> Self {
        Self {
            hairs: [0; ROOM],
            roots: [SurfacePoint::default(); ROOM],
        }
    }

    fn drawn(&mut self) -> Drawn<'_> {
        Drawn::into(&mut self.hairs, &mut self.roots)
    }
}

/// Hairs of the largest block that starts at `first` and has at most `count`: a power
/// of two that divides `first`; where that is too small for tiles, all hairs up to the
/// next larger block.
fn largest_block(first: u64, count: usize) -> usize {
    let fits = 1usize << count.ilog2().min(LARGEST);
    let aligned = 1usize << first.trailing_zeros().min(LARGEST);
    let block = fits.min(aligned);
    let smallest = ROWS * RUN;
    if block >= smallest {
        return block;
    }
    match first as usize % smallest {
        0 => count,
        past => count.min(smallest - past),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{sheet, spots};
    use crate::{Density, Spread, Wrap};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn many_roots_at_once_are_the_same_roots(
            first in prop_oneof![0u64..1 << 20, (1u64 << 40) - 9000..1 << 40, Just(1u64 << 32)],
            count in 0usize..20_000, seed: u64,
        ) {
            let map = spots();
            let density = Density { value: 1.0, map: Some((&map, 0, Wrap::Repeat)) };
            let sampler = RootSampler::new(&sheet(6), &density, seed).unwrap();
            let mut roots = Vec::new();
            sampler.roots(first..first + count as u64, &mut roots);
            prop_assert_eq!(roots.len(), count);
            for (k, root) in roots.iter().enumerate() {
                prop_assert_eq!(*root, sampler.root(first + k as u64));
            }
        }
    }

    #[test]
    fn the_roots_of_an_interval_are_those_of_its_hairs() {
        let map = spots();
        let density = Density {
            value: 1.0,
            map: Some((&map, 0, Wrap::Repeat)),
        };
        let even = RootSampler::new(&sheet(6), &density, 4).unwrap();
        for sampler in [even.clone().with_spread(Spread::Random), even] {
            for (low, high) in [(0, 1 << 64), (1 << 61, 5 << 61), (77, 78)] {
                let mut found = Vec::new();
                sampler.roots_in(low, high, 7..30_000, |hairs, roots| {
                    for (&hair, root) in hairs.iter().zip(roots) {
                        assert_eq!(*root, sampler.root(hair));
                        found.push(hair);
                    }
                });
                let none = SurfacePoint::default();
                for room in [0, 1, 100, found.len(), found.len() + 200] {
                    let (mut hairs, mut roots) = (vec![u64::MAX; room], vec![none; room]);
                    let count = sampler.fill_in(low, high, 7..30_000, &mut hairs, &mut roots);
                    assert_eq!(count, found.len());
                    assert_eq!(hairs[..count.min(room)], found[..count.min(room)]);
                    for (&hair, root) in hairs[..count.min(room)].iter().zip(&roots) {
                        assert_eq!(*root, sampler.root(hair));
                    }
                }
                let mut expected = Vec::new();
                let visit = &mut |hair| expected.push(hair);
                sampler.sequence().indices_in(low, high, 7..30_000, visit);
                found.sort_unstable();
                expected.sort_unstable();
                assert_eq!(found, expected);
            }
        }
    }

    #[test]
    fn blocks_are_aligned_and_fit() {
        assert_eq!(largest_block(0, 1 << 23), 1 << 22);
        assert_eq!(largest_block(1 << 14, 1 << 22), 1 << 14);
        assert_eq!(largest_block(0, 100), 100);
        assert_eq!(largest_block(5, 100_000), ROWS * RUN - 5);
        assert_eq!(largest_block(u64::MAX - 3, 3), 3);
    }
}
