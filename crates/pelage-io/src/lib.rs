//! Files that hair, meshes and maps travel in; one module a format.
//!
//! Readers give plain data and never panic: whatever a file holds, the answer is
//! data or a [`ReadError`] that names the file, the place and what is allowed.
//! Writers are [`Sink`](pelage_strands::Sink)s that write beside their target and
//! rename into place, so that an old file stays whole until a new one is.

mod curves;
mod error;
mod strands_of;
mod usd;

pub use curves::{AttributeInfo, CurveFile, CurveSet};
pub use error::{Blame, ReadError};
pub use strands_of::strands_through_vertices;
pub use usd::{UsdMesh, read_usd_curves, read_usd_mesh, usd_mesh_frames};
