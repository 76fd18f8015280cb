//! A crate file in the making: the bootstrap and the values.

use super::sections::Sections;
use super::value::{Kind, ValueRep};
use crate::AtomicFile;
use crate::spool::{Spool, pour};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

/// Bytes before the first value.
const BOOTSTRAP_BYTES: u64 = 88;
/// Where in them the offset of the table of contents stands.
const CONTENTS_AT: u64 = 16;
/// The oldest version with 64-bit array counts and all else that we write; older
/// programs read it too.
const VERSION: [u8; 8] = [0, 8, 0, 0, 0, 0, 0, 0];

#[derive(Debug)]
pub(super) struct CrateFile {
    out: AtomicFile,
    /// Bytes written, which is the offset of the next one.
    at: u64,
}

impl CrateFile {
    /// Starts the file that will be `path`.
    pub(super) fn create(path: &Path) -> io::Result<Self> {
        let mut file = Self {
            out: AtomicFile::create(path)?,
            at: 0,
        };
        file.put(b"PXR-USDC")?;
        file.put(&VERSION)?;
        file.put(&[0; BOOTSTRAP_BYTES as usize - 16])?;
        Ok(file)
    }

    /// Adds bytes at the end.
    pub(super) fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.out.write_all(bytes)?;
        self.at += bytes.len() as u64;
        Ok(())
    }

    fn put_u64(&mut self, value: u64) -> io::Result<()> {
        self.put(&value.to_le_bytes())
    }

    /// Pads to a multiple of 8 bytes, so that arrays can be read in place from a
    /// mapped file; gives the offset reached.
    fn align(&mut self) -> io::Result<u64> {
        let padding = self.at.next_multiple_of(8) - self.at;
        self.put(&[0; 8][..padding as usize])?;
        Ok(self.at)
    }

    fn patch(&mut self, offset: u64, value: u64) -> io::Result<()> {
        self.out.seek(SeekFrom::Start(offset))?;
        self.out.write_all(&value.to_le_bytes())?;
        self.out.seek(SeekFrom::Start(self.at))?;
        Ok(())
    }

    /// Starts an array whose count is not known yet; gives its offset. Its entries
    /// follow through [`put`](Self::put).
    pub(super) fn begin_array(&mut self) -> io::Result<u64> {
        let offset = self.align()?;
        self.put_u64(0)?;
        Ok(offset)
    }

    /// Ends the array at `offset`, which has got `count` entries.
    pub(super) fn end_array(
        &mut self,
        offset: u64,
        kind: Kind,
        count: u64,
    ) -> io::Result<ValueRep> {
        if count == 0 {
            return Ok(ValueRep::array(kind, 0));
        }
        self.patch(offset, count)?;
        Ok(ValueRep::array(kind, offset))
    }

    /// Writes an array of raw entries.
    pub(super) fn array(&mut self, kind: Kind, count: u64, raw: &[u8]) -> io::Result<ValueRep> {
        self.array_from(kind, count, raw.len() as u64, &mut io::Cursor::new(raw))
    }

    /// Writes an array of all entries of `spool`.
    pub(super) fn array_of(
        &mut self,
        kind: Kind,
        count: u64,
        spool: Spool,
    ) -> io::Result<ValueRep> {
        let bytes = spool.bytes();
        self.array_from(kind, count, bytes, &mut spool.into_reader()?)
    }

    /// Writes an array of the next `bytes` bytes of `from`.
    pub(super) fn array_from(
        &mut self,
        kind: Kind,
        count: u64,
        bytes: u64,
        from: &mut impl io::Read,
    ) -> io::Result<ValueRep> {
        if count == 0 {
            return Ok(ValueRep::array(kind, 0));
        }
        let offset = self.align()?;
        self.put_u64(count)?;
        pour(from, bytes, &mut self.out)?;
        self.at += bytes;
        Ok(ValueRep::array(kind, offset))
    }

    /// Writes a number; those that an f32 holds exactly need no room.
    pub(super) fn double(&mut self, value: f64) -> io::Result<ValueRep> {
        let short = value as f32;
        if f64::from(short) == value {
            return Ok(ValueRep::inlined(Kind::Double, short.to_bits()));
        }
        let offset = self.align()?;
        self.put(&value.to_le_bytes())?;
        Ok(ValueRep::at(Kind::Double, offset))
    }

    /// Writes a list of tokens, given by their indices.
    pub(super) fn tokens(&mut self, tokens: &[u32]) -> io::Result<ValueRep> {
        let offset = self.align()?;
        self.put_u64(tokens.len() as u64)?;
        self.put(bytemuck::cast_slice(tokens))?;
        Ok(ValueRep::at(Kind::TokenVector, offset))
    }

    /// Writes the times of samples.
    pub(super) fn times(&mut self, times: &[f64]) -> io::Result<ValueRep> {
        let offset = self.align()?;
        self.put_u64(times.len() as u64)?;
        self.put(bytemuck::cast_slice(times))?;
        Ok(ValueRep::at(Kind::DoubleVector, offset))
    }

    /// Writes samples: `values`, one a time of `times`.
    ///
    /// Both parts start with a distance to what they speak of, which lets writers
    /// put nested values in between; ours are written before, so it is 8, the size
    /// of the distance itself.
    pub(super) fn samples(&mut self, times: ValueRep, values: &[ValueRep]) -> io::Result<ValueRep> {
        let offset = self.align()?;
        self.put_u64(8)?;
        self.put_u64(times.0)?;
        self.put_u64(8)?;
        self.put_u64(values.len() as u64)?;
        for value in values {
            self.put_u64(value.0)?;
        }
        Ok(ValueRep::at(Kind::TimeSamples, offset))
    }

    /// Writes the sections and their table of contents, and gives the file its name.
    pub(super) fn finish(mut self, sections: &Sections) -> io::Result<()> {
        let mut contents = Vec::new();
        for (name, bytes) in sections.encode()? {
            let start = self.align()?;
            self.put(&bytes)?;
            let mut padded = [0; 16];
            padded[..name.len()].copy_from_slice(name.as_bytes());
            contents.extend(padded);
            contents.extend(start.to_le_bytes());
            contents.extend((bytes.len() as u64).to_le_bytes());
        }
        let start = self.align()?;
        self.put_u64(contents.len() as u64 / 32)?;
        self.put(&contents)?;
        self.patch(CONTENTS_AT, start)?;
        self.out.commit()
    }
}
