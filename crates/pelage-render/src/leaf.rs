//! Where a ray crosses a leaf: a short straight piece of hair.
//!
//! In the frame of the ray, the leaf is a segment in a plane; the ray is the
//! origin of that plane. A ribbon turned to the ray is hit where the nearest point
//! of the segment is closer than half its width (Woop et al., "Exploiting Local
//! Orientation Similarity for Efficient Ray Traversal of Hair and Fur", HPG 2014,
//! section 3). A round tube is hit earlier, by what the circle of its section
//! stands out towards the ray; exact for a cylinder, close for a slim cone.

use crate::sampling::frame;
use glam::Vec3;

/// A ray with unit vectors across it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub origin: Vec3,
    /// Unit direction.
    pub direction: Vec3,
    x: Vec3,
    y: Vec3,
}

impl Ray {
    /// The ray from `origin` along the unit vector `direction`.
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        let (x, y) = frame(direction);
        Self {
            origin,
            direction,
            x,
            y,
        }
    }

    fn local(&self, p: &[f32; 4]) -> Vec3 {
        let d = Vec3::new(p[0], p[1], p[2]) - self.origin;
        Vec3::new(d.dot(self.x), d.dot(self.y), d.dot(self.direction))
    }
}

/// How far tubes reach into each other, in half widths: enough for the largest turn
/// that strands are cut by where they are wide. Strands become longer by as much.
const JOINT: f32 = 0.1;

/// Distance along the ray and place along the leaf (0 at `a`, 1 at `b`) where it is
/// crossed. `a` and `b` hold a position and half a width.
#[inline]
pub(crate) fn cross(ray: &Ray, a: &[f32; 4], b: &[f32; 4], round: bool) -> Option<(f32, f32)> {
    let (p, q) = (ray.local(a), ray.local(b));
    let edge = q - p;
    let across = edge.x * edge.x + edge.y * edge.y;
    let s = -(p.x * edge.x + p.y * edge.y) / across;
    // Also refuses the NaN of a leaf that lies along the ray.
    if round {
        if !(-8.0..=9.0).contains(&s) {
            return None;
        }
    } else if !(0.0..1.0).contains(&s) {
        return None;
    }
    let (x, y) = (p.x + edge.x * s, p.y + edge.y * s);
    let half = a[3] + (b[3] - a[3]) * s.clamp(0.0, 1.0);
    let inside = half * half - (x * x + y * y);
    if inside < 0.0 || half <= 0.0 {
        return None;
    }
    if !round {
        return Some((p.z + edge.z * s, s));
    }
    let length = edge.length();
    let (sine, cosine) = (across.sqrt() / length, edge.z / length);
    let back = inside.sqrt() / sine;
    let s_entry = s - back * cosine / length;
    // Tubes reach into each other a little, or a joint that bends would gape.
    let slack = JOINT * half / length;
    if !(-slack..1.0 + slack).contains(&s_entry) {
        return None;
    }
    Some((p.z + edge.z * s - back, s_entry.clamp(0.0, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tube_is_hit_on_its_surface_whatever_the_slant() {
        for k in 1..8 {
            let slant = k as f32 * 0.3 - 1.2;
            let (a, b) = ([-2.0, 0.0, -2.0 * slant, 0.3], [2.0, 0.0, 2.0 * slant, 0.3]);
            let ray = Ray::new(Vec3::new(0.05, 0.1, -9.0), Vec3::Z);
            let (t, s) = cross(&ray, &a, &b, true).unwrap();
            let hit = ray.origin + ray.direction * t;
            let axis = Vec3::new(1.0, 0.0, slant).normalize();
            let off = hit - axis * hit.dot(axis);
            assert!(
                (off.length() - 0.3).abs() < 1e-4,
                "slant {slant}: {}",
                off.length()
            );
            let on_axis = Vec3::new(-2.0 + 4.0 * s, 0.0, (-2.0 + 4.0 * s) * slant);
            assert!((hit - on_axis).dot(axis).abs() < 1e-3);
        }
    }

    #[test]
    fn a_leaf_along_the_ray_is_missed_without_harm() {
        let ray = Ray::new(Vec3::ZERO, Vec3::Z);
        for round in [false, true] {
            let hit = cross(&ray, &[0.0, 0.0, 1.0, 0.1], &[0.0, 0.0, 2.0, 0.1], round);
            assert!(hit.is_none());
        }
    }
}
