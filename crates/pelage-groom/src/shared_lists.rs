//! The guides of hairs side by side that choose among the same few.
//!
//! Neighbours on the surface read the same list of candidates (see
//! [`locator`](crate::locator)). So a candidate is read once for all of them, and what is
//! computed of it is computed for all of them at once, the same bits as one by one.
//!
//! Loops over vectors are written out: closures that are handed to `map` are not compiled for
//! the processor at hand.

use crate::guide_set::GuideSet;
use crate::lanes::{Frames, HALF, LANES, Number, Row, turned};
use crate::stages::weights::{Axes, Falloff, Share};
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, SimdSplit, mask32x16, u32x16};

/// Most guides that a hair chooses its own and the one behind them from.
pub(crate) const MOST: usize = 6;

/// Hairs side by side that choose among the same guides.
#[derive(Clone, Copy)]
pub(crate) struct Choice<'a> {
    pub guides: &'a GuideSet,
    /// Where the list begins and ends.
    pub list: [u32; 2],
    /// A bit for each of the hairs.
    pub lanes: u64,
}

/// The shares of hairs side by side.
#[derive(Clone, Debug, Default)]
pub(crate) struct ShareRows {
    /// Of each hair, nearest guides first; those of weight 0 are none.
    shares: [[Share; LANES]; MOST],
    /// Means of the guides' lengths.
    lengths: Row,
}

impl ShareRows {
    /// Appends the shares of the hair in `lane` to `shares`, nearest guide first; gives the mean
    /// of the guides' lengths.
    #[inline(always)]
    pub(crate) fn append(&self, lane: usize, nearest: usize, shares: &mut Vec<Share>) -> f32 {
        shares.reserve(MOST);
        for row in &self.shares[..nearest] {
            if row[lane].weight > 0.0 {
                shares.push(row[lane]);
            }
        }
        self.lengths[lane]
    }

    /// Finds the shares of the hairs at `frames`, each of which has one of `choices`, by inverse
    /// distance: of the `nearest` guides, 2 to [`MOST`], all but the last where `wanted` are fewer.
    #[inline(always)]
    pub(crate) fn find<S: Simd>(
        &mut self,
        simd: S,
        choices: &[Choice],
        frames: &Frames,
        [nearest, wanted]: [usize; 2],
    ) {
        match nearest {
            2 => self.find_among::<S, 2>(simd, choices, frames, wanted),
            3 => self.find_among::<S, 3>(simd, choices, frames, wanted),
            4 => self.find_among::<S, 4>(simd, choices, frames, wanted),
            5 => self.find_among::<S, 5>(simd, choices, frames, wanted),
            _ => self.find_among::<S, MOST>(simd, choices, frames, wanted),
        }
    }

    #[inline(always)]
    fn find_among<S: Simd, const K: usize>(
        &mut self,
        simd: S,
        choices: &[Choice],
        frames: &Frames,
        wanted: usize,
    ) {
        let points = frames.position.load(simd).0;
        let mut near = Nearest::<S, K>::none(simd);
        for choice in choices {
            let found: Nearest<S, K> = choice.nearest(simd, points);
            let own = mask32x16::from_bitmask(simd, choice.lanes);
            for k in 0..K {
                near.squares[k] = own.select(found.squares[k], near.squares[k]);
                near.guides[k] = own.select(found.guides[k], near.guides[k]);
            }
        }
        let weights = near.weights(simd, wanted);
        let hair = frames.axes(simd);
        let zero = Number::splat(simd, 0.0);
        let mut turns = Turns {
            cosines: [zero; K],
            sines: [zero; K],
            lengths: [zero; K],
        };
        for choice in choices {
            let own = mask32x16::from_bitmask(simd, choice.lanes);
            for &guide in choice.list() {
                let number = u32x16::splat(simd, guide);
                let (mut here, mut anywhere) = ([own; K], mask32x16::splat(simd, false));
                for (k, here) in here.iter_mut().enumerate() {
                    *here &= near.guides[k].simd_eq(number) & weights[k].simd_gt(zero);
                    anywhere |= *here;
                }
                if anywhere.to_bitmask() != 0 {
                    turns.set(simd, &here, (choice.guides, guide), &hair);
                }
            }
        }
        let mut mean = zero;
        for (k, row) in self.shares[..K].iter_mut().enumerate() {
            let (weight, guide) = (weights[k], Number::from_bits(near.guides[k]));
            let (cosine, sine) = (weight * turns.cosines[k], weight * turns.sines[k]);
            store([guide, weight, cosine, sine], row);
            mean += weight * turns.lengths[k];
        }
        mean.store_array(&mut self.lengths);
    }
}

/// Writes the shares of which all guides, as bits, weights, cosines and sines are given.
#[inline(always)]
fn store<S: Simd>(parts: [Number<S>; 4], shares: &mut [Share; LANES]) {
    let [a, b, c, d] = parts;
    let ((a, e), (b, f), (c, g), (d, h)) = (a.split(), b.split(), c.split(), d.split());
    let (low, high) = shares.split_at_mut(HALF);
    for (share, parts) in low.iter_mut().zip(turned([a, b, c, d])) {
        *share = bytemuck::cast(parts.to_array());
    }
    for (share, parts) in high.iter_mut().zip(turned([e, f, g, h])) {
        *share = bytemuck::cast(parts.to_array());
    }
}

/// What is read of the guides of hairs side by side: the turns from their frames, and their
/// lengths.
struct Turns<S: Simd, const K: usize> {
    cosines: [Number<S>; K],
    sines: [Number<S>; K],
    lengths: [Number<S>; K],
}

impl<S: Simd, const K: usize> Turns<S, K> {
    /// Those of `guide`, for the hairs at `hair` whose slots are marked `here`.
    #[inline(always)]
    fn set(
        &mut self,
        simd: S,
        here: &[mask32x16<S>; K],
        (guides, guide): (&GuideSet, u32),
        hair: &Axes<Number<S>>,
    ) {
        let frame = &guides.frames[guide as usize];
        let [cosine, sine] = Axes::splat(simd, frame).turn(hair);
        let length = Number::splat(simd, guides.lengths[guide as usize]);
        for (k, here) in here.iter().enumerate() {
            self.cosines[k] = here.select(cosine, self.cosines[k]);
            self.sines[k] = here.select(sine, self.sines[k]);
            self.lengths[k] = here.select(length, self.lengths[k]);
        }
    }
}

/// The nearest guides of hairs side by side, nearest first; at one distance the one of the
/// smaller index.
struct Nearest<S: Simd, const K: usize> {
    /// Squared distances, as bits: those of floats that are not negative order as the floats do.
    squares: [u32x16<S>; K],
    guides: [u32x16<S>; K],
}

impl<S: Simd, const K: usize> Nearest<S, K> {
    #[inline(always)]
    fn none(simd: S) -> Self {
        Self {
            squares: [u32x16::splat(simd, u32::MAX); K],
            guides: [u32x16::splat(simd, u32::MAX); K],
        }
    }

    /// Takes in a guide whose index is larger than that of all before.
    #[inline(always)]
    fn add(&mut self, square: u32x16<S>, guide: u32x16<S>) {
        for k in (0..K).rev() {
            let (mut moved, mut moved_guide) = (square, guide);
            if k > 0 {
                let before = square.simd_lt(self.squares[k - 1]);
                moved = before.select(self.squares[k - 1], square);
                moved_guide = before.select(self.guides[k - 1], guide);
            }
            let nearer = square.simd_lt(self.squares[k]);
            self.squares[k] = nearer.select(moved, self.squares[k]);
            self.guides[k] = nearer.select(moved_guide, self.guides[k]);
        }
    }

    #[inline(always)]
    fn weights(&self, simd: S, wanted: usize) -> [Number<S>; K] {
        let ends = [
            Number::from_bits(self.squares[0]),
            Number::from_bits(self.squares[K - 1]),
        ];
        let falloff = Falloff::new(ends, K, wanted);
        let mut sum = Number::splat(simd, 0.0);
        let mut weights = [sum; K];
        for (weight, &square) in weights.iter_mut().zip(&self.squares) {
            *weight = falloff.part(Number::from_bits(square));
            sum += *weight;
        }
        for (k, weight) in weights.iter_mut().enumerate() {
            *weight = falloff.weight(k, *weight, sum);
        }
        weights
    }
}

impl<'a> Choice<'a> {
    #[inline(always)]
    fn list(&self) -> &'a [u32] {
        self.guides.locator.candidates(self.list)
    }

    #[inline(always)]
    fn nearest<S: Simd, const K: usize>(&self, simd: S, points: [Number<S>; 3]) -> Nearest<S, K> {
        let mut near = Nearest::none(simd);
        for &guide in self.list() {
            let root = self.guides.locator.root(guide);
            let x = Number::splat(simd, root.x) - points[0];
            let y = Number::splat(simd, root.y) - points[1];
            let z = Number::splat(simd, root.z) - points[2];
            let square = x * x + y * y + z * z;
            near.add(square.to_bits(), u32x16::splat(simd, guide));
        }
        near
    }
}
