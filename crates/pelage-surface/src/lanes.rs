//! Places on the surface side by side.
//!
//! Processors do with sixteen numbers at once what they do with one. Places are drawn lane by
//! lane, so each has the same bits whatever its neighbours and whatever the processor's vectors.

use crate::SurfacePoint;
use fearless_simd::{Bytes, Simd, SimdBase, SimdFloat, SimdInt, f32x16, i32x16, u32x16};

/// Places that go through the arithmetic together: one of the widest common vectors.
pub(crate) const LANES: usize = 16;

/// Where places lie: the triangle, the part of it (see [`Part`](crate::part::Part)), and how far
/// into the share of that part.
#[derive(Clone, Copy)]
pub(crate) struct Found<S: Simd> {
    pub triangle: u32x16<S>,
    pub origin: [f32x16<S>; 2],
    pub size: f32x16<S>,
    pub inside: f32x16<S>,
    pub width: f32x16<S>,
}

impl<S: Simd> Found<S> {
    /// Writes the places, which lie in their parts at the fractions `y` of 2^32.
    #[inline(always)]
    pub(crate) fn place(self, simd: S, y: u32x16<S>, places: &mut [SurfacePoint; LANES]) {
        // Document 004, 2.1.5: a triangle's area grows with the square of the distance
        // from its first corner.
        let one = f32x16::splat(simd, 1.0);
        let root = (self.inside / self.width).sqrt();
        let along = float(y >> 8) * (1.0 / (1 << 24) as f32) * root;
        let u = self.origin[0] + self.size * (one - root);
        let v = self.origin[1] + self.size * along;
        let rest = (one - u - v).max(0.0);
        // Four rows turned, twice by pairs.
        let (low, high) = f32x16::from_bits(self.triangle).interleave(u);
        let (even, odd) = rest.interleave(v);
        let ((a, b), (c, d)) = (low.interleave(even), high.interleave(odd));
        let numbers: &mut [f32] = bytemuck::cast_slice_mut(places);
        for (row, numbers) in [a, b, c, d].iter().zip(numbers.chunks_exact_mut(LANES)) {
            row.store_slice(numbers);
        }
    }
}

/// Numbers of at most 31 bits as floats: signed ones are turned fastest.
#[inline(always)]
pub(crate) fn float<S: Simd>(words: u32x16<S>) -> f32x16<S> {
    words.bitcast::<i32x16<S>>().to_float()
}

/// `x` as an integer, which is whole and in 0..2^23; anything where it is not. As Rust converts
/// floats, out of bounds too, takes them one by one; here many go at once.
#[inline(always)]
pub(crate) fn low_word(x: f32) -> u32 {
    const LAST_BIT_IS_1: f32 = (1u32 << 23) as f32;
    (x + LAST_BIT_IS_1)
        .to_bits()
        .wrapping_sub(LAST_BIT_IS_1.to_bits())
}

/// [`low_word`] of `x` in 0..2^32.
#[inline(always)]
pub(crate) fn low_word_f64(x: f64) -> u32 {
    const LAST_BIT_IS_1: f64 = (1u64 << 52) as f64;
    (x + LAST_BIT_IS_1).to_bits() as u32
}
