//! Scale: how long a hair is compared with its guides.
//!
//! Source: document 004, section 2.2.2: `amount · (1 - random · ξ)`. A fraction without
//! unit; local space, where the root is the origin.

use crate::maps::ScalarField;
use crate::random::{Channel, uniform};
use pelage_curves::{Vec2, Vec3};

/// The amount at `uv`, at least 0.
#[inline]
pub fn amount(amount: &ScalarField, uv: Vec2) -> f32 {
    amount.at(uv).max(0.0)
}

/// What chance leaves of it to hair `hair` with its root at `uv`, 0..=1.
#[inline]
pub fn random(random: &ScalarField, uv: Vec2, seed: u64, hair: u64) -> f32 {
    1.0 - random.at(uv).clamp(0.0, 1.0) * uniform(seed, hair, Channel::Scale)
}

/// Scales the vertices of a hair about its root.
#[inline]
pub fn scale(factor: f32, hair: &mut [Vec3]) {
    hair.iter_mut().for_each(|v| *v *= factor);
}
