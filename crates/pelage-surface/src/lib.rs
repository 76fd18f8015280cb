//! Surfaces that grow hair: triangle meshes at rest and posed, and image maps.

mod image_map;
mod mesh;

pub use image_map::{ImageMap, MapError, Wrap};
pub use mesh::{Mesh, MeshError, PolygonMesh};
