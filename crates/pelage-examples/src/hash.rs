//! Numbers that look random and are the same on every machine.
//!
//! Everything is a pure function of its arguments: a counter-based hash (the
//! finaliser of SplitMix64: Steele, Lea, Flood, "Fast splittable pseudorandom
//! number generators", OOPSLA 2014) and value noise over it.

use glam::DVec3;

/// Mixes 64 bits so that every output bit depends on every input bit.
pub fn mix(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A number in 0..1 from what it is for (`channel`) and which one it is (`index`).
pub fn unit(channel: u64, index: u64) -> f64 {
    (mix(mix(channel) ^ index) >> 11) as f64 / (1u64 << 53) as f64
}

/// Smooth noise in -1..1 with features about one unit wide.
pub fn noise(channel: u64, p: DVec3) -> f64 {
    let cell = p.floor();
    let t = p - cell;
    // Quintic fade: continuous second derivatives, hence no creases in shading.
    let fade = t * t * t * (t * (t * 6.0 - DVec3::splat(15.0)) + DVec3::splat(10.0));
    // One multiplication an axis, with odd constants, then one good mix.
    let corner = |dx: i64, dy: i64, dz: i64| {
        let key = ((cell.x as i64 + dx) as u64).wrapping_mul(0xd6e8_feb8_6659_fd93)
            ^ ((cell.y as i64 + dy) as u64).wrapping_mul(0xa076_1d64_78bd_642f)
            ^ ((cell.z as i64 + dz) as u64).wrapping_mul(0xe703_7ed1_a0b4_28db);
        let bits = mix(key ^ channel.rotate_left(32)) >> 11;
        bits as f64 / (1u64 << 52) as f64 - 1.0
    };
    let along_x = |dy, dz| mix_between(corner(0, dy, dz), corner(1, dy, dz), fade.x);
    let along_y = |dz| mix_between(along_x(0, dz), along_x(1, dz), fade.y);
    mix_between(along_y(0), along_y(1), fade.z)
}

/// Three octaves of [`noise`], still within -1..1.
pub fn fractal(channel: u64, p: DVec3) -> f64 {
    let octave =
        |k: u64| noise(channel.wrapping_add(k), p * (1u64 << k) as f64) / (1u64 << k) as f64;
    (octave(0) + octave(1) + octave(2)) / 1.75
}

/// `a` at 0, `b` at 1.
pub fn mix_between(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// 0 below `low`, 1 above `high`, smooth between.
pub fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_continuous_over_cell_borders_and_bounded() {
        for i in -3..3 {
            let border = DVec3::new(i as f64, 0.3, -0.7);
            let step = noise(1, border - DVec3::X * 1e-9) - noise(1, border + DVec3::X * 1e-9);
            assert!(step.abs() < 1e-7);
        }
        for i in 0..1000 {
            let p = DVec3::new(unit(2, i), unit(3, i), unit(4, i)) * 20.0;
            assert!(fractal(5, p).abs() <= 1.0);
        }
    }
}
