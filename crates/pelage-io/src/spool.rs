//! Bytes that wait for their place in a file, or grow there.
//!
//! A streaming writer gets all attributes of a chunk at once, while files want one
//! array after another. Each array therefore has a spool: a block of memory, and a
//! file that the block is emptied into whenever it is full. Where the stream said how
//! much will come, that file is the target, and the place in it the one that the array
//! has if as much comes: then nothing is left to move in the end. Where less came, the
//! arrays close up; where nothing was said, they wait in unnamed files beside the
//! target. Small grooms never leave the block; large ones never grow in memory.

use crate::AtomicFile;
use crate::positional::{ReadFrom, write_at};
use crc32fast::Hasher;
use std::fs::File;
use std::io::{self, Cursor, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Bytes a spool keeps in memory. A writer holds a dozen spools; with this, few MB.
const BLOCK_BYTES: usize = 1 << 18;

/// A growing run of bytes.
#[derive(Debug)]
pub(crate) struct Spool {
    home: Home,
    /// Bytes in the file of `home`.
    written: u64,
    /// The bytes behind those.
    block: Vec<u8>,
    checksum: Option<Hasher>,
}

/// Where full blocks go.
#[derive(Debug)]
enum Home {
    /// Into an unnamed file in this folder, once there is one.
    Beside(PathBuf),
    Unnamed(Arc<File>),
    /// Into the target, from this offset on.
    Target(Arc<File>, u64),
}

impl Spool {
    /// An empty spool whose temporary file would lie in the folder of `target`.
    pub(crate) fn beside(target: &Path) -> Self {
        let folder = match target.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        Self {
            home: Home::Beside(folder.into()),
            written: 0,
            block: Vec::new(),
            checksum: None,
        }
    }

    /// Keeps the CRC-32 of what is put in.
    pub(crate) fn with_checksum(mut self) -> Self {
        self.checksum = Some(Hasher::new());
        self
    }

    /// Lets this spool, empty still, grow in `target` from `start` on.
    pub(crate) fn place(&mut self, target: &Arc<File>, start: u64) {
        debug_assert_eq!(self.bytes(), 0, "what is spooled already would be lost");
        self.home = Home::Target(target.clone(), start);
    }

    /// Bytes put in so far.
    pub(crate) fn bytes(&self) -> u64 {
        self.written + self.block.len() as u64
    }

    /// CRC-32 of the bytes put in so far, where it was asked for.
    pub(crate) fn checksum(&self) -> Option<&Hasher> {
        self.checksum.as_ref()
    }

    /// Adds `bytes` at the end.
    pub(crate) fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        if let Some(checksum) = &mut self.checksum {
            checksum.update(bytes);
        }
        if self.block.len() + bytes.len() > BLOCK_BYTES {
            self.empty_block()?;
        }
        if bytes.len() > BLOCK_BYTES {
            return self.write(bytes);
        }
        self.block.extend_from_slice(bytes);
        Ok(())
    }

    fn empty_block(&mut self) -> io::Result<()> {
        let mut block = std::mem::take(&mut self.block);
        self.write(&block)?;
        block.clear();
        self.block = block;
        Ok(())
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        if let Home::Beside(folder) = &self.home {
            self.home = Home::Unnamed(Arc::new(tempfile::tempfile_in(folder)?));
        }
        match &self.home {
            Home::Target(file, start) => write_at(file, bytes, start + self.written)?,
            Home::Unnamed(file) => write_at(file, bytes, self.written)?,
            Home::Beside(_) => {}
        }
        self.written += bytes.len() as u64;
        Ok(())
    }

    /// All bytes, from the first.
    pub(crate) fn into_reader(self) -> impl Read {
        let (file, offset) = match self.home {
            Home::Target(file, start) => (Some(file), start),
            Home::Unnamed(file) => (Some(file), 0),
            Home::Beside(_) => (None, 0),
        };
        let on_disk = file.map(|file| ReadFrom { file, offset }.take(self.written));
        let on_disk: Box<dyn Read> = match on_disk {
            Some(on_disk) => Box::new(on_disk),
            None => Box::new(io::empty()),
        };
        on_disk.chain(Cursor::new(self.block))
    }

    /// Brings all bytes to `offset` of `target`, which is where `target` writes next,
    /// and leaves it writing behind them.
    ///
    /// Bytes that stand there already are not touched. Others in the same file must
    /// stand further on: they are read before they are written over.
    pub(crate) fn settle(mut self, target: &mut AtomicFile, offset: u64) -> io::Result<()> {
        match self.home {
            Home::Target(_, start) if start == offset => {
                self.empty_block()?;
                target.seek(SeekFrom::Start(offset + self.written))?;
                Ok(())
            }
            Home::Target(_, start) if start < offset => Err(io::Error::other(
                "arrays overlap: this is a mistake of ours",
            )),
            _ => {
                let bytes = self.bytes();
                pour(&mut self.into_reader(), bytes, target)
            }
        }
    }
}

/// Where an array of `size` bytes that starts at `start` ends; `None` where files
/// should not reach. An announcement may be far above what comes, and file systems
/// refuse to write far behind the largest size that they take, though little is there.
pub(crate) fn reach(start: u64, size: u64) -> Option<u64> {
    let end = start.checked_add(size)?;
    (end <= LARGEST).then_some(end)
}

/// 1 TiB.
const LARGEST: u64 = 1 << 40;

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

    /// Pieces of every kind: none, small ones, one that passes a block, many.
    const PIECES: [(usize, usize); 4] = [(0, 0), (3, 5), (1, BLOCK_BYTES + 1), (700, 1000)];

    fn fill(spool: &mut Spool, (pieces, length): (usize, usize)) -> Vec<u8> {
        let mut expected = Vec::new();
        for piece in 0..pieces {
            let bytes = vec![piece as u8; length];
            spool.put(&bytes).unwrap();
            expected.extend(bytes);
        }
        assert_eq!(spool.bytes(), expected.len() as u64);
        expected
    }

    #[test]
    fn what_was_put_in_comes_out_whether_it_fits_memory_or_not() {
        let folder = tempfile::tempdir().unwrap();
        for pieces in PIECES {
            let mut spool = Spool::beside(&folder.path().join("x"));
            let expected = fill(&mut spool, pieces);
            let mut found = Vec::new();
            let mut reader = spool.into_reader();
            pour(&mut reader, expected.len() as u64, &mut found).unwrap();
            assert!(found == expected);
            assert!(pour(&mut reader, 1, &mut found).is_err());
        }
    }

    #[test]
    fn bytes_settle_in_the_target_wherever_they_grew() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x");
        for pieces in PIECES {
            for place in [None, Some(4), Some(5), Some(300_000)] {
                let mut file = AtomicFile::create(&path).unwrap();
                file.write_all(b"head").unwrap();
                let mut spool = Spool::beside(&path).with_checksum();
                if let Some(start) = place {
                    spool.place(&file.handle().unwrap(), start);
                }
                let expected = fill(&mut spool, pieces);
                let checksum = spool.checksum().unwrap().clone().finalize();
                assert_eq!(checksum, crc32fast::hash(&expected));
                spool.settle(&mut file, 4).unwrap();
                file.write_all(b"tail").unwrap();
                file.end_at(expected.len() as u64 + 8).unwrap();
                file.commit().unwrap();
                let found = std::fs::read(&path).unwrap();
                assert!(found == [b"head", &expected[..], b"tail"].concat());
            }
        }
    }
}
