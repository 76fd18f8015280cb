//! Frames that do not twist: double reflection.
//!
//! Source: document 004, section 2.2.8 (after Wang et al. 2008). Each normal is
//! the one before it reflected in the plane half way between the two vertices,
//! then in the plane that brings the reflected tangent onto the new one. Fourth
//! order in the step; no trigonometry. Both reflections are guarded: vertices
//! that coincide reflect nothing, and a tangent that already fits needs no second
//! reflection.

use glam::Vec3;

/// Some unit vector perpendicular to the unit vector `direction`; a continuous
/// function of it but for one direction (-Z).
#[inline(always)]
pub fn any_perpendicular(direction: Vec3) -> Vec3 {
    // Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
    let sign = 1.0f32.copysign(direction.z);
    let a = -1.0 / (sign + direction.z);
    let b = direction.x * direction.y * a;
    Vec3::new(
        1.0 + sign * direction.x * direction.x * a,
        sign * b,
        -sign * direction.x,
    )
}

/// Writes a unit normal for each vertex, perpendicular to its unit tangent, such
/// that the frames turn about the curve as little as possible.
///
/// `first` is where the first normal should point; it is made perpendicular to
/// the first tangent, and replaced by some perpendicular where they are parallel.
/// The three slices have one length. [`untwisted_normals`](crate::untwisted_normals)
/// is faster for many curves.
pub fn double_reflection(points: &[Vec3], tangents: &[Vec3], first: Vec3, normals: &mut [Vec3]) {
    let Some(&tangent) = tangents.first() else {
        return;
    };
    let mut normal = perpendicular_part(first, tangent);
    normals[0] = normal;
    for i in 1..points.len() {
        let step = points[i] - points[i - 1];
        let carried = reflect_twice(step, tangents[i - 1], tangents[i], normal);
        normal = perpendicular_part(carried, tangents[i]);
        normals[i] = normal;
    }
}

/// Carries the unit `normal` along `step` from a vertex with unit tangent `from` to one
/// with `to`; what is left along `to` is rounding.
#[inline(always)]
pub(crate) fn reflect_twice(step: Vec3, from: Vec3, to: Vec3, normal: Vec3) -> Vec3 {
    let square = step.length_squared();
    let (tangent_left, normal_left) = if square > 0.0 {
        let scale = 2.0 / square;
        (
            from - step * (step.dot(from) * scale),
            normal - step * (step.dot(normal) * scale),
        )
    } else {
        (from, normal)
    };
    let across = to - tangent_left;
    let square = across.length_squared();
    if square > 0.0 {
        normal_left - across * (across.dot(normal_left) * 2.0 / square)
    } else {
        normal_left
    }
}

/// Unit part of `vector` perpendicular to the unit `tangent`.
#[inline(always)]
pub(crate) fn perpendicular_part(vector: Vec3, tangent: Vec3) -> Vec3 {
    let part = vector - tangent * vector.dot(tangent);
    let square = part.length_squared();
    // Below this the direction is rounding noise of a unit vector.
    if square > 1e-10 && square.is_finite() {
        part / square.sqrt()
    } else {
        any_perpendicular(tangent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catmull_rom;
    use proptest::prelude::*;

    #[test]
    fn on_a_plane_curve_the_plane_normal_stays() {
        let points: Vec<_> = (0..20)
            .map(|i| {
                let a = i as f32 * 0.3;
                Vec3::new(libm::cosf(a), libm::sinf(a), 0.0)
            })
            .collect();
        let mut tangents = vec![Vec3::ZERO; 20];
        catmull_rom::tangents(&points, &mut tangents);
        let mut normals = vec![Vec3::ZERO; 20];
        double_reflection(&points, &tangents, Vec3::Z, &mut normals);
        for n in normals {
            assert!(n.distance(Vec3::Z) < 1e-5);
        }
    }

    /// On a helix the frame that does not twist turns against the Frenet frame by
    /// minus the torsion: a closed form to sweep a tolerance against.
    #[test]
    fn on_a_helix_the_error_falls_with_the_fourth_power_of_the_step() {
        let mut previous = f32::INFINITY;
        for steps in [2usize, 4, 8, 16] {
            let error = helix_error(steps);
            let bound = (previous / 8.0).max(ROUNDING);
            assert!(error < bound, "{steps} steps: {error} after {previous}");
            previous = error;
        }
    }

    const ROUNDING: f32 = 2e-6;

    fn helix_error(steps: usize) -> f32 {
        let (radius, pitch) = (1.0f32, 0.5f32);
        let speed = (radius * radius + pitch * pitch).sqrt();
        let end = 4.0f32;
        let at = |a: f32| Vec3::new(radius * libm::cosf(a), radius * libm::sinf(a), pitch * a);
        let tangent =
            |a: f32| Vec3::new(-radius * libm::sinf(a), radius * libm::cosf(a), pitch) / speed;
        let angles: Vec<f32> = (0..=steps).map(|i| end * i as f32 / steps as f32).collect();
        let points: Vec<_> = angles.iter().map(|&a| at(a)).collect();
        let tangents: Vec<_> = angles.iter().map(|&a| tangent(a)).collect();
        let mut normals = vec![Vec3::ZERO; points.len()];
        double_reflection(&points, &tangents, -Vec3::X, &mut normals);
        // Torsion times arc length: pitch / speed² · speed · angle.
        let turn = -(pitch / speed) * end;
        let frenet_n = -Vec3::new(libm::cosf(end), libm::sinf(end), 0.0);
        let frenet_b = tangent(end).cross(frenet_n);
        let exact = frenet_n * libm::cosf(turn) + frenet_b * libm::sinf(turn);
        normals[steps].distance(exact)
    }

    proptest! {
        #[test]
        fn frames_are_orthonormal_whatever_the_points(
            points in prop::collection::vec(prop::array::uniform3(-2i8..3), 1..12),
            first in prop::array::uniform3(-1i8..2),
        ) {
            let vec = |p: &[i8; 3]| Vec3::new(p[0] as f32, p[1] as f32, p[2] as f32);
            let points: Vec<_> = points.iter().map(vec).collect();
            let mut tangents = vec![Vec3::ZERO; points.len()];
            catmull_rom::tangents(&points, &mut tangents);
            let mut normals = vec![Vec3::ZERO; points.len()];
            double_reflection(&points, &tangents, vec(&first), &mut normals);
            for (n, t) in normals.iter().zip(&tangents) {
                prop_assert!((n.length() - 1.0).abs() < 1e-4);
                prop_assert!(n.dot(*t).abs() < 1e-4);
            }
        }
    }
}
