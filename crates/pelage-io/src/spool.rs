//! Bytes that wait for their place in a file.
//!
//! A streaming writer gets all attributes of a chunk at once, while files want one
//! array after another. All arrays but the first therefore wait in a spool each:
//! a block of memory, and an unnamed temporary file beside the target as soon as
//! the block is full. Small grooms never touch the disk twice; large ones never
//! grow in memory.

use std::fs::File;
use std::io::{self, Cursor, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Bytes a spool keeps in memory. A writer holds a dozen spools; with this, few MB.
const BLOCK_BYTES: usize = 1 << 18;

/// A growing run of bytes, read once from its start.
#[derive(Debug)]
pub(crate) struct Spool {
    folder: PathBuf,
    file: Option<File>,
    block: Vec<u8>,
    bytes: u64,
}

impl Spool {
    /// An empty spool whose temporary file would lie in the folder of `target`.
    pub(crate) fn beside(target: &Path) -> Self {
        let folder = match target.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        Self {
            folder: folder.into(),
            file: None,
            block: Vec::new(),
            bytes: 0,
        }
    }

    /// Bytes put in so far.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Adds `bytes` at the end.
    pub(crate) fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.bytes += bytes.len() as u64;
        if self.block.len() + bytes.len() <= BLOCK_BYTES {
            self.block.extend_from_slice(bytes);
            return Ok(());
        }
        if self.file.is_none() {
            self.file = Some(tempfile::tempfile_in(&self.folder)?);
        }
        if let Some(file) = &mut self.file {
            file.write_all(&self.block)?;
            file.write_all(bytes)?;
        }
        self.block.clear();
        Ok(())
    }

    /// All bytes, from the first.
    pub(crate) fn into_reader(self) -> io::Result<impl Read> {
        let mut file = self.file;
        if let Some(file) = &mut file {
            file.seek(SeekFrom::Start(0))?;
        }
        let on_disk: Box<dyn Read> = match file {
            Some(file) => Box::new(file),
            None => Box::new(io::empty()),
        };
        Ok(on_disk.chain(Cursor::new(self.block)))
    }
}

/// Bytes copied at a time: a multiple of every entry's size (4, 8 and 12), so that
/// pieces hold whole entries.
const POUR_BYTES: u64 = 24 * 10_000;

/// Copies exactly `bytes` bytes; fails where `from` holds fewer.
pub(crate) fn pour(from: &mut impl Read, bytes: u64, into: &mut impl Write) -> io::Result<()> {
    let mut block = vec![0; POUR_BYTES.min(bytes) as usize];
    let mut left = bytes;
    while left > 0 {
        let now = (left.min(block.len() as u64)) as usize;
        from.read_exact(&mut block[..now])?;
        into.write_all(&block[..now])?;
        left -= now as u64;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_put_in_comes_out_whether_it_fits_memory_or_not() {
        let folder = tempfile::tempdir().unwrap();
        for (pieces, length) in [(0, 0), (3, 5), (1, BLOCK_BYTES + 1), (700, 1000)] {
            let mut spool = Spool::beside(&folder.path().join("x"));
            let mut expected = Vec::new();
            for piece in 0..pieces {
                let bytes = vec![piece as u8; length];
                spool.put(&bytes).unwrap();
                expected.extend(bytes);
            }
            assert_eq!(spool.bytes(), expected.len() as u64);
            let mut found = Vec::new();
            let mut reader = spool.into_reader().unwrap();
            pour(&mut reader, expected.len() as u64, &mut found).unwrap();
            assert!(found == expected);
            assert!(pour(&mut reader, 1, &mut found).is_err());
        }
    }
}
