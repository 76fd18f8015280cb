//! Files that hair, meshes and maps travel in; one module a format.
//!
//! Readers give plain data and never panic: whatever a file holds, the answer is
//! data or a [`ReadError`] that names the file, the place and what is allowed.
//! Writers are [`Sink`](pelage_strands::Sink)s that write beside their target and
//! rename into place, so that an old file stays whole until a new one is.

mod atomic;
mod columns;
mod curves;
mod drawable;
mod error;
mod file_sink;
mod frame_path;
mod hair_prim;
mod npz_write;
mod recorder;
mod rib;
mod spool;
mod stored_zip;
mod text_array;
mod text_numbers;
mod usda;
mod usdc;
mod write;

pub use atomic::AtomicFile;
pub use curves::{AttributeInfo, CurveFile, CurveSet};
pub use error::{Blame, ReadError};
pub use npz_write::NpzWriter;
pub use rib::RibWriter;
pub use usda::UsdaWriter;
pub use usdc::UsdcWriter;
pub use write::{WRITABLE, WriteOptions, sink_for};
