//! From the local frame of the root to the space of the posed surface.
//!
//! Source: document 004, section 2.2.2. The only stage that sees the pose.

use pelage_curves::Vec3;
use pelage_surface::RootFrame;

/// Moves the local vertices of a hair to the space of `frame`, the frame of its root.
#[inline]
pub fn to_world(frame: &RootFrame, hair: &mut [Vec3]) {
    for vertex in hair {
        *vertex = frame.position + frame.vector(*vertex);
    }
}
