//! Tangents along +u, continuous where the texture is.
//!
//! A corner's tangent is the average of ∂P/∂u over the triangles that share its
//! vertex *and* its texture coordinates *and* the handedness of the mapping: seams
//! and mirrored halves keep their own. Source: document 004, section 2.2.3, with the
//! 2 × 2 matrix inverted as it must be (errata).

use pelage_curves::{Vec2, Vec3, any_perpendicular};
use std::collections::HashMap;

/// Unit tangent at each corner, perpendicular to the corner's normal.
pub(crate) fn corner_tangents(
    positions: &[Vec3],
    triangles: &[[u32; 3]],
    uvs: &[[Vec2; 3]],
    normals: &[[Vec3; 3]],
) -> Vec<[Vec3; 3]> {
    let along_u: Vec<Option<(Vec3, bool)>> = triangles
        .iter()
        .enumerate()
        .map(|(t, triangle)| {
            let corners = triangle.map(|v| positions[v as usize]);
            uvs.get(t).and_then(|uv| derivative_u(corners, *uv))
        })
        .collect();
    let sums = sum_over_fans(triangles, uvs, &along_u);
    (0..triangles.len())
        .map(|t| {
            let own = along_u[t].map_or_else(|| first_edge(positions, triangles[t]), |(d, _)| d);
            std::array::from_fn(|k| {
                let shared = along_u[t].and_then(|(_, mirrored)| {
                    sums.get(&key(triangles[t][k], uvs[t][k], mirrored))
                        .copied()
                });
                let normal = normals[t][k];
                shared
                    .and_then(|d| in_plane(d, normal))
                    .or_else(|| in_plane(own, normal))
                    .unwrap_or_else(|| any_perpendicular(normal))
            })
        })
        .collect()
}

type FanKey = (u32, [u32; 2], bool);

fn key(vertex: u32, uv: Vec2, mirrored: bool) -> FanKey {
    (vertex, [uv.x.to_bits(), uv.y.to_bits()], mirrored)
}

fn sum_over_fans(
    triangles: &[[u32; 3]],
    uvs: &[[Vec2; 3]],
    along_u: &[Option<(Vec3, bool)>],
) -> HashMap<FanKey, Vec3> {
    let mut sums = HashMap::new();
    for (t, derivative) in along_u.iter().enumerate() {
        let Some((derivative, mirrored)) = *derivative else {
            continue;
        };
        for k in 0..3 {
            let sum = sums
                .entry(key(triangles[t][k], uvs[t][k], mirrored))
                .or_insert(Vec3::ZERO);
            *sum += derivative.normalize_or_zero();
        }
    }
    sums
}

/// ∂P/∂u of a triangle and whether its mapping is mirrored; `None` where the
/// texture coordinates have no area.
pub(crate) fn derivative_u([a, b, c]: [Vec3; 3], [s, t, r]: [Vec2; 3]) -> Option<(Vec3, bool)> {
    let (e, f) = ((b - a).as_dvec3(), (c - a).as_dvec3());
    let (g, h) = ((t - s).as_dvec2(), (r - s).as_dvec2());
    let determinant = g.x * h.y - g.y * h.x;
    let derivative = (e * h.y - f * g.y) / determinant;
    (determinant != 0.0 && derivative.is_finite())
        .then(|| (derivative.as_vec3(), determinant < 0.0))
}

fn first_edge(positions: &[Vec3], triangle: [u32; 3]) -> Vec3 {
    positions[triangle[1] as usize] - positions[triangle[0] as usize]
}

fn in_plane(direction: Vec3, normal: Vec3) -> Option<Vec3> {
    let direction = direction.try_normalize()?;
    let part = direction - normal * direction.dot(normal);
    // A direction almost along the normal leaves only rounding noise.
    if part.length_squared() > 1e-8 {
        part.try_normalize()
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tangent_follows_u() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let uvs = [[Vec2::ZERO, Vec2::Y, Vec2::X]];
        let tangents = corner_tangents(&positions, &[[0, 1, 2]], &uvs, &[[Vec3::Z; 3]]);
        assert_eq!(tangents[0], [Vec3::Y; 3]);
    }

    #[test]
    fn mirrored_halves_do_not_cancel() {
        // u = |x|: on the line x = 0 the two sides pull in opposite directions.
        let positions = [
            Vec3::new(-1., 0., 0.),
            Vec3::ZERO,
            Vec3::Y,
            Vec3::new(1., 0., 0.),
        ];
        let triangles = [[0, 1, 2], [1, 3, 2]];
        let uv = |v: u32| Vec2::new(positions[v as usize].x.abs(), positions[v as usize].y);
        let uvs: Vec<_> = triangles.iter().map(|t: &[u32; 3]| t.map(uv)).collect();
        let tangents = corner_tangents(&positions, &triangles, &uvs, &[[Vec3::Z; 3]; 2]);
        assert_eq!(tangents[0], [-Vec3::X; 3]);
        assert_eq!(tangents[1], [Vec3::X; 3]);
    }

    #[test]
    fn without_texture_area_any_tangent_is_perpendicular() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let uvs = [[Vec2::ZERO; 3]];
        let tangents = corner_tangents(&positions, &[[0, 1, 2]], &uvs, &[[Vec3::Z; 3]]);
        assert!(
            tangents[0]
                .iter()
                .all(|t| t.dot(Vec3::Z).abs() < 1e-6 && t.is_normalized())
        );
    }
}
