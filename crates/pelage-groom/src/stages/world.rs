//! From the local frame of the root to the space of the posed surface.
//!
//! Source: document 004, section 2.2.2. The only stage that sees the pose.

use pelage_curves::Vec3;
use pelage_surface::RootFrame;

/// Writes local vertices as positions in the space of `frame`.
#[inline]
pub fn to_world(frame: &RootFrame, local: impl Iterator<Item = Vec3>, world: &mut [Vec3]) {
    for (out, v) in world.iter_mut().zip(local) {
        *out = frame.position + frame.vector(v);
    }
}
