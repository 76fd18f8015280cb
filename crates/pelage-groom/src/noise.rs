//! Noise in three dimensions, three numbers at each of many points at a time.
//!
//! Source: document 004, section 2.2.5; Perlin 2002, "Improving Noise", for the quintic
//! fade and for gradients that are chosen instead of computed. Ours differ in three ways,
//! all for speed:
//!
//! - The lattice is hashed by integer multiplications instead of a table of permutations:
//!   processors multiply many numbers at once and look up one at a time, a seed enters
//!   the hash, and nothing repeats within 2^32 cells.
//! - A point's three numbers share cell, weights and hash; each takes four bits of it.
//! - Three of those are the signs of a gradient along a diagonal of the cell, the fourth
//!   that of a value. The value keeps all three numbers from vanishing at the points of
//!   the lattice, where gradients alone are 0. Gradients along the diagonals have the
//!   second moments of any isotropic set, and so noise has the same correlations.

use crate::lanes::{LANES, Number, Rows, Vectors};
use fearless_simd::{
    Bytes, ExtractToken, Level, Simd, SimdBase, SimdFloat, dispatch, i32x16, u32x16,
};
use pelage_curves::Vec3;

/// Odd numbers that spread the cells of each axis over all words.
const PRIMES: [u32; 3] = [0x9e37_79b1, 0x85eb_ca77, 0xc2b2_ae3d];

/// Value at the points of the lattice, where gradients are 1 along each axis: so large
/// that noise has nearly the same spread at a point of the lattice as inside a cell.
const VALUE: f32 = 0.375;

/// Brings the spread to that of Perlin's noise, a little more than a quarter.
const SCALE: f32 = 0.65;

/// Three independent noises at `point`, numbers in about -1..1 that vary smoothly over one
/// unit (document 004's `noise3D`). Another `seed` gives other noises.
///
/// Finite for every input; beyond 2^23 there is nothing left between whole coordinates.
///
/// ```
/// use pelage_curves::Vec3;
/// use pelage_groom::noise::noise;
/// let (here, near) = (noise(7, Vec3::splat(0.5)), noise(7, Vec3::splat(0.501)));
/// assert!(here.abs().max_element() <= 1.0 && here.distance(near) < 0.01);
/// ```
pub fn noise(seed: u32, point: Vec3) -> Vec3 {
    let mut value = [Vec3::ZERO];
    noise_vectors(seed, &[point], &mut value);
    value[0]
}

/// Writes [`noise`] at each of `points` to `values`, which has the same length.
pub fn noise_vectors(seed: u32, points: &[Vec3], values: &mut [Vec3]) {
    dispatch!(Level::new(), simd => {
        for (points, values) in points.chunks(LANES).zip(values.chunks_mut(LANES)) {
            let mut row = Rows::of(points, |point| *point);
            row = noise_at(seed, row.load(simd)).rows();
            for (lane, value) in values.iter_mut().enumerate() {
                *value = row.get(lane);
            }
        }
    });
}

/// [`noise`] at points side by side.
#[inline(always)]
pub(crate) fn noise_at<S: Simd>(seed: u32, points: Vectors<S>) -> Vectors<S> {
    let [x, y, z] = points.0;
    let x = ends(x, PRIMES[0], 1.0);
    let y = ends(y, PRIMES[1], 1.0);
    let z = ends(z, PRIMES[2], SCALE).map(|end| End {
        hash: end.hash ^ seed,
        ..end
    });
    face(&x, &y, z[0]) + face(&x, &y, z[1])
}

/// Words of [`LANES`] points.
type Word<S> = u32x16<S>;

#[inline(always)]
fn face<S: Simd>(x: &[End<S>; 2], y: &[End<S>; 2], z: End<S>) -> Vectors<S> {
    edge(x, y[0], z) + edge(x, y[1], z)
}

#[inline(always)]
fn edge<S: Simd>(x: &[End<S>; 2], y: End<S>, z: End<S>) -> Vectors<S> {
    corner(x[0], y, z) + corner(x[1], y, z)
}

/// What one axis adds to the corners at one end of a cell.
#[derive(Clone, Copy)]
struct End<S: Simd> {
    hash: Word<S>,
    /// From the corner to the point.
    offset: Number<S>,
    /// Nearness of the point.
    weight: Number<S>,
}

/// Both ends of the cell of `x` along an axis, with weights that sum to `scale`.
#[inline(always)]
fn ends<S: Simd>(x: Number<S>, prime: u32, scale: f32) -> [End<S>; 2] {
    let (whole, inside) = cell(x);
    let hash = whole * prime;
    let far = fade(inside) * scale;
    [
        End {
            hash,
            offset: inside,
            weight: Number::splat(x.token(), scale) - far,
        },
        End {
            hash: hash + prime,
            offset: inside - 1.0,
            weight: far,
        },
    ]
}

/// What a corner says to three noises: its gradient along the offset, and its value. The
/// weight enters before the signs, so that it is multiplied once for all three.
#[inline(always)]
fn corner<S: Simd>(x: End<S>, y: End<S>, z: End<S>) -> Vectors<S> {
    let bits = scrambled(z.hash ^ y.hash ^ x.hash);
    let weight = x.weight * y.weight * z.weight;
    let parts = [x.offset * weight, y.offset * weight, z.offset * weight];
    let value = weight * VALUE;
    Vectors([
        signed_sum(parts, value, bits),
        signed_sum(parts, value, bits << 4),
        signed_sum(parts, value, bits << 8),
    ])
}

#[inline(always)]
fn signed_sum<S: Simd>([x, y, z]: [Number<S>; 3], value: Number<S>, bits: Word<S>) -> Number<S> {
    let across = signed(x, bits) + signed(y, bits << 1);
    across + (signed(z, bits << 2) + signed(value, bits << 3))
}

/// The cell of coordinate `x`: its whole part, and what is left, 0..=1.
#[inline(always)]
fn cell<S: Simd>(x: Number<S>) -> (Word<S>, Number<S>) {
    let below = x.floor();
    let whole: i32x16<S> = below.to_int_precise();
    // Nothing is left of infinity.
    (whole.bitcast(), (x - below).max_precise(0.0))
}

/// 6t⁵ - 15t⁴ + 10t³: first and second derivatives vanish at the lattice.
#[inline(always)]
fn fade<S: Simd>(t: Number<S>) -> Number<S> {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// A word of which the upper bits look random.
#[inline(always)]
fn scrambled<S: Simd>(h: Word<S>) -> Word<S> {
    let h = (h ^ (h >> 15)) * 0x2c1b_3c6d;
    (h ^ (h >> 12)) * 0x297a_2d39
}

/// `value`, with the other sign where the highest bit of `bits` is set.
#[inline(always)]
fn signed<S: Simd>(value: Number<S>, bits: Word<S>) -> Number<S> {
    let sign = bits & (1 << 31);
    Number::from_bits(value.to_bits() ^ sign)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(scale: f32) -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-scale..scale).prop_map(Vec3::from)
    }

    proptest! {
        #[test]
        fn noise_is_smooth_and_small(seed: u32, p in point(1e3), step in point(1e-2)) {
            let (a, b) = (noise(seed, p), noise(seed, p + step));
            prop_assert!(a.abs().max_element() <= 1.22);
            // No gradient is steeper than that of the fade times that of the corners.
            let apart = (a - b).abs().max_element();
            prop_assert!(apart <= 8.0 * step.length() + 1e-4, "{} {}", a, b);
        }

        #[test]
        fn every_input_has_a_noise(seed: u32, x: f32, y: f32, z: f32) {
            prop_assert!(noise(seed, Vec3::new(x, y, z)).is_finite());
        }

        #[test]
        fn many_at_once_are_those_one_by_one(
            seed: u32, points in prop::collection::vec(point(50.0), 0..70)
        ) {
            let mut values = vec![Vec3::ZERO; points.len()];
            noise_vectors(seed, &points, &mut values);
            for (value, point) in values.iter().zip(points) {
                prop_assert_eq!(*value, noise(seed, point));
            }
        }
    }

    /// Points along a line that meets no lattice, so that every place in a cell comes up.
    fn points() -> impl Iterator<Item = Vec3> {
        (0..60_000).map(|i| Vec3::new(0.5137, 0.271, 0.1293) * i as f32)
    }

    /// Mean of the products of `a` and `b`, over that of the squares of both.
    fn correlation(a: &[f32], b: &[f32]) -> f32 {
        let sum =
            |x: &[f32], y: &[f32]| -> f64 { x.iter().zip(y).map(|(x, y)| (x * y) as f64).sum() };
        (sum(a, b) / (sum(a, a) * sum(b, b)).sqrt()) as f32
    }

    /// Component `k` of noise `seed` at `points`.
    fn component(seed: u32, k: usize, points: impl Iterator<Item = Vec3>) -> Vec<f32> {
        points.map(|point| noise(seed, point)[k]).collect()
    }

    #[test]
    fn noise_has_no_mean_and_reaches_far() {
        for (seed, k) in [(1, 0), (1, 1), (2, 2), (u32::MAX, 0)] {
            let values = component(seed, k, points());
            let n = values.len() as f32;
            let mean = values.iter().sum::<f32>() / n;
            let spread = (values.iter().map(|x| x * x).sum::<f32>() / n).sqrt();
            assert!(mean.abs() < 0.01, "{mean}");
            assert!((0.25..0.3).contains(&spread), "{spread}");
            assert!(values.iter().any(|x| x.abs() > 0.8));
        }
    }

    #[test]
    fn noise_spreads_as_a_bell_with_both_sides_alike() {
        let values = component(5, 1, points());
        // Shares below -0.5, in four steps of a quarter, and above 0.5.
        let mut shares = [0.0; 6];
        for value in &values {
            let bin = (value * 4.0).floor().clamp(-3.0, 2.0) + 3.0;
            shares[bin as usize] += 1.0 / values.len() as f32;
        }
        let bell = [0.035, 0.146, 0.319, 0.319, 0.146, 0.035];
        for (share, expected) in shares.iter().zip(bell) {
            assert!((share - expected).abs() < 0.03, "{shares:?}");
        }
    }

    #[test]
    fn components_and_seeds_are_independent() {
        let one = component(1, 0, points());
        for (seed, k) in [(1, 1), (1, 2), (2, 0), (3, 0), (1 << 31, 0)] {
            let other = correlation(&one, &component(seed, k, points()));
            assert!(other.abs() < 0.03, "{seed} {k}: {other}");
        }
    }

    #[test]
    fn noise_is_alike_along_all_axes_and_forgets_within_two_cells() {
        let one = component(9, 0, points());
        let moved = |step: Vec3| correlation(&one, &component(9, 0, points().map(|p| p + step)));
        let axes = [Vec3::X, Vec3::Y, Vec3::Z];
        let half = axes.map(|axis| moved(axis * 0.5));
        assert!(half.iter().all(|c| (c - half[0]).abs() < 0.03), "{half:?}");
        for step in axes
            .iter()
            .flat_map(|&axis| [2.0, 3.0, 16.0, 256.0].map(|n| axis * n))
        {
            assert!(moved(step).abs() < 0.03, "{step}: {}", moved(step));
        }
    }

    #[test]
    fn neighbouring_corners_share_no_bit() {
        // One more than a step beyond the cells that are looked at.
        let (n, side) = (40u32, 43u32);
        let cells: Vec<[u32; 3]> = (0..n * n * n)
            .map(|i| [i % n, i / n % n, i / n / n])
            .collect();
        let words: Vec<u32> = (0..side * side * side)
            .map(|i| {
                let cell = [i % side, i / side % side, i / side / side];
                let word = |k: usize| cell[k].wrapping_mul(PRIMES[k]);
                let word = 77 ^ word(0) ^ word(1) ^ word(2);
                dispatch!(Level::new(), simd => scrambled(Word::splat(simd, word))[0])
            })
            .collect();
        let hash = |[x, y, z]: [u32; 3]| words[(x + side * (y + side * z)) as usize];
        let steps = (1..27u32).map(|i| [i % 3, i / 3 % 3, i / 9]);
        for (step, other) in steps.flat_map(|step| (0..12).map(move |bit| (step, bit))) {
            let mut alike = [0i32; 12];
            for &cell in &cells {
                let moved = std::array::from_fn(|k| cell[k] + step[k]);
                let both = hash(cell) ^ hash(moved).rotate_left(other);
                for (bit, alike) in alike.iter_mut().enumerate() {
                    *alike += 1 - 2 * (both >> (31 - bit) & 1) as i32;
                }
            }
            // Six standard deviations, as thousands of pairs are tried.
            let most = 6.0 * (cells.len() as f32).sqrt();
            assert!(
                alike.iter().all(|a| (*a as f32).abs() < most),
                "{step:?} {other} {alike:?}"
            );
        }
    }
}
