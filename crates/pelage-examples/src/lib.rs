//! Example grooms made by our own code: meshes, maps, guides and recipes, without
//! a downloaded asset.
//!
//! Everything is computed in f64 with `libm`'s functions and hashes instead of
//! random generators, so that each byte is the same on every machine.

mod animal;
mod ball;
mod charts;
mod cyclone;
mod example;
mod files;
mod flatten;
mod grass;
mod grow;
mod hash;
mod head;
#[cfg(test)]
mod laws;
mod lift;
mod model;
mod obj;
mod pack;
mod polygonise;
mod raster;
mod relax;
mod scatter;
mod sdf;
mod sheet;
mod tree;
mod untangle;
mod usda;

pub use example::{Example, example, names};
pub use files::write;
