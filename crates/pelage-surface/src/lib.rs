//! Surfaces that grow hair: triangle meshes at rest and posed, image maps, places
//! on a surface, and roots sampled by density.

mod closest;
mod frame;
mod image_map;
mod mesh;
mod normals;
mod tangents;
mod triangulate;

pub use closest::ClosestPoint;
pub use frame::{RootFrame, SurfacePoint};
pub use image_map::{ImageMap, MapError, Wrap, linear_from_srgb, srgb_from_linear};
pub use mesh::{Mesh, MeshError, PolygonMesh};
