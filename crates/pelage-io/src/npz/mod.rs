//! NumPy archives: strands as named arrays.

mod frames;
mod read;
mod write;

pub use read::read_npz_curves;
pub(crate) use read::read_super_helices;
pub use write::NpzWriter;
pub(crate) use write::npy_header;
