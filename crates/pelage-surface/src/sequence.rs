//! Two numbers for each hair, addressable by its index.
//!
//! The first is the van der Corput sequence, the second the second dimension of
//! Sobol's sequence; together a (0,2)-sequence (document 004, 2.1.7, wants points
//! that are well spread in two dimensions; here every prefix is). Both get a nested
//! (Owen) scramble so that seeds give independent sets with the same spread: every
//! bit is flipped by a hash of the bits above it. As in Laine and Karras (2011) the
//! scramble is computed on the reversed word by operations in which a bit depends on
//! lower bits only; we use 64 bits and constants of our own.
//!
//! The scramble can be undone bit by bit (architecture.md, law 3): all hairs whose
//! first number starts with k given bits are r, r + 2^k, r + 2·2^k, …

/// A scrambled (0,2)-sequence of 64-bit fractions.
#[derive(Clone, Copy, Debug)]
pub struct RootSequence {
    first: Scramble,
    second: Scramble,
}

impl RootSequence {
    /// The sequence of `seed`.
    pub fn new(seed: u64) -> Self {
        Self {
            first: Scramble::new(seed, 1),
            second: Scramble::new(seed, 2),
        }
    }

    /// Element `index`, as fractions of 2^64.
    #[inline]
    pub fn sample(&self, index: u64) -> [u64; 2] {
        [
            self.first.apply(index).reverse_bits(),
            self.second.apply(sobol_second(index)).reverse_bits(),
        ]
    }

    /// Calls `visit` with every index below `count` whose first number lies in
    /// `low..high` (`high` up to 2^64), in time proportional to their number plus
    /// the logarithm of `count`. The order is not that of the indices.
    pub fn indices_in(&self, low: u64, high: u128, count: u64, visit: &mut impl FnMut(u64)) {
        self.descend(
            Node {
                prefix: 0,
                bits: 0,
                residue: 0,
            },
            low as u128,
            high,
            count,
            visit,
        );
    }

    fn descend(&self, node: Node, low: u128, high: u128, count: u64, visit: &mut impl FnMut(u64)) {
        let (start, end) = node.interval();
        if node.residue >= count || end <= low || start >= high {
            return;
        }
        let step = if node.bits < 64 { 1u64 << node.bits } else { 0 };
        let inside = low <= start && end <= high;
        let alone = step == 0
            || node
                .residue
                .checked_add(step)
                .is_none_or(|next| next >= count);
        if inside {
            let mut index = node.residue;
            loop {
                visit(index);
                match index.checked_add(step) {
                    Some(next) if step > 0 && next < count => index = next,
                    _ => break,
                }
            }
        } else if alone {
            let x = self.sample(node.residue)[0] as u128;
            if low <= x && x < high {
                visit(node.residue);
            }
        } else {
            let own = self.first.apply(node.residue) >> node.bits & 1;
            for bit in [0, 1] {
                let residue = if bit == own {
                    node.residue
                } else {
                    node.residue | step
                };
                let child = Node {
                    prefix: node.prefix << 1 | bit as u128,
                    bits: node.bits + 1,
                    residue,
                };
                self.descend(child, low, high, count, visit);
            }
        }
    }
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
}

/// A permutation of 64-bit words in which a bit depends on lower bits only.
#[derive(Clone, Copy, Debug)]
struct Scramble {
    shift: u64,
    stretch: [u64; 2],
}

impl Scramble {
    fn new(seed: u64, channel: u64) -> Self {
        let word = |k: u64| hash(seed ^ hash(channel << 8 | k));
        Self {
            shift: word(0),
            stretch: [word(1) | 1, word(2) | 1],
        }
    }

    /// `x ^= x * even` carries low bits up by a data-dependent pattern; the odd
    /// factors and the shift bring in the seed at every level.
    #[inline]
    fn apply(&self, mut x: u64) -> u64 {
        x ^= x.wrapping_mul(0x9e6c_63d0_7692_6cf2);
        x = x.wrapping_add(self.shift).wrapping_mul(self.stretch[0]);
        x ^= x.wrapping_mul(0xd1b5_4a32_d192_ed06);
        x = x.wrapping_mul(self.stretch[1]);
        x ^= x.wrapping_mul(0xaef1_7502_108e_f2da);
        x
    }
}

/// Second dimension of Sobol's sequence with its bits reversed: output bit j is the
/// exclusive or of all index bits k whose binary digits contain those of j, since
/// its generator matrix is Pascal's triangle modulo 2.
#[inline]
fn sobol_second(mut x: u64) -> u64 {
    x ^= x >> 1 & 0x5555_5555_5555_5555;
    x ^= x >> 2 & 0x3333_3333_3333_3333;
    x ^= x >> 4 & 0x0f0f_0f0f_0f0f_0f0f;
    x ^= x >> 8 & 0x00ff_00ff_00ff_00ff;
    x ^= x >> 16 & 0x0000_ffff_0000_ffff;
    x ^ x >> 32
}

/// A 64-bit hash: Stafford's mix 13, as in SplitMix64. Every input bit moves every
/// output bit.
///
/// ```
/// assert_ne!(pelage_surface::hash(0), pelage_surface::hash(1));
/// ```
#[inline]
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
            let sequence = RootSequence::new(seed);
            for m in 1..=8u32 {
                for block in 0..3u64 {
                    for k in 0..=m {
                        let cells: HashSet<_> = (block << m..(block + 1) << m)
                            .map(|i| {
                                let [x, y] = sequence.sample(i);
                                let cut =
                                    |v: u64, bits| if bits == 0 { 0 } else { v >> (64 - bits) };
                                (cut(x, k), cut(y, m - k))
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
                    let [x, y] = RootSequence::new(seed).sample(index);
                    counts[((x >> shift & 15) << 4 | y >> shift & 15) as usize] += 1.0;
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

    proptest! {
        #[test]
        fn listing_an_interval_finds_exactly_its_hairs(
            seed: u64, count in 0u64..600, a: u64, b: u64,
        ) {
            let sequence = RootSequence::new(seed);
            let (low, high) = (a.min(b), a.max(b) as u128 + 1);
            let mut found = Vec::new();
            sequence.indices_in(low, high, count, &mut |i| found.push(i));
            found.sort_unstable();
            let expected: Vec<u64> = (0..count)
                .filter(|&i| {
                    let x = sequence.sample(i)[0];
                    x >= low && (x as u128) < high
                })
                .collect();
            prop_assert_eq!(found, expected);
        }

        #[test]
        fn a_narrow_interval_costs_little_even_among_a_trillion_hairs(seed: u64, low: u64) {
            let sequence = RootSequence::new(seed);
            let mut found = 0;
            let width = 1u128 << 28; // expects 2^40 · 2^28 / 2^64 = 16 hairs
            sequence.indices_in(low, low as u128 + width, 1 << 40, &mut |_| found += 1);
            prop_assert!(found <= 40, "{}", found);
        }
    }
}
