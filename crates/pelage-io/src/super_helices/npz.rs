//! The NumPy form: the arrays under their names, and nothing else.

use super::SuperHelices;
use super::arrays::Entries;
use crate::AtomicFile;
use crate::npz::npy_header;
use crate::stored_zip::StoredZip;
use std::io;
use std::path::Path;

pub(super) fn write(path: &Path, strands: &SuperHelices) -> io::Result<()> {
    let mut zip = StoredZip::new(AtomicFile::create(path)?)?;
    for (name, entries) in strands.arrays() {
        let count = entries.len() as u64;
        let mut array = match &entries {
            Entries::Counts(_) => npy_header("<u4", &[count]),
            Entries::Vectors(_) => npy_header("<f4", &[count, 3]),
            Entries::Numbers(_) => npy_header("<f4", &[count]),
        };
        array.extend_from_slice(entries.raw());
        zip.add_bytes(&format!("{name}.npy"), &array)?;
    }
    zip.finish()?.commit()
}
