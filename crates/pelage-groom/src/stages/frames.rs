//! A normal at every vertex such that the hair does not twist.
//!
//! Source: document 004, section 2.2.8, with its errata: the first normal is the
//! surface tangent at the root made perpendicular to the curve. World space, unit
//! vectors.

use pelage_curves::{FrameScratch, Vec3, untwisted_normals};

/// Writes the normals of curves; curve `i` has the vertices `offsets[i]..offsets[i + 1]`,
/// and `tangent(i)` is the surface's tangent at its root.
pub fn normals(
    tangent: impl Fn(usize) -> Vec3,
    curves: &[Vec3],
    offsets: &[u32],
    scratch: &mut FrameScratch,
    normals: &mut [Vec3],
) {
    untwisted_normals(curves, offsets, tangent, scratch, normals);
}
