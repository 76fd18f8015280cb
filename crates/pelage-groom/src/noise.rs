//! Perlin's improved gradient noise in three dimensions, many points at a time.
//!
//! Source: document 004, section 2.2.5; Perlin 2002, "Improving Noise" (the quintic fade
//! and the twelve gradients). The lattice hash is ours: integer multiplications instead of
//! a permutation table, since processors multiply many numbers at once and look up one
//! at a time, and since a seed enters it. No repetition within 2^32 cells.

use fearless_simd::{Level, dispatch};
use pelage_curves::Vec3;

/// Points that go through the arithmetic together.
const LANES: usize = 16;

/// Shifts of the three components' lattices against each other: gradient noise is 0 at
/// the points of its lattice, and the three must not be so in the same places.
const SHIFTS: [[f32; 3]; 3] = [
    [0.0, 0.0, 0.0],
    [19.371, 7.613, 43.237],
    [31.719, 57.147, 11.583],
];

/// Gradient noise at `point`, a number in about -1..1 that varies smoothly over one unit;
/// 0 at points of whole coordinates. Another `seed` gives another noise.
///
/// Finite for every input; beyond 2^23 there is nothing left between whole coordinates.
///
/// ```
/// use pelage_curves::Vec3;
/// use pelage_groom::noise::noise;
/// assert_eq!(noise(7, Vec3::new(3.0, -2.0, 5.0)), 0.0);
/// assert!(noise(7, Vec3::splat(0.5)).abs() <= 1.0);
/// ```
#[inline(always)]
pub fn noise(seed: u32, point: Vec3) -> f32 {
    let cells = point.to_array().map(cell);
    let [u, v, w] = cells.map(|(_, inside)| fade(inside));
    let near = face(seed, cells, 0, [u, v]);
    let far = face(seed, cells, 1, [u, v]);
    mix(w, near, far)
}

// The parts of a noise are functions, not closures: closures that are called often are
// not inlined, and then nothing runs side by side.

#[inline(always)]
fn face(seed: u32, cells: [Cell; 3], dz: u32, [u, v]: [f32; 2]) -> f32 {
    let near = edge(seed, cells, [0, dz], u);
    let far = edge(seed, cells, [1, dz], u);
    mix(v, near, far)
}

#[inline(always)]
fn edge(seed: u32, cells: [Cell; 3], [dy, dz]: [u32; 2], u: f32) -> f32 {
    let near = corner(seed, cells, [0, dy, dz]);
    let far = corner(seed, cells, [1, dy, dz]);
    mix(u, near, far)
}

#[inline(always)]
fn corner(seed: u32, [x, y, z]: [Cell; 3], [dx, dy, dz]: [u32; 3]) -> f32 {
    let hash = lattice(seed, [(x.0, dx), (y.0, dy), (z.0, dz)]);
    gradient(hash, x.1 - dx as f32, y.1 - dy as f32, z.1 - dz as f32)
}

#[inline(always)]
fn mix(t: f32, a: f32, b: f32) -> f32 {
    a + t * (b - a)
}

/// Writes a vector of three independent noises for each of `points` to `values`, which
/// has the same length (document 004's `noise3D`).
pub fn noise_vectors(seed: u32, points: &[Vec3], values: &mut [Vec3]) {
    dispatch!(Level::new(), simd => {
        let _ = simd;
        let (rows, rest) = values.as_chunks_mut::<LANES>();
        for (points, values) in points.chunks_exact(LANES).zip(rows) {
            *values = row(seed, std::array::from_fn(|k| points[k]));
        }
        let done = points.len() - rest.len();
        let last = |k: usize| points[(done + k).min(points.len() - 1)];
        if !rest.is_empty() {
            rest.copy_from_slice(&row(seed, std::array::from_fn(last))[..rest.len()]);
        }
    });
}

#[inline(always)]
fn row(seed: u32, points: [Vec3; LANES]) -> [Vec3; LANES] {
    let coordinates: [[f32; LANES]; 3] =
        std::array::from_fn(|axis| std::array::from_fn(|k| points[k][axis]));
    let [x, y, z] = coordinates;
    let mut values = [[0.0; LANES]; 3];
    for (component, shift) in values.iter_mut().zip(SHIFTS) {
        for k in 0..LANES {
            let point = Vec3::new(x[k] + shift[0], y[k] + shift[1], z[k] + shift[2]);
            component[k] = noise(seed, point);
        }
    }
    std::array::from_fn(|k| Vec3::from(values.map(|component| component[k])))
}

/// The whole part of a coordinate, and what is left, 0..=1.
type Cell = (i32, f32);

/// The cell of coordinate `x`. Written with a conversion to integers,
/// since `floor` is a call where processors are only asked for their oldest instructions.
#[inline(always)]
fn cell(x: f32) -> Cell {
    let whole = x as i32;
    let whole = whole.wrapping_sub((whole as f32 > x) as i32);
    (whole, (x - whole as f32).clamp(0.0, 1.0))
}

/// 6t⁵ - 15t⁴ + 10t³: first and second derivatives vanish at the lattice.
#[inline(always)]
fn fade(t: f32) -> f32 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// A number for a point of the lattice, of which the upper bits look random.
#[inline(always)]
fn lattice(seed: u32, [x, y, z]: [(i32, u32); 3]) -> u32 {
    let x = (x.0 as u32).wrapping_add(x.1);
    let y = (y.0 as u32).wrapping_add(y.1);
    let z = (z.0 as u32).wrapping_add(z.1);
    let mut h = seed
        ^ x.wrapping_mul(0x9e37_79b1)
        ^ y.wrapping_mul(0x85eb_ca77)
        ^ z.wrapping_mul(0xc2b2_ae3d);
    h ^= h >> 15;
    h = h.wrapping_mul(0x2c1b_3c6d);
    h ^= h >> 12;
    h.wrapping_mul(0x297a_2d39)
}

/// Product of (x, y, z) with one of the twelve directions to the edges of a cube, four of
/// them twice, by the upper four bits of `hash`.
#[inline(always)]
fn gradient(hash: u32, x: f32, y: f32, z: f32) -> f32 {
    let h = hash >> 28;
    let a = if h < 8 { x } else { y };
    let b = if h < 4 {
        y
    } else if h & 13 == 12 {
        x
    } else {
        z
    };
    signed(a, h) + signed(b, h >> 1)
}

/// `value`, negative where the lowest bit of `bits` is set.
#[inline(always)]
fn signed(value: f32, bits: u32) -> f32 {
    f32::from_bits(value.to_bits() ^ (bits << 31))
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
            prop_assert!(a.abs() <= 1.3);
            // No gradient is steeper than that of the fade times that of the corners.
            prop_assert!((a - b).abs() <= 8.0 * step.length() + 1e-4, "{} {}", a, b);
        }

        #[test]
        fn noise_is_zero_at_the_lattice(seed: u32, cell in prop::array::uniform3(-9999i16..9999)) {
            prop_assert_eq!(noise(seed, Vec3::from(cell.map(f32::from))), 0.0);
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
                let alone = SHIFTS.map(|shift| noise(seed, point + Vec3::from(shift)));
                prop_assert_eq!(value.to_array(), alone);
            }
        }
    }

    #[test]
    fn noise_has_no_mean_reaches_far_and_other_seeds_are_other_noises() {
        let points: Vec<Vec3> = (0..60_000)
            .map(|i| Vec3::new(i as f32 * 0.137, i as f32 * 0.071, i as f32 * 0.0293))
            .collect();
        let values = |seed| {
            let noises: Vec<f32> = points.iter().map(|&p| noise(seed, p)).collect();
            noises
        };
        let (a, b) = (values(1), values(2));
        let n = points.len() as f32;
        let mean = a.iter().sum::<f32>() / n;
        let spread = (a.iter().map(|x| x * x).sum::<f32>() / n).sqrt();
        let both = a.iter().zip(&b).map(|(x, y)| x * y).sum::<f32>() / n;
        assert!(mean.abs() < 0.01, "{mean}");
        assert!((0.2..0.35).contains(&spread), "{spread}");
        assert!(both.abs() < 0.05 * spread * spread, "{both}");
        assert!(a.iter().any(|x| x.abs() > 0.8));
    }
}
