//! Files that hair, meshes and maps travel in; one module a format.
//!
//! Readers give plain data and never panic: whatever a file holds, the answer is
//! data or a [`ReadError`] that names the file, the place and what is allowed.
//! Writers are [`Sink`](pelage_strands::Sink)s that write beside their target and
//! rename into place, so that an old file stays whole until a new one is.

mod curves;
mod error;
mod inspect;
mod inspect_mesh;
mod layout;
mod npz;
mod read;
mod strands_of;
mod usd;

pub use curves::{AttributeInfo, CurveFile, CurveSet};
pub use error::{Blame, ReadError};
pub use inspect::{AttributeReport, CurveReport, Inspection, Problem, Span, inspect};
pub use inspect_mesh::MeshReport;
pub use npz::read_npz_curves;
pub use read::{FileKind, MeshFile, mesh_frames, read_curves, read_mesh, sniff};
pub use strands_of::strands_through_vertices;
pub use usd::{read_usd_curves, read_usd_mesh, usd_mesh_frames};
