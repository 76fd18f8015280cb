//! A normal at every vertex such that the hair does not twist.
//!
//! Source: document 004, section 2.2.8, with its errata: the first normal is the
//! surface tangent at the root made perpendicular to the curve. World space, unit
//! vectors.

use pelage_curves::{Vec3, catmull_rom, double_reflection};
use pelage_surface::RootFrame;

/// Writes the normals of a hair; `tangents` is scratch of the same length.
#[inline]
pub fn normals(root: &RootFrame, hair: &[Vec3], tangents: &mut [Vec3], normals: &mut [Vec3]) {
    catmull_rom::tangents(hair, tangents);
    double_reflection(hair, tangents, root.tangent, normals);
}
