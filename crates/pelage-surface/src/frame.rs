//! Places on a surface, and the frame of a root.
//!
//! Source: document 004, section 2.2.3. The local frame is (tangent, binormal,
//! normal) with binormal = tangent × normal. It is left-handed: with the tangent
//! along +u, the binormal points along -v. Every local vector in Pelage is written
//! in that order.

use crate::Mesh;
use bytemuck::{Pod, Zeroable};
use pelage_curves::{Vec2, Vec3, any_perpendicular};

/// A place on a surface: a triangle and the weights of its corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct SurfacePoint {
    /// Triangle of the mesh.
    pub triangle: u32,
    /// Weights of the triangle's corners; at least 0, summing to 1.
    pub barycentric: [f32; 3],
}

/// Position and orthonormal frame at a place on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RootFrame {
    /// Position.
    pub position: Vec3,
    /// Unit tangent, along +u where the surface has UVs.
    pub tangent: Vec3,
    /// `tangent × normal`.
    pub binormal: Vec3,
    /// Unit normal.
    pub normal: Vec3,
}

impl RootFrame {
    /// A frame from a normal and a tangent that need not be perpendicular or units.
    #[inline(always)]
    pub fn new(position: Vec3, tangent: Vec3, normal: Vec3) -> Self {
        let normal = unit_or(normal, Vec3::Z);
        let part = tangent - normal * tangent.dot(normal);
        let tangent = unit_or(part, any_perpendicular(normal));
        Self {
            position,
            tangent,
            binormal: tangent.cross(normal),
            normal,
        }
    }

    /// A vector with local coordinates (tangent, binormal, normal), in the space of
    /// the frame.
    #[inline]
    pub fn vector(&self, local: Vec3) -> Vec3 {
        self.tangent * local.x + self.binormal * local.y + self.normal * local.z
    }

    /// Local coordinates of a vector.
    #[inline]
    pub fn local(&self, vector: Vec3) -> Vec3 {
        Vec3::new(
            vector.dot(self.tangent),
            vector.dot(self.binormal),
            vector.dot(self.normal),
        )
    }
}

impl Mesh {
    /// Position at `point`.
    #[inline]
    pub fn position(&self, point: &SurfacePoint) -> Vec3 {
        weigh(self.corners(point.triangle as usize), point.barycentric)
    }

    /// Texture coordinates at `point`; (0, 0) on a surface without UVs.
    #[inline]
    pub fn uv(&self, point: &SurfacePoint) -> Vec2 {
        let [a, b, c] = point.barycentric;
        self.uvs()
            .get(point.triangle as usize)
            .map_or(Vec2::ZERO, |uv| uv[0] * a + uv[1] * b + uv[2] * c)
    }

    /// Unit normal at `point`: that of its frame.
    #[inline]
    pub fn normal(&self, point: &SurfacePoint) -> Vec3 {
        let normal = weigh(self.normals()[point.triangle as usize], point.barycentric);
        normal.try_normalize().unwrap_or(Vec3::Z)
    }

    /// Position and frame at `point`.
    #[inline]
    pub fn frame(&self, point: &SurfacePoint) -> RootFrame {
        let t = point.triangle as usize;
        let position = weigh(self.corners(t), point.barycentric);
        let normal = weigh(self.normals()[t], point.barycentric);
        RootFrame::new(position, self.tangent(point), normal)
    }

    /// Some vector along +u at `point`.
    #[inline(always)]
    pub(crate) fn tangent(&self, point: &SurfacePoint) -> Vec3 {
        let corners = &self.tangents()[point.triangle as usize];
        let tangent = weigh(*corners, point.barycentric);
        // Tangents that cancel (a sharp fold of the texture) leave the corner's own.
        if tangent.length_squared() > 1e-6 {
            tangent
        } else {
            corners[0]
        }
    }
}

/// `vector` at length 1, or `otherwise` where it has none. Both are computed and one is
/// chosen, so that many go side by side.
#[inline(always)]
fn unit_or(vector: Vec3, otherwise: Vec3) -> Vec3 {
    let scale = vector.length_recip();
    let has_length = scale.is_finite() & (scale > 0.0);
    let unit = vector * scale;
    Vec3::from_array(std::array::from_fn(|k| {
        if has_length { unit[k] } else { otherwise[k] }
    }))
}

#[inline]
pub(crate) fn weigh([a, b, c]: [Vec3; 3], weights: [f32; 3]) -> Vec3 {
    a * weights[0] + b * weights[1] + c * weights[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn local_coordinates_and_back_is_the_identity(
            normal in prop::array::uniform3(-1.0f32..1.0),
            tangent in prop::array::uniform3(-1.0f32..1.0),
            vector in prop::array::uniform3(-1.0f32..1.0),
        ) {
            let frame = RootFrame::new(Vec3::ZERO, tangent.into(), normal.into());
            let vector = Vec3::from(vector);
            prop_assert!(frame.vector(frame.local(vector)).distance(vector) < 1e-5);
            prop_assert!(frame.local(frame.tangent).distance(Vec3::X) < 1e-5);
            prop_assert!(frame.local(frame.normal).distance(Vec3::Z) < 1e-5);
        }
    }

    #[test]
    fn the_binormal_is_tangent_cross_normal() {
        let frame = RootFrame::new(Vec3::ZERO, Vec3::X, Vec3::Z);
        assert_eq!(frame.binormal, -Vec3::Y);
    }
}
