//! Position along a Hilbert curve in space, for orders that keep neighbours near.

use pelage_curves::Vec3;

/// Bits an axis: cells of a 2000th of the largest side.
const BITS: u32 = 11;

/// Index of the cell of `point` along the Hilbert curve that fills the cube from
/// `low` with side `side` (Skilling 2004, "Programming the Hilbert curve").
pub(crate) fn hilbert_index(point: Vec3, low: Vec3, side: f32) -> u64 {
    let cells = (1u32 << BITS) as f32;
    let cell = |x: f32| ((x / side * cells) as u32).min((1 << BITS) - 1);
    let offset = point - low;
    let mut axes = [cell(offset.x), cell(offset.y), cell(offset.z)];
    // Masks instead of branches, half of which would be guessed wrong.
    let mask = |axis: u32, bit: u32| (axis >> bit & 1).wrapping_neg();
    for bit in (1..BITS).rev() {
        let below = (1 << bit) - 1;
        for i in 0..3 {
            let set = mask(axes[i], bit);
            let exchanged = (axes[0] ^ axes[i]) & below & !set;
            axes[0] ^= below & set | exchanged;
            axes[i] ^= exchanged;
        }
    }
    axes[1] ^= axes[0];
    axes[2] ^= axes[1];
    let t = (1..BITS).fold(0, |t, bit| t ^ (mask(axes[2], bit) & ((1 << bit) - 1)));
    let [x, y, z] = axes.map(|a| a ^ t);
    (0..BITS).rev().fold(0, |index, bit| {
        let digit = (x >> bit & 1) << 2 | (y >> bit & 1) << 1 | (z >> bit & 1);
        index << 3 | digit as u64
    })
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
