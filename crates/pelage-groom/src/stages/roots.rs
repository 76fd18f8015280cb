//! Roots: where each hair grows, its texture coordinates and its group.
//!
//! Source: document 004, sections 2.1 and 2.2.3. Reads the rest pose alone. Positions
//! in the unit of the mesh.

use crate::groups::Groups;
use pelage_curves::{Vec2, Vec3};
use pelage_surface::{Mesh, SurfacePoint};

/// Where a hair grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// Index of the hair.
    pub hair: u64,
    /// Place on the surface.
    pub place: SurfacePoint,
    /// Position on the surface at rest.
    pub rest: Vec3,
    /// Texture coordinates, (0, 0) without UVs.
    pub uv: Vec2,
    /// Interpolation group.
    pub group: u32,
}

/// The root of hair `hair`, which the sampler placed at `place`.
#[inline]
pub fn root(hair: u64, place: SurfacePoint, rest: &Mesh, groups: &Groups) -> Root {
    let uv = rest.uv(&place);
    Root {
        hair,
        place,
        rest: rest.position(&place),
        uv,
        group: groups.at(uv),
    }
}
