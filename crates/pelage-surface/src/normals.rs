//! Normals where a file has none.

use pelage_curves::Vec3;

/// Normal at each corner: the normals of all triangles around its vertex, each
/// weighted by its angle there (Thürmer and Wüthrich 1998), so that the result does
/// not depend on how faces were cut into triangles. Where they cancel, and at
/// vertices of degenerate triangles only, the corner has its triangle's own normal,
/// else +Z.
pub(crate) fn angle_weighted(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[Vec3; 3]> {
    let mut sums = vec![Vec3::ZERO; positions.len()];
    for triangle in triangles {
        let Some(normal) = face_normal(positions, triangle) else {
            continue;
        };
        for k in 0..3 {
            let [p, q, r] = [0, 1, 2].map(|j| positions[triangle[(k + j) % 3] as usize]);
            sums[triangle[k] as usize] += normal * angle(q - p, r - p);
        }
    }
    triangles
        .iter()
        .map(|triangle| {
            let own = face_normal(positions, triangle).unwrap_or(Vec3::Z);
            triangle.map(|v| sums[v as usize].try_normalize().unwrap_or(own))
        })
        .collect()
}

/// Unit normals from a file: normalised, and those without direction replaced by
/// the triangle's own.
pub(crate) fn repaired(
    mut normals: Vec<[Vec3; 3]>,
    positions: &[Vec3],
    triangles: &[[u32; 3]],
) -> Vec<[Vec3; 3]> {
    for (corners, triangle) in normals.iter_mut().zip(triangles) {
        for normal in corners {
            *normal = normal
                .try_normalize()
                .or_else(|| face_normal(positions, triangle))
                .unwrap_or(Vec3::Z);
        }
    }
    normals
}

fn face_normal(positions: &[Vec3], triangle: &[u32; 3]) -> Option<Vec3> {
    let [a, b, c] = triangle.map(|v| positions[v as usize].as_dvec3());
    (b - a).cross(c - a).try_normalize().map(|n| n.as_vec3())
}

/// Angle between two edges; `libm` so that it is the same on every machine.
fn angle(a: Vec3, b: Vec3) -> f32 {
    libm::atan2f(a.cross(b).length(), a.dot(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_corner_points_along_the_diagonal_however_its_faces_are_cut() {
        // Three squares meeting at the origin; the first is cut so that the corner
        // belongs to both of its triangles, the others so that it belongs to one.
        let p = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
        let positions = vec![
            p(0., 0., 0.),
            p(1., 0., 0.),
            p(1., 1., 0.),
            p(0., 1., 0.),
            p(0., 0., 1.),
            p(1., 0., 1.),
            p(0., 1., 1.),
        ];
        let triangles = [
            [0, 2, 1],
            [0, 3, 2], // z = 0, cut through the corner
            [0, 1, 4],
            [1, 5, 4], // y = 0
            [0, 4, 3],
            [4, 6, 3], // x = 0
        ];
        let normals = angle_weighted(&positions, &triangles);
        assert!(
            normals[0][0].distance(-Vec3::ONE.normalize()) < 1e-6,
            "{}",
            normals[0][0]
        );
    }
}
