//! Hashes and permutations of words of 32 bits, of one or of many side by side.

use crate::hash;
use fearless_simd::{Simd, u32x16};
use std::ops::{BitAnd, BitXor, Shr};

/// A word, or many that are treated alike. Sums and products are modulo 2^32.
pub(crate) trait Word:
    Copy
    + BitXor<Output = Self>
    + BitXor<u32, Output = Self>
    + BitAnd<u32, Output = Self>
    + Shr<u32, Output = Self>
{
    fn plus(self, other: Self) -> Self;
    fn plus_word(self, other: u32) -> Self;
    fn times(self, factor: u32) -> Self;
    /// The highest bit becomes the lowest.
    fn reversed(self) -> Self;
}

impl Word for u32 {
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }

    #[inline(always)]
    fn plus_word(self, other: u32) -> Self {
        self.wrapping_add(other)
    }

    #[inline(always)]
    fn times(self, factor: u32) -> Self {
        self.wrapping_mul(factor)
    }

    #[inline(always)]
    fn reversed(self) -> Self {
        self.reverse_bits()
    }
}

impl<S: Simd> Word for u32x16<S> {
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline(always)]
    fn plus_word(self, other: u32) -> Self {
        self + other
    }

    #[inline(always)]
    fn times(self, factor: u32) -> Self {
        self * factor
    }

    #[inline(always)]
    fn reversed(self) -> Self {
        let mut words = self;
        for word in words.iter_mut() {
            *word = word.reverse_bits();
        }
        words
    }
}

/// A permutation of 32-bit words in which a bit depends on lower bits only.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scramble {
    pub shift: u32,
    stretch: [u32; 2],
}

impl Scramble {
    pub(crate) fn new(seed: u64, channel: u64) -> Self {
        let word = |k: u64| hash(seed ^ hash(channel << 8 | k)) as u32;
        Self {
            shift: word(0),
            stretch: [word(1) | 1, word(2) | 1],
        }
    }

    /// `x ^= x * even` carries low bits up by a data-dependent pattern; the odd
    /// factors and the shift bring in the seed at every level.
    #[inline(always)]
    pub(crate) fn apply<W: Word>(&self, mut x: W) -> W {
        x = x ^ x.times(0x7692_6cf2);
        x = x.plus_word(self.shift).times(self.stretch[0]);
        x = x ^ x.times(0xd192_ed06);
        x = x.times(self.stretch[1]);
        x ^ x.times(0x108e_f2da)
    }
}

/// Second dimension of Sobol's sequence with its bits reversed: output bit j is the
/// exclusive or of all index bits k whose binary digits contain those of j, since
/// its generator matrix is Pascal's triangle modulo 2. Of a 64-bit index, the lower
/// word of the output is that of both words' outputs.
#[inline(always)]
pub(crate) fn sobol_second<W: Word>(mut x: W) -> W {
    x = x ^ (x >> 1 & 0x5555_5555);
    x = x ^ (x >> 2 & 0x3333_3333);
    x = x ^ (x >> 4 & 0x0f0f_0f0f);
    x = x ^ (x >> 8 & 0x00ff_00ff);
    x ^ x >> 16
}

/// A 32-bit hash: Wellons' search of 2018, bias 0.17. Every input bit moves every
/// output bit.
#[inline(always)]
pub(crate) fn mix<W: Word>(mut x: W) -> W {
    x = (x ^ x >> 16).times(0x7feb_352d);
    x = (x ^ x >> 15).times(0x846c_a68b);
    x ^ x >> 16
}
