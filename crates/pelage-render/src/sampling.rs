//! Random numbers as hashes, and well-spread samples.
//!
//! Sources: the integer hash is Chris Wellons' `lowbias32`; the nested uniform
//! scramble is Laine and Karras' hash as given in Burley, "Practical Hash-based
//! Owen Scrambling" (JCGT 2020).

use glam::Vec3;

/// A number from a number; every bit of the result depends on every bit of `x`.
pub(crate) fn hash(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// A hash of two numbers.
pub(crate) fn hash2(x: u32, y: u32) -> u32 {
    hash(x ^ hash(y).wrapping_add(0x9e37_79b9))
}

/// The top 24 bits as a number in 0..1.
pub(crate) fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

fn owen_scramble(x: u32, seed: u32) -> u32 {
    let mut x = x.reverse_bits();
    x = x.wrapping_add(seed);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^= x.wrapping_mul(0x8d22_f6e6);
    x.reverse_bits()
}

/// Second dimension of Sobol's sequence (primitive polynomial x + 1).
fn sobol_second(index: u32) -> u32 {
    let mut direction = 1u32 << 31;
    let mut index = index;
    let mut result = 0;
    while index != 0 {
        if index & 1 == 1 {
            result ^= direction;
        }
        direction ^= direction >> 1;
        index >>= 1;
    }
    result
}

/// Point `index` of a scrambled (0,2)-sequence, as bits of two numbers in 0..1.
/// Different seeds give independent scrambles of the same even spread.
pub(crate) fn point_bits(index: u32, seed: u32) -> [u32; 2] {
    let index = owen_scramble(index, seed);
    let first = owen_scramble(index.reverse_bits(), hash(seed ^ 0x5bd1_e995));
    let second = owen_scramble(sobol_second(index), hash(seed ^ 0x27d4_eb2f));
    [first, second]
}

/// Point `index` of the sequence of `seed` in the unit square.
pub(crate) fn point(index: u32, seed: u32) -> [f32; 2] {
    point_bits(index, seed).map(unit)
}

/// Two unit vectors that make a right-handed frame with the unit vector `n`.
/// Source: Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017).
pub(crate) fn frame(n: Vec3) -> (Vec3, Vec3) {
    let sign = 1.0f32.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    (
        Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
        Vec3::new(b, sign + n.y * n.y * a, -n.y),
    )
}

/// A unit vector within the cone of `cos_angle` around `axis`, even over its cap.
pub(crate) fn in_cone(axis: Vec3, cos_angle: f32, [u, v]: [f32; 2]) -> Vec3 {
    let z = 1.0 - u * (1.0 - cos_angle);
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = libm::sincosf(std::f32::consts::TAU * v);
    let (x, y) = frame(axis);
    x * (r * cos) + y * (r * sin) + axis * z
}

/// A unit vector over the hemisphere of `axis`, dense as the cosine.
pub(crate) fn over_cosine(axis: Vec3, [u, v]: [f32; 2]) -> Vec3 {
    let r = u.sqrt();
    let (sin, cos) = libm::sincosf(std::f32::consts::TAU * v);
    let (x, y) = frame(axis);
    x * (r * cos) + y * (r * sin) + axis * (1.0 - u).max(0.0).sqrt()
}

/// Smooth step from 0 at `low` to 1 at `high`.
pub(crate) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_points_fill_every_elementary_interval_once() {
        for seed in 0..20 {
            for (columns, rows) in [(16, 1), (8, 2), (4, 4), (2, 8), (1, 16)] {
                let mut seen = [false; 16];
                for i in 0..16 {
                    let [u, v] = point(i, hash(seed));
                    let cell = (u * columns as f32) as usize * rows + (v * rows as f32) as usize;
                    assert!(!seen[cell], "seed {seed}: cell {cell} twice");
                    seen[cell] = true;
                }
            }
        }
    }

    #[test]
    fn cone_samples_stay_in_the_cone() {
        let axis = Vec3::new(0.6, -0.8, 0.0);
        for i in 0..256 {
            let d = in_cone(axis, 0.9, point(i, 3));
            assert!(d.dot(axis) > 0.9 - 1e-5 && (d.length() - 1.0).abs() < 1e-5);
        }
    }
}
