//! Roots on a displaced surface.
//!
//! Source: document 004, section 2.2.3: `P' = P + D N` and
//! `∂P' = ∂P + ∂D N + D ∂N`, the normal from the product of two such derivatives, the
//! tangent by Gram–Schmidt (errata). Two things are done otherwise:
//!
//! - Derivatives are taken along two edges of the triangle instead of u and v. The
//!   product of the two is the same up to a factor, and the 2 × 2 matrix of the texture
//!   coordinates, which the document multiplies with where it has to be inverted, is not
//!   needed: singular texture coordinates are no special case.
//! - `∂P` is taken in the plane of the interpolated normal, not of the triangle (as
//!   Pharr, Jakob and Humphreys do for bumps on shading geometry). A displacement of 0
//!   then gives the frame of the plain surface, and facets do not show.
//!
//! Computed in f64, since differences of normals over a small triangle lose digits.

use crate::frame::weigh;
use crate::{Mesh, RootFrame, SurfacePoint};
use pelage_curves::{DVec3, Vec2, Vec3};

/// What a displacement says at one place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Displacement {
    /// How far the surface moves along its normal, in the unit of the mesh.
    pub height: f32,
    /// How fast that changes along u and v, in the unit of the mesh by unit of texture
    /// space.
    pub slope: Vec2,
}

impl Mesh {
    /// Position and frame at `point` of the surface displaced along its normals. The
    /// normal points to the side that the plain one points to; where the displaced
    /// surface has no direction, it is the plain one.
    ///
    /// ```
    /// use pelage_surface::{Displacement, Mesh, PolygonMesh, SurfacePoint};
    /// use pelage_curves::{Vec2, Vec3};
    ///
    /// let mesh = Mesh::new(PolygonMesh {
    ///     positions: vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
    ///     face_sizes: vec![3],
    ///     corner_vertices: vec![0, 1, 2],
    ///     corner_uvs: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
    ///     ..PolygonMesh::default()
    /// })?;
    /// // A slope of 2 over one unit of u, which is two units of length: 45°.
    /// let slope = Displacement { height: 0.5, slope: Vec2::new(2.0, 0.0) };
    /// let point = SurfacePoint { triangle: 0, barycentric: [1.0, 0.0, 0.0] };
    /// let frame = mesh.displaced_frame(&point, &slope);
    /// assert_eq!(frame.position, Vec3::new(0.0, 0.0, 0.5));
    /// assert!(frame.normal.distance(Vec3::new(-1.0, 0.0, 1.0).normalize()) < 1e-6);
    /// # Ok::<(), pelage_surface::MeshError>(())
    /// ```
    pub fn displaced_frame(&self, point: &SurfacePoint, by: &Displacement) -> RootFrame {
        let plain = self.frame(point);
        if *by == Displacement::default() {
            return plain;
        }
        let normal = self.displaced_normal(point, &plain, by);
        let tangent = plain.tangent.as_dvec3();
        let part = tangent - normal * tangent.dot(normal);
        // Little of it is left where the surface rises steeply along u; less than this is
        // the rounding of the plain tangent, and any perpendicular is as good.
        let part = match part.length_squared() > 1e-12 {
            true => part.normalize().as_vec3(),
            false => Vec3::ZERO,
        };
        let position = plain.position + plain.normal * by.height;
        RootFrame::new(position, part, normal.as_vec3())
    }

    fn displaced_normal(
        &self,
        point: &SurfacePoint,
        plain: &RootFrame,
        by: &Displacement,
    ) -> DVec3 {
        let triangle = point.triangle as usize;
        let corners = self.corners(triangle).map(|p| p.as_dvec3());
        let normals = self.normals()[triangle];
        let shared = weigh(normals, point.barycentric).length() as f64;
        let normals = normals.map(|n| n.as_dvec3());
        let normal = plain.normal.as_dvec3();
        let in_plane = |v: DVec3| v - normal * v.dot(normal);
        let uvs = self.uvs().get(triangle);
        let along = |k: usize| {
            let change = uvs.map_or(0.0, |uv| by.slope.dot(uv[k] - uv[0]) as f64);
            // ∂N of the interpolated normal made a unit vector.
            let turn = in_plane(normals[k] - normals[0]) / shared;
            in_plane(corners[k] - corners[0]) + normal * change + turn * by.height as f64
        };
        let across = along(1).cross(along(2));
        let outward = if across.dot(normal) < 0.0 {
            -across
        } else {
            across
        };
        outward.try_normalize().unwrap_or(normal)
    }
}
