//! Position along a Hilbert curve in space, for orders that keep neighbours near.

use crate::Mesh;
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec3;
use rayon::prelude::*;

/// Bits an axis: cells of a 2000th of the largest side.
const BITS: u32 = 11;

/// Triangles placed on the curve at once.
const LANES: usize = 32;

/// Index of the cell of `point` along the Hilbert curve that fills the cube from
/// `low` with side `side`.
pub(crate) fn hilbert_index(point: Vec3, low: Vec3, side: f32) -> u64 {
    hilbert_indices([point], low, side)[0]
}

/// The same for many points at once (Skilling 2004, "Programming the Hilbert curve").
#[inline(always)]
fn hilbert_indices<const N: usize>(points: [Vec3; N], low: Vec3, side: f32) -> [u64; N] {
    let cells = (1u32 << BITS) as f32;
    let cell = |x: f32| ((x / side * cells) as u32).min((1 << BITS) - 1);
    let mut axes = [[0; N]; 3];
    for (k, point) in points.into_iter().enumerate() {
        let offset = point - low;
        [axes[0][k], axes[1][k], axes[2][k]] = [cell(offset.x), cell(offset.y), cell(offset.z)];
    }
    // Masks instead of branches, half of which would be guessed wrong.
    let mask = |axis: u32, bit: u32| (axis >> bit & 1).wrapping_neg();
    for bit in (1..BITS).rev() {
        let below = (1 << bit) - 1;
        for i in 0..3 {
            let mut own = axes[i];
            for (first, own) in axes[0].iter_mut().zip(&mut own) {
                let set = mask(*own, bit);
                let exchanged = (*first ^ *own) & below & !set;
                *first ^= below & set | exchanged;
                *own ^= exchanged;
            }
            if i > 0 {
                axes[i] = own;
            }
        }
    }
    let mut indices = [0; N];
    for (k, index) in indices.iter_mut().enumerate() {
        let [x, mut y, mut z] = axes.map(|axis| axis[k]);
        y ^= x;
        z ^= y;
        // Each bit of z turns all bits below it.
        let mut t = z >> 1;
        t ^= t >> 1;
        t ^= t >> 2;
        t ^= t >> 4;
        t ^= t >> 8;
        let [x, y, z] = [x, y, z].map(|a| every_third(a ^ t));
        *index = x << 2 | y << 1 | z;
    }
    indices
}

/// The bits of a number of [`BITS`] bits, with two zeros between them.
#[inline(always)]
fn every_third(x: u32) -> u64 {
    let x = x as u64;
    let x = (x | x << 16) & 0x00ff_0000_ff00_00ff;
    let x = (x | x << 8) & 0xf00f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x30c3_0c30_c30c_30c3;
    (x | x << 2) & 0x9249_2492_4924_9249
}

/// Triangles along a Hilbert curve through their centres.
pub(crate) fn along_curve(mesh: &Mesh) -> Vec<u32> {
    let (low, high) = mesh.bounds();
    let side = (high - low).max_element().max(f32::MIN_POSITIVE);
    let count = mesh.triangles().len();
    // One word each: where on the curve, then which triangle.
    let bits = usize::BITS - count.leading_zeros();
    let spare = (3 * BITS + bits).saturating_sub(64);
    let mut order = vec![0; count];
    let level = Level::new();
    let rows = order.par_chunks_mut(LANES).enumerate().with_min_len(LANES);
    rows.for_each(|(row, words)| {
        let first = row * LANES;
        dispatch!(level, simd => {
            let _ = simd;
            let mut centres = [Vec3::ZERO; LANES];
            // A closure would be compiled for the oldest processors.
            for (k, centre) in centres.iter_mut().enumerate() {
                let [a, b, c] = mesh.corners((first + k).min(count - 1));
                *centre = (a + b + c) / 3.0;
            }
            let along = hilbert_indices(centres, low, side);
            for (k, word) in words.iter_mut().enumerate() {
                *word = along[k] >> spare << bits | (first + k) as u64;
            }
        });
    });
    order.par_sort_unstable();
    let triangle = |word| (word & ((1 << bits) - 1)) as u32;
    order.into_iter().map(triangle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_that_follow_each_other_are_neighbours() {
        // Cells of an eighth: eleven bits agree with three where the low bits are 0.
        let n = 8usize;
        let mut order: Vec<(u64, [usize; 3])> = (0..n * n * n)
            .map(|i| {
                let c = [i % n, i / n % n, i / n / n];
                let p = Vec3::new(c[0] as f32, c[1] as f32, c[2] as f32) + 0.5;
                (hilbert_index(p, Vec3::ZERO, n as f32), c)
            })
            .collect();
        order.sort_unstable();
        for pair in order.windows(2) {
            let steps: usize = (0..3).map(|k| pair[0].1[k].abs_diff(pair[1].1[k])).sum();
            assert_eq!(steps, 1, "{pair:?}");
        }
    }
}
