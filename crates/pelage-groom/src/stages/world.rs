//! From the local frame of the root to the space of the posed surface.
//!
//! Source: document 004, section 2.2.2. The only stage that sees the pose.

use crate::lanes::{Frames, Rows};
use fearless_simd::Simd;

/// Moves the local vertices of hairs that lie side by side to the space of `frames`, those of
/// their roots.
#[inline(always)]
pub(crate) fn to_world<S: Simd>(simd: S, frames: &Frames, hairs: &mut [Rows]) {
    for vertex in hairs {
        *vertex = frames.place(simd, vertex.load(simd)).rows();
    }
}
