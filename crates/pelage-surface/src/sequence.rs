//! Two numbers for each hair, addressable by its index.
//!
//! The first is the van der Corput sequence, the second the second dimension of
//! Sobol's sequence; together a (0,2)-sequence (document 004, 2.1.7, wants points
//! that are well spread in two dimensions; here every prefix is). Both get a nested
//! (Owen) scramble so that seeds give independent sets with the same spread: every
//! bit is flipped by a hash of the bits above it. As in Laine and Karras (2011) the
//! scramble is computed on the reversed word by operations in which a bit depends on
//! lower bits only.
//!
//! Everything is done on 32-bit words, of which processors multiply many at once. The
//! first number has two of them, since millions of pieces of surface share it; the
//! second only places a root inside one piece, and needs no more than one.

use crate::lanes::LANES;
use crate::scramble::{Scramble, Word, mix, sobol_second};
use fearless_simd::{Bytes, Simd, SimdBase, u32x16, u64x8};

/// How the numbers of different hairs go together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spread {
    /// A scrambled (0,2)-sequence: every prefix is well spread.
    #[default]
    Stratified,
    /// Independent of each other, as by throwing dice. The hairs of an interval can
    /// only be found by trying all.
    Random,
}

/// A scrambled (0,2)-sequence, or independent numbers.
#[derive(Clone, Copy, Debug)]
pub struct RootSequence {
    spread: Spread,
    /// Scramble of the upper word of the first number.
    upper: Scramble,
    /// Scramble of its lower word.
    lower: Scramble,
    /// What the lower word takes of the index's lower word.
    key: u32,
    second: Scramble,
}

impl RootSequence {
    /// The sequence of `seed`.
    pub fn new(seed: u64, spread: Spread) -> Self {
        Self {
            spread,
            upper: Scramble::new(seed, 1),
            lower: Scramble::new(seed, 2),
            key: hash(seed ^ hash(3)) as u32,
            second: Scramble::new(seed, 4),
        }
    }

    /// How the numbers go together.
    pub fn spread(&self) -> Spread {
        self.spread
    }

    /// Element `index`: the first number as a fraction of 2^64, the second of 2^32.
    pub fn sample(&self, index: u64) -> (u64, u32) {
        match self.spread {
            Spread::Stratified => {
                let [upper, lower, y] = self.stratified(index as u32, (index >> 32) as u32);
                ((upper as u64) << 32 | lower as u64, y)
            }
            Spread::Random => self.random(index),
        }
    }

    /// The elements of [`LANES`] indices: the upper and the lower words of the first number,
    /// and the second.
    #[inline(always)]
    pub(crate) fn samples<S: Simd>(&self, simd: S, indices: &[u64; LANES]) -> [u32x16<S>; 3] {
        match self.spread {
            Spread::Stratified => {
                let (low, high) = indices.split_at(LANES / 2);
                let (low, high) = (u64x8::from_slice(simd, low), u64x8::from_slice(simd, high));
                let (low, high): (u32x16<S>, u32x16<S>) = (low.bitcast(), high.bitcast());
                let (low, high) = low.deinterleave(high);
                self.stratified(low, high)
            }
            Spread::Random => {
                let [mut upper, mut lower, mut ys] = [[0; LANES]; 3];
                for (k, &index) in indices.iter().enumerate() {
                    let (x, y) = self.random(index);
                    (upper[k], lower[k], ys[k]) = ((x >> 32) as u32, x as u32, y);
                }
                let load = |words: &[u32; LANES]| u32x16::load_array_ref(simd, words);
                [load(&upper), load(&lower), load(&ys)]
            }
        }
    }

    #[inline(always)]
    pub(crate) fn random(&self, index: u64) -> (u64, u32) {
        let key = (self.key as u64) << 32 | self.second.shift as u64;
        let x = hash(key ^ hash(index));
        (x, hash(x ^ key) as u32)
    }

    /// Words of 32 bits from the words of the index to those of the numbers.
    #[inline(always)]
    fn stratified<W: Word>(&self, low: W, high: W) -> [W; 3] {
        let [upper, lower] = self.first(low, high);
        // Linear, so the outputs for both words need not be made.
        let y = self.second.apply(sobol_second(low ^ high));
        [upper.reversed(), lower.reversed(), y.reversed()]
    }

    /// The words of the first number of the element whose index has the words `low` and
    /// `high`; the upper first, and the bits of each reversed.
    #[inline(always)]
    fn first<W: Word>(&self, low: W, high: W) -> [W; 2] {
        let lower = high.plus(mix(low ^ self.key));
        [self.upper.apply(low), self.lower.apply(lower)]
    }

    /// Bit number `bit`, from the highest, of the first number of element `index`.
    #[inline(always)]
    pub(crate) fn bit(&self, index: u64, bit: u32) -> u64 {
        let (low, high) = (index as u32, (index >> 32) as u32);
        let word = match bit {
            0..32 => self.upper.apply(low) >> bit,
            _ => self.first(low, high)[1] >> (bit - 32),
        };
        (word & 1) as u64
    }
}

/// A 64-bit hash: Stafford's mix 13, as in SplitMix64. Every input bit moves every
/// output bit.
///
/// ```
/// assert_ne!(pelage_surface::hash(0), pelage_surface::hash(1));
/// ```
#[inline(always)]
pub fn hash(x: u64) -> u64 {
    let mut x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ x >> 31
}

/// Element `index` of the van der Corput sequence in base `base`: the index's digits
/// mirrored at the point. Halton's points in the plane take bases 2 and 3
/// (document 004, 3.1.1).
///
/// ```
/// use pelage_surface::radical_inverse;
/// assert_eq!(radical_inverse(2, 6), 0.375);
/// ```
pub fn radical_inverse(base: u32, mut index: u64) -> f64 {
    let base = base.max(2) as u64;
    let (mut value, mut scale) = (0.0, 1.0);
    while index > 0 {
        scale /= base as f64;
        value += (index % base) as f64 * scale;
        index /= base;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_block_of_a_power_of_two_fills_every_elementary_interval() {
        for seed in [0, 1, 99] {
            let sequence = RootSequence::new(seed, Spread::Stratified);
            for m in 1..=8u32 {
                for block in 0..3u64 {
                    for k in 0..=m {
                        let cells: HashSet<_> = (block << m..(block + 1) << m)
                            .map(|i| {
                                let (x, y) = sequence.sample(i);
                                let cut =
                                    |v: u64, bits| if bits == 0 { 0 } else { v >> (64 - bits) };
                                (cut(x, k), cut((y as u64) << 32, m - k))
                            })
                            .collect();
                        assert_eq!(cells.len(), 1 << m, "seed {seed}, 2^{m}, {k} bits of x");
                    }
                }
            }
        }
    }

    /// A scramble makes each element uniform over the seeds, and so estimates unbiased.
    #[test]
    fn over_the_seeds_every_element_is_uniform_in_the_square() {
        let seeds = 16_384u64;
        for index in [0, 1, 5, 1 << 20, (1 << 40) + 3] {
            for shift in [60, 52, 44] {
                let mut counts = [0f64; 256];
                for seed in 0..seeds {
                    let (x, y) = RootSequence::new(seed, Spread::Stratified).sample(index);
                    let y = (y >> (shift - 32)) as u64;
                    counts[((x >> shift & 15) << 4 | y & 15) as usize] += 1.0;
                }
                let expected = seeds as f64 / 256.0;
                let chi_square: f64 = counts
                    .iter()
                    .map(|c| (c - expected) * (c - expected) / expected)
                    .sum();
                // 255 degrees of freedom: 400 has a probability of 1e-8.
                assert!(
                    chi_square < 400.0,
                    "index {index}, bits {shift}: {chi_square}"
                );
            }
        }
    }
}
