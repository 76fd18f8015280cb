//! Scale: how long a hair is compared with its guides.
//!
//! Source: document 004, section 2.2.2: `amount · (1 - random · ξ)`. A fraction without
//! unit; local space, where the root is the origin.

use crate::lanes::{Row, Rows};
use crate::random::{Channel, uniform};

/// The factor of hair `hair` where the properties are `amount` and `random`.
#[inline]
pub fn factor(amount: f32, random: f32, seed: u64, hair: u64) -> f32 {
    let shrink = random.clamp(0.0, 1.0) * uniform(seed, hair, Channel::Scale);
    amount.max(0.0) * (1.0 - shrink)
}

/// Scales hairs that lie side by side about their roots.
#[inline(always)]
pub(crate) fn scale(factors: &Row, hairs: &mut [Rows]) {
    for vertex in hairs {
        *vertex = Rows::from_fn(|lane| vertex.get(lane) * factors[lane]);
    }
}
