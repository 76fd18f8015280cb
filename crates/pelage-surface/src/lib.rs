//! Surfaces that grow hair: triangle meshes at rest and posed, image maps, places
//! on a surface, and roots sampled by density.

mod along_surface;
mod blue_noise;
mod bulk;
mod closest;
mod cut;
mod density;
mod displacement;
mod distribution;
mod drawing;
#[cfg(test)]
mod fixture;
mod frame;
mod frames;
mod grid;
mod hilbert;
mod image_map;
mod interval;
mod lanes;
mod mesh;
mod neighbours;
mod normals;
mod pages;
mod part;
mod pdf;
mod pieces;
pub mod quality;
mod runs;
mod sampler;
mod scramble;
mod sequence;
mod sheet;
mod subdivide;
mod sums;
mod tangents;
mod texels;
mod tiles;
mod triangle_order;
mod triangulate;
mod voxels;
mod window;

pub use along_surface::AlongSurface;
pub use blue_noise::BlueNoise;
pub use closest::ClosestPoint;
pub use density::Density;
pub use displacement::Displacement;
pub use distribution::{Distribution, Pick};
pub use frame::{RootFrame, SurfacePoint};
pub use image_map::{ImageMap, MapError, Wrap, linear_from_srgb, srgb_from_linear};
pub use mesh::{Mesh, MeshError, PolygonMesh};
pub use pdf::RootPdf;
pub use sampler::RootSampler;
pub use sequence::{RootSequence, Spread, hash, radical_inverse};
pub use texels::{Codes, Texels};
pub use tiles::{TiledDensity, Tiles, tile_number};
pub use voxels::VoxelRoots;
