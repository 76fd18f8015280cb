//! Hair as NumPy arrays: a `.npz` archive for `numpy.load`.
//!
//! | array | type | shape |
//! |---|---|---|
//! | `points` | f32 | n, 3 |
//! | `counts` | u32 | m: vertices of each strand, real ones only |
//! | `widths` | f32 | n: full diameters |
//! | `colors` | f32 | n, 3: linear RGB |
//! | `opacities` | f32 | n |
//! | `normals` | f32 | n, 3: unit curve normals |
//! | `hair_id` | u64 | m |
//! | `strand_id` | u32 | m |
//! | `root_uv`, `strand_uv` | f32 | m, 2 |
//! | `group`, `triangle` | u32 | m |
//! | `barycentric`, `root_rest` | f32 | m, 3 |
//!
//! Strands are written as they are: a root without hair is a strand of one vertex.
//! Attributes that the strands lack are left out. Where frames were announced,
//! `points` and `normals` are shaped frames, n, 3 and an array `frames` (f64) names
//! them; everything else is of the first frame, as it does not change.
//!
//! Arrays are stored uncompressed, in this order and with a fixed date: the same
//! strands make the same bytes, however they were cut into chunks.

use crate::AtomicFile;
use crate::columns::{Column, Content, Ends, Field, Scalar};
use crate::file_sink::{Stream, file_sink};
use crate::recorder::{Recorded, Recorder};
use crate::spool::reach;
use crate::stored_zip::StoredZip;
use crate::write::WriteOptions;
use pelage_strands::{Amount, StrandBuffer, StreamInfo};
use std::io;
use std::path::Path;

file_sink! {
    /// Writes hair as NumPy arrays (`.npz`): `points` and `counts`, `widths`,
    /// `colors`, `opacities`, `normals` one entry a vertex, and `hair_id`,
    /// `strand_id`, `root_uv`, `strand_uv`, `group`, `triangle`, `barycentric`,
    /// `root_rest` one a strand. For several frames `points` and `normals` get a
    /// leading axis, and `frames` names them.
    NpzWriter, Npz
}

const FIELDS: [(&str, Field); 14] = [
    ("points", Field::Points),
    ("counts", Field::Counts),
    ("widths", Field::Widths),
    ("colors", Field::Colors),
    ("opacities", Field::Opacities),
    ("normals", Field::Normals),
    ("hair_id", Field::HairId),
    ("strand_id", Field::StrandId),
    ("root_uv", Field::RootUv),
    ("strand_uv", Field::StrandUv),
    ("group", Field::Group),
    ("triangle", Field::Triangle),
    ("barycentric", Field::Barycentric),
    ("root_rest", Field::RootRest),
];

/// Name of a field's array.
fn name(field: Field) -> &'static str {
    let named = FIELDS.iter().find(|named| named.1 == field);
    named.map_or("", |named| named.0)
}

/// Name of the archive's entry for an array.
fn entry(array: &str) -> String {
    format!("{array}.npy")
}

#[derive(Debug)]
struct Npz {
    zip: StoredZip,
    recorder: Recorder,
    /// Frames that will come, at least one.
    frames: u64,
    is_laid_out: bool,
}

impl Stream for Npz {
    fn begin(path: &Path, _options: &WriteOptions, info: &StreamInfo) -> io::Result<Self> {
        let column = |(_, field)| Column::new(field, path).with_checksum();
        let recorder = Recorder::new(info, Ends::Real, FIELDS.map(column).into())?;
        Ok(Self {
            zip: StoredZip::new(AtomicFile::create(path)?)?,
            recorder,
            frames: info.frames.len().max(1) as u64,
            is_laid_out: false,
        })
    }

    fn begin_frame(&mut self) -> io::Result<()> {
        self.recorder.begin_frame()
    }

    fn write(&mut self, strands: &StrandBuffer) -> io::Result<()> {
        let Self { zip, frames, .. } = self;
        let is_laid_out = &mut self.is_laid_out;
        self.recorder.take(strands, |columns, most| {
            // The arrays hold all frames.
            if !std::mem::replace(is_laid_out, true) {
                reserve(zip, columns, most, *frames);
            }
        })?;
        Ok(())
    }

    fn end_frame(&mut self) -> io::Result<()> {
        self.recorder.end_frame().map(|_| ())
    }

    fn finish(self) -> io::Result<()> {
        let mut zip = self.zip;
        let Recorded {
            info,
            tally,
            columns,
            ..
        } = self.recorder.finish()?;
        let moving = |shape: &[u64]| match info.frames.len() as u64 {
            0 => shape.to_vec(),
            frames => [&[frames], shape].concat(),
        };
        for mut column in columns {
            let field = column.field;
            let Content::Values(spool) = column.finish() else {
                continue;
            };
            let (scalar, components) = field.element();
            let mut shape = vec![field.entries(tally.amount)];
            if components > 1 {
                shape.push(components as u64);
            }
            if field.moves() {
                shape = moving(&shape);
            }
            let header = npy_header(type_name(scalar), &shape);
            zip.add(&entry(name(field)), &header, spool)?;
        }
        if !info.frames.is_empty() {
            let mut array = npy_header("<f8", &[info.frames.len() as u64]);
            array.extend_from_slice(bytemuck::cast_slice(&info.frames));
            zip.add_bytes(&entry("frames"), &array)?;
        }
        zip.finish()?.commit()
    }
}

/// Lets `columns` grow where their arrays will be if each of `frames` frames brings
/// `most`. The first whose size is not known has the rest of the file.
fn reserve(zip: &StoredZip, columns: &mut [&mut Column], most: Option<Amount>, frames: u64) {
    let mut end = Some(zip.end());
    for column in columns {
        let Some(before) = end else {
            return;
        };
        let head = StoredZip::head_bytes(&entry(name(column.field))) + NPY_HEADER_BYTES as u64;
        let start = before + head;
        column.place(zip.handle(), start);
        let times = if column.field.moves() { frames } else { 1 };
        end = most.and_then(|most| reach(start, column.field.size(most)?.checked_mul(times)?));
    }
}

fn type_name(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::F32 => "<f4",
        Scalar::U32 => "<u4",
        Scalar::U64 => "<u8",
    }
}

/// Size of every header that we write, so that the place of an array is known before
/// its shape. Three 64-bit sizes fit.
const NPY_HEADER_BYTES: usize = 128;

/// Header of a `.npy` file, format 1.0, of an array in row-major order.
pub(crate) fn npy_header(type_name: &str, shape: &[u64]) -> Vec<u8> {
    let mut sizes: Vec<String> = shape.iter().map(u64::to_string).collect();
    if sizes.len() == 1 {
        // A Python tuple of one.
        sizes.push(String::new());
    }
    let description = format!(
        "{{'descr': '{type_name}', 'fortran_order': False, 'shape': ({}), }}",
        sizes.join(", ").trim_end_matches(' ')
    );
    let mut header = b"\x93NUMPY\x01\x00".to_vec();
    header.extend((NPY_HEADER_BYTES as u16 - 10).to_le_bytes());
    header.extend(description.as_bytes());
    header.resize(NPY_HEADER_BYTES - 1, b' ');
    header.push(b'\n');
    header
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_of_one_size_whatever_the_shape() {
        for shape in [&[3][..], &[u64::MAX, 3], &[u64::MAX, u64::MAX, 3]] {
            let header = npy_header("<f4", shape);
            assert_eq!(header.len(), NPY_HEADER_BYTES);
            let end = &header[header.len() - 2..];
            assert_eq!(end, b" \n", "{}", String::from_utf8_lossy(&header[10..]));
        }
        let header = npy_header("<u8", &[7]);
        let text = String::from_utf8_lossy(&header[10..]);
        assert_eq!(
            text.trim_end(),
            "{'descr': '<u8', 'fortran_order': False, 'shape': (7,), }"
        );
    }
}
