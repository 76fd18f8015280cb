//! A normal, carried from one tangent to the next.

use crate::frenet::{Frame, unit};
use glam::DVec3;

/// Below this, 1 + cos of the angle between two tangents leaves no axis to turn about.
const OPPOSITE: f64 = 1e-12;

/// Below this, the second reflection has no plane.
const FITS: f64 = 1e-12;

/// The normal of `frame` turned by the smallest rotation that brings its tangent onto the
/// unit tangent `to`. Where that is the opposite one, all axes are as good: the normal is
/// kept, as if turned about itself.
pub(crate) fn turned(frame: &Frame, to: DVec3) -> DVec3 {
    let (from, normal) = (frame.tangent, frame.normal);
    let both = 1.0 + from.dot(to);
    if both < OPPOSITE {
        return normal;
    }
    // Rodrigues' rotation of what is perpendicular to `from`, without an angle.
    normal - (from + to) * (normal.dot(to) / both)
}

/// The normal of `frame` reflected in the plane half way along `step`, then in the one that
/// brings the tangent onto `to`. Two reflections are a rotation, one is not: where either
/// has no plane (points that coincide, a step to the side), the smallest rotation takes the
/// place of both.
pub(super) fn reflected_twice(frame: &Frame, step: DVec3, to: DVec3) -> DVec3 {
    let Some(step) = unit(step) else {
        return turned(frame, to);
    };
    let reflect = |v: DVec3, plane: DVec3| v - plane * (2.0 * plane.dot(v));
    let tangent = reflect(frame.tangent, step);
    match unit(to - tangent).filter(|_| to.distance(tangent) > FITS) {
        Some(plane) => reflect(reflect(frame.normal, step), plane),
        None => turned(frame, to),
    }
}
