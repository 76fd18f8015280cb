//! Hair, and meshes, as a USD crate file (`.usdc`), version 0.8.0: every OpenUSD since 2019
//! reads it.
//!
//! Layout, offsets from the start of the file, all numbers little-endian:
//!
//! ```text
//! bootstrap   88 bytes: "PXR-USDC", version, offset of the table of contents
//! values      arrays and other values too large for a field, 8-byte aligned
//! sections    TOKENS STRINGS FIELDS FIELDSETS PATHS SPECS, small and compressed
//! contents    name, start and size of each section
//! ```
//!
//! Values come first, so arrays stream to the disk and the sections that point at
//! them follow once everything is known. Arrays are stored raw: float arrays do not
//! compress in this format, and integers one a hair are a small part.
//!
//! The layout was learnt from files that OpenUSD wrote and from its documentation;
//! every file of the tests is read back by OpenUSD.

mod attribute;
mod compress;
mod crate_file;
mod mesh;
mod sections;
mod value;
mod writer;

pub(crate) use mesh::write_mesh;
pub use writer::UsdcWriter;
pub(crate) use writer::{Beside, write_with};
