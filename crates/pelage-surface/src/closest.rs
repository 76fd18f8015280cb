//! The place on a surface that is nearest to a point.
//!
//! A bounding volume hierarchy of the triangles (`obvhs`) is walked nearest box
//! first; the distance to a triangle is Ericson's region test ("Real-Time Collision
//! Detection", 5.1.5). Of places at equal distance the one on the triangle of
//! smallest index wins, so that the answer does not depend on the hierarchy.

use crate::{Mesh, SurfacePoint};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::triangle::Triangle;
use pelage_curves::Vec3;
use std::time::Duration;

/// Answers nearest-place queries on one mesh.
pub struct ClosestPoint<'a> {
    mesh: &'a Mesh,
    bvh: Bvh2,
}

impl<'a> ClosestPoint<'a> {
    /// Prepares `mesh`; degenerate triangles are never an answer.
    pub fn new(mesh: &'a Mesh) -> Self {
        let triangles: Vec<Triangle> = (0..mesh.triangles().len())
            .map(|t| {
                let [v0, v1, v2] = mesh.corners(t).map(Into::into);
                Triangle { v0, v1, v2 }
            })
            .collect();
        let bvh = obvhs::bvh2::builder::build_bvh2_from_tris(
            &triangles,
            BvhBuildParams::medium_build(),
            &mut Duration::default(),
        );
        Self { mesh, bvh }
    }

    /// The nearest place and its distance; `None` where every triangle is
    /// degenerate or `point` is not finite.
    pub fn query(&self, point: Vec3) -> Option<(SurfacePoint, f32)> {
        let mut best: Option<(f32, SurfacePoint)> = None;
        let mut stack = vec![(0.0f32, 0usize)];
        while let Some((near, node)) = stack.pop() {
            if best.is_some_and(|(d, _)| near > d) {
                continue;
            }
            let Some(node) = self.bvh.nodes.get(node) else {
                continue;
            };
            if node.is_leaf() {
                let first = node.first_index as usize;
                for &t in &self.bvh.primitive_indices[first..first + node.prim_count as usize] {
                    self.offer(point, t, &mut best);
                }
            } else {
                let first = node.first_index as usize;
                let mut children =
                    [first, first + 1].map(|c| (distance(self.bvh.nodes[c].aabb(), point), c));
                if children[0].0 < children[1].0 {
                    children.swap(0, 1);
                }
                stack.extend(children);
            }
        }
        best.map(|(square, place)| (place, square.sqrt()))
    }

    fn offer(&self, point: Vec3, triangle: u32, best: &mut Option<(f32, SurfacePoint)>) {
        let corners = self.mesh.corners(triangle as usize);
        let Some(barycentric) = nearest_in_triangle(corners, point) else {
            return;
        };
        let place = SurfacePoint {
            triangle,
            barycentric,
        };
        let square = self.mesh.position(&place).distance_squared(point);
        let better = best
            .as_ref()
            .is_none_or(|(d, p)| square < *d || (square == *d && triangle < p.triangle));
        if better && square.is_finite() {
            *best = Some((square, place));
        }
    }
}

/// Squared distance from `point` to a box.
fn distance(aabb: &Aabb, point: Vec3) -> f32 {
    let (low, high): (Vec3, Vec3) = (aabb.min.into(), aabb.max.into());
    point.clamp(low, high).distance_squared(point)
}

/// Weights of the corners at the point of a triangle nearest to `p`; `None` for a
/// triangle without area.
fn nearest_in_triangle([a, b, c]: [Vec3; 3], p: Vec3) -> Option<[f32; 3]> {
    let [a, b, c, p] = [a, b, c, p].map(|v| v.as_dvec3());
    let (ab, ac, ap) = (b - a, c - a, p - a);
    if ab.cross(ac).length_squared() <= 0.0 {
        return None;
    }
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    let (bp, cp) = (p - b, p - c);
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    let (v, w) = if d1 <= 0.0 && d2 <= 0.0 {
        (0.0, 0.0)
    } else if d3 >= 0.0 && d4 <= d3 {
        (1.0, 0.0)
    } else if d6 >= 0.0 && d5 <= d6 {
        (0.0, 1.0)
    } else if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        (d1 / (d1 - d3), 0.0)
    } else if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        (0.0, d2 / (d2 - d6))
    } else if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        (1.0 - w, w)
    } else {
        let sum = va + vb + vc;
        (vb / sum, vc / sum)
    };
    let (v, w) = (v as f32, w as f32);
    Some([(1.0 - v - w).max(0.0), v, w])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PolygonMesh;
    use proptest::prelude::*;

    fn soup() -> Mesh {
        let n = 60u32;
        let positions: Vec<[f32; 3]> = (0..3 * n)
            .map(|i| {
                let r = |k: u32| (i * 7 + k * 131).wrapping_mul(2_654_435_761) as f32;
                [r(1), r(2), r(3)].map(|x| x / u32::MAX as f32)
            })
            .collect();
        Mesh::new(PolygonMesh {
            positions,
            face_sizes: vec![3; n as usize],
            corner_vertices: (0..3 * n).collect(),
            ..Default::default()
        })
        .unwrap()
    }

    proptest! {
        #[test]
        fn the_hierarchy_finds_what_trying_every_triangle_finds(
            point in prop::array::uniform3(-0.5f32..1.5)
        ) {
            let (mesh, point) = (soup(), Vec3::from(point));
            let closest = ClosestPoint::new(&mesh);
            let mut best = None;
            (0..mesh.triangles().len() as u32).for_each(|t| closest.offer(point, t, &mut best));
            let (place, distance) = closest.query(point).unwrap();
            let (square, expected) = best.unwrap();
            prop_assert_eq!(place, expected);
            prop_assert_eq!(distance, square.sqrt());
        }

        #[test]
        fn no_sampled_place_is_nearer(
            corners in prop::array::uniform3(prop::array::uniform3(-1.0f32..1.0)),
            point in prop::array::uniform3(-2.0f32..2.0),
        ) {
            let [a, b, c] = corners.map(Vec3::from);
            let point = Vec3::from(point);
            let Some(w) = nearest_in_triangle([a, b, c], point) else { return Ok(()) };
            let best = (a * w[0] + b * w[1] + c * w[2]).distance(point);
            for i in 0..=20 {
                for j in 0..=20 - i {
                    let (u, v) = (i as f32 / 20.0, j as f32 / 20.0);
                    let p = a * (1.0 - u - v) + b * u + c * v;
                    prop_assert!(p.distance(point) >= best - 1e-5);
                }
            }
        }
    }
}
