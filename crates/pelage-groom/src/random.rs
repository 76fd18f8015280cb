//! Random numbers as a function of (seed, hair, channel).
//!
//! There is no generator state: whoever needs a number for a hair asks for it by the
//! hair's index and the purpose, and always gets the same (architecture.md, law 1).

use pelage_surface::hash;

/// What a random number is for. Numbers of two channels are independent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u64)]
pub enum Channel {
    /// `scale.random`.
    Scale = 1,
    /// Where the grown guides start in Halton's sequence.
    GuideRoot = 2,
    /// Phase of a grown guide's curl.
    GuideCurl = 3,
    /// The noise of `frizz`.
    Frizz = 4,
    /// The noise of `kink`.
    Kink = 5,
    /// Whether a hair is a mutant.
    Mutant = 8,
    /// `color.variation.hue`.
    Hue = 9,
    /// `color.variation.saturation`.
    Saturation = 10,
    /// `color.variation.value`.
    Value = 11,
    /// Where the first fibre of a multi-strand stands in its disc.
    FiberPlace = 12,
    /// `strand.randomize`.
    FiberLength = 13,
    /// `clump.levels[].random`.
    Clump = 14,
    /// Whether a hair is a flyaway.
    Flyaway = 15,
    /// How steeply it strays.
    FlyawayHeight = 16,
    /// Which way it strays.
    FlyawayAngle = 17,
}

/// A number in 0..1 for hair `hair` of the groom seeded `seed`.
///
/// ```
/// use pelage_groom::random::{Channel, uniform};
/// assert_eq!(uniform(7, 42, Channel::Scale), uniform(7, 42, Channel::Scale));
/// assert_ne!(uniform(7, 42, Channel::Scale), uniform(7, 43, Channel::Scale));
/// ```
#[inline(always)]
pub fn uniform(seed: u64, hair: u64, channel: Channel) -> f32 {
    let word = word(seed, hair, channel);
    (word >> 40) as f32 * (1.0 / (1u32 << 24) as f32)
}

/// 64 random bits for hair `hair` of the groom seeded `seed`.
#[inline]
pub fn word(seed: u64, hair: u64, channel: Channel) -> u64 {
    hash(hash(seed ^ hash(channel as u64)) ^ hair)
}

/// The seed of a noise in the groom seeded `seed`.
pub(crate) fn noise_seed(seed: u64, channel: Channel) -> u32 {
    (hash(seed ^ hash(channel as u64)) >> 32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_neighbouring_hairs_are_uniform_and_uncorrelated() {
        let n = 65_536u64;
        for seed in [0, 1, u64::MAX] {
            let x: Vec<f64> = (0..n)
                .map(|i| uniform(seed, i, Channel::Scale) as f64)
                .collect();
            let mut bins = [0f64; 64];
            x.iter().for_each(|v| bins[(v * 64.0) as usize] += 1.0);
            let expected = n as f64 / 64.0;
            let chi_square: f64 = bins
                .iter()
                .map(|b| (b - expected) * (b - expected) / expected)
                .sum();
            assert!(chi_square < 130.0, "seed {seed}: {chi_square}");
            let lag: f64 = x.windows(2).map(|w| (w[0] - 0.5) * (w[1] - 0.5)).sum();
            let correlation = lag / (n as f64 / 12.0);
            assert!(correlation.abs() < 0.02, "seed {seed}: {correlation}");
        }
    }
}
