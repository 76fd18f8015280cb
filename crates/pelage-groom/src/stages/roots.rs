//! Roots: where each hair grows, its texture coordinates and its group.
//!
//! Source: document 004, sections 2.1 and 2.2.3. Reads the rest pose alone. Positions
//! in the unit of the mesh.

use crate::groups::Groups;
use pelage_curves::{Vec2, Vec3};
use pelage_surface::{Mesh, RootFrame, SurfacePoint};

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

/// Puts the roots of `hairs`, which the sampler placed at `places`, into `roots`, and their
/// frames on `rest` into `frames`; both are emptied first.
pub(crate) fn roots(
    (hairs, places): (&[u64], &[SurfacePoint]),
    (rest, groups): (&Mesh, &Groups),
    roots: &mut Vec<Root>,
    frames: &mut Vec<RootFrame>,
) {
    frames.clear();
    rest.frames(places.iter().copied(), frames);
    roots.clear();
    let placed = hairs.iter().zip(places).zip(&*frames);
    roots.extend(placed.map(|((&hair, &place), frame)| {
        let uv = rest.uv(&place);
        Root {
            hair,
            place,
            rest: frame.position,
            uv,
            group: groups.at(uv),
        }
    }));
}
