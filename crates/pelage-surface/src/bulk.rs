//! Many roots by their index, at the speed of reading the tables in order.
//!
//! Consecutive hairs lie as far apart on the surface as they can, so drawing them one
//! after the other waits for memory at every step. But all hairs whose indices agree in
//! the lower k bits share the first k bits of their first number (see
//! [`RootSequence`](crate::RootSequence)): they are neighbours. A block of hairs is
//! therefore drawn in tiles. A tile row is [`ROWS`] such neighbours, whose tables lie
//! within a few kilobytes; its columns are hairs that follow each other, so that a tile
//! is copied out in runs. What is drawn for a hair does not depend on the tiles.

use crate::drawing::{BATCH, Drawn, Room};
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
    use crate::{Density, Wrap};
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
    fn blocks_are_aligned_and_fit() {
        assert_eq!(largest_block(0, 1 << 23), 1 << 22);
        assert_eq!(largest_block(1 << 14, 1 << 22), 1 << 14);
        assert_eq!(largest_block(0, 100), 100);
        assert_eq!(largest_block(5, 100_000), ROWS * RUN - 5);
        assert_eq!(largest_block(u64::MAX - 3, 3), 3);
    }
}
