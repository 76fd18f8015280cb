//! A normal at every vertex such that the hair does not twist.
//!
//! Source: document 004, section 2.2.8, with its errata: the first normal is the
//! surface tangent at the root made perpendicular to the curve. World space, unit
//! vectors.

use pelage_curves::{FrameScratch, Vec3, untwisted_normals};
use pelage_surface::RootFrame;

/// Writes the normals of hairs; hair `i` has the vertices `offsets[i]..offsets[i + 1]`.
pub fn normals(
    roots: &[RootFrame],
    hairs: &[Vec3],
    offsets: &[u32],
    scratch: &mut FrameScratch,
    normals: &mut [Vec3],
) {
    untwisted_normals(hairs, offsets, |i| roots[i].tangent, scratch, normals);
}
