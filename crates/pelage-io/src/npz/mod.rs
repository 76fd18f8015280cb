//! NumPy archives: strands as named arrays.

mod frames;
mod read;
mod write;

pub use read::read_npz_curves;
pub use write::NpzWriter;
