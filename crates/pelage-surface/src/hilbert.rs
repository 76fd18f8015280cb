//! Position along a Hilbert curve in space, for orders that keep neighbours near.

use pelage_curves::Vec3;

/// Bits an axis: cells of a 2000th of the largest side.
const BITS: u32 = 11;

/// Bits of an index along the curve.
pub(crate) const INDEX_BITS: u32 = 3 * BITS;

/// Index of the cell of `point` along the Hilbert curve that fills the cube from
/// `low` with side `side`.
pub(crate) fn hilbert_index(point: Vec3, low: Vec3, side: f32) -> u64 {
    hilbert_indices(point.to_array().map(|x| [x]), low, side)[0]
}

/// The same for many points at once, all x, all y, all z (Skilling 2004, "Programming the
/// Hilbert curve").
#[inline(always)]
pub(crate) fn hilbert_indices<const N: usize>(
    points: [[f32; N]; 3],
    low: Vec3,
    side: f32,
) -> [u64; N] {
    let cells = (1u32 << BITS) as f32;
    // By way of i32, which processors make of many floats at once.
    let cell = |x: f32| ((x / side * cells) as i32).clamp(0, (1 << BITS) - 1) as u32;
    let mut axes = [[0; N]; 3];
    for (i, low) in low.to_array().into_iter().enumerate() {
        for k in 0..N {
            axes[i][k] = cell(points[i][k] - low);
        }
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
