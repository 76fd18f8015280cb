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
mod gltf;
mod gltf_buffers;
mod hair;
mod hair_prim;
mod image;
mod image_exr;
#[cfg(test)]
mod image_tests;
mod image_tiff;
mod image_write;
mod inspect;
mod inspect_mesh;
mod layout;
mod mesh_write;
mod npz;
mod obj;
mod ply;
mod ply_points;
mod positional;
mod read;
mod recorder;
mod rib;
mod source;
mod spool;
mod stored_zip;
mod strands_of;
mod super_helices;
mod text_array;
mod text_numbers;
mod usd;
mod usda;
mod usdc;
mod write;

pub use self::gltf::{parse_gltf_mesh, read_gltf_mesh};
pub use self::image::{parse_image, read_image};
pub use atomic::AtomicFile;
pub use curves::{AttributeInfo, CurveFile, CurveSet};
pub use error::{Blame, ReadError};
pub use hair::{parse_hair, read_hair};
pub use image_write::{PngCodes, write_exr, write_png};
pub use inspect::{AttributeReport, CurveReport, Inspection, Problem, Span, inspect};
pub use inspect_mesh::MeshReport;
pub use mesh_write::{MESH_EXTENSIONS, Triangles, write_mesh};
pub use npz::NpzWriter;
pub use npz::read_npz_curves;
pub use obj::{parse_obj_curves, parse_obj_mesh, read_obj_curves, read_obj_mesh};
pub use ply::{parse_ply_mesh, read_ply_mesh};
pub use ply_points::PlyRootsWriter;
pub use read::{FileKind, MeshFile, mesh_frames, read_curves, read_mesh, sniff};
pub use rib::RibWriter;
pub use strands_of::strands_through_vertices;
pub use super_helices::{
    SUPER_HELIX_EXTENSIONS, SuperHelices, parse_super_helices, read_super_helices,
    write_super_helices,
};
pub use usd::{read_usd_curves, read_usd_mesh, usd_mesh_frames};
pub use usda::UsdaWriter;
pub use usdc::UsdcWriter;
pub use write::{ROOTS_WRITABLE, WRITABLE, WriteOptions, root_sink_for, sink_for};
