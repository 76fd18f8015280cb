//! Reading and writing at a place of a file without moving its cursor, so that
//! several writers can share one file.

use std::fs::File;
use std::io::{self, Read};
use std::sync::Arc;

/// Writes all `bytes` at `offset`.
#[cfg(unix)]
pub(crate) fn write_at(file: &File, bytes: &[u8], offset: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::write_all_at(file, bytes, offset)
}

#[cfg(unix)]
fn read_at(file: &File, bytes: &mut [u8], offset: u64) -> io::Result<usize> {
    std::os::unix::fs::FileExt::read_at(file, bytes, offset)
}

/// Writes all `bytes` at `offset`.
#[cfg(not(unix))]
pub(crate) fn write_at(file: &File, bytes: &[u8], offset: u64) -> io::Result<()> {
    elsewhere(file, offset, |mut file| {
        io::Write::write_all(&mut file, bytes)
    })
}

#[cfg(not(unix))]
fn read_at(file: &File, bytes: &mut [u8], offset: u64) -> io::Result<usize> {
    elsewhere(file, offset, |mut file| file.read(bytes))
}

/// Takes the cursor to `offset` for `work`, and back.
#[cfg(not(unix))]
fn elsewhere<T>(
    mut file: &File,
    offset: u64,
    work: impl FnOnce(&File) -> io::Result<T>,
) -> io::Result<T> {
    use std::io::{Seek, SeekFrom};
    let before = file.stream_position()?;
    file.seek(SeekFrom::Start(offset))?;
    let done = work(file);
    file.seek(SeekFrom::Start(before))?;
    done
}

/// The bytes of a file from a place on.
pub(crate) struct ReadFrom {
    pub(crate) file: Arc<File>,
    pub(crate) offset: u64,
}

impl Read for ReadFrom {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = read_at(&self.file, bytes, self.offset)?;
        self.offset += read as u64;
        Ok(read)
    }
}
