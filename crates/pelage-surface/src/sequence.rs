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
//!
//! The scramble can be undone bit by bit (architecture.md, law 3): all hairs whose
//! first number starts with k given bits are r, r + 2^k, r + 2·2^k, …

use std::ops::Range;

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
        let (mut x, mut y) = ([0], [0]);
        self.samples(|_| index, &mut x, &mut y);
        (x[0], y[0])
    }

    /// The elements `index(0)`, `index(1)`, … to `xs` and `ys`.
    #[inline(always)]
    pub(crate) fn samples<const N: usize>(
        &self,
        index: impl Fn(usize) -> u64,
        xs: &mut [u64; N],
        ys: &mut [u32; N],
    ) {
        match self.spread {
            Spread::Stratified => self.stratified(index, xs, ys),
            Spread::Random => {
                for k in 0..N {
                    (xs[k], ys[k]) = self.random(index(k));
                }
            }
        }
    }

    #[inline(always)]
    fn random(&self, index: u64) -> (u64, u32) {
        let key = (self.key as u64) << 32 | self.second.shift as u64;
        let x = hash(key ^ hash(index));
        (x, hash(x ^ key) as u32)
    }

    /// Words of 32 bits from the indices to the numbers, so that as many as fit go at once.
    #[inline(always)]
    fn stratified<const N: usize>(
        &self,
        index: impl Fn(usize) -> u64,
        xs: &mut [u64; N],
        ys: &mut [u32; N],
    ) {
        let [mut low, mut high] = [[0; N]; 2];
        for k in 0..N {
            let index = index(k);
            (low[k], high[k]) = (index as u32, (index >> 32) as u32);
        }
        let [mut upper, mut lower] = [[0; N]; 2];
        for k in 0..N {
            [upper[k], lower[k]] = self.first(low[k], high[k]).map(u32::reverse_bits);
            // Linear, so the outputs for both words need not be made.
            let y = sobol_second(low[k] ^ high[k]);
            ys[k] = self.second.apply(y).reverse_bits();
        }
        for k in 0..N {
            xs[k] = (upper[k] as u64) << 32 | lower[k] as u64;
        }
    }

    /// The words of the first number of the element whose index has the words `low` and
    /// `high`; the upper first, and the bits of each reversed.
    #[inline(always)]
    fn first(&self, low: u32, high: u32) -> [u32; 2] {
        let lower = high.wrapping_add(mix(low ^ self.key));
        [self.upper.apply(low), self.lower.apply(lower)]
    }

    /// Bit number `bit`, from the highest, of the first number of element `index`.
    #[inline(always)]
    fn bit(&self, index: u64, bit: u32) -> u64 {
        let [upper, lower] = self.first(index as u32, (index >> 32) as u32);
        ((lower as u64) << 32 | upper as u64) >> bit & 1
    }

    /// Calls `visit` with every one of `indices` whose first number lies in `low..high`
    /// (`high` up to 2^64), in time proportional to how many they are plus the logarithm of
    /// `indices.end` (random numbers: to the length of `indices`). The order is not that of
    /// the indices.
    pub fn indices_in(
        &self,
        low: u64,
        high: u128,
        indices: Range<u64>,
        visit: &mut impl FnMut(u64),
    ) {
        self.runs_in([low as u128, high], indices, u64::MAX, &mut |run| {
            (0..run.count).for_each(|k| visit(run.index(k)));
        });
    }

    /// The same indices in runs of at most `most`, ordered by their first numbers from
    /// run to run: the finer the runs, the nearer their hairs.
    pub(crate) fn runs_in(
        &self,
        [low, high]: [u128; 2],
        indices: Range<u64>,
        most: u64,
        visit: &mut impl FnMut(Run),
    ) {
        if self.spread == Spread::Random {
            return indices
                .filter(|&index| {
                    let x = self.random(index).0 as u128;
                    low <= x && x < high
                })
                .for_each(|index| visit(Run::one(index)));
        }
        let interval = Interval {
            low,
            high,
            indices,
            most,
        };
        let all = Node {
            prefix: 0,
            bits: 0,
            residue: 0,
        };
        self.descend(all, &interval, visit);
    }

    fn descend(&self, node: Node, wanted: &Interval, visit: &mut impl FnMut(Run)) {
        let (start, end) = node.interval();
        if end <= wanted.low || start >= wanted.high {
            return;
        }
        let Some(run) = node.run(&wanted.indices) else {
            return;
        };
        let inside = wanted.low <= start && end <= wanted.high;
        if inside && run.count <= wanted.most {
            visit(run);
        } else if run.count == 1 {
            let x = self.sample(run.first).0 as u128;
            if inside || wanted.low <= x && x < wanted.high {
                visit(run);
            }
        } else {
            let own = self.bit(node.residue, node.bits);
            for bit in [0, 1] {
                let residue = if bit == own {
                    node.residue
                } else {
                    node.residue | 1 << node.bits
                };
                let child = Node {
                    prefix: node.prefix << 1 | bit as u128,
                    bits: node.bits + 1,
                    residue,
                };
                self.descend(child, wanted, visit);
            }
        }
    }
}

/// Indices that are a step apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    first: u64,
    step: u64,
    pub count: u64,
}

impl Run {
    fn one(index: u64) -> Self {
        Self {
            first: index,
            step: 0,
            count: 1,
        }
    }

    /// Index number `k` of the run.
    #[inline(always)]
    pub fn index(&self, k: u64) -> u64 {
        self.first + k * self.step
    }
}

/// Which are wanted: those of `indices` with a first number in `low..high`, at most `most`
/// a run.
struct Interval {
    low: u128,
    high: u128,
    indices: Range<u64>,
    most: u64,
}

/// The numbers that start with `bits` given bits, and the smallest index of one.
#[derive(Clone, Copy)]
struct Node {
    prefix: u128,
    bits: u32,
    residue: u64,
}

impl Node {
    fn interval(&self) -> (u128, u128) {
        let shift = 64 - self.bits;
        (self.prefix << shift, (self.prefix + 1) << shift)
    }

    /// Those of `wanted`, if there are any.
    fn run(&self, wanted: &Range<u64>) -> Option<Run> {
        let Some(step) = 1u64.checked_shl(self.bits) else {
            return wanted
                .contains(&self.residue)
                .then(|| Run::one(self.residue));
        };
        let skipped = wanted.start.saturating_sub(self.residue).div_ceil(step);
        let first = self.residue.checked_add(skipped.checked_mul(step)?)?;
        (first < wanted.end).then(|| Run {
            first,
            step,
            count: ((wanted.end - first - 1) >> self.bits) + 1,
        })
    }
}

/// A permutation of 32-bit words in which a bit depends on lower bits only.
#[derive(Clone, Copy, Debug)]
struct Scramble {
    shift: u32,
    stretch: [u32; 2],
}

impl Scramble {
    fn new(seed: u64, channel: u64) -> Self {
        let word = |k: u64| hash(seed ^ hash(channel << 8 | k)) as u32;
        Self {
            shift: word(0),
            stretch: [word(1) | 1, word(2) | 1],
        }
    }

    /// `x ^= x * even` carries low bits up by a data-dependent pattern; the odd
    /// factors and the shift bring in the seed at every level.
    #[inline(always)]
    fn apply(&self, mut x: u32) -> u32 {
        x ^= x.wrapping_mul(0x7692_6cf2);
        x = x.wrapping_add(self.shift).wrapping_mul(self.stretch[0]);
        x ^= x.wrapping_mul(0xd192_ed06);
        x = x.wrapping_mul(self.stretch[1]);
        x ^ x.wrapping_mul(0x108e_f2da)
    }
}

/// Second dimension of Sobol's sequence with its bits reversed: output bit j is the
/// exclusive or of all index bits k whose binary digits contain those of j, since
/// its generator matrix is Pascal's triangle modulo 2. Of a 64-bit index, the lower
/// word of the output is that of both words' outputs.
#[inline(always)]
fn sobol_second(mut x: u32) -> u32 {
    x ^= x >> 1 & 0x5555_5555;
    x ^= x >> 2 & 0x3333_3333;
    x ^= x >> 4 & 0x0f0f_0f0f;
    x ^= x >> 8 & 0x00ff_00ff;
    x ^ x >> 16
}

/// A 32-bit hash: Wellons' search of 2018, bias 0.17. Every input bit moves every
/// output bit.
#[inline(always)]
pub(crate) fn mix(mut x: u32) -> u32 {
    x = (x ^ x >> 16).wrapping_mul(0x7feb_352d);
    x = (x ^ x >> 15).wrapping_mul(0x846c_a68b);
    x ^ x >> 16
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
    use proptest::prelude::*;
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

    #[test]
    fn fine_runs_follow_each_other_along_the_first_number() {
        let sequence = RootSequence::new(3, Spread::Stratified);
        let mut highest = 0;
        let mut found = 0;
        sequence.runs_in([0, 1 << 64], 0..5000, 8, &mut |run| {
            assert!(run.count <= 8);
            let numbers = (0..run.count).map(|k| sequence.sample(run.index(k)).0);
            let numbers: Vec<u64> = numbers.collect();
            assert!(numbers.iter().all(|&x| x >= highest));
            highest = numbers.into_iter().fold(highest, u64::max);
            found += run.count;
        });
        assert_eq!(found, 5000);
    }

    proptest! {
        #[test]
        fn listing_an_interval_finds_exactly_its_hairs(
            seed: u64, from in 0u64..300, count in 0u64..600, a: u64, b: u64, dice: bool,
        ) {
            let spread = if dice { Spread::Random } else { Spread::Stratified };
            let sequence = RootSequence::new(seed, spread);
            let (low, high) = (a.min(b), a.max(b) as u128 + 1);
            let mut found = Vec::new();
            sequence.indices_in(low, high, from..count, &mut |i| found.push(i));
            found.sort_unstable();
            let expected: Vec<u64> = (from..count)
                .filter(|&i| {
                    let x = sequence.sample(i).0;
                    x >= low && (x as u128) < high
                })
                .collect();
            prop_assert_eq!(found, expected);
        }

        #[test]
        fn a_narrow_interval_costs_little_even_among_a_trillion_hairs(seed: u64, low: u64) {
            let sequence = RootSequence::new(seed, Spread::Stratified);
            let mut found = 0;
            let width = 1u128 << 28; // expects 2^40 · 2^28 / 2^64 = 16 hairs
            sequence.indices_in(low, low as u128 + width, 0..1 << 40, &mut |_| found += 1);
            prop_assert!(found <= 40, "{}", found);
        }
    }
}
