//! The hairs of a chunk in their local frames, sixteen side by side.
//!
//! Every stage of local space does the same to each vertex of each hair, so hairs lie in
//! blocks of [`LANES`]: the first vertices of all, their second vertices, and so on.

use crate::curves::Curves;
use crate::lanes::{HALF, LANES, Row, Rows};
use fearless_simd::Simd;
use pelage_curves::Vec3;
use std::ops::Range;

/// The vertices of hairs, block by block.
#[derive(Clone, Debug, Default)]
pub(crate) struct Blocks {
    rows: Vec<Rows>,
    /// Where the rows of each block start; one more entry than blocks.
    starts: Vec<u32>,
    /// Number of vertices of each hair. In a block of longer ones, what stands in its lane
    /// behind them is left open.
    lengths: Vec<u32>,
}

impl Blocks {
    /// Makes room for hairs of so many vertices each; what they hold is left open.
    pub(crate) fn lay_out(&mut self, lengths: impl Iterator<Item = u32>) {
        self.lengths.clear();
        self.lengths.extend(lengths);
        self.starts.clear();
        self.starts.push(0);
        let mut end = 0;
        for block in self.lengths.chunks(LANES) {
            end += block.iter().max().copied().unwrap_or(0);
            self.starts.push(end);
        }
        self.rows.resize(end as usize, Rows::default());
    }

    /// Number of hairs.
    pub(crate) fn len(&self) -> usize {
        self.lengths.len()
    }

    /// Number of blocks.
    pub(crate) fn blocks(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The hairs of a block.
    #[inline(always)]
    pub(crate) fn hairs(&self, block: usize) -> Range<usize> {
        block * LANES..self.len().min((block + 1) * LANES)
    }

    #[inline(always)]
    fn range(&self, block: usize) -> Range<usize> {
        self.starts[block] as usize..self.starts[block + 1] as usize
    }

    /// The vertices of a block, number by number.
    #[inline(always)]
    pub(crate) fn block(&self, block: usize) -> &[Rows] {
        &self.rows[self.range(block)]
    }

    /// The vertices of a block, to be changed.
    #[inline(always)]
    pub(crate) fn block_mut(&mut self, block: usize) -> &mut [Rows] {
        let range = self.range(block);
        &mut self.rows[range]
    }

    /// Vertices of hair `i`.
    #[inline(always)]
    pub(crate) fn length(&self, i: usize) -> usize {
        self.lengths[i] as usize
    }

    /// Vertices of the hairs of a block.
    #[inline(always)]
    pub(crate) fn lengths(&self, block: usize) -> &[u32] {
        &self.lengths[self.hairs(block)]
    }

    /// How far t, which is 0 at the first and 1 at the last vertex, goes from one vertex of
    /// each hair of a block to the next.
    #[inline(always)]
    pub(crate) fn steps(&self, block: usize) -> Row {
        let mut steps = [0.0; LANES];
        for (step, &length) in steps.iter_mut().zip(self.lengths(block)) {
            *step = 1.0 / (length.max(2) - 1) as f32;
        }
        steps
    }

    /// The vertices of hair `i`, to `hair`, which is emptied first.
    pub(crate) fn read(&self, i: usize, hair: &mut Vec<Vec3>) {
        let rows = &self.block(i / LANES)[..self.lengths[i] as usize];
        hair.clear();
        hair.extend(rows.iter().map(|row| row.get(i % LANES)));
    }

    /// Gives hair `i` the vertices `hair`, as many as it has.
    pub(crate) fn write(&mut self, i: usize, hair: &[Vec3]) {
        let rows = self.block_mut(i / LANES);
        for (row, vertex) in rows.iter_mut().zip(hair) {
            row.set(i % LANES, *vertex);
        }
    }

    /// Writes the hairs to `curves`, one after the other.
    #[inline(always)]
    pub(crate) fn unroll<S: Simd>(&self, simd: S, curves: &mut Curves) {
        curves.lay_out(self.lengths.iter().copied());
        for block in 0..self.blocks() {
            let lengths = self.lengths(block);
            let starts = &curves.starts[block * LANES..][..lengths.len()];
            for (number, row) in self.block(block).iter().enumerate() {
                for (half, hairs) in row.halves(simd).into_iter().enumerate() {
                    let first = half * HALF;
                    for (lane, vertex) in (first..lengths.len()).zip(hairs) {
                        if number < lengths[lane] as usize {
                            curves.vertices[starts[lane] as usize + number] = vertex;
                        }
                    }
                }
            }
        }
    }

    /// Takes over the vertices of `curves`, the hairs that were [unrolled](Self::unroll).
    pub(crate) fn roll(&mut self, curves: &Curves) {
        for i in 0..self.len() {
            self.write(i, curves.get(i));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn hairs_come_out_as_they_went_in(lengths in prop::collection::vec(1u32..9, 0..50)) {
            let vertex = |i: usize, k: usize| Vec3::new(i as f32, k as f32, 1.0);
            let mut blocks = Blocks::default();
            blocks.lay_out(lengths.iter().copied());
            for (i, &length) in lengths.iter().enumerate() {
                let hair: Vec<Vec3> = (0..length as usize).map(|k| vertex(i, k)).collect();
                blocks.write(i, &hair);
            }
            let (mut curves, mut hair) = (Curves::default(), Vec::new());
            dispatch!(Level::new(), simd => blocks.unroll(simd, &mut curves));
            prop_assert_eq!(curves.len(), lengths.len());
            for (i, &length) in lengths.iter().enumerate() {
                let expected: Vec<Vec3> = (0..length as usize).map(|k| vertex(i, k)).collect();
                prop_assert_eq!(curves.get(i), &expected[..]);
                blocks.read(i, &mut hair);
                prop_assert_eq!(&hair, &expected);
            }
            let before = blocks.clone();
            blocks.roll(&curves);
            prop_assert!(before.rows.iter().zip(&blocks.rows).all(|(a, b)| a.0 == b.0));
        }
    }
}
