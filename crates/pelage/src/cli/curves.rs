//! Every curve of a file.

use anyhow::Result;
use pelage::StrandBuffer;
use pelage::io::{CurveFile, read_curves, strands_through_vertices};
use pelage::strands::UpAxis;
use std::path::Path;

/// The curves of the file `path` at `time`, through their vertices, and the axis that points
/// up in it if it says.
pub fn read(path: &Path, time: Option<f64>) -> Result<(StrandBuffer, Option<UpAxis>)> {
    let file = read_curves(path, time)?;
    Ok((of(&file), file.up_axis))
}

/// The curves of all sets of `file`, through their vertices.
pub fn of(file: &CurveFile) -> StrandBuffer {
    let mut strands = StrandBuffer::new();
    let sets = file.sets.iter().map(strands_through_vertices);
    sets.for_each(|set| strands.append(&set));
    strands
}
