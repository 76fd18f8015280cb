//! A crate file in the making: the bootstrap and the values.

use super::sections::Sections;
use super::value::{Kind, ValueRep};
use crate::AtomicFile;
use crate::columns::Column;
use crate::spool::{Spool, reach};
use pelage_strands::Amount;
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;
use std::sync::Arc;

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
    /// The same file, for columns.
    handle: Arc<File>,
    /// Bytes written, which is the offset of the next one.
    at: u64,
}

impl CrateFile {
    /// Starts the file that will be `path`.
    pub(super) fn create(path: &Path) -> io::Result<Self> {
        let out = AtomicFile::create(path)?;
        let handle = out.handle()?;
        let mut file = Self { out, handle, at: 0 };
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

    /// Lets `columns` grow where their arrays will be if each comes to `most`. The
    /// first whose size is not known has the rest of the file; those behind it stay
    /// where they are.
    pub(super) fn reserve(&self, columns: &mut [&mut Column], most: Option<Amount>) {
        let mut end = Some(self.at);
        for column in columns {
            let Some(start) = end.map(|end| end.next_multiple_of(8) + 8) else {
                return;
            };
            column.place(&self.handle, start);
            end = most.and_then(|most| reach(start, column.field.size(most)?));
        }
    }

    /// Writes an array of raw entries.
    pub(super) fn array(&mut self, kind: Kind, count: u64, raw: &[u8]) -> io::Result<ValueRep> {
        if count == 0 {
            return Ok(ValueRep::array(kind, 0));
        }
        let offset = self.align()?;
        self.put_u64(count)?;
        self.put(raw)?;
        Ok(ValueRep::array(kind, offset))
    }

    /// Writes an array of all entries of `spool`. Spools with a place come in the
    /// order of their places.
    pub(super) fn array_of(
        &mut self,
        kind: Kind,
        count: u64,
        spool: Spool,
    ) -> io::Result<ValueRep> {
        let offset = self.array(kind, count, &[])?;
        let bytes = spool.bytes();
        spool.settle(&mut self.out, self.at)?;
        self.at += bytes;
        Ok(offset)
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
    fn tokens(&mut self, tokens: &[u32]) -> io::Result<ValueRep> {
        let offset = self.align()?;
        self.put_u64(tokens.len() as u64)?;
        self.put(bytemuck::cast_slice(tokens))?;
        Ok(ValueRep::at(Kind::TokenVector, offset))
    }

    /// Writes a list of names.
    pub(super) fn names(
        &mut self,
        sections: &mut Sections,
        names: &[&str],
    ) -> io::Result<ValueRep> {
        let tokens: Vec<u32> = names.iter().map(|name| sections.token(name)).collect();
        self.tokens(&tokens)
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
        self.out.end_at(self.at)?;
        self.out.seek(SeekFrom::Start(CONTENTS_AT))?;
        self.out.write_all(&start.to_le_bytes())?;
        self.out.commit()
    }
}
